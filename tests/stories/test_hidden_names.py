"""Names without room on the canvas: a mark says how many, and its tooltip lists them."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF, QRect
from PySide6.QtGui import QImage

from smsl_studio.picture.hidden_names import RADIUS, HiddenMarks, HiddenNames
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person


def marks(person: Person) -> list[HiddenNames]:
    """The marks whose middle is in view and covered by no node and no float."""
    canvas = person.window.canvas
    sheet = canvas.sheet
    assert sheet is not None
    view = canvas.viewport().rect().adjusted(20, 80, -20, -80)
    every = HiddenMarks(sheet.geometry).of(range(len(sheet.picture.operations)))
    return [one for one in every if view.contains(person.on_canvas(one.at))]


def inks(image: QImage, at: QPoint) -> int:
    """The number of colours around a point."""
    half = round(RADIUS)
    box = QRect(at.x() - half, at.y() - half, 2 * half, 2 * half)
    part = image.copy(box)
    return len({part.pixel(x, y) for x in range(part.width()) for y in range(part.height())})


def test_a_mark_is_painted_and_its_tooltip_lists_the_names(sit: Sit) -> None:
    person = sit(SAMPLES / "registration.json", (900, 560))
    canvas = person.window.canvas
    person.until(lambda: bool(marks(person)))
    sheet = canvas.sheet
    assert sheet is not None
    found = [one for one in marks(person) if len(one.edges) > 1]
    assert found
    picture = canvas.viewport().grab().toImage()
    told = 0
    for one in found:
        at = person.on_canvas(QPointF(*one.at))
        assert one.words == f"+{len(one.edges)}"
        assert inks(picture, at) > 10, "a ring with a number"
        person.move_to(at)
        tip = canvas.viewport().toolTip()
        # The handle of a state beside the mark has a tooltip of its own.
        if not tip.startswith("Drag to draw"):
            told += 1
            assert f"There is no room for {len(one.edges)} names" in tip
            assert all(sheet.picture.operations[edge] in tip for edge in one.edges)
    assert told
