"""What is there when a window has opened, and what is made later, in its place."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.style import style_sheet
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.draw.find.palette import Palette
from smsl_studio.studio.features.draw.panels.branch_table import BranchTable
from smsl_studio.studio.features.draw.panels.fact_form import FactForm
from smsl_studio.studio.features.draw.panels.history import History
from smsl_studio.studio.features.draw.panels.library import Library
from smsl_studio.studio.features.draw.panels.operation_form import OperationForm
from smsl_studio.studio.features.draw.panels.state_form import StateForm
from smsl_studio.studio.features.draw.source.pane import SourcePane
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

LATE = (Library, SourcePane, History, BranchTable, Palette, StateForm, FactForm, OperationForm)
"""What nobody sees when a file was opened."""


def keys_in(part: QWidget) -> list[QWidget]:
    """The widgets of a part that the key Tab goes to, in the order of the window."""
    found, at = [], part.window().nextInFocusChain()
    while at is not None and at is not part.window():
        if at.focusPolicy() & Qt.FocusPolicy.TabFocus and part.isAncestorOf(at):
            found.append(at)
        at = at.nextInFocusChain()
    return found


def test_the_first_window_brings_the_style_sheet(qapp: QApplication, sit: Sit) -> None:
    assert qapp.styleSheet() == ""
    sit(SAMPLES / "hanoi-corrected.json")
    assert qapp.styleSheet() == style_sheet(LIGHT)


def test_forms_that_are_made_late_stand_in_their_place_for_the_key_tab(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-corrected.json")
    properties = person.window.properties
    assert not properties.findChildren(FactForm)
    assert not properties.findChildren(OperationForm)
    person.window.session.select((Address("SB1", "State_aaa", "Op_1b"),))
    person.until(lambda: len(properties.findChildren(OperationForm)) == 1)
    properties.show_fact("SB1", 0)
    person.until(lambda: len(properties.findChildren(FactForm)) == 1)
    fact, operation = properties.fact, properties.operation
    state, line = keys_in(properties.state)[0], keys_in(properties.line)[0]
    wanted = [fact.close_button, fact.name, state, operation.name, operation.cost, line]
    assert [key for key in keys_in(properties) if key in wanted] == wanted


def test_what_nobody_sees_is_not_made(sit: Sit) -> None:
    window = sit(SAMPLES / "hanoi-corrected.json").window
    assert [late.__name__ for late in LATE if window.findChildren(late)] == []


def test_a_panel_behind_a_tab_is_made_in_its_place_and_knows_what_it_missed(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    window = person.window
    person.until(lambda: len(window.findings.findings) > 0)
    window.show_tab("Library")
    (library,) = window.findChildren(Library)
    assert {row.severity for row in library.list.rows.rows} >= {"E"}
    window.show_tab("Source")
    (source,) = window.findChildren(SourcePane)
    assert source.editor.sheet.text == (SAMPLES / "hanoi.json").read_text(encoding="utf-8")
    docks = window.docks
    wanted = [docks.left_tabs.bar, library.filter, docks.bottom_tabs.bar, source.editor,
              window.findings.list]  # fmt: skip
    assert [key for key in keys_in(window) if key in wanted] == wanted
