"""The rows of the findings list: the sentence has its room before the words of the button."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import Place
from smsl_studio.inspection.rules.finding import Finding, Fix, Severity
from smsl_studio.studio.base.theme import LIGHT, text_font
from smsl_studio.studio.features.draw.panels.finding_rows import FindingDelegate

SAID = "The names of the states have no facts that the sub-SB of this one could expand"


@pytest.mark.parametrize("width", [900.0, 1000.0, 1400.0])
def test_a_wide_fix_leaves_the_sentence_of_its_finding_whole(
    qapp: QApplication, width: float
) -> None:
    place, words = Place("cell.json", 1, 1), "Give values: Idle 0 0 0 0, Homed 0 0 0 1 and 10 more"
    fix = Fix(words, lambda blueprint: blueprint)
    finding = Finding("R05", Severity.WARNING, Address("SB1"), place, SAID, "", fix)
    button = FindingDelegate(LIGHT).button(QRectF(0, 0, width, 35), finding)
    metrics = QFontMetricsF(text_font(13))
    assert button.left() > 84 + metrics.horizontalAdvance("SB1") + metrics.horizontalAdvance(SAID)
    assert button.right() <= width - 12
