"""Chips: what is on is shown as on, on the canvas, in pictures and in panels."""

from __future__ import annotations

from typing import Any

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.chips import kind_of
from tests.blueprint.test_templates import STATES, blueprint, state


def test_a_recovery_takes_no_mark_from_the_chips_of_other_states() -> None:
    before = blueprint(_facts={"0": {"on": "0"}})
    after, _ = edit.add_recovery(before, state("State_10"))

    def kinds(shown: Blueprint, name: str) -> list[str]:
        picture = Picture(shown, "VIAL")
        face = picture.face(picture.index[name])
        assert [chip.kind for chip in face.chips] == [
            kind_of(shown["VIAL"], name, digit) for digit in range(2)
        ], "panels show the same"
        return [chip.kind for chip in face.chips]

    for name in STATES:
        assert kinds(after, name) == kinds(before, name)
    assert kinds(after, "State_01") == ["on", "on"]
    assert kinds(after, "State_10") == ["off", "off"]
    assert kinds(after, "State_1x") == ["off", "value"]


def test_what_is_declared_as_on_is_shown_as_on() -> None:
    letters: dict[str, Any] = {"S_ab": {}, "S_bb": {}, "S_cb": {}}
    declared = blueprint(letters, _facts={"0": {"on": "b"}, "1": {"on": "b"}})
    plain = blueprint(letters)
    kinds = [[kind_of(one["VIAL"], name, 0) for name in letters] for one in (declared, plain)]
    assert kinds == [["value", "on", "value"], ["value", "value", "value"]]
    assert kind_of(declared["VIAL"], "S_ab", 1) == "on"
