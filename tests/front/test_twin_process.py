"""The twin in a process of its own: the same forecasts, and nothing that it does costs the run."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.front import twin_process
from smsl_studio.front.inputs import read
from smsl_studio.front.request import RunRequest
from smsl_studio.front.twin import LIVES, Twin
from smsl_studio.front.twin_child import TOLD, answer_of
from smsl_studio.front.twin_process import HANG_LIMIT, OPEN_LIMIT, TwinProcess
from smsl_studio.library.prediction import AGREES, DIFFERS, Prediction
from smsl_studio.shipped import samples_dir
from smsl_studio.stop import Stopped, heeding
from tests.cases import case
from tests.plugin_folder import blueprint_of, write_plugin

SAMPLE = samples_dir() / "hanoi-2.json"
WILD = """
import mmap
import os

def register(library):
    @library.world("wild", engine="table")
    def build(world, blueprint, seed):
        return world

    @library.arrange("wild")
    def arrange(world, facts):
        world.set_facts(facts)

    @library.sensor("fact", fact="1", period=0.1)
    def fact(world):
        return world.fact("SB", 0)

    @library.operation("Go", timeout=5.0)
    def go(world):
        yield
        print("a plugin may print")
        world.set_facts({("SB", 0): "b"})

    @library.operation("Long", timeout=1e9)
    def long(world):
        while True:
            yield

    @library.operation("Hang", timeout=5.0)
    def hang(world):
        yield
        while True:
            pass

    @library.operation("Die", timeout=5.0)
    def die(world):
        yield
        os._exit(3)

    @library.operation("Eat", timeout=5.0)
    def eat(world):
        yield
        # Memory that nobody writes to costs nothing, but counts.
        mmap.mmap(-1, os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") * 3 // 4)
        world.set_facts({("SB", 0): "b"})
"""
NAMES = ("Go", "Long", "Hang", "Die", "Eat")
BLUEPRINT: dict[str, Any] = {
    "SB": {
        "HEADER": {"INITIAL": "State_a", "ACTIVATING": "State_b", "NUM_FACTS": 1},
        "State_a": dict.fromkeys(NAMES, "State_b"),
        "State_b": {},
    }
}
START = {"SB": "State_a"}


@pytest.fixture
def wild(tmp_path: Path) -> Iterator[TwinProcess]:
    place = write_plugin(tmp_path, "wild", WILD)
    twin = TwinProcess(RunRequest(blueprint_of(BLUEPRINT), "wild", plugin_paths=(place,)))
    yield twin
    twin.close()


def edge(name: str) -> Address:
    return Address("SB", "State_a", name)


def gone(pid: int | None) -> bool:
    """Whether a process has ended."""
    assert pid is not None
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    return False


def test_it_predicts_what_a_twin_in_this_process_predicts() -> None:
    request = RunRequest(read(SAMPLE))
    near, far = Twin(request), TwinProcess(request)
    route = [Address("SB1", state, name) for state, name in (
        ("State_aa", "Op_1b"), ("State_ba", "Op_2c"), ("State_bc", "Op_1c"),
    )]  # fmt: skip
    heard: list[float] = []
    try:
        assert far.onward(route[1]) is None, "nothing was forecast yet"
        start = {"SB1": "State_aa"}
        told = near.predict(start, route[0])
        assert told == far.predict(start, route[0], lambda seconds, _: heard.append(seconds))
        assert told.verdict == AGREES
        assert heard[0] == 0.0
        assert heard == sorted(set(heard))
        for one in (route[2], *route[1:]):
            assert near.onward(one) == far.onward(one)
        wrong = {"SB1": "State_zz"}
        assert near.predict(wrong, route[0]) == far.predict(wrong, route[0])
        pid = far.pid
    finally:
        far.close()
        near.close()
    assert gone(pid)


def test_a_forecast_that_is_called_off_keeps_the_world_for_the_next(wild: TwinProcess) -> None:
    heard: list[float] = []

    def heed() -> None:
        if heard:
            raise Stopped

    with heeding(heed), pytest.raises(Stopped):
        wild.predict(START, edge("Long"), lambda seconds, _: heard.append(seconds))
    pid = wild.pid
    assert wild.predict(START, edge("Go")) == Prediction(AGREES, {"SB/0": "b"})
    assert wild.pid == pid


def test_a_process_that_is_lost_costs_one_forecast(
    wild: TwinProcess, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(twin_process, "HANG_LIMIT", 1.0)
    for name, words in (
        ("Die", "the forecast process ended by itself with exit status 3"),
        ("Hang", "the forecast process did not answer for "),
    ):
        with case("operation", name):
            found = wild.predict(START, edge(name))
            assert (found.verdict, found.after) == ("none", {})
            assert found.reason.startswith(words)
            assert wild.pid is None
    found = wild.predict(START, edge("Eat"))
    assert found.verdict == DIFFERS, "the operation failed, and the process lives"
    assert found.apart == ("SB/0",)
    assert wild.predict(START, edge("Go")).verdict == AGREES
    assert wild.pid is not None
    os.kill(wild.pid, signal.SIGKILL)
    found = wild.predict(START, edge("Go"))
    assert found.reason == "the forecast process was killed by signal 9 (SIGKILL)"
    again = wild.predict(START, edge("Go"))
    assert again == found, f"after {LIVES} lost processes no further one is started"
    assert wild.pid is None


CODE = """
import sys, time
from pathlib import Path
from tests.front.test_twin_process import BLUEPRINT, RunRequest, START, TwinProcess, edge
from tests.plugin_folder import blueprint_of
place = Path(sys.argv[1])
twin = TwinProcess(RunRequest(blueprint_of(BLUEPRINT), "wild", plugin_paths=(place,)))
twin.predict(START, edge("Hang"), lambda *_: print(twin.pid, flush=True))
"""


def test_it_ends_with_the_run_that_is_killed(tmp_path: Path) -> None:
    """Also while code of a plugin hangs."""
    place = write_plugin(tmp_path, "wild", WILD)
    with subprocess.Popen(
        [sys.executable, "-c", CODE, str(place)], stdout=subprocess.PIPE, text=True
    ) as run:
        assert run.stdout is not None
        child = os.pidfd_open(int(run.stdout.readline()))
        run.kill()
    look = select.poll()
    look.register(child, select.POLLIN)
    assert look.poll(20_000), "the child outlives the run"
    os.close(child)


class Liar:
    """A child process that answers each command with the same frame, or with none."""

    def __init__(self, clock: list[float], kind: str, body: bytes) -> None:
        self._clock, self._frame = clock, SimpleNamespace(kind=kind, body=body)
        self._ready = [SimpleNamespace(kind="ok", body=b"")]
        self.wire = SimpleNamespace(send=lambda *_: None)
        self.pid, self.killed, self.shut_out = 0, False, False

    def tell(self, *_: object) -> None: ...

    def told(self) -> None: ...

    def starved(self) -> bool:
        return False

    def heard(self, seconds: float) -> Any:
        if self._ready:
            return self._ready.pop()
        self._clock[0] += seconds
        return self._frame if self._frame.kind else None

    def kill(self) -> None:
        self.killed = True


def test_nothing_that_the_process_says_is_believed_unchecked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It speaks with the code of plugins in it."""
    clock = [0.0]
    monkeypatch.setattr(
        "smsl_studio.host.patience.time", SimpleNamespace(monotonic=lambda: clock[0])
    )
    blueprint = read(SAMPLE)
    fine = answer_of(blueprint)
    other = answer_of(blueprint_of(BLUEPRINT)).encode(Prediction(AGREES, {"SB/0": "b"}))
    sound = fine.encode(Prediction(AGREES, {"SB1/0": "b"}))
    for kind, body, words in (
        ("ok", b"", "said what is no forecast"),
        ("ok", sound + b"x", "said what is no forecast"),
        ("ok", sound[:-1], "said what is no forecast"),
        ("ok", other[:8] + b"\xff" * 8, "said what is no forecast"),
        ("refused", b"\x00", "said what is no forecast: it says refused"),
        ("loads", b"\xff" * 40, "said what is no forecast"),
        ("loads", TOLD.encode(((float(2**20), ()),))[:-1], "said what is no forecast"),
        ("crashed", b"\xff", "said what is no forecast"),
        ("", b"", f"did not answer for {OPEN_LIMIT}"),
    ):
        with case("answer", (kind, body)):
            liar = Liar(clock, kind, body)
            monkeypatch.setattr(twin_process, "start_child", lambda _, one=liar: one)
            twin = TwinProcess(RunRequest(blueprint))
            told = twin.predict({"SB1": "State_aa"}, Address("SB1", "State_aa", "Op_1b"))
            assert told.verdict == "none"
            assert told.reason.startswith(f"the forecast process {words}"), told.reason
            assert liar.killed
    assert HANG_LIMIT < OPEN_LIMIT


def test_only_a_forecast_that_builds_the_world_has_the_time_for_that(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    clock = [0.0]
    monkeypatch.setattr(
        "smsl_studio.host.patience.time", SimpleNamespace(monotonic=lambda: clock[0])
    )
    blueprint = read(SAMPLE)
    for verdict, limit in ((AGREES, HANG_LIMIT), ("none", OPEN_LIMIT)):
        with case("the forecast before", verdict):
            liar = Liar(clock, "", b"")
            body = answer_of(blueprint).encode(Prediction(verdict))
            told = SimpleNamespace(kind="loads", body=TOLD.encode(()))
            # From the last one on: the plugins are loaded, and one forecast is made.
            liar._ready = [SimpleNamespace(kind="ok", body=body), told, *liar._ready]
            monkeypatch.setattr(twin_process, "start_child", lambda _, one=liar: one)
            twin = TwinProcess(RunRequest(blueprint))
            asked = ({"SB1": "State_aa"}, Address("SB1", "State_aa", "Op_1b"))
            assert twin.predict(*asked).verdict == verdict
            began = clock[0]
            assert "did not answer for " in twin.predict(*asked).reason
            assert limit < clock[0] - began < limit + 1.0
