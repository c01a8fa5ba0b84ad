"""Cost functions of a plugin: their arguments, and valid and invalid answers, in both hosts."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.host.local import LocalHost
from smsl_studio.host.process import ProcessHost
from smsl_studio.host.protocol import Host, Priced
from smsl_studio.library.loading import discover
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

ON, BREAK, SPIN, OFF = (
    Address("LAMP", "State_0", "Op_on"),
    Address("LAMP", "State_0", "Op_break"),
    Address("LAMP", "State_0", "Op_spin"),
    Address("LAMP", "State_1", "Op_off"),
)
START = {"LAMP": "State_0"}
PRICED = (
    LAMP_PLUGIN
    + """
    @library.cost("Op_{to}")
    def worn(state, scene, history, to: str):
        used = sum(edge == f"LAMP/{state}/Op_{to}" for edge, outcome in history)
        return used * 1.5 if used else None

    @library.cost("Op_break")
    def odd(state, scene, history):
        answers = {"0": -1, "1": float("nan"), "2": "much", "3": True, "4": 2e12, "5": 7}
        found = scene["LAMP/0"]
        if found is None:
            raise ValueError("the lamp is dark")
        if found == "6":
            raise SystemExit("no")
        return answers[found]
"""
)


@pytest.fixture(params=["local", "process"])
def host(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Host]:
    write_plugin(tmp_path, "lamp", PRICED)
    kinds: dict[str, Callable[..., Host]] = {"local": LocalHost, "process": ProcessHost}
    host = kinds[request.param](blueprint_of(LAMP), "lamp", 0, [tmp_path])
    yield host
    host.close()


def test_only_what_is_news_is_answered_and_history_is_kept(host: Host) -> None:
    assert host.open(START).priced
    assert host.costs({"LAMP/0": "5"}, ()) == Priced({BREAK: 7.0})
    assert host.costs({"LAMP/0": "5"}, ((str(ON), "committed"),)) == Priced({ON: 1.5})
    assert host.costs({"LAMP/0": "5"}, ()) == Priced()
    found = host.costs({"LAMP/0": "5"}, ((str(ON), "failed"), (str(OFF), "committed")))
    assert found == Priced({ON: 3.0, OFF: 1.5})
    host.open(START)
    assert host.costs({"LAMP/0": "5"}, ((str(ON), "committed"),)) == Priced({ON: 1.5, BREAK: 7.0})


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("0", "says -1 for LAMP/State_0/Op_break, which is no number from 0 to 1e12"),
        ("1", "says nan for"),
        ("2", "says 'much' for"),
        ("3", "says True for"),
        ("4", "says 2000000000000.0 for"),
        ("6", "raised an error for LAMP/State_0/Op_break: SystemExit: no"),
        (None, "raised an error for LAMP/State_0/Op_break: ValueError: the lamp is dark"),
    ],
)
def test_an_answer_that_is_no_cost_is_a_named_fault_and_the_declared_cost_stands(
    host: Host, value: str | None, words: str
) -> None:
    host.open(START)
    host.costs({"LAMP/0": "5"}, ())
    found = host.costs({"LAMP/0": value}, ())
    assert found.costs == {BREAK: None}
    assert len(found.faults) == 1
    assert found.faults[0].startswith("the cost function lamp.odd ")
    assert words in found.faults[0]
    assert found.faults[0].endswith("; what is declared stands")


def test_a_world_without_cost_functions_says_so(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    host = LocalHost(blueprint_of(LAMP), "lamp", 0, [tmp_path])
    assert not host.open(START).priced
    host.close()


def test_a_cost_function_must_take_what_it_is_given(tmp_path: Path) -> None:
    code = LAMP_PLUGIN + '\n    @library.cost("Op_on")\n    def cost(state): ...\n'
    write_plugin(tmp_path, "lamp", code)
    faults = [str(fault) for fault in discover([tmp_path]).faults]
    words = "cost does not take the state, scene, history as its first parameters"
    assert any(words in fault for fault in faults)
