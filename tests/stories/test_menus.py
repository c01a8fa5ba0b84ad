"""The menus: what has submenus, and that a menu fits into a window of 720 pixels."""

from __future__ import annotations

from PySide6.QtWidgets import QMenu

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

LOWEST = 720 - 32 - 26
"""The height below the menu bar in the lowest window that is not small (pixels)."""


def menus(person: Person) -> dict[str, QMenu]:
    """The menus of the window, by name."""
    found: dict[str, QMenu] = {}
    for entry in person.window.menu_row.menus.actions():
        menu = entry.menu()
        assert isinstance(menu, QMenu)
        found[entry.text().replace("&", "")] = menu
    return found


def test_every_menu_stands_below_its_bar_in_a_low_window(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (1280, 720))
    for name, menu in menus(person).items():
        menu.aboutToShow.emit()
        assert menu.sizeHint().height() <= LOWEST, name


def test_rows_of_one_kind_stand_in_a_submenu_and_do_what_they_say(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (1280, 800))
    view = menus(person)["View"]
    (panels,) = (one.menu() for one in view.actions() if one.text() == "Panels")
    assert isinstance(panels, QMenu)
    words = [one.text() for one in panels.actions()]
    assert {"Source", "Facts", "Inspection", "History"} <= set(words)
    (source,) = (one for one in panels.actions() if one.text() == "Source")
    source.trigger()
    assert person.window.source.isVisible()
