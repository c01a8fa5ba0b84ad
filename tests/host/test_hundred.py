"""A hundred hostile plugins: none runs in this process, none stops the others, each has one named
fault."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import StudioError
from smsl_studio.front.runs import run
from smsl_studio.host.plugin_offers import describe
from smsl_studio.host.process import ChildTerms, ProcessHost
from smsl_studio.host.protocol import Outcome
from smsl_studio.library.loaded import Loaded
from tests.hostile_files import write_files
from tests.hostile_plugins import RUNNING, write_hostile, write_running
from tests.plugin_folder import LAMP, LAMP_PLUGIN, SHIPPED, blueprint_of, write_plugin
from tests.processes import child_processes

LIMIT = 1.5
ON = Address("LAMP", "State_0", "Op_on")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home"))
    return tmp_path / "plugins"


@pytest.fixture
def marks(tmp_path: Path) -> Iterator[Path]:
    """Where plugins leave the numbers of the processes that their code runs in: never ours."""
    file = tmp_path / "marks"
    yield file
    ran_in = set(file.read_text().split())
    assert ran_in
    assert str(os.getpid()) not in ran_in


def _faults(loaded: Loaded) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for fault in loaded.faults:
        found.setdefault(Path(fault.location).name, []).append(fault.sentence)
    return found


def test_each_is_one_named_error_and_the_others_are_there(
    folder: Path, marks: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    words = write_hostile(folder, marks, os.getpid()) | write_files(folder)
    write_plugin(folder, "aa_good", LAMP_PLUGIN)
    write_plugin(folder, "zz_good", LAMP_PLUGIN.replace('"lamp"', '"lantern"'))
    before = child_processes()
    told = describe([folder], limit=4.0)
    said = capfd.readouterr()
    faults = _faults(told)
    assert {"lamp", "lantern", "hanoi"} <= set(told.worlds)
    names = [plugin.name for plugin in told.plugins]
    assert names == ["aa_good", "zz_good", *SHIPPED]
    assert {name: len(told) for name, told in faults.items()} == dict.fromkeys(words, 1)
    wrong = {name: told for name, told in faults.items() if not re.search(words[name], told[0])}
    assert wrong == {}
    assert child_processes() == before
    assert said.out == ""
    assert len(said.err) < 1_001_000
    assert "\x1b" not in said.err
    assert "\x9b" not in said.err


@pytest.mark.parametrize("name", list(RUNNING))
def test_each_that_does_it_in_a_run_is_one_error_of_that_run(
    folder: Path, marks: Path, name: str
) -> None:
    write_running(folder, marks, name)
    blueprint = blueprint_of(LAMP)
    host = ProcessHost(blueprint, name, 0, [folder], ChildTerms(hang_limit=LIMIT, open_limit=5.0))
    said: list[str] = []
    try:
        opened = host.open({"LAMP": "State_0"})
        said += [sample.reason for sample in host.sense()]
        said += host.costs({}, ()).faults
        host.begin(ON)
        tick = host.tick()
        while tick.outcome is Outcome.RUNNING and tick.time < 0.5:
            tick = host.tick()
        said.append(tick.message)
        if RUNNING[name][0] == "fault":
            host.inject("dark")
            host.tick()
        host.cancel("abort")
        assert opened.world == name
    except StudioError as error:
        said.append(error.sentence)
    finally:
        host.close()
    told = [words for words in said if words]
    assert len({re.sub("for LAMP/.*", "", words) for words in told}) == 1, told
    assert re.search(RUNNING[name][2], told[0]), told
    assert child_processes() == []


TURNCOAT = """
import os, sys
def register(library):
    open({marks!r}, "a").write(f"{{os.getpid()}}\\n")
    described = "smsl_studio.host.plugin_child" in sys.modules
    if not described:
        os._exit(3)
    @library.world("other", engine="table")
    def build(world, blueprint, seed): pass
"""


def test_a_run_goes_on_beside_them_all(folder: Path, marks: Path) -> None:
    for name in ("built_exit", "killed"):
        write_running(folder, marks, name)
    write_plugin(folder, "turncoat", TURNCOAT.format(marks=str(marks)))
    write_plugin(folder, "lamp", LAMP_PLUGIN)
    blueprint, avoid = blueprint_of(LAMP), ["Op_break", "Op_spin"]
    done = run(blueprint, "lamp", host="process", plugin_paths=[folder], avoid=avoid)
    assert done.reason == "goal_reached", done.sentence
    lost = run(blueprint, "other", host="process", plugin_paths=[folder])
    assert "exit status 3 while the plugin 'turncoat' was loaded" in lost.sentence
