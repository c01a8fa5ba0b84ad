"""Somebody at the tab Configuration of the page Inspection."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton

from smsl_studio.studio.features.inspection.configuration_page import ConfigurationPage
from smsl_studio.studio.features.inspection.tab_line import CONFIGURATION
from tests.stories.conftest import Sit
from tests.stories.person import Person


def at_configuration(sit: Sit, file: Path | None, size: tuple[int, int] = (1440, 900)) -> Person:
    """Open a file, and choose the tab with the pointer."""
    person = sit(file, size)
    person.ctrl(Qt.Key.Key_I)
    tabs = person.window.features.inspection.panel.tabs
    person.click(tabs, tabs.tabRect(CONFIGURATION).center())
    settled(person)
    return person


def page(person: Person) -> ConfigurationPage:
    """The tab."""
    return person.window.features.inspection.panel.configuration


def settled(person: Person) -> None:
    """Wait until nothing is looked for."""
    person.until(lambda: not page(person).explorer.is_outdated and not page(person).explorer.work)


def here(person: Person) -> dict[str, str]:
    """Where it stands."""
    return dict(page(person).explorer.configuration)


def permitted(person: Person) -> list[str]:
    """What the buttons of the permitted steps say."""
    return [one.accessibleName() for one in page(person).steps.buttons()]


def refused(person: Person) -> dict[str, str]:
    """The refused operations with their reasons, as they are shown."""
    found = {}
    for line in page(person).steps.refusals():
        name, reason = line.findChildren(QLabel)[:2]
        found[name.text()] = reason.text()
    return found


def step(person: Person, words: str) -> None:
    """Click the permitted step whose name begins with some words."""
    button = button_of(person, words)
    page(person).steps.ensureWidgetVisible(button)
    person.click(button)
    settled(person)


def button_of(person: Person, words: str) -> QPushButton:
    """The button of a permitted step."""
    for one in page(person).steps.buttons():
        if one.accessibleName().startswith(words):
            return one
    raise AssertionError(f"{words} is not among {permitted(person)}")


def pick(person: Person, branch: str, state: str) -> None:
    """Click a state in its column."""
    for one in page(person).columns.buttons():
        if one.accessibleName().split(",")[0] == f"{branch} {state}":
            person.click(one)
            settled(person)
            return
    raise AssertionError(f"{branch} {state} is not shown")


def alt_left(person: Person) -> None:
    """Press Alt+Left on what has the focus."""
    person.press(Qt.Key.Key_Left, [Qt.KeyboardModifier.AltModifier])
    settled(person)


def write(person: Person, text: str) -> None:
    """Type a configuration and press Enter."""
    field = page(person).field
    person.click(field)
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)
    settled(person)
