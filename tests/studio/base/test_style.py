"""The style sheet: every placeholder is filled in both themes, and the sheet stays small."""

from __future__ import annotations

import re

import pytest
from PySide6.QtWidgets import QRadioButton
from pytestqt.qtbot import QtBot

from smsl_studio.picture.contrast import MARK, contrast
from smsl_studio.shipped import resources_dir
from smsl_studio.studio.base.style import style_sheet
from smsl_studio.studio.base.theme import CONTRAST, DARK, LIGHT, Tokens


@pytest.mark.parametrize("tokens", [LIGHT, DARK], ids=lambda tokens: tokens.name)
def test_every_place_becomes_a_colour(tokens: Tokens) -> None:
    sheet = style_sheet(tokens)
    assert not re.search(r"\{[a-z]\w*\}", sheet)
    assert sheet.count("{") == sheet.count("}")
    assert tokens.acc.name() in sheet


def test_the_sheet_stays_below_150_lines() -> None:
    assert len((resources_dir() / "studio.qss").read_text("utf-8").splitlines()) < 150


@pytest.mark.parametrize("tokens", [LIGHT, DARK], ids=lambda tokens: tokens.name)
def test_the_keyboard_focus_is_visible_on_a_filled_button_too(tokens: Tokens) -> None:
    """The ring of the primary button is not of the colour that fills it."""
    rules = re.findall(r"([^{}]+)\{([^{}]*)\}", style_sheet(tokens))
    (ring,) = (body for names, body in rules if 'QPushButton[role="primary"]:focus' in names)
    assert tokens.acc.name() not in ring
    assert f"2px solid {tokens.tx.name()}" in ring


@pytest.mark.parametrize("tokens", [LIGHT, DARK, CONTRAST], ids=lambda tokens: tokens.name)
def test_the_ring_of_a_choice_that_is_not_chosen_is_seen(tokens: Tokens, qtbot: QtBot) -> None:
    """Without it nobody sees that there is something to choose."""
    button = QRadioButton("")
    qtbot.addWidget(button)
    button.setStyleSheet(style_sheet(tokens))
    drawn = button.grab().toImage()
    middle = drawn.height() // 2
    colours = [drawn.pixelColor(at, middle).name() for at in range(9)]
    assert max(contrast(colours[-1], one) for one in colours) >= MARK
