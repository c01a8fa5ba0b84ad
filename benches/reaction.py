"""The reaction time of a run: commands at random moments, and a world that dies, hangs or freezes.

The world is a plugin's, in a process of its own, and an operation is always under way. A command is
given by another thread; what counts is how many steps of the world begin after that until it is
read. Times are wall time, the longest of all tries.
"""

from __future__ import annotations

import os
import signal
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random

from benches.row import Row
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.host.process import ChildTerms, ProcessHost
from smsl_studio.host.protocol import Tick
from smsl_studio.runlog.events import Commanded, Held
from smsl_studio.smsl.json_form import parse

COMMANDS, ALL_COMMANDS = 100, 1_000
TRIES, ALL_TRIES = 5, 30
HANG = 0.5

PLUGIN = """
def register(library):
    @library.world("walk", engine="table")
    def build(world, blueprint, seed):
        return None

    @library.sensor("step", fact="1", period=1 / 240)
    def step(world):
        return "0"

    @library.operation("Walk", timeout=1e9)
    def walk(world):
        while True:
            yield

    @library.operation("Hang", timeout=1e9)
    def hang(world):
        yield
        while True:
            pass
"""

TEXT = """{"WALK": {"HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1"},
 "State_0": {"%s": "State_1"}, "State_1": {}}}"""


class Counting(ProcessHost):
    """A process host that counts the begun steps of the world, and notes the step of the brake."""

    begun = braked_at = 0

    def tick(self) -> Tick:
        self.begun += 1
        return super().tick()

    def cancel(self, mode: str) -> None:
        self.braked_at = self.begun
        super().cancel(mode)


def rows() -> Iterator[Row]:
    """Measure a tenth of the commands, with few tries."""
    return _rows(COMMANDS, TRIES)


def all_rows() -> Iterator[Row]:
    """Measure everything that is promised."""
    return _rows(ALL_COMMANDS, ALL_TRIES)


def _rows(commands: int, tries: int) -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as name:
        folder = _plugin(Path(name))
        yield from _commands(folder, commands)
        killed = max(_until_held(folder, "Walk", _kill) for _ in range(tries))
        yield Row(f"process killed, {tries} times: until the run holds", killed * 1000,
                  bound="at most 100 ms (wall time)")  # fmt: skip
        hung = max(_until_held(folder, "Hang", _nothing) for _ in range(tries))
        yield Row(f"operation hangs, {tries} times: beyond its limit until the run holds",
                  (hung - HANG) * 1000, bound="at most 300 ms (wall time)")  # fmt: skip


def obeyed(count: int) -> Iterator[Row]:
    """Give so many commands at random moments."""
    with tempfile.TemporaryDirectory() as name:
        yield from _commands(_plugin(Path(name)), count)


def _plugin(place: Path) -> Path:
    folder = place / "walk"
    folder.mkdir()
    (folder / "plugin.toml").write_text('name = "walk"\nversion = "1"\n')
    (folder / "plugin.py").write_text(PLUGIN)
    return folder


@dataclass
class _Said:
    """A command, and the number of steps that had begun when it was given."""

    command: str
    begun: int


def _commands(folder: Path, count: int) -> Iterator[Row]:
    host = Counting(_blueprint("Walk"), "walk", plugin_paths=[folder])
    dispatcher = Dispatcher(_blueprint("Walk"), host, RunTerms(attended=True))
    dispatcher.open()
    random, steps = Random(1), []
    said: list[_Said] = []
    words = ("pause", "stop", "take_over")
    try:
        for number in range(count):
            word = words[number % len(words)]
            _going(dispatcher)
            person = threading.Timer(
                random.uniform(0.0, 0.01), _say, (dispatcher, host, word, said)
            )
            person.start()
            answered = False
            while not answered:
                events = dispatcher.tick()
                answered = any(isinstance(e, Commanded) and e.command == word for e in events)
            person.join()
            # A paused world stands still; a stopped one goes on, braked.
            obeyed = host.begun if word == "pause" else host.braked_at
            steps.append(max(0, obeyed - said[-1].begun))
    finally:
        dispatcher.close()
    late = sum(bool(one) for one in steps)
    yield Row(f"{count:,} commands, {late} read a step late: steps begun before, at most",
              max(steps), "steps", bound="0, or the one that was just beginning")  # fmt: skip


def _say(dispatcher: Dispatcher, host: Counting, word: str, said: list[_Said]) -> None:
    command: Callable[[], None] = getattr(dispatcher, word)
    command()
    said.append(_Said(word, host.begun))


def _going(dispatcher: Dispatcher) -> None:
    """Bring the run back to a running operation after any command."""
    back = {
        "stopped": ("reset",),
        "paused": ("resume",),
        "taken_over": ("give_back", "accept", "resume"),
    }
    while dispatcher.status.running is None:
        for word in back.get(dispatcher.phase, ()):
            getattr(dispatcher, word)()
            dispatcher.tick()
        dispatcher.tick()


def _until_held(folder: Path, operation: str, harm: Callable[[ProcessHost], None]) -> float:
    """Wall seconds from the harm, done while an operation is under way, to the event ``held``."""
    blueprint = _blueprint(operation)
    host = ProcessHost(blueprint, "walk", plugin_paths=[folder], terms=ChildTerms(hang_limit=HANG))
    dispatcher = Dispatcher(blueprint, host, RunTerms(attended=True))
    events = list(dispatcher.open())
    try:
        while dispatcher.status.running is None:
            dispatcher.tick()
        harm(host)
        began = time.monotonic()
        while not any(isinstance(event, Held) for event in events):
            events += dispatcher.tick()
        return time.monotonic() - began
    finally:
        dispatcher.close()


def _kill(host: ProcessHost) -> None:
    assert host.pid is not None
    os.kill(host.pid, signal.SIGKILL)


def _nothing(host: ProcessHost) -> None:
    """Let the operation itself do the harm."""


def _blueprint(operation: str) -> Blueprint:
    return read_blueprint(parse(TEXT % operation, "walk.json"))
