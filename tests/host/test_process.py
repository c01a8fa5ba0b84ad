"""The process host: the same trace as the local one, and a child that dies, hangs or freezes."""

from __future__ import annotations

import errno
import os
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import add_operation
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import HostError, WorldError
from smsl_studio.front.inputs import read
from smsl_studio.host.local import LocalHost
from smsl_studio.host.process import ChildTerms, ProcessHost
from smsl_studio.host.protocol import Host, Outcome
from smsl_studio.stop import StopListener, Stopped, heeding
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin
from tests.processes import child_processes

START = {"LAMP": "State_0"}
ON, SPIN = Address("LAMP", "State_0", "Op_on"), Address("LAMP", "State_0", "Op_spin")


@pytest.fixture
def lamp(tmp_path: Path) -> Iterator[Callable[..., ProcessHost]]:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    hosts: list[ProcessHost] = []

    def make(**limits: Any) -> ProcessHost:
        hosts.append(ProcessHost(blueprint_of(LAMP), "lamp", 0, [tmp_path], ChildTerms(**limits)))
        return hosts[-1]

    yield make
    for host in hosts:
        host.close()
        host.close()


def _trace(host: Host, blueprint: Blueprint, start: dict[str, str]) -> Sequence[Any]:
    """Everything a host says when every edge is carried out once, whatever the world thinks."""
    found: list[Any] = [host.open(start), host.sense()]
    for branch in blueprint:
        for edge in branch.edges():
            if edge.address not in found[0].bound:
                continue
            host.begin(edge.address)
            found.append(host.tick())
            while found[-1].outcome is Outcome.RUNNING:
                found.append(host.tick())
    return found


@st.composite
def blueprints(draw: st.DrawFn) -> Blueprint:
    """A base SB of any alphabet with, perhaps, a sub-SB under its first digit."""
    width = draw(st.integers(1, 3))
    tail = st.text("01xé/~", min_size=width - 1, max_size=width - 1)
    names = draw(st.lists(tail, min_size=1, max_size=4, unique=True))
    states = [f"State_{on}{name}" for name in names for on in "01"]
    target = st.dictionaries(st.sampled_from(["go", "é", "a/b"]), st.sampled_from(states))
    base: dict[str, Any] = {state: draw(target) for state in states}
    if not draw(st.booleans()):
        return blueprint_of({"BASE": base})
    load = {"_operations": {"go": {"subs": draw(st.sampled_from(["load", "drive"]))}}}
    sub = {"HEADER": {}, "State_0": {"up": "State_1"}, "State_1": {"down": "State_0"}}
    header = {"SUB_SBS": {"SUB": 0}, "INITIAL": states[0], "ACTIVATING": states[-1]}
    return blueprint_of({"BASE": {"HEADER": header, **load, **base}, "SUB": sub})


def test_the_child_runs_what_is_open_and_not_what_stands_on_disk(tmp_path: Path) -> None:
    base = tmp_path / "base.json"
    base.write_text('{"_imports": ["sub.json"], "A": {"State0": {"o": "State1"}, "State1": {}}}')
    (tmp_path / "sub.json").write_text('{"B": {"State0": {"p": "State1"}, "State1": {}}}')
    blueprint = add_operation(read(base), "B", "State1", "typed", "State0")
    (tmp_path / "sub.json").write_text("{")
    child = ProcessHost(blueprint, "table")
    try:
        opened = child.open({"A": "State0", "B": "State1"})
        assert Address("B", "State1", "typed") in opened.bound
    finally:
        child.close()


@pytest.mark.parametrize("now", ["another file", "a pipe", "nothing"])
def test_a_name_that_leads_elsewhere_by_now_is_nothing_to_the_child(
    tmp_path: Path, now: str
) -> None:
    """The child has the texts that the parent has looked at, wherever their names lead."""
    base, sub, other = (tmp_path / f"{name}.json" for name in ("base", "sub", "other"))
    states = '{"State0": {"o": "State1"}, "State1": {}}'
    base.write_text(f'{{"_imports": ["sub.json", "late.json"], "A": {states}}}')
    sub.write_text('{"B": {"State0": {"p": "State1"}, "State1": {}}}')
    blueprint = read(base)
    (tmp_path / "late.json").write_text(f'{{"C": {states}}}')
    sub.unlink()
    if now == "a pipe":
        os.mkfifo(other)
    elif now == "another file":
        other.write_text('{"B": {"State0": {"q": "State1"}, "State1": {}}}')
    sub.symlink_to(other)
    child = ProcessHost(blueprint, "table")
    try:
        opened = child.open({"A": "State0", "B": "State0"})
        assert opened.bound.keys() == {Address("A", "State0", "o"), Address("B", "State0", "p")}
    finally:
        child.close()


@settings(max_examples=8)
@given(blueprints())
def test_both_hosts_tell_the_same_story_on_the_table(blueprint: Blueprint) -> None:
    start = {branch.name: branch.initial for branch in blueprint}
    local, child = LocalHost(blueprint, "table"), ProcessHost(blueprint, "table")
    try:
        assert _trace(local, blueprint, start) == _trace(child, blueprint, start)
    finally:
        local.close()
        child.close()


def test_both_hosts_tell_the_same_story_of_library_code(
    lamp: Callable[..., ProcessHost], tmp_path: Path
) -> None:
    values = {"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1", "Op_break": "State_1"}}}
    blueprint = blueprint_of(values)
    local = LocalHost(blueprint, "lamp", 0, [tmp_path])
    child = ProcessHost(blueprint, "lamp", 0, [tmp_path])
    try:
        assert _trace(local, blueprint, START) == _trace(child, blueprint, START)
    finally:
        child.close()


def test_a_killed_child_is_one_clear_error(lamp: Callable[..., ProcessHost]) -> None:
    host = lamp()
    host.open(START)
    host.begin(ON)
    host.tick()
    assert host.pid is not None
    os.kill(host.pid, signal.SIGKILL)
    for _ in range(2):
        with pytest.raises(HostError) as caught:
            host.tick()
        assert caught.value.sentence == (
            "the simulation process was killed by signal 9 (SIGKILL)"
            " in the middle of LAMP/State_0/Op_on"
        )
    assert host.pid is None
    assert host.poses() == ()


def test_a_hanging_operation_is_given_up(lamp: Callable[..., ProcessHost]) -> None:
    host = lamp(hang_limit=0.5)
    host.open(START)
    host.begin(SPIN)
    host.tick()
    with pytest.raises(HostError, match=r"did not answer for 0\.\d s in the middle of LAMP"):
        host.tick()


def test_a_stop_ends_a_child_that_does_not_answer(lamp: Callable[..., ProcessHost]) -> None:
    host = lamp()
    host.open({"LAMP": "State_0"})
    host.begin(Address("LAMP", "State_0", "Op_spin"))
    host.tick()
    with heeding(StopListener(1).heed), pytest.raises(Stopped):
        host.tick()
    with pytest.raises(HostError, match="was ended in the middle of LAMP/State_0/Op_spin"):
        host.cancel("hold")
    assert child_processes() == []


def test_a_world_that_is_at_a_tick_when_a_stop_comes_may_finish_it(tmp_path: Path) -> None:
    told = tmp_path / "told"
    waits = f"while not __import__('os').path.exists({str(told)!r}): pass"
    code = LAMP_PLUGIN.replace('print("switching")', waits)
    write_plugin(tmp_path, "lamp", code)
    host = ProcessHost(blueprint_of(LAMP), "lamp", 0, [tmp_path])
    host.open(START)
    host.begin(ON)

    def stop() -> None:
        told.touch()
        raise Stopped

    with heeding(stop):
        assert host.tick().outcome is Outcome.RUNNING
    host.cancel("hold")
    assert host.pid is not None
    host.close()


def test_a_stop_ends_the_building_of_a_world(tmp_path: Path) -> None:
    code = LAMP_PLUGIN.replace(
        '    @library.world("lamp"', "    FOREVER\n" + '    @library.world("lamp"', 1
    )
    assert "FOREVER" in code
    folder = write_plugin(tmp_path, "lamp", code.replace("FOREVER", "while True: pass"))
    host = ProcessHost(blueprint_of(LAMP), "lamp", plugin_paths=[folder])
    with heeding(StopListener(3).heed), pytest.raises(Stopped):
        host.open({"LAMP": "State_0"})
    assert child_processes() == []


def test_a_frozen_child_is_given_up(lamp: Callable[..., ProcessHost]) -> None:
    host = lamp(silence_limit=0.3)
    host.open(START)
    assert host.pid is not None
    os.kill(host.pid, signal.SIGSTOP)
    with pytest.raises(HostError, match="has shown no pulse"):
        host.tick()


def test_a_child_that_dies_while_nothing_is_asked_of_it_is_seen(
    lamp: Callable[..., ProcessHost],
) -> None:
    host = lamp()
    host.open(START)
    host.check()
    assert host.pid is not None
    gone = os.pidfd_open(host.pid)
    os.kill(host.pid, signal.SIGKILL)
    select.select([gone], [], [])
    os.close(gone)
    for _ in range(2):
        with pytest.raises(HostError, match="SIGKILL"):
            host.check()


def test_a_child_that_freezes_while_nothing_is_asked_of_it_is_seen(
    lamp: Callable[..., ProcessHost],
) -> None:
    host = lamp(silence_limit=0.3)
    host.open(START)
    assert host.pid is not None
    os.kill(host.pid, signal.SIGSTOP)

    def look_until_it_is_given_up() -> None:
        while True:
            host.check()

    with pytest.raises(HostError, match="has shown no pulse"):
        look_until_it_is_given_up()


def test_a_close_from_another_thread_ends_what_hangs(lamp: Callable[..., ProcessHost]) -> None:
    host = lamp(hang_limit=60.0)
    host.open(START)
    host.begin(SPIN)
    host.tick()
    threading.Timer(0.05, host.close).start()
    with pytest.raises(HostError, match="the host is closed"):
        host.tick()
    assert host.pid is None


def test_a_child_that_cannot_start_is_one_clear_error(
    lamp: Callable[..., ProcessHost], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.EAGAIN, "no more processes")

    monkeypatch.setattr(subprocess, "Popen", full)
    host = lamp()
    for _ in range(2):
        with pytest.raises(HostError, match="cannot be started: no more processes"):
            host.open(START)
    host.close()


def test_an_error_of_the_child_arrives_whole(lamp: Callable[..., ProcessHost]) -> None:
    host = ProcessHost(blueprint_of(LAMP), "tabel")
    with pytest.raises(WorldError) as caught:
        host.open(START)
    assert caught.value.advice == "Did you mean table?"
    host.close()
    with pytest.raises(HostError, match="closed"):
        host.open(START)
    lit = lamp()
    lit.open(START)
    lit.begin(ON)
    with pytest.raises(HostError, match="another operation runs"):
        lit.begin(ON)


def test_what_the_child_prints_is_no_data(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    loud = LAMP_PLUGIN.replace('print("built")', '__import__("os").write(1, b"from below\\n")')
    write_plugin(tmp_path, "lamp", loud)
    host = ProcessHost(blueprint_of(LAMP), "lamp", 0, [tmp_path])
    host.open(START)
    host.close()
    said = capfd.readouterr()
    assert said.out == ""
    assert "from below" in said.err


PARENT = """
import sys
from pathlib import Path
from smsl_studio.blueprint.address import Address
from smsl_studio.front.inputs import read
from smsl_studio.host.process import ChildTerms, ProcessHost

if __name__ == "__main__":
    terms = ChildTerms(hang_limit=60.0)
    host = ProcessHost(read(sys.argv[1]), "lamp", 0, [Path(sys.argv[2])], terms)
    host.open({"LAMP": "State_0"})
    host.begin(Address("LAMP", "State_0", "Op_spin"))
    host.tick()
    print(host.pid, flush=True)
    host.tick()
"""


def test_a_child_that_hangs_ends_with_its_parent(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    (tmp_path / "lamp.json").write_text(blueprint_of(LAMP).document.text)
    script = tmp_path / "parent.py"
    script.write_text(PARENT)
    command = [sys.executable, str(script), str(tmp_path / "lamp.json"), str(tmp_path)]
    root = str(Path(__file__).parents[2])
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": root},
    ) as parent:
        assert parent.stdout is not None
        child = int(parent.stdout.readline())
        parent.kill()
    assert _ends(child)


def _ends(pid: int, limit: float = 10.0) -> bool:
    deadline = time.monotonic() + limit
    while time.monotonic() < deadline:
        try:
            os.kill(pid, 0)
            state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except (ProcessLookupError, FileNotFoundError):
            return True
        if state == "Z":
            return True
        os.sched_yield()
    return False
