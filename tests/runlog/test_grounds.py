"""The header of a log holds what state checks depend on."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import smsl_studio as smsl
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.events import OperationStarted
from smsl_studio.runlog.grammar.log_reader import read_log
from smsl_studio.runlog.grounds import BoundCode, grounds_of
from smsl_studio.shipped import samples_dir
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

SILENT = LAMP_PLUGIN.replace('print("built")', "pass").replace('print("switching")', "pass")


def _grounds(path: Path) -> Any:
    return read_log(path, COMMANDS).header["grounds"]


def test_a_log_says_what_states_want_and_what_is_sensed(tmp_path: Path) -> None:
    blueprint = smsl.read(samples_dir() / "registration-digitization.json")
    smsl.run(blueprint, log=tmp_path / "log")
    found = _grounds(tmp_path / "log")
    assert found["states"]["REGISTRATION"]["State110"] == ["1", None, "0"]
    assert found["states"]["DIGITIZATION"] == {"State0": ["0"], "State1": ["1"]}
    assert found["subs"] == {"REGISTRATION": {"1": {
        "sub": "DIGITIZATION", "activating": "State1", "initial": "State0",
        "on": ["State110", "State111"]}}}  # fmt: skip
    assert found["sensed"] == ["REGISTRATION/0", "REGISTRATION/2", "DIGITIZATION/0"]


def silent_logs(folder: Path) -> Iterator[Path]:
    """The log of a run in a world of a plugin, for each host."""
    write_plugin(folder / "plugins", "lamp", SILENT)
    for host in ("local", "process"):
        path = folder / host
        smsl.run(blueprint_of(LAMP), "lamp", host=host, plugin_paths=[folder / "plugins"],
                 avoid=["LAMP/State_0/Op_spin"], log=path)  # fmt: skip
        yield path


def test_sensors_of_a_plugin_are_named_before_its_world_is_built(tmp_path: Path) -> None:
    for path in silent_logs(tmp_path):
        assert _grounds(path)["sensed"] == ["LAMP/0"]


def test_a_header_stays_a_line_that_people_open() -> None:
    """An SB with too many states is left out whole, and a smaller one behind it is not."""
    many: dict[str, Any] = {f"State_{n:04}": {} for n in range(999)}
    three: dict[str, Any] = {f"State_{n:04}": {} for n in range(3)}
    blueprint = blueprint_of({"MANY": many, "THREE": three, "ONE": {"State_0": {}}})
    found = grounds_of(blueprint, BoundCode(("MANY", n) for n in range(1001)))
    assert list(found["states"]) == ["MANY", "ONE"]
    assert found["sensed"] == []
    assert len(json.dumps(found)) < 100_000


def test_a_log_says_which_functions_and_costs_operations_have(tmp_path: Path) -> None:
    """A rise runs no function and costs nothing of its own; the same name elsewhere does."""
    blueprint = smsl.read(samples_dir() / "registration-digitization.json")
    smsl.run(blueprint, log=tmp_path / "log")
    found = _grounds(tmp_path / "log")
    functions, costs = found["functions"]["REGISTRATION"], found["costs"]["REGISTRATION"]
    assert functions["Registered"] == "table.set_facts"
    assert functions["State100/LandmarksDigitized"] == ""
    assert functions["State110/LandmarksDigitized"] == "table.set_facts"
    assert costs["State100/LandmarksDigitized"] is None
    assert "Registered" not in costs
    assert found["priced"] is False


def test_functions_of_a_plugin_are_named_before_its_world_is_built(tmp_path: Path) -> None:
    for path in silent_logs(tmp_path):
        run = read_log(path, COMMANDS)
        assert run.doubt is None
        told = [one for one in run.events if isinstance(one, OperationStarted)]
        known = _grounds(path)["functions"]["LAMP"]
        assert told
        assert all(known[one.address.split("/")[2]] == one.function for one in told)


def test_operations_beyond_a_bound_are_not_named() -> None:
    """The header stays a line that people open, and its making stays quick."""
    ends = {f"Op_{n}": "State_1" for n in range(1001)}
    blueprint = blueprint_of({"MANY": {"State_0": ends, "State_1": {}},
                              "ONE": {"State_0": {"Op": "State_1"}, "State_1": {}}})  # fmt: skip
    found = grounds_of(blueprint, BoundCode(function=lambda edge: "f"))
    assert list(found["functions"]) == ["ONE"]
    assert found["costs"] == {"ONE": {}}
