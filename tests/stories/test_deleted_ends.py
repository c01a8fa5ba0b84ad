"""Deleting the initial or the activating state writes which one follows, and says so."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import delete, rename
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.forms import form_named
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, sample

Key = Qt.Key
FILE = SAMPLES / "hanoi-corrected.json"


def _read(text: str) -> Blueprint:
    return read_blueprint(form_named("json").parse(text, "f.json"))


@pytest.mark.parametrize(
    ("gone", "key", "kind", "follower"),
    [
        ("State_aaa", "INITIAL", "initial", "State_baa"),
        ("State_ccc", "ACTIVATING", "activating", "State_bcc"),
    ],
)
def test_the_deletion_of_an_end_says_what_it_decides_and_offers_undo(
    sit: Sit, gone: str, key: str, kind: str, follower: str
) -> None:
    person = sit(FILE)
    text, toast = person.blueprint.document.text, person.window.toast
    person.click_canvas(person.place(f"SB1/{gone}"))
    person.press(Key.Key_Delete)
    branch = person.blueprint["SB1"]
    assert gone not in branch.table
    assert getattr(branch, kind) == follower
    assert f'"{key}": "{follower}"' in person.blueprint.document.text
    assert toast.words == (
        f"{gone} is gone: {follower} is the {kind} state of SB1 now, and {key} says so."
    )
    person.click(toast.button)
    assert person.blueprint.document.text == text
    assert not toast.isVisible()


def test_the_deletion_of_any_other_state_says_nothing(sit: Sit) -> None:
    person = sit(FILE)
    person.click_canvas(person.place("SB1/State_bca"))
    person.press(Key.Key_Delete)
    assert "HEADER" not in person.window.toast.words
    assert not person.window.toast.isVisible()
    assert person.blueprint["SB1"].header.initial is None


def test_an_end_is_never_given_to_the_other_end() -> None:
    sub = '{"S": {"HEADER": {"ACTIVATING": "B"}, "A": {"a": "B"}, "B": {}, "C": {}}}'
    after = delete(_read(sub), [Address("S", "A")])["S"]
    assert (after.header.initial, after.header.activating) == ("C", "B")


def test_where_one_state_is_left_nothing_is_decided() -> None:
    two = '{"S": {"HEADER": {"INITIAL": "A"}, "A": {"a": "B"}, "B": {}}}'
    after = delete(_read(two), [Address("S", "A")])["S"]
    assert after.header.initial is None
    assert after.header.activating is None


def test_a_renamed_end_is_not_gone(sit: Sit) -> None:
    person = sit(FILE)
    person.window.session.edit(
        "Rename", lambda bp: rename(bp, Address("SB1", "State_aaa"), "State_aad")
    )
    assert "is gone" not in person.window.toast.words
    assert sample("hanoi-corrected.json")["SB1"].initial == "State_aaa"
