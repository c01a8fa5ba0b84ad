"""Starts the programs that play the nodes of a site, hands faults to them, and ends them all.

Each node is a process of its own. A node whose input ends leaves by itself, so no node outlives the
program that has started it.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from time import monotonic

from smsl_studio.blueprint.address import fact_text
from smsl_studio.errors import PluginError, UsageError, did_you_mean
from smsl_studio.front.sites.site_file import Site, SiteNode, read_site
from smsl_studio.host.started_child import environment_of_child
from smsl_studio.shipped import samples_dir

LEAVE = 3.0
"""The time (s) that a node has to say that it goes. Then it is ended."""
LOOK = 0.05
LONGEST = 500
"""The longest line of a node that is told, in characters."""
_PROGRAM = re.compile(r"[A-Za-z0-9_]{1,60}\.py")

Tell = Callable[[str, str], None]
"""Called with the name of a node and a line that it has said. Any thread may call it."""


class NodePrograms:
    """The running programs of a site."""

    def __init__(self, site: Site, broker: str, tell: Tell) -> None:
        self.site, self._broker, self._tell = site, broker, tell
        self._running: dict[str, subprocess.Popen[str]] = {}
        self._threads: list[threading.Thread] = []
        self._programs = {name: program_of(site, name) for name in site.nodes}

    def start(self, faults: Sequence[tuple[str, str]] = ()) -> None:
        """Start every node, with the faults that are on from the beginning: node and fault."""
        for name, _ in faults:
            self._known(name)
        for name, node in self.site.nodes.items():
            own = [fault for who, fault in faults if who == name]
            process = subprocess.Popen(
                self._command(name, node, own),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                env=environment_of_child(),
                text=True,
                errors="replace",
            )
            self._running[name] = process
            thread = threading.Thread(target=self._hear, args=(name, process), daemon=True)
            thread.start()
            self._threads.append(thread)

    def say(self, name: str, fault: str) -> None:
        """Switch a fault of a node on, or all of them off with ``good``. UsageError if there is no
        such node."""
        self._known(name)
        process = self._running.get(name)
        if process is None or process.stdin is None or process.poll() is not None:
            self._tell(name, "it is not running")
            return
        with suppress(OSError):
            process.stdin.write(f"{fault}\n")
            process.stdin.flush()

    @property
    def running(self) -> bool:
        """Whether a node is still running."""
        return any(process.poll() is None for process in self._running.values())

    def end(self) -> None:
        """End all nodes: each may say that it goes. A second call does nothing."""
        running, self._running = self._running, {}
        for process in running.values():
            if process.stdin is not None:
                with suppress(OSError):
                    process.stdin.close()
        until = monotonic() + LEAVE
        for process in running.values():
            try:
                process.wait(max(0.0, until - monotonic()))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        for thread in self._threads:
            thread.join(LEAVE)
        for process in running.values():
            if process.stdout is not None:
                process.stdout.close()

    def _hear(self, name: str, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        with suppress(ValueError, OSError):
            while line := process.stdout.readline(LONGEST):
                if line.strip():
                    self._tell(name, line.strip())
        status = process.wait()
        if status:
            self._tell(name, f"ended with {status}")

    def _known(self, name: str) -> None:
        if name not in self.site.nodes:
            advice = did_you_mean(name, self.site.nodes) or f"There are {_names(self.site)}."
            raise UsageError(f"the site has no node {name!r}", advice=advice)

    def _command(self, name: str, node: SiteNode, faults: Sequence[str]) -> list[str]:
        site = self.site
        words = ["--broker", self._broker, "--site", site.name, "--run", site.run]
        words += ["--node", name, "--rate", f"{node.rate:g}"]
        login = site.folder / "keys" / f"{name}.toml"
        if os.path.lexists(login):
            words += ["--login", str(login)]
        words += [f"--source={one}" for one in _sources(node)]
        for other, victim in site.nodes.items():
            if other != name and victim.sources:
                words += ["--victim", other, *(f"--foreign={one}" for one in _sources(victim))]
                break
        words += [f"--fault={fault}" for fault in faults]
        return [sys.executable, str(self._programs[name]), *words]


def open_nodes(folder: str | os.PathLike[str], broker: str, tell: Tell) -> NodePrograms:
    """Read the site in a folder. Nothing is started yet.

    UsageError if the address of the broker makes no sense, PluginError if the site file is not
    valid or names a program that does not exist.

    >>> from smsl_studio.shipped import samples_dir
    >>> nodes = open_nodes(samples_dir() / "nodes", "localhost:1883", print)
    >>> len(nodes.site.nodes)
    8
    """
    from smsl_studio.monitor.mqtt import host_and_port

    host_and_port(broker)
    return NodePrograms(read_site(Path(folder).absolute()), broker, tell)


def program_of(site: Site, name: str) -> Path:
    """Return the program that plays a node: of the site's folder, else of the sample site."""
    program = site.nodes[name].program
    place = site.place(name)
    if not _PROGRAM.fullmatch(program):
        words = f"{name} names no program" if not program else f"{program!r} is no program's name"
        raise PluginError(words, place, 'Write program = "NAME.py", a file beside the site file.')
    for folder in (site.folder, samples_dir() / "nodes"):
        if (folder / program).is_file():
            return folder / program
    raise PluginError(f"there is no {program} beside the site file", place, "Write one there.")


def _sources(node: SiteNode) -> list[str]:
    return [f"{fact_text(branch, digit)}:{source}" for branch, digit, source in node.sources]


def _names(site: Site) -> str:
    return ", ".join(site.nodes)
