"""A blueprint whose names are markup or control characters: the window shows them as text."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import Qt as Guess
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QLabel,
    QTableView,
    QTreeView,
    QWidget,
)
from shiboken6 import isValid

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.tips import tip_text
from tests.hostile_names import BRANCH, FIRST, OPERATION, TAG, TURNS, hidden, write_hostile
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import Person

Key = Qt.Key
TABLES = (QTableView, QTreeView)
ESCAPED = "&lt;img src=x&gt;"
MARKUP = '<p style="white-space: pre-wrap">'


@pytest.fixture
def person(sit: Sit, tmp_path: Path) -> Person:
    found = sit(write_hostile(tmp_path))
    found.until_inspected()
    return found


def _texts(view: QAbstractItemView) -> Iterator[str]:
    """The tool tips of all rows of a view, as Qt would show them."""
    model = view.model()
    for row in range(min(model.rowCount(), 50)):
        for column in range(model.columnCount() if isinstance(view, TABLES) else 1):
            yield str(model.index(row, column).data(Qt.ItemDataRole.ToolTipRole) or "")


def _rich(person: Person) -> list[str]:
    """What the labels show that take markup."""
    labels = person.window.findChildren(QLabel)
    return [one.text() for one in labels if one.textFormat() != Qt.TextFormat.PlainText]


def _check(person: Person) -> None:
    """Everything that any part of the window shows or says is text."""
    widgets = [w for top in QApplication.topLevelWidgets() for w in top.findChildren(QWidget)]
    assert len(widgets) > 100
    own = {id(widget) for widget in person.window.findChildren(QWidget)}
    for widget in (person.window, *widgets):
        if not isValid(widget):  # of a window before, which goes while this one is looked at
            assert id(widget) not in own
            continue
        who = f"{type(widget).__name__} {widget.accessibleName()!r}"
        tips = [widget.toolTip()]
        if isinstance(widget, QAbstractItemView):
            tips += _texts(widget)
        for tip in tips:
            assert not hidden(tip), who
            if Guess.mightBeRichText(tip):
                assert tip.startswith(MARKUP), who
                assert TAG not in tip, who
        assert not hidden(widget.accessibleName() + widget.accessibleDescription()), who
        if isinstance(widget, QLabel):
            assert not hidden(widget.text()), who
            if widget.textFormat() != Qt.TextFormat.PlainText:
                assert TAG not in widget.text().replace("&nbsp;", " "), who
    assert not hidden(person.window.windowTitle())


def test_while_drawing_names_are_text(person: Person) -> None:
    window = person.window
    _check(person)
    for one in (Address(BRANCH), Address(BRANCH, FIRST), Address(BRANCH, FIRST, OPERATION)):
        window.session.jump(one)
        QApplication.processEvents()
        _check(person)
    for panel in window.docks.panels:
        window.show_tab(panel.name)
        _check(person)


def test_while_it_runs_names_are_text(sit: Sit, tmp_path: Path) -> None:
    # A world in a child passes on no names that steer or turn round.
    person = sit(write_hostile(tmp_path, without=f"\x1b\x00\x9b{TURNS}\n"))
    run = AtRun(person)
    run.choose(world="table")
    person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    _check(person)
    assert ESCAPED in "".join(_rich(person)).replace("&nbsp;", " ")
    person.ctrl(Key.Key_3)
    QApplication.processEvents()
    _check(person)
    person.ctrl(Key.Key_M)
    QApplication.processEvents()
    _check(person)
    person.press(Key.Key_F8)


def test_what_qt_takes_for_markup_is_given_as_markup_that_says_the_same() -> None:
    assert tip_text("Op_1b: a < b") == "Op_1b: a < b"
    assert tip_text(f"a {TAG}\n{TURNS}") == (
        f'<p style="white-space: pre-wrap">a {ESCAPED}<br>\\u202e\\u2066</p>'
    )
    assert tip_text("a &lt;b") == '<p style="white-space: pre-wrap">a &amp;lt;b</p>'
