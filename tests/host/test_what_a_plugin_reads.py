"""What runs when plugins are only described, and what their environment has."""

from __future__ import annotations

import json
import os
from contextlib import closing
from importlib.util import cache_from_source
from pathlib import Path
from py_compile import compile as compiled

import pytest

import smsl_studio as smsl
from smsl_studio.front.campaign_runs import CampaignRun
from smsl_studio.front.campaign_workers import CampaignWorkers
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.loading import discover
from tests.cli.shell import make_shell
from tests.installed_package import BLUEPRINT
from tests.plugin_folder import LAMP_PLUGIN, blueprint_of, write_plugin

SECRETS = ("SMSL_PASSPHRASE", "SMSL_NEW_PASSPHRASE")

TELLS = """
import os
with open({file!r}, "a") as file:
    file.write(" ".join(sorted(name for name in os.environ if "PASSPHRASE" in name)) + "|")
"""
"""The code of a plugin that writes down which passphrases it can read."""


@pytest.fixture
def told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """What a plugin has read of the passphrases that stand in the environment."""
    file = tmp_path / "told.txt"
    write_plugin(tmp_path / "plugins", "lamp", TELLS.format(file=str(file)) + LAMP_PLUGIN)
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(tmp_path / "plugins"))
    for name in SECRETS:
        monkeypatch.setenv(name, "correct horse")
    return file


def test_a_plugin_that_is_described_reads_no_passphrase(told: Path) -> None:
    assert "lamp" in describe().worlds
    assert told.read_text() == "|"


def test_a_plugin_in_the_process_of_a_run_reads_no_passphrase(told: Path) -> None:
    assert smsl.run(blueprint_of(BLUEPRINT), "lamp", host="process").reason == "goal_reached"
    assert set(told.read_text()) == {"|"}


def test_a_worker_of_a_campaign_reads_no_passphrase(told: Path, tmp_path: Path) -> None:
    file = tmp_path / "lamp.json"
    file.write_text(json.dumps(BLUEPRINT))
    with closing(CampaignWorkers(str(file), 1)) as workers:
        (verdict,) = workers.verdicts([CampaignRun("lamp", 0)])
    assert verdict.reached
    assert set(told.read_text()) == {"|"}


def test_a_command_that_loads_plugins_itself_has_no_passphrase_left(
    told: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "lamp.json"
    file.write_text(json.dumps(BLUEPRINT))
    answer = make_shell(capsys)("run", str(file), "--world", "lamp", "--host", "local")
    assert answer.status == 0, answer.err
    assert set(told.read_text()) == {"|"}
    assert os.environ["SMSL_PASSPHRASE"] == "correct horse", "it is put back at the end"


SEEKS = """
import sys
with open({file!r}, "a") as file:
    ours = [name for name in sys.modules if name.startswith("smsl_studio")]
    found = [name for name in ours if "correct horse" in repr(vars(sys.modules[name]))]
    file.write(f"{{len(ours) > 100}} {{found}}")
"""
"""The code of a plugin that looks for a passphrase in all variables of the program's modules."""


def test_no_variable_of_a_module_has_a_passphrase_while_a_command_runs(
    told: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    plugin = tmp_path / "plugins" / "lamp" / "plugin.py"
    plugin.write_text(SEEKS.format(file=str(told)) + LAMP_PLUGIN)
    file = tmp_path / "lamp.json"
    file.write_text(json.dumps(BLUEPRINT))
    answer = make_shell(capsys)("run", str(file), "--world", "lamp", "--host", "local")
    assert answer.status == 0, answer.err
    assert told.read_text() == "True []"


WORLD = """
def register(library):
    @library.world("{name}", engine="table")
    def build(world, blueprint, seed): ...
"""


def test_bytecode_beside_a_plugin_is_not_run_to_describe_it(tmp_path: Path) -> None:
    """It could say of its worlds what the source does not say, such as that none is hardware."""
    place = write_plugin(tmp_path, "lamp", WORLD.format(name="told"))
    times = (place / "plugin.py").stat()
    other = tmp_path / "other.py"
    other.write_text((place / "plugin.py").read_text().replace("told", "evil"))
    os.utime(other, ns=(times.st_atime_ns, times.st_mtime_ns))
    assert other.stat().st_size == times.st_size
    compiled(str(other), cfile=cache_from_source(str(place / "plugin.py")), doraise=True)
    assert "evil" in discover([tmp_path]).worlds, "this is what Python believes"
    assert {"told", "evil"} & set(describe([tmp_path]).worlds) == {"told"}


def test_a_module_that_is_bytecode_alone_is_not_run_to_describe_a_plugin(tmp_path: Path) -> None:
    place = write_plugin(tmp_path, "lamp", "from .words import NAME\n" + WORLD, words="")
    (place / "words.py").write_text("NAME = 1")
    compiled(str(place / "words.py"), cfile=str(place / "words.pyc"), doraise=True)
    (place / "words.py").unlink()
    (fault,) = describe([tmp_path]).faults
    assert "No module named" in fault.sentence


def test_a_plugin_whose_code_lies_elsewhere_is_described_all_the_same(tmp_path: Path) -> None:
    """Its user has named the folder; an approval cannot sign its code."""
    place = write_plugin(tmp_path / "plugins", "lamp", "from .words import *\n" + LAMP_PLUGIN)
    (tmp_path / "words.py").write_text("")
    (place / "words.py").symlink_to("../../words.py")
    assert "lamp" in describe([tmp_path / "plugins"]).worlds
