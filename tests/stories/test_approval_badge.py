"""The badge of trust: it follows the record of the blueprint, and a click tells the reasons."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import delete
from tests.approval import DOOR
from tests.stories.conftest import Sit
from tests.stories.person import Person

WORDS = b"correct horse"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "door.json"
    path.write_text(json.dumps(DOOR, indent=1))
    smsl.make_key("Ada Lovelace", "engineer", WORDS, "ada")
    return path


def approve(file: Path, **more: object) -> None:
    smsl.approve(smsl.ApprovalRequest(smsl.read(file), "ada", WORDS, **more))  # type: ignore[arg-type]


def says(person: Person, words: str) -> None:
    person.until(lambda: person.window.features.approval.badge.text() == words)


def test_without_a_record_nobody_has_inspected_it(sit: Sit, file: Path) -> None:
    person = sit(file)
    says(person, "Uninspected")
    person.click(person.window.features.approval.badge)
    card = person.window.features.approval.card
    assert card is not None
    assert any("Nobody has signed" in line for line in card.lines)
    assert any("smsl-studio approve" in line for line in card.lines)
    card.close()


def test_it_follows_the_record_and_every_change(sit: Sit, file: Path) -> None:
    approve(file)
    person = sit(file)
    badge = person.window.features.approval.badge
    says(person, "Approved by 1")
    assert badge.said.is_good
    assert "Ada Lovelace (engineer)" in badge.accessibleDescription()
    gone = (Address("DOOR", "State_1", "close"),)
    person.window.session.edit("Delete close", lambda blueprint: delete(blueprint, gone))
    says(person, "Changed since signed")
    assert not badge.said.is_good
    person.window.session.history.undo()
    says(person, "Approved by 1")


def test_a_rejection_and_an_open_condition_are_told(sit: Sit, file: Path) -> None:
    approve(file, conditions=("the drill is calibrated",))
    says(sit(file), "Approved with conditions")
    approve(file, verdict="rejected")
    says(sit(file), "Rejected")
