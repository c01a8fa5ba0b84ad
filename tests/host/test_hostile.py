"""Hostile library code ends its run at most, and never the process of the dispatcher."""

from __future__ import annotations

import os
import re
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import HostError, StudioError
from smsl_studio.front.runs import run
from smsl_studio.host.local import LocalHost
from smsl_studio.host.process import ChildTerms, ProcessHost
from smsl_studio.host.protocol import Host, Outcome, Tick
from tests.plugin_folder import LAMP, blueprint_of, write_plugin

START = {"LAMP": "State_0"}
ON = Address("LAMP", "State_0", "Op_on")

PLUGIN = """
import ctypes, os, signal, stat, threading, time
import numpy
from smsl_studio.errors import PluginError, WorldError
{top}

def sockets():
    known = [f for f in range(3, 99) if os.path.exists(f"/proc/self/fd/{{f}}")]
    return [f for f in known if stat.S_ISSOCK(os.fstat(f).st_mode)]

class Odd:
    def __str__(self): raise ValueError("no")
    __repr__ = __str__

class Mute(Exception):
    def __str__(self): raise ValueError("no")

class Own(WorldError):
    def __reduce__(self): return (print, ("pwned",))

def register(library):
    @library.world("lamp", engine="table", settle=0.1)
    def build(world, blueprint, seed):
        {build}

    @library.arrange("lamp")
    def arrange(world, facts):
        {arrange}
        world.set_facts(facts)

    @library.sensor("bulb_{{n}}", fact="{{n}}", period=0.05)
    def bulb(world, n: int):
        {sense}
        return world.fact("LAMP", n - 1)

    @library.operation("Op_{{to}}", timeout=1.0)
    def switch(world, to: str):
        yield
        {act}
        yield
        world.set_facts({{("LAMP", 0): "1"}})
"""

Make = Callable[..., ProcessHost]


@pytest.fixture
def folder(tmp_path: Path) -> Callable[..., Path]:
    def write(**code: str) -> Path:
        parts = {"top": "", "build": "pass", "arrange": "pass", "sense": "pass", "act": "pass"}
        write_plugin(tmp_path, "lamp", PLUGIN.format(**(parts | code)))
        return tmp_path

    return write


@pytest.fixture
def child(folder: Callable[..., Path]) -> Iterator[Make]:
    hosts: list[ProcessHost] = []

    def make(limit: float = 10.0, memory: int | None = None, **code: str) -> ProcessHost:
        paths = [folder(**code)]
        terms = ChildTerms(hang_limit=limit, open_limit=limit, memory=memory)
        host = ProcessHost(blueprint_of(LAMP), "lamp", 0, paths, terms)
        hosts.append(host)
        return host

    yield make
    for host in hosts:
        host.close()


def _carried_out(host: Host) -> Tick:
    host.open(START)
    host.begin(ON)
    tick = host.tick()
    while tick.outcome is Outcome.RUNNING and tick.time < 0.5:
        tick = host.tick()
    return tick


@pytest.mark.parametrize(
    ("act", "words"),
    [
        ("ctypes.string_at(0)", r"killed by signal 11 \(SIGSEGV\)"),
        ("os.abort()", r"killed by signal 6 \(SIGABRT\)"),
        ("os._exit(3)", "ended by itself with exit status 3"),
        (
            "raise KeyboardInterrupt",
            "library code raised KeyboardInterrupt",
        ),
        ("os.closerange(3, 200); time.sleep(0.3)", "the simulation process was killed by signal 9"),
        ("os.kill(os.getpid(), signal.SIGTERM); time.sleep(5)", r"killed by signal 15"),
        ("[os.write(f, b'garbage ' * 9) for f in sockets()]", "said what is no answer"),
        ("[os.write(f, b'\\x7f\\xff\\xff\\xff') for f in sockets()]", "said what is no answer"),
        ("[os.write(f, b'\\xff\\xff\\xff\\xff') for f in sockets()]", "said what is no answer"),
    ],
)
def test_what_takes_the_child_down_is_one_error(child: Make, act: str, words: str) -> None:
    host = child(act=act)
    with pytest.raises(HostError, match=words):
        _carried_out(host)
    with pytest.raises(HostError, match=words):
        host.tick()


@pytest.mark.parametrize(
    ("act", "words"),
    [
        ("raise SystemExit(4)", "SystemExit: 4"),
        ("raise BaseException('base')", "BaseException: base"),
        ("raise Mute", "Mute: it cannot say what"),
        ("raise ValueError('x' * 10**7)", r"x \.\.\. \(10000012 characters\)"),
        ("raise ValueError('\\ud800')", r"ValueError: \?"),
        ("(lambda f: f(f))(lambda f: f(f))", "RecursionError: maximum recursion"),
        ("raise Own('own')", "Own: own"),
        ("raise GeneratorExit", "GeneratorExit"),
    ],
)
def test_what_an_operation_raises_ends_the_operation(child: Make, act: str, words: str) -> None:
    host = child(act=act)
    tick = _carried_out(host)
    assert tick.outcome is Outcome.RAISED
    assert re.search(words, tick.message)
    assert len(tick.message) < 700
    assert host.tick().outcome is Outcome.IDLE


@pytest.mark.parametrize(
    ("sense", "words"),
    [
        ("return 'x' * 10**8", "it reads a text of 100000000 characters, more than 1000"),
        ("return '\\ud800'", "it reads a text that cannot be written"),
        ("return b'1'", "it reads a value of type bytes, which is no text"),
        ("return numpy.str_('1')", "it reads a value of type str_, which is no text"),
        ("return numpy.ones(10**6)", "it reads a value of type ndarray, which is no text"),
        ("return 10**100000", "it reads a value of type int, which is no text"),
        ("return Odd()", "it reads a value of type Odd, which is no text"),
        ("return 1", "it reads 1, which is no text"),
        ("raise Mute", "Mute: it cannot say what (lamp/plugin.py:33)"),
        ("raise SystemExit", "SystemExit (lamp/plugin.py:33)"),
    ],
)
def test_what_is_no_reading_is_none(folder: Callable[..., Path], sense: str, words: str) -> None:
    host = LocalHost(blueprint_of(LAMP), "lamp", 0, [folder(sense=sense)])
    host.open(START)
    (sample,) = host.sense()
    assert (sample.value, sample.reason) == (None, words)
    host.close()


@pytest.mark.parametrize("place", ["build", "arrange"])
@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("raise SystemExit(2)", "broke .*SystemExit: 2"),
        ("raise Mute", "broke .*Mute: it cannot say what"),
        ("raise Own('x' * 10**6)", r"x \.\.\. \(1000000 characters\)"),
    ],
)
def test_a_world_that_cannot_be_put_up_is_one_error(
    child: Make, place: str, code: str, words: str
) -> None:
    host = child(**{place: code})
    with pytest.raises(StudioError, match=words):
        host.open(START)


@pytest.mark.parametrize(
    ("place", "code"),
    [
        ("top", "time.sleep(60)"),
        ("build", "time.sleep(60)"),
        ("sense", "while True: pass"),
        ("act", "while True: print('flood ' * 1000)"),
        ("act", "[os.write(f, bytes(3)) for f in sockets()]; time.sleep(60)"),
    ],
)
def test_what_hangs_is_given_up_at_its_limit(
    child: Make, place: str, code: str, capfd: pytest.CaptureFixture[str]
) -> None:
    host = child(limit=1.5, **{place: code})
    with pytest.raises(HostError, match="did not answer for 1"):
        _carried_out(host)
    assert len(capfd.readouterr().err) < 1_100_000


def test_what_takes_all_memory_is_refused_it(child: Make) -> None:
    host = child(memory=2**30, act="held = [bytearray(2**28) for _ in range(9)]")
    tick = _carried_out(host)
    assert tick.outcome is Outcome.RAISED
    assert tick.message.startswith("MemoryError")


def test_threads_and_processes_that_are_left_behind_end_with_the_run(
    child: Make, tmp_path: Path
) -> None:
    note = tmp_path / "pids"
    start = "threading.Thread(target=time.sleep, args=(600,)).start()"
    fork = f"open({str(note)!r}, 'w').write(str(os.fork() or time.sleep(600)))"
    host = child(act=f"{start}; {fork}")
    assert _carried_out(host).outcome is Outcome.RETURNED
    pid = int(note.read_text())
    os.kill(pid, 0)
    host.close()
    _gone(pid)


def test_a_copy_that_an_operation_makes_of_its_process_tells_nothing(child: Make) -> None:
    host = child(act="os.fork()")
    assert _carried_out(host).outcome is Outcome.RETURNED
    before = host.tick().time
    assert host.tick().time > before


def test_a_child_that_dies_and_leaves_its_pipes_to_another_is_seen(
    child: Make, tmp_path: Path
) -> None:
    note = tmp_path / "pids"
    fork = f"open({str(note)!r}, 'w').write(str(os.fork() or time.sleep(600)))"
    host = child(act=f"{fork}; os._exit(5)")
    with pytest.raises(HostError, match="ended by itself with exit status 5"):
        _carried_out(host)
    _gone(int(note.read_text()))


def _gone(pid: int) -> None:
    """The process has ended, or does so soon; a zombie that nobody reads counts as ended."""
    until = time.monotonic() + 10.0
    while time.monotonic() < until:
        try:
            if Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z":
                return
        except OSError:
            return
    pytest.fail(f"process {pid} lives on")


def test_a_world_that_draws_nonsense_keeps_its_last_picture(child: Make) -> None:
    shape = "from smsl_studio.world.protocol import Shape"
    build = (
        "world.shapes = lambda: (Shape('lamp', (0.0,) * 9, (1.0, 1.0, 1.0)),); "
        "world.poses = lambda: (float('nan') if world.fact('LAMP', 0) == '1' else 0.5,) * 7; "
        "world.status = lambda: {'x' * 10**6: 'y' * 10**6, 'nan': 1}"
    )
    host = child(top=shape, build=build)
    host.open(START)
    before = host.poses()
    assert before == (0.5,) * 7
    host.begin(ON)
    while host.tick().outcome is Outcome.RUNNING:
        pass
    host.tick()
    assert host.poses() == before
    assert all(len(name) < 100 and len(words) < 300 for name, words in host.status().items())


def test_a_run_ends_failed_and_says_so(folder: Callable[..., Path]) -> None:
    done = run(blueprint_of(LAMP), "lamp", host="process", plugin_paths=[folder(act="os._exit(7)")])
    assert done.reason == "failed"
    assert "ended by itself with exit status 7" in done.sentence
    assert threading.active_count() < 10
