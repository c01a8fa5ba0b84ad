"""The list of possible operations tells names apart that begin alike."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.possible_rows import PossibleRow
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.running.possible_list import PossibleList

BLOCKS = ("uppercase-A", "lowercase-a", "1")


@pytest.mark.parametrize("kind", ["running", "waits", "later"])
def test_the_end_of_a_long_name_is_shown(qtbot: QtBot, kind: str) -> None:
    names = [f"move-circle-chess-to-block-{block}" for block in BLOCKS]
    rows = tuple(
        PossibleRow(Address("SB1", "State_0B1B", name), name, "0BAB", kind, "", "1.0", "From")
        for name in names
    )
    shown = PossibleList(LIGHT)
    qtbot.addWidget(shown)
    shown.resize(600, 300)
    shown.show()
    shown.show_rows(rows, False, "")
    for row, block in zip(shown.row_widgets(), BLOCKS, strict=True):
        texts = [one for one in row.findChildren(QLabel) if one.text().startswith("move")]
        (name,) = texts
        assert name.text().endswith(block[-6:])
        assert name.sizeHint().width() <= name.width()
        assert f"block-{block}" in row.accessibleName()
