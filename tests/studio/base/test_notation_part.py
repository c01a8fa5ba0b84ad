"""The selected element in the notation of the paper, on demand."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.base.notation_part import HIDE, SHOW, NotationPart
from tests.plugin_folder import blueprint_of

MADE = blueprint_of({
    "SB": {
        "_facts": {"0": {"sources": {"force": "N"}, "predicate": {"0": "force < 1 N"}}},
        "State_0": {"Close": "State_1"},
        "State_1": {},
    }
})  # fmt: skip


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("SB/0", "f_1 = λs. F(sense(force, s))\nF = 0 if force < 1 N"),
        ("SB/State_1", "C_State_1 = λs. [f_1(s) = 1]"),
        ("SB/State_0/Close", "Close = λs. C_State_0(s) → C_State_1(s)"),
    ],
)
def test_it_is_written_when_it_is_asked_for(qapp: QApplication, address: str, words: str) -> None:
    part = NotationPart()
    part.show_element(MADE, address)
    assert (part.button.text(), part.words.text()) == (SHOW, "")
    part.button.click()
    assert part.button.text() == HIDE
    assert part.words.text().startswith(words)
    assert not part.words.isHidden()
    part.show_element(MADE, "SB/State_0")
    assert part.words.text() == "C_State_0 = λs. [f_1(s) = 0]"
    part.show_element(MADE, "")
    assert part.isHidden()


def test_what_is_gone_says_so(qapp: QApplication) -> None:
    part = NotationPart()
    part.button.click()
    part.show_element(MADE, "SB/State_7")
    assert "State_7" in part.words.text()
