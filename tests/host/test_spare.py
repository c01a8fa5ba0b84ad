"""The spare child: it is quick to take, serves one run only, and is never older than the
plugins."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.generate.rules import hanoi
from smsl_studio.host.process import ProcessHost
from smsl_studio.host.protocol import Outcome
from smsl_studio.host.spare import Spare
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

START = {"LAMP": "State_0"}
ON = Address("LAMP", "State_0", "Op_on")
Make = Callable[..., ProcessHost]


@pytest.fixture
def spare() -> Iterator[Spare]:
    found = Spare()
    yield found
    found.close()
    found.close()
    assert found.pid is None


@pytest.fixture
def lamp(tmp_path: Path, spare: Spare) -> Iterator[Make]:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    hosts: list[ProcessHost] = []

    def make(seed: int = 0) -> ProcessHost:
        hosts.append(ProcessHost(blueprint_of(LAMP), "lamp", seed, [tmp_path], spare=spare))
        return hosts[-1]

    yield make
    for host in hosts:
        host.close()


def _story(host: ProcessHost) -> list[object]:
    found: list[object] = [host.open(START), host.sense()]
    host.begin(ON)
    tick = host.tick()
    while tick.outcome is Outcome.RUNNING:
        found.append(tick)
        tick = host.tick()
    return [*found, tick]


def test_a_prepared_child_serves_the_run_it_was_made_for_and_no_other(
    lamp: Make, spare: Spare
) -> None:
    cold = lamp()
    told = _story(cold)
    spare.warm(cold.recipe)
    waiting = spare.pid
    spare.warm(cold.recipe)
    assert spare.pid == waiting is not None
    warm, next_one = lamp(), lamp()
    assert _story(warm) == told
    assert warm.pid == waiting
    assert spare.pid is None
    assert _story(next_one) == told
    assert next_one.pid != waiting


def test_a_child_that_only_has_its_imports_done_serves_any_run(lamp: Make, spare: Spare) -> None:
    spare.warm()
    waiting = spare.pid
    one = lamp(seed=3)
    one.open(START)
    assert one.pid == waiting


def test_a_child_prepared_for_something_else_is_not_taken(lamp: Make, spare: Spare) -> None:
    spare.warm(lamp(seed=1).recipe)
    waiting = spare.pid
    other = lamp(seed=2)
    other.open(START)
    assert other.pid != waiting
    assert spare.pid is None


def test_an_edited_plugin_is_read_anew(lamp: Make, spare: Spare, tmp_path: Path) -> None:
    spare.warm(lamp().recipe)
    waiting = spare.pid
    code = tmp_path / "lamp" / "plugin.py"
    code.write_text(code.read_text("utf-8").replace('"1" if to', '"9" if to'), "utf-8")
    after = lamp()
    _story(after)
    assert after.pid != waiting
    assert after.sense()[0].value == "9"


def test_a_spare_that_died_costs_nothing(lamp: Make, spare: Spare) -> None:
    host = lamp()
    spare.warm(host.recipe)
    assert spare.pid is not None
    os.kill(spare.pid, signal.SIGKILL)
    _story(host)
    assert host.pid is not None


def test_what_a_prepared_child_could_not_do_is_told_by_open(
    lamp: Make, spare: Spare, tmp_path: Path
) -> None:
    code = tmp_path / "lamp" / "plugin.py"
    broken = code.read_text("utf-8").replace('print("built")', "raise SystemExit(9)")
    code.write_text(broken, "utf-8")
    host = lamp()
    spare.warm(host.recipe)
    waiting = spare.pid
    with pytest.raises(Exception, match="broke while it was built: SystemExit: 9"):
        host.open(START)
    assert host.pid == waiting


def test_a_blueprint_longer_than_the_pipe_is_taken_in_meanwhile(spare: Spare) -> None:
    blueprint = hanoi(7)
    assert len(blueprint.document.text) > 2**17
    start = {"SB1": blueprint["SB1"].initial}
    spare.warm(ProcessHost(blueprint, "table").recipe)
    host = ProcessHost(blueprint, "table", spare=spare)
    waiting = spare.pid
    assert len(host.open(start).bound) == blueprint.operation_count
    assert host.pid == waiting
    host.close()
    spare.warm(ProcessHost(blueprint, "table").recipe)
    spare.close()
