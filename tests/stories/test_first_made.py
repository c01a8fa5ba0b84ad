"""What is there when a window has opened, and what is made later, in its place."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.style import style_sheet
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.draw.panels.fact_form import FactForm
from smsl_studio.studio.features.draw.panels.operation_form import OperationForm
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES


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
