"""A button that is hidden has a name, because a screen reader finds it."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtWidgets import QAbstractButton

from smsl_studio.studio.running import decisions
from smsl_studio.studio.running.confirmation import ConfirmBox
from tests.stories.conftest import Sit


def test_the_button_of_a_message_without_one_keeps_its_name(sit: Sit) -> None:
    toast = sit().window.toast
    toast.offer("Deleted State Branch SB2.", "Undo", lambda: None)
    assert toast.button.text() == "Undo"
    toast.say("Saved hanoi.json.")
    assert toast.button.isHidden()
    assert toast.button.text() == "Undo"


def test_the_button_of_a_question_without_one_has_a_name(sit: Sit) -> None:
    sit()
    box = ConfirmBox()
    for decision in (None, decisions.way_out("reset"), None):
        box.show_decision(decision)
        named(box)
    box.show_decision(replace(decisions.way_out("reset"), verb=""))
    named(box)


def named(box: ConfirmBox) -> None:
    for button in box.findChildren(QAbstractButton):
        assert button.accessibleName() or button.text()
