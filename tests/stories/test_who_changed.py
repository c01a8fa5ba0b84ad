"""A person asks in the properties who changed an element last."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from tests.blueprint.merge.test_merge import BASE, changed
from tests.front.test_revisions import commit, folder, git
from tests.stories.conftest import Sit
from tests.stories.person import Person

__all__ = ["folder"]
GO = Address("A", "S0", "go")


@pytest.fixture
def plan(folder: Path) -> Path:
    git(folder, "init", "-q")
    path = folder / "plan.json"
    commit(folder, path, json.dumps(BASE, indent=1), "First")
    commit(folder, path, json.dumps(changed(("A|S0|go", "S2")), indent=4), "Go on <b>to</b> S2")
    commit(folder, path, json.dumps(changed(("A|S0|go", "S2")), indent=1), "Indented")
    return path


def ask(person: Person) -> str:
    form = person.window.properties.changed_by
    person.click(form.ask)
    person.until(lambda: form.cancel.isHidden())
    return form.words


def test_author_day_message_and_the_former_look_are_shown(sit: Sit, plan: Path) -> None:
    person = sit(plan)
    form = person.window.properties.changed_by
    assert form.isHidden()
    person.window.session.select([GO])
    assert form.words == "", "git is asked on demand only"
    words = ask(person)
    assert words.startswith("Ada, 20")
    assert "Go on <b>to</b> S2" in words
    assert '"go": "S1",' in words
    assert "Indented" not in words
    person.window.session.select([Address("A", "S2", "back")])
    assert form.words == ""
    assert "First" in ask(person)
    assert "It was not there before." in form.words


def test_an_edit_hides_the_answer_and_is_told_apart(sit: Sit, plan: Path) -> None:
    person = sit(plan)
    person.window.session.select([GO])
    ask(person)
    form = person.window.properties.changed_by
    person.window.session.edit("x", lambda bp: editing.retarget(bp, GO, "S0"))
    assert form.words == ""
    words = ask(person)
    assert "Changed since the last commit: " in words
    assert "Go on" in words


def test_no_repository_no_git_and_no_file_are_told(
    sit: Sit, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = folder / "alone.json"
    path.write_text(json.dumps(BASE))
    person = sit(path)
    person.window.session.select([GO])
    assert "Alone.json is in no git repository" in ask(person) or "in no git" in ask(person)
    monkeypatch.setenv("PATH", str(folder / "nowhere"))
    assert ask(person).startswith("Git is not installed here")
    monkeypatch.undo()
    path.unlink()
    assert ask(person) == "The file is not saved yet, so git does not know it."


def test_the_search_can_be_cancelled(
    sit: Sit, plan: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    person = sit(plan)
    program = tmp_path / "bin" / "git"
    program.parent.mkdir()
    program.write_text(f"#!/bin/sh\nexec tail -f {plan}\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{program.parent}{os.pathsep}{os.environ['PATH']}")
    person.window.session.select([GO])
    form = person.window.properties.changed_by
    person.click(form.ask)
    assert form.words == "Looking in git"
    person.click(form.cancel)
    assert form.words == "Stopped looking."
    assert form.ask.isEnabled()


def test_several_elements_have_no_single_answer(sit: Sit, plan: Path) -> None:
    person = sit(plan)
    person.window.session.select([GO, Address("A", "S1")])
    assert person.window.properties.changed_by.isHidden()
