"""A plugin in the user's folder runs only after it was allowed. All commands report its state."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.shell import Shell
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

RAN = "import pathlib\npathlib.Path({0!r}).write_text('ran')\n"


@pytest.fixture
def lamp(home: Path, tmp_path: Path) -> Path:
    """A new plugin in the user's folder; its code leaves the file ``ran`` behind."""
    folder = write_plugin(home / "plugins", "lamp", _code(tmp_path))
    words = 'version = "1.5"\ndescription = "A lamp."\nworlds = ["lamp"]\n'
    (folder / "plugin.toml").write_text(f'name = "lamp"\n{words}', "utf-8")
    return folder


def _code(tmp_path: Path) -> str:
    return RAN.format(str(tmp_path / "ran")) + LAMP_PLUGIN


@pytest.fixture
def blueprint(tmp_path: Path) -> str:
    file = tmp_path / "lamp.json"
    file.write_text(blueprint_of(LAMP).document.text, "utf-8")
    return str(file)


def _told(shell: Shell, name: str) -> dict[str, object]:
    told = shell("plugins", "--format", "json").json
    found = [one for one in (*told["plugins"], *told["faults"]) if one.get("name", name) == name]
    (one,) = [one for one in found if one.get("plugin", name) == name]
    return dict(one)


def test_a_new_plugin_is_listed_from_its_own_words_and_does_not_run(
    shell: Shell, lamp: Path, blueprint: str, tmp_path: Path
) -> None:
    told = _told(shell, "lamp")
    assert (told["state"], told["version"], told["location"]) == ("new", "1.5", str(lamp))
    kinds = ("operations", "sensors", "faults", "supervisors")
    rest: dict[str, list[str]] = {kind: [] for kind in kinds}
    assert told["manifest"] == {"worlds": ["lamp"], **rest}
    assert "plugins allow lamp" in str(told["message"])
    text = shell("plugins").out
    assert f"lamp 1.5 (user, {lamp}): new\n    A lamp.\n" in text
    assert "plugins allow lamp" in text
    assert "plugins allow lamp" in shell("worlds").out
    for world in ("lamp", "table"):
        shell("run", blueprint, "--world", world)
        shell("check", blueprint, "--world", world)
    assert not (tmp_path / "ran").exists()


def test_a_run_in_a_world_of_a_new_plugin_says_how_to_allow_it(
    shell: Shell, lamp: Path, blueprint: str
) -> None:
    refused = shell("run", blueprint, "--world", "lamp")
    assert (refused.status, refused.out) == (2, "")
    assert f"the world 'lamp' is of the plugin 'lamp' in {lamp}" in refused.err
    assert "smsl-studio plugins allow lamp" in refused.err
    (lamp / "plugin.toml").write_text('name = "lamp"\n', "utf-8")
    silent = shell("run", blueprint, "--world", "lamp").err
    assert "the plugin 'lamp' is not loaded: it is new" in silent
    assert "smsl-studio plugins allow lamp" in silent


def test_what_was_allowed_runs_until_its_files_change(
    shell: Shell, lamp: Path, blueprint: str, tmp_path: Path
) -> None:
    run = (
        "run",
        blueprint,
        "--world",
        "lamp",
        "--avoid=State_0/Op_break",
        "--avoid=State_0/Op_spin",
    )
    allowed = shell("plugins", "allow", "lamp")
    assert (allowed.status, allowed.err) == (0, "")
    assert allowed.out.startswith(f"lamp: allowed (user, {lamp})\n    files: SHA-256 ")
    assert not (tmp_path / "ran").exists(), "allowing is no running"
    assert _told(shell, "lamp")["state"] == "allowed"
    assert shell(*run).status == 0
    assert (tmp_path / "ran").exists()
    assert _told(shell, "lamp")["state"] == "allowed", "loading leaves the folder as it was"
    (tmp_path / "ran").unlink()
    (lamp / "more.py").write_text("", "utf-8")
    changed = _told(shell, "lamp")
    assert changed["state"] == "changed"
    assert "plugins allow lamp" in str(changed["message"])
    refused = shell(*run)
    assert refused.status == 2
    assert "its files have changed since it was allowed" in refused.err
    assert not (tmp_path / "ran").exists()
    shell("plugins", "allow", "lamp")
    assert shell(*run).status == 0


def test_what_is_forbidden_does_not_load_wherever_it_comes_from(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = write_plugin(tmp_path / "path", "lamp", _code(tmp_path))
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(tmp_path / "path"))
    forbidden = shell("plugins", "forbid", "lamp", "--format", "json")
    assert (forbidden.status, forbidden.json["state"]) == (0, "forbidden")
    assert _told(shell, "lamp")["state"] == "forbidden"
    (place / "plugin.py").write_text(_code(tmp_path) + "\n", "utf-8")
    assert _told(shell, "lamp")["state"] == "forbidden", "whatever it becomes"
    shell("plugins", "forbid", "hanoi")
    assert _told(shell, "hanoi")["state"] == "forbidden"
    assert "hanoi: engine" not in shell("worlds").out
    assert not (tmp_path / "ran").exists()
    for name in ("lamp", "hanoi"):
        shell("plugins", "allow", name)
        assert _told(shell, name)["state"] == "allowed"


def test_a_name_of_two_plugins_and_one_of_none_are_refused_with_the_names(
    shell: Shell, lamp: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    twin = write_plugin(tmp_path / "path", "lamp", LAMP_PLUGIN)
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(tmp_path / "path"))
    for verb in ("allow", "forbid"):
        both = shell("plugins", verb, "lamp")
        assert (both.status, both.out) == (2, "")
        assert f"there are 2 plugins 'lamp': {twin}, {lamp}" in both.err
        none = shell("plugins", verb, "candle")
        assert (none.status, none.out) == (2, "")
        assert "there is no plugin 'candle'" in none.err
        assert "There are chess, hanoi, lamp, registration, river." in none.err
        assert shell("plugins", verb).status == 2
    assert shell("plugins", "allow", str(lamp)).status == 0
    assert shell("plugins", "permit", "lamp").status == 2


def test_the_robots_of_a_world_are_listed(shell: Shell, tmp_path: Path, home: Path) -> None:
    code = """\
from dataclasses import replace
from smsl_studio.world.arms.panda import ARM
def register(library):
    library.robot(replace(ARM, name="long_panda"))
"""
    write_plugin(home / "plugins", "more", code)
    shell("plugins", "allow", "more")
    hanoi, more = _told(shell, "hanoi"), _told(shell, "more")
    choice = {"world": "hanoi", "robots": ["panda", "iiwa", "dvrk", "long_panda"]}
    assert (hanoi["world_robots"], hanoi["robots"]) == ([choice], [])
    assert (more["world_robots"], more["robots"]) == ([], ["long_panda"])
    assert _told(shell, "chess")["world_robots"] == []
    text = shell("plugins").out
    assert "    robots of hanoi: panda, iiwa, dvrk, long_panda\n" in text
    assert "    robots: long_panda\n" in text
