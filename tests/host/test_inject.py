"""Faults that are injected into a world by name: at once or over many ticks, equal in both
hosts."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import HostError, UsageError
from smsl_studio.front.inputs import read
from smsl_studio.host.local import LocalHost
from smsl_studio.host.process import ProcessHost
from smsl_studio.host.protocol import Host, Outcome, Tick
from smsl_studio.library.loading import discover
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

ON = Address("LAMP", "State_0", "Op_on")
START = {"LAMP": "State_0"}
FAULTY = (
    LAMP_PLUGIN
    + """
    @library.fault("lamp", "flip")
    def flip(world, to: str = "1"):
        if to not in "01":
            from smsl_studio.errors import WorldError
            raise WorldError(f"the lamp has no {to}", advice="It is 0 or 1.")
        world.set_facts({("LAMP", 0): to})

    @library.fault("lamp", "flicker")
    def flicker(world, times: int):
        for number in range(times):
            world.set_facts({("LAMP", 0): str(number % 2)})
            yield

    @library.fault("lamp", "burst")
    def burst(world, after: float = 0.0):
        if after:
            yield
        raise SystemExit("glass everywhere")
"""
)


@pytest.fixture(params=["local", "process"])
def host(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Host]:
    write_plugin(tmp_path, "lamp", FAULTY)
    kinds: dict[str, Callable[..., Host]] = {"local": LocalHost, "process": ProcessHost}
    host = kinds[request.param](blueprint_of(LAMP), "lamp", 0, [tmp_path])
    yield host
    host.close()


def _read(host: Host) -> str | None:
    return host.sense()[0].value


def test_a_plain_fault_befalls_at_once(host: Host) -> None:
    assert host.open(START).world_faults == ("flip", "flicker", "burst")
    host.inject("flip")
    assert _read(host) == "1"
    host.inject("flip", to="0")
    assert _read(host) == "0"


def test_a_generator_goes_on_tick_by_tick_until_it_ends_or_all_begins_anew(host: Host) -> None:
    host.open(START)
    host.inject("flicker", times=4)
    read = [_read(host)]
    for _ in range(5):
        host.tick()
        read.append(_read(host))
    assert read == ["0", "1", "0", "1", "1", "1"]
    host.inject("flicker", times=9)
    host.open(START)
    host.tick()
    host.tick()
    assert _read(host) == "0"


@pytest.mark.parametrize(
    ("fault", "parameters", "words", "advice"),
    [
        ("flik", {}, "the world 'lamp' has no fault 'flik'", "Did you mean flip?"),
        ("zzz", {}, "has no fault 'zzz'", "There are flip, flicker, burst."),
        ("flip", {"too": "1"}, "the fault flip: there is no parameter 'too'", "Did you mean to?"),
        ("flip", {"to": 1}, "the fault flip: to is 1, not a text", ""),
        ("flip", {"to": "9"}, "the fault flip: the lamp has no 9", "It is 0 or 1."),
        ("flicker", {}, "the fault flicker: the argument 'times' is missing", ""),
        ("flicker", {"times": 1.5}, "times is 1.5, not a whole number", ""),
    ],
)
def test_what_cannot_be_injected_is_said_and_costs_nothing(
    host: Host, fault: str, parameters: dict[str, Any], words: str, advice: str
) -> None:
    host.open(START)
    with pytest.raises(UsageError, match=words) as caught:
        host.inject(fault, **parameters)
    assert caught.value.advice == advice
    host.tick()
    assert _read(host) == "0"


def test_a_fault_that_breaks_is_told_with_its_line(host: Host) -> None:
    host.open(START)
    words = r"the fault 'burst' of the world 'lamp' broke: SystemExit: glass .*plugin\.py:\d+"
    with pytest.raises(HostError, match=words):
        host.inject("burst")


def test_a_fault_that_breaks_later_is_told_then(host: Host) -> None:
    host.open(START)
    host.inject("burst", after=1.0)
    with pytest.raises(HostError, match="the fault 'burst' of the world 'lamp' broke"):
        host.tick()


def test_a_fault_needs_a_world_of_its_own_plugin_and_a_name_of_its_own(tmp_path: Path) -> None:
    dim = '    library.fault("{}", "dim")(lambda world: None)\n'
    alien = "def register(library):\n" + dim.format("lamp")
    write_plugin(tmp_path, "alien", alien)
    write_plugin(tmp_path, "twice", LAMP_PLUGIN + 2 * dim.format("lamp"))
    faults = {fault.plugin: fault.sentence for fault in discover([tmp_path]).faults}
    assert "which it does not register" in faults["alien"]
    assert "'dim' cannot be given to a fault of 'lamp'" in faults["twice"]


# The table world's own -----------------------------------------------------------------------


@pytest.fixture(params=["local", "process"])
def table(request: pytest.FixtureRequest) -> Iterator[Host]:
    kinds: dict[str, Callable[..., Host]] = {"local": LocalHost, "process": ProcessHost}
    host = kinds[request.param](read("samples/registration-digitization.json"), "table")
    host.open({"REGISTRATION": "State000", "DIGITIZATION": "State0"})
    yield host
    host.close()


PLAN = Address("REGISTRATION", "State000", "LandmarksPlanned")


def _facts(host: Host) -> dict[str, str | None]:
    return {f"{one.branch}/{one.digit}": one.value for one in host.sense()}


def _carried_out(host: Host) -> Tick:
    host.begin(PLAN)
    return host.tick()


def test_any_blueprint_can_be_tried_with_what_befalls_its_next_operation(table: Host) -> None:
    before = _facts(table)
    table.inject("nothing")
    assert _carried_out(table).outcome is Outcome.RETURNED
    assert _facts(table) == before
    table.inject("fail")
    assert _carried_out(table).outcome is Outcome.FAILED
    table.inject("raise")
    assert _carried_out(table).outcome is Outcome.RAISED
    assert _facts(table) == before
    table.inject("elsewhere", state="REGISTRATION/State111")
    assert _carried_out(table).outcome is Outcome.RETURNED
    assert _facts(table) == {"REGISTRATION/0": "1", "REGISTRATION/2": "1", "DIGITIZATION/0": "0"}
    table.inject("set", fact="REGISTRATION/2", value="0")
    assert _facts(table)["REGISTRATION/2"] == "0"
    table.inject("hang")
    assert _carried_out(table).outcome is Outcome.RUNNING
    assert all(table.tick().outcome is Outcome.RUNNING for _ in range(50))
    table.cancel("hold")
    assert _carried_out(table).outcome is Outcome.RETURNED
    assert _facts(table)["REGISTRATION/0"] == "1"


@pytest.mark.parametrize(
    ("fault", "parameters", "words"),
    [
        ("set", {"fact": "REGISTRATION/1", "value": "1"}, "no fact called 'REGISTRATION/1'"),
        ("set", {"fact": "1", "value": "1"}, "no fact called '1'"),
        ("elsewhere", {"state": "State112"}, "there is no state 'State112'"),
        ("burst", {}, "the world 'table' has no fault 'burst'"),
    ],
)
def test_what_the_table_does_not_have_is_said(
    table: Host, fault: str, parameters: dict[str, Any], words: str
) -> None:
    with pytest.raises(UsageError, match=words):
        table.inject(fault, **parameters)
