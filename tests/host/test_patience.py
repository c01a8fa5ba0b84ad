"""How long a child is waited for: the time in which it could have worked counts, and no other."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import HostError
from smsl_studio.host.patience import Patience
from smsl_studio.host.plugin_offers import describe
from smsl_studio.host.plugin_process import PluginProcess
from smsl_studio.host.process import ChildTerms, ProcessHost
from smsl_studio.host.processor import ProcessorTime
from smsl_studio.host.protocol import Outcome
from smsl_studio.host.started_child import Child
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

ON = Address("LAMP", "State_0", "Op_on")
LOOK = (0.05, False)
SHUT_OUT = (0.05, True)
STALLED = (2.0, False)


@pytest.mark.parametrize(
    ("looks", "strict", "over", "words"),
    [
        pytest.param([LOOK] * 18, False, False, "0.9 s$", id="still within"),
        pytest.param([LOOK] * 21, False, True, "1.1 s", id="could have answered"),
        pytest.param([SHUT_OUT] * 21, False, False, r"1.1 s \(1 s of it without", id="was not let"),
        pytest.param([SHUT_OUT] * 218, False, False, r"10.9 s \(10 s of", id="was not let, long"),
        pytest.param([SHUT_OUT] * 221, False, True, r"11.1 s \(10 s of it", id="has had its grace"),
        pytest.param([STALLED] * 3, False, False, r"6.0 s \(6 s of it without", id="nobody looked"),
        pytest.param([SHUT_OUT] * 21, True, True, "1.1 s$", id="hardware"),
        pytest.param([STALLED], True, True, "2.0 s$", id="hardware, and nobody looked"),
    ],
)
def test_only_the_time_in_which_a_child_could_have_worked_counts(
    looks: Sequence[tuple[float, bool]],
    strict: bool,
    over: bool,
    words: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now = 0.0
    monkeypatch.setattr("time.monotonic", lambda: now)
    wait = Patience(1.0, strict=strict)
    for seconds, shut_out in looks:
        now += seconds
        wait.look(shut_out=shut_out)
    assert wait.over is over
    assert re.match(words, wait.words)


@pytest.mark.parametrize("hardware", [False, True])
def test_a_world_that_the_machine_does_not_let_work_is_waited_for_unless_it_is_hardware(
    hardware: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told, looks = tmp_path / "told", 0
    waits = f"while not __import__('os').path.exists({str(told)!r}): pass"
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN.replace('print("switching")', waits))
    terms = ChildTerms(hang_limit=0.1, silence_limit=60.0, hardware=hardware)
    host = ProcessHost(blueprint_of(LAMP), "lamp", 0, [tmp_path], terms)

    def starved(child: Child) -> bool:
        nonlocal looks
        child.shut_out = True
        looks += 1
        if looks == 5:
            told.touch()
        return True

    host.open({"LAMP": "State_0"})
    host.begin(ON)
    monkeypatch.setattr(Child, "starved", starved)
    try:
        if hardware:
            with pytest.raises(HostError, match=r"did not answer for 0\.\d s in the middle of"):
                host.tick()
        else:
            assert host.tick().outcome is Outcome.RUNNING
            assert looks >= 5
    finally:
        host.close()


@pytest.mark.parametrize("shut_out", [False, True])
def test_loading_counts_only_the_time_in_which_the_plugin_could_have_worked(
    shut_out: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    now, ran = 0.0, 0.0
    monkeypatch.setattr("time.monotonic", lambda: now)
    monkeypatch.setattr(
        ProcessorTime, "of", lambda pid: ProcessorTime(now, ran, ready=True), raising=True
    )
    pipe, theirs = os.pipe()
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        loads = PluginProcess(0, process.pid, pipe, limit=2.0, turn=1.0)
        told, looks = None, 0
        while told is None:
            looks += 1
            now += 0.06
            ran += 0.0 if shut_out and looks <= 100 else 0.05
            told = loads.told(set())
        process.kill()
    loads.close()
    os.close(theirs)
    assert told.words == "it did not load within 2 s"
    assert looks == (134 if shut_out else 34)


def test_whoever_waits_for_plugins_counts_only_the_time_in_which_they_could_have_worked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By the clock here the plugin takes 36 s of 30 that it may take, and is never let work."""
    begun, told, looks, now = tmp_path / "begun", tmp_path / "told", 0, 0.0
    waits = f"from pathlib import Path\nPath({str(begun)!r}).touch()\n"
    waits += f"while not Path({str(told)!r}).exists(): pass\n"
    write_plugin(tmp_path, "lamp", waits + LAMP_PLUGIN)

    def clock() -> float:
        nonlocal now
        now += 0.06
        return now

    def shut_out_since(later: ProcessorTime, before: ProcessorTime) -> bool:
        nonlocal looks
        looks += begun.exists()
        if looks == 600:
            told.touch()
        return True

    monkeypatch.setattr("smsl_studio.host.patience.time", SimpleNamespace(monotonic=clock))
    monkeypatch.setattr("smsl_studio.host.plugin_offers.LOOK", 0.001)
    monkeypatch.setattr(ProcessorTime, "shut_out_since", shut_out_since)
    found = describe([tmp_path])
    assert "lamp" in found.worlds
    assert not found.faults
