"""Folders and decisions are trusted only if no other user could have written them."""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.errors import PluginError, SaveError
from smsl_studio.library.decisions import PluginDecision, decide, read_decisions
from smsl_studio.library.loading import discover
from smsl_studio.library.ownership import exposure_of
from smsl_studio.library.permission import allow, forbid
from smsl_studio.library.survey import FoundPlugin, PluginState, survey
from tests.plugin_folder import SHIPPED, found_plugin, write_allowed, write_plugin

CODE = "def register(library): ..."


@pytest.fixture
def lamp(home: Path) -> Path:
    """A plugin in the user's folder that was allowed."""
    return write_allowed(home, "lamp", CODE)


def _fault() -> str:
    """The sentence of the one plugin that cannot be loaded; it and no other is missing."""
    loaded = discover()
    assert [plugin.name for plugin in loaded.plugins] == [*SHIPPED]
    (fault,) = loaded.faults
    return fault.sentence


@pytest.mark.parametrize("where", ["", "plugin.py", "plugin.toml", "inner", ".."])
def test_what_everybody_may_write_is_one_named_error(lamp: Path, where: str) -> None:
    (lamp / "inner").mkdir()
    allow(found_plugin("lamp"))
    (lamp / where).chmod(0o777)
    sentence = _fault()
    assert "may be written by everybody" in sentence
    assert f"chmod go-w {(lamp / where).resolve()}" in sentence
    faulty = next(found for found in survey() if found.state is PluginState.FAULTY)
    with pytest.raises(PluginError, match="may be written by everybody"):
        allow(faulty)


def test_a_sticky_bit_is_not_enough_for_the_plugins_own_folder(lamp: Path) -> None:
    lamp.chmod(0o1777)
    assert "may be written by everybody" in _fault()


def test_a_folder_of_plugins_that_others_may_write_is_one_error_however_many_it_holds(
    lamp: Path, home: Path
) -> None:
    write_allowed(home, "candle", CODE)
    lamp.parent.chmod(0o777)
    assert "may be written by everybody" in _fault()


def test_what_a_group_may_write_is_one_named_error_unless_it_is_the_users_own_group(
    lamp: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lamp.chmod(0o775)
    monkeypatch.setattr("smsl_studio.library.ownership._is_own_group", lambda *_: False)
    sentence = _fault()
    assert "may be written by the group" in sentence
    assert f"chmod g-w {lamp}" in sentence
    monkeypatch.setattr("smsl_studio.library.ownership._is_own_group", lambda *_: True)
    assert found_plugin("lamp").state is PluginState.ALLOWED


def test_the_group_of_root_is_nobodys_own(lamp: Path) -> None:
    shown: list[Any] = list(lamp.stat())
    shown[stat.ST_MODE] |= stat.S_IWGRP
    shown[stat.ST_GID] = 0
    assert exposure_of(lamp, os.stat_result(shown)) is not None


def test_a_folder_above_that_others_may_write_counts_unless_it_is_sticky(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shared = tmp_path / "shared"
    write_plugin(shared / "inner", "lamp", CODE)
    for named in (shared / "inner" / "lamp", shared / "inner"):
        monkeypatch.setenv("SMSL_PLUGIN_PATH", str(named))
        shared.chmod(0o1777)
        assert found_plugin("lamp").state is PluginState.ALLOWED
        shared.chmod(0o777)
        assert f"{shared} may be written by everybody" in _fault()


def test_a_plugin_of_another_user_is_one_named_error(
    lamp: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("smsl_studio.library.ownership.ROOT", -1)
    monkeypatch.setattr("os.geteuid", lambda: 12345)
    exposed = exposure_of(lamp, lamp.stat())
    assert exposed is not None
    assert "belongs to the user" in exposed.words
    assert "belongs to the user" in next(f for f in discover().faults if f.plugin).sentence


def test_a_plugin_reached_by_a_link_is_the_one_it_leads_to(home: Path, tmp_path: Path) -> None:
    place = write_plugin(tmp_path / "code", "lamp", CODE)
    (home / "plugins").mkdir(parents=True)
    (home / "plugins" / "lamp").symlink_to(place)
    assert (found_plugin("lamp").location, found_plugin("lamp").source) == (str(place), "user")
    allow(found_plugin("lamp"))
    assert found_plugin("lamp").state is PluginState.ALLOWED
    other = write_plugin(tmp_path / "other", "lamp", CODE)
    (home / "plugins" / "lamp").unlink()
    (home / "plugins" / "lamp").symlink_to(other)
    assert found_plugin("lamp").state is PluginState.NEW
    (tmp_path / "other").chmod(0o777)
    assert f"{tmp_path / 'other'} may be written by everybody" in _fault()


def test_forbidding_works_whatever_is_wrong_and_allowing_again_asks_for_it(lamp: Path) -> None:
    (lamp / "plugin.toml").write_text("name = 3")
    assert "name" in _fault()
    forbid(next(found for found in survey() if found.location == str(lamp)))
    loaded = discover()
    assert not loaded.faults
    assert [found.state for found in loaded.waiting] == [PluginState.FORBIDDEN]
    with pytest.raises(PluginError, match="name"):
        allow(loaded.waiting[0])


def _states() -> dict[str, str]:
    return {found.name: found.state.value for found in survey() if found.name}


def test_decisions_without_the_right_form_are_not_believed(
    lamp: Path, home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    candle = write_plugin(tmp_path / "path", "candle", CODE)
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(candle))
    forbid(found_plugin("candle"))
    file = home / "plugin-decisions.json"
    good = file.read_bytes()
    again = json.loads(good)
    again["plugins"] *= 2
    broken = {
        "it is no JSON": b"{",
        "it is no JSON: maximum": b"[" * 100_000,
        "version": good.replace(b'"version": 1', b'"version": 2'),
        "plugins.1.decision": good.replace(b'"allowed"', b'"yes"'),
        "plugins.1.digest": good.replace(b'"digest": "', b'"digest": "x'),
        "plugins.0.more": good.replace(b'"name"', b'"more": 1, "name"'),
        "decides twice": json.dumps(again).encode(),
        "longer than": b" " * 4_000_001,
    }
    for words, raw in broken.items():
        file.write_bytes(raw)
        with pytest.raises(PluginError, match="not believed") as caught:
            read_decisions()
        assert words in caught.value.sentence or "plugins." in words
        assert caught.value.place is not None
        assert _states() == {
            "candle": "new",
            "lamp": "new",
            "hanoi": "allowed",
            "registration": "allowed",
            "chess": "allowed",
            "river": "allowed",
        }
        with pytest.raises(PluginError):
            allow(found_plugin("lamp"))
        assert file.read_bytes() == raw
    (fault,) = discover().faults
    assert str(fault).startswith(f"{file}:1:1: the decisions about plugins are not believed")
    file.write_bytes(good)
    assert _states() == {
        "candle": "forbidden",
        "lamp": "allowed",
        "hanoi": "allowed",
        "registration": "allowed",
        "chess": "allowed",
        "river": "allowed",
    }


def test_decisions_that_others_could_have_written_are_not_believed(lamp: Path, home: Path) -> None:
    file = home / "plugin-decisions.json"
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    file.chmod(0o666)
    assert _states()["lamp"] == "new"
    file.chmod(0o600)
    assert _states()["lamp"] == "allowed"
    file.rename(home / "elsewhere.json")
    file.symlink_to(home / "elsewhere.json")
    assert _states()["lamp"] == "new"
    file.unlink()
    os.mkfifo(file)
    assert _states()["lamp"] == "new"
    file.unlink()
    assert _states()["lamp"] == "new"


def test_a_decision_that_cannot_be_written_is_an_error_and_leaves_nothing_behind(
    home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    decide(PluginDecision(location="/a", name="a", decision="forbidden"))

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    with pytest.raises(SaveError, match="No space left"):
        decide(PluginDecision(location="/b", name="b", decision="forbidden"))
    assert list(read_decisions()) == ["/a"]
    assert [path.name for path in home.iterdir()] == ["plugin-decisions.json"]


def test_a_path_that_is_no_text_is_a_fault_and_spoils_no_decision(lamp: Path) -> None:
    lamp.rename(os.fsdecode(os.fsencode(lamp.parent) + b"/l\xff"))
    assert "its path is no valid text" in _fault()
    found: FoundPlugin = next(found for found in survey() if found.error)
    with pytest.raises(PluginError):
        allow(found)
