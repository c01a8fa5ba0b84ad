"""The local host: ticks, outcomes, sensors at their periods, and library code that fails."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import HostError, PluginError, RunRefused, WorldError
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import Outcome, Tick
from smsl_studio.world.table import TableWorld
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

ON = Address("LAMP", "State_0", "Op_on")
BREAK = Address("LAMP", "State_0", "Op_break")
START = {"LAMP": "State_0"}


@pytest.fixture
def host(tmp_path: Path) -> Iterator[LocalHost]:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    host = LocalHost(blueprint_of(LAMP), "lamp", 0, [tmp_path])
    yield host
    host.close()


def _until_done(host: LocalHost) -> list[Tick]:
    ticks = [host.tick()]
    while ticks[-1].outcome is Outcome.RUNNING:
        ticks.append(host.tick())
    return ticks


def test_a_function_runs_from_yield_to_yield(host: LocalHost) -> None:
    opened = host.open(START)
    assert (opened.tick, opened.settle, opened.hardware) == (0.05, 0.1, False)
    assert opened.bound[ON].function == "lamp.switch"
    assert opened.bound[ON].timeout == 5.0
    host.begin(ON)
    ticks = _until_done(host)
    assert [tick.outcome.value for tick in ticks] == ["running", "running", "returned"]
    assert [tick.time for tick in ticks] == pytest.approx([0.05, 0.1, 0.15])
    assert host.tick().outcome is Outcome.IDLE
    assert [sample.value for sample in host.sense()] == ["1"]


def test_sensors_speak_when_their_period_ends(host: LocalHost) -> None:
    host.open(START)
    spoken = [[sample.sequence for sample in host.tick().samples] for _ in range(6)]
    assert spoken == [[], [1], [], [2], [], [3]]


def test_what_a_function_raises_is_named_with_its_line(host: LocalHost) -> None:
    host.open(START)
    host.begin(BREAK)
    last = _until_done(host)[-1]
    assert last.outcome is Outcome.RAISED
    line = 1 + LAMP_PLUGIN.split("\n").index('        raise RuntimeError("the bulb broke")')
    assert last.message == f"RuntimeError: the bulb broke (lamp/plugin.py:{line})"
    assert host.tick().outcome is Outcome.IDLE


def test_a_function_that_returns_false_has_failed(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    note = {"binding": {"function": "lamp.refuse", "arguments": {"times": 2}}}
    values = {"LAMP": {"_operations": {"Op_on": note}, **LAMP["LAMP"]}}
    host = LocalHost(blueprint_of(values), "lamp", 0, [tmp_path])
    host.open(START)
    host.begin(ON)
    assert [t.outcome.value for t in _until_done(host)] == ["running", "running", "failed"]


def test_a_cancelled_call_never_resumes(host: LocalHost, monkeypatch: pytest.MonkeyPatch) -> None:
    braked: list[float] = []
    monkeypatch.setattr(TableWorld, "brake", lambda world: braked.append(world.time))
    host.open(START)
    host.begin(ON)
    host.tick()
    host.cancel("finish")
    assert host.tick().outcome is Outcome.RUNNING
    assert braked == []
    host.cancel("hold")
    assert braked == [0.1]
    assert host.tick().outcome is Outcome.IDLE
    assert [sample.value for sample in host.sense()] == ["0"]


def test_opened_again_it_begins_again(host: LocalHost) -> None:
    host.open(START)
    host.begin(ON)
    _until_done(host)
    first = host.sense()[0]
    host.open({"LAMP": "State_1"})
    second = host.sense()[0]
    assert (second.value, second.time) == ("1", 0.0)
    assert (second.boot, second.sequence) > (first.boot, first.sequence)


def test_two_functions_never_run_at_once(host: LocalHost) -> None:
    host.open(START)
    host.begin(ON)
    with pytest.raises(HostError, match="another operation runs"):
        host.begin(BREAK)


def test_before_it_is_open_nothing_goes(host: LocalHost) -> None:
    with pytest.raises(HostError, match="not open"):
        host.tick()
    assert (host.poses(), dict(host.status())) == ((), {})


def test_what_library_code_prints_is_no_data(
    host: LocalHost, capsys: pytest.CaptureFixture[str]
) -> None:
    host.open(START)
    host.begin(ON)
    _until_done(host)
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "built\nswitching\n")


WORLD = """
from smsl_studio.errors import WorldError

def register(library):
    @library.world("w", engine="table")
    def build(world, blueprint, seed):
        {build}

    @library.arrange("w")
    def arrange(world, facts):
        {arrange}

    @library.sensor("eye_{{n}}", fact="{{n}}")
    def eye(world, n: int):
        {eye}
"""


@pytest.mark.parametrize(
    ("build", "error", "words"),
    [
        ("raise WorldError('too small')", WorldError, "too small"),
        ("1 / 0", HostError, r"broke while it was built: ZeroDivisionError.*\(w/plugin.py:7\)"),
    ],
)
def test_a_world_that_cannot_be_built_says_why(
    tmp_path: Path, build: str, error: type[Exception], words: str
) -> None:
    write_plugin(tmp_path, "w", WORLD.format(build=build, arrange="pass", eye="return '0'"))
    with pytest.raises(error, match=words):
        LocalHost(blueprint_of(LAMP), "w", 0, [tmp_path]).open(START)


@pytest.mark.parametrize(
    ("arrange", "error", "words"),
    [
        ("raise WorldError('it does not fit there')", RunRefused, "it does not fit there"),
        ("1 / 0", HostError, r"broke at the start: ZeroDivisionError.*\(w/plugin.py:11\)"),
    ],
)
def test_a_world_that_cannot_stand_at_the_start_says_why(
    tmp_path: Path, arrange: str, error: type[Exception], words: str
) -> None:
    write_plugin(tmp_path, "w", WORLD.format(build="pass", arrange=arrange, eye="return '0'"))
    with pytest.raises(error, match=words):
        LocalHost(blueprint_of(LAMP), "w", 0, [tmp_path]).open(START)


@pytest.mark.parametrize(
    ("eye", "reason"),
    [
        ("return None", "no valid reading"),
        ("return 3", "it reads 3, which is no text"),
        ("1 / 0", "ZeroDivisionError: division by zero (w/plugin.py:15)"),
    ],
)
def test_a_sensor_that_goes_wrong_has_no_reading(tmp_path: Path, eye: str, reason: str) -> None:
    write_plugin(tmp_path, "w", WORLD.format(build="pass", arrange="pass", eye=eye))
    host = LocalHost(blueprint_of(LAMP), "w", 0, [tmp_path])
    host.open(START)
    (sample,) = host.sense()
    assert (sample.value, sample.reason) == (None, reason)


def test_an_unknown_world_is_named() -> None:
    with pytest.raises(WorldError, match="no world 'lmap'"):
        LocalHost(blueprint_of(LAMP), "lmap").open(START)


def test_a_broken_bindings_file_is_named(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    (tmp_path / "b.toml").write_text("[world.lamp.operations]\nOp = 3\n")
    blueprint = blueprint_of(LAMP, str(tmp_path / "b.json"))
    with pytest.raises(PluginError) as caught:
        LocalHost(blueprint, "lamp", 0, [tmp_path]).open(START)
    assert caught.value.place is not None
    assert caught.value.place.line == 2


def test_bindings_that_do_not_fit_are_told_when_it_opens(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    (tmp_path / "b.toml").write_text('[world.lamp.operations]\nOp_on = {function="lamp.refused"}\n')
    blueprint = blueprint_of(LAMP, str(tmp_path / "b.json"))
    host = LocalHost(blueprint, "lamp", 0, [tmp_path])
    opened = host.open(START)
    assert ON not in opened.bound
    assert "Did you mean lamp.refuse?" in opened.faults[0]
    with pytest.raises(HostError, match="no library function"):
        host.begin(ON)
