"""The high-contrast theme: chosen in the palette of commands, worn by the whole window, kept."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import CONTRAST
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key


def colours(person: Person) -> set[str]:
    """The colours of the window, each seen in many places."""
    image = person.window.grab().toImage()
    step = range(0, image.width(), 3)
    seen = [image.pixelColor(x, y).name() for y in range(0, image.height(), 3) for x in step]
    return {name for name in set(seen) if seen.count(name) > 40}


def test_the_theme_is_chosen_by_keys_and_kept(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.ctrl(Key.Key_K)
    person.type("High-contrast")
    person.press(Key.Key_Return)
    person.until(lambda: person.windows.theme == "contrast")
    assert person.windows.tokens is CONTRAST
    assert Settings().theme == "contrast"
    shown = colours(person)
    assert {"#000000", "#ffffff"} <= shown
    # Nothing is left in a light ground: what is light is text or a line, and much less than black.
    image = person.window.grab().toImage()
    light = sum(
        QColor(image.pixel(x, y)).lightness() > 128
        for x in range(0, image.width(), 5)
        for y in range(0, image.height(), 5)
    )
    assert light < image.width() * image.height() / 25 * 0.15
    person.windows.set_theme("light")
    assert person.windows.tokens is not CONTRAST
