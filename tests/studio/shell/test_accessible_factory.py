"""What assistive tools find while widgets are created and deleted."""

from __future__ import annotations

import gc
from collections.abc import Callable
from weakref import ref

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import (
    QAbstractScrollArea,
    QApplication,
    QGraphicsScene,
    QGraphicsView,
    QScrollArea,
    QWidget,
)
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.theme import DARK
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.shell.accessible_factory import install
from tests.stories.at_canvas import sample


class Special(QScrollArea):
    """A scroll area with a class of its own, as those of the window have."""


def graphics() -> QGraphicsView:
    return QGraphicsView(QGraphicsScene())


def found(widget: QObject) -> QAccessibleInterface:
    return QAccessible.queryAccessibleInterface(widget)


@pytest.mark.parametrize("make", [QScrollArea, Special, QAbstractScrollArea, graphics])
def test_a_reader_that_counted_before_a_scroll_bar_went_lives(
    make: Callable[[], QAbstractScrollArea], qtbot: QtBot, qapp: QApplication
) -> None:
    install(qapp)
    area = make()
    qtbot.addWidget(area)
    area.resize(100, 100)
    bar = area.verticalScrollBar()
    holder = bar.parentWidget()
    assert holder is not None
    area.show()
    area.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOn)
    qtbot.waitUntil(bar.isVisible)
    counted = found(area).childCount()

    area.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    qtbot.waitUntil(lambda: not bar.isVisible())
    gc.collect()
    # Before anything is asked for beyond the end: where Qt itself answers the process would die.
    assert found(area).childCount() == counted
    assert found(area).child(counted) is None
    parts = [found(area).child(index).object() for index in range(counted)]
    assert area.viewport() in parts
    assert found(area).child(parts.index(holder)).state().invisible
    assert [found(area).indexOfChild(found(part)) for part in parts] == list(range(counted))


def test_a_scroll_area_leads_to_what_is_in_it(qtbot: QtBot, qapp: QApplication) -> None:
    install(qapp)
    area, inner = QScrollArea(), QWidget()
    qtbot.addWidget(area)
    area.setAccessibleName("Steps")
    inner.setMinimumHeight(2000)
    area.setWidget(inner)
    area.show()
    assert found(area).text(QAccessible.Text.Name) == "Steps"
    viewport = found(area).child(0)
    assert viewport.parent().object() is area
    assert viewport.child(0).object() is inner
    middle = area.viewport().mapToGlobal(area.viewport().rect().center())
    assert found(area).childAt(middle.x(), middle.y()).object() is area.viewport()
    assert found(area).focusChild() is None


def closed(canvas: Canvas) -> None:
    """Close a canvas for good, and let Qt clear it away."""
    canvas.deleteLater()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_a_canvas_that_was_read_out_goes_when_it_is_closed(qapp: QApplication) -> None:
    install(qapp)
    canvas = Canvas(DARK)
    held = ref(canvas)
    assert found(canvas).childCount() == 0
    closed(canvas)
    del canvas
    gc.collect()
    assert held() is None


def test_what_a_reader_holds_of_a_closed_canvas_is_not_valid(qapp: QApplication) -> None:
    install(qapp)
    canvas = Canvas(DARK)
    editor = CanvasEditor(Session(sample("hfsm.json")), canvas)
    state = found(canvas).child(0)
    operation = state.child(0)
    assert state.isValid()
    assert operation.isValid()
    closed(canvas)
    del canvas, editor
    gc.collect()
    for gone in (state, operation):
        assert not gone.isValid()
        assert gone.childCount() == 0
        assert gone.text(QAccessible.Text.Name) == ""
        assert gone.rect().isEmpty()
        assert not gone.state().selected
