"""A person makes a drawing of a planning problem."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.studio.features.planning import feature
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

PDDL = SAMPLES / "pddl"


def test_two_files_become_a_drawing_and_a_wrong_one_is_refused(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit()
    answers: list[Path | str] = []
    monkeypatch.setattr(feature, "ask_to_open", lambda *_: str(answers.pop(0)))
    ask = person.window.actions_table["planning_problem"].trigger
    answers[:] = [PDDL / "lamps.pddl", PDDL / "ward-4.pddl"]
    ask()
    person.until(lambda: "another domain" in person.window.toast.words)
    assert person.window.files.path is None
    answers[:] = [PDDL / "ward.pddl", ""]
    ask()
    assert answers == [], "nothing is made without a problem"
    answers[:] = [PDDL / "ward.pddl", PDDL / "ward-4.pddl"]
    ask()
    person.until(lambda: "Made 38 states." in person.window.toast.words)
    assert person.window.mode == "draw"
    assert person.blueprint.fields["_origin"]["how"] == "pddl"
    person.until_inspected()
