"""The window asks about a plugin in the user's folder before any of its code runs."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from smsl_studio.library.survey import PluginState
from smsl_studio.studio.shell.plugin_question import PluginQuestion
from tests.plugin_folder import found_plugin, write_plugin
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

CODE = """
import pathlib
pathlib.Path({ran!r}).write_text("ran")

def register(library):
    @library.world("lamp", engine="table")
    def build(world, blueprint, seed): ...

    @library.operation("Op_1b")
    def work(world):
        yield
"""
MANIFEST = """
name = "lamp"
version = "1.5"
description = "<b>A lamp</b> \\u202e that is switched."
worlds = ["lamp"]
operations = ["Op_1b", "<img src=x>"]
"""


class Desk:
    """A person at a window, and a plugin that somebody has put into their folder."""

    def __init__(self, person: Person, folder: Path, ran: Path) -> None:
        self.person, self.folder, self._ran = person, folder, ran

    @property
    def ran(self) -> bool:
        return self._ran.exists()

    @property
    def question(self) -> PluginQuestion | None:
        shown = self.person.window.findChildren(PluginQuestion)
        return next((one for one in shown if one.isVisible()), None)

    @property
    def offered(self) -> bool:
        return "lamp" in self.person.windows.plugins.loaded.worlds

    def look(self) -> PluginQuestion:
        """Look for plugins again; the question that comes up."""
        self.person.window.actions_table["reload_plugins"].trigger()
        self.person.until(lambda: self.question is not None)
        assert self.question is not None
        return self.question

    def look_in_vain(self) -> None:
        """Look for plugins again; nothing is asked."""
        self.person.window.actions_table["reload_plugins"].trigger()
        plugins = self.person.windows.plugins
        self.person.until(lambda: not plugins.looking)
        assert self.question is None


@pytest.fixture
def desk(sit: Sit, home: Path, tmp_path: Path) -> Desk:
    person = sit(SAMPLES / "hanoi.json")
    folder = write_plugin(home / "plugins", "lamp", CODE.format(ran=str(tmp_path / "ran")))
    (folder / "plugin.toml").write_text(MANIFEST, "utf-8")
    return Desk(person, folder, tmp_path / "ran")


def _said(question: PluginQuestion) -> list[str]:
    found = question.findChildren(QLabel)
    assert all(one.textFormat() == Qt.TextFormat.PlainText for one in found)
    return [one.text() for one in found]


def test_a_new_plugin_is_asked_about_before_its_code_runs(desk: Desk) -> None:
    question = desk.look()
    said = _said(question)
    assert "The plugin lamp is new. Allow it?" in said
    assert {"1.5", str(desk.folder), "lamp", "Op_1b, <img src=x>"} <= set(said)
    assert any(words.startswith("<b>A lamp</b> ") for words in said)
    assert question.later.isDefault()
    assert not desk.ran
    assert not desk.offered
    desk.person.click(question.allow)
    desk.person.until(lambda: desk.offered)
    assert desk.ran
    assert found_plugin("lamp").state is PluginState.ALLOWED
    desk.look_in_vain()


def test_who_decides_later_is_asked_again_when_they_look(desk: Desk) -> None:
    desk.person.click(desk.look().later)
    desk.person.until(lambda: desk.question is None)
    assert not desk.ran
    assert not desk.offered
    assert found_plugin("lamp").state is PluginState.NEW
    question = desk.look()
    desk.person.press(Qt.Key.Key_Escape)
    desk.person.until(lambda: desk.question is None)
    assert found_plugin("lamp").state is PluginState.NEW
    assert question is not desk.look()
    desk.person.press(Qt.Key.Key_Return)
    assert found_plugin("lamp").state is PluginState.NEW, "Enter without a look allows nothing"


def test_a_plugin_that_has_changed_is_asked_about_again_and_can_be_forbidden(desk: Desk) -> None:
    desk.person.click(desk.look().allow)
    desk.person.until(lambda: desk.ran)
    (desk.folder / "more.py").write_text("", "utf-8")
    question = desk.look()
    assert "The plugin lamp has changed since you allowed it. Allow it?" in _said(question)
    assert not desk.offered
    desk.person.click(question.forbid)
    desk.person.until(lambda: found_plugin("lamp").state is PluginState.FORBIDDEN)
    desk.person.until(lambda: not desk.person.windows.plugins.looking)
    desk.look_in_vain()
    assert not desk.offered


def test_a_decision_that_cannot_be_written_is_told(desk: Desk, home: Path) -> None:
    (home / "plugin-decisions.json").mkdir()
    question = desk.look()
    desk.person.click(question.allow)
    desk.person.until(lambda: "not believed" in desk.person.window.toast.words)
    assert not desk.ran
    assert not desk.offered


def test_several_plugins_are_asked_about_one_after_the_other(desk: Desk, home: Path) -> None:
    write_plugin(home / "plugins", "candle", "def register(library): ...")
    first = desk.look()
    assert first.found.name == "candle"
    desk.person.click(first.forbid)
    desk.person.until(lambda: desk.question is not None and desk.question is not first)
    second = desk.question
    assert second is not None
    assert second.found.name == "lamp"
    desk.person.click(second.allow)
    desk.person.until(lambda: desk.offered)
    assert found_plugin("candle").state is PluginState.FORBIDDEN
