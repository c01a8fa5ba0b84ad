"""The legend of a dense drawing: it takes the room that is there."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.overlays.dense_legend import DenseLegend
from smsl_studio.studio.base.theme import LIGHT


def words(legend: DenseLegend) -> list[str]:
    buttons = legend.bundles, legend.back, legend.mixed, legend.all
    return [button.text() for button in buttons if not button.isHidden()]


def test_without_room_only_the_numbers_stand_at_the_icons(qtbot: QtBot) -> None:
    view = QWidget()
    qtbot.addWidget(view)
    legend = DenseLegend(view, LIGHT)
    legend.show_counts(True, 1_032, 4, 14)
    whole = ["Bundles 1,032, 4 open", "Back to start 14", "Show all"]
    assert words(legend) == whole
    wide = legend.width()
    legend.fit(wide)
    assert words(legend) == whole
    legend.fit(wide - 1)
    assert words(legend) == ["1,032, 4 open", "14", "Show all"]
    assert legend.width() < wide - 1
    assert legend.bundles.accessibleName() == whole[0]
    # What is shown next has to fit, too.
    legend.show_mixed(3, dimmed=True)
    assert words(legend) == ["1,032, 4 open", "14", "3, dimmed", "Show all"]
    legend.fit(wide + 300)
    assert words(legend) == [*whole[:2], "Load and mixed 3, dimmed", "Show all"]
    right = [button.geometry().right() for button in (legend.bundles, legend.back, legend.all)]
    assert max(right) <= legend.width()
