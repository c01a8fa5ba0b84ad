"""The card of a finding covers no state if there is room, and is read out as a whole."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.studio.features.draw.canvas.copy_card import CopyCard
from smsl_studio.studio.features.draw.canvas.fix_card import FixCard
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Modifier = Qt.Key, Qt.KeyboardModifier


def odd_state(person: Person) -> FixCard:
    """Add a state that leads nowhere; the card that says so."""
    person.press(Key.Key_N, [Modifier.ControlModifier, Modifier.ShiftModifier])
    person.type("State099")
    person.press(Key.Key_Return)
    person.until_inspected()
    card = person.window.fix_card
    assert card.isHidden(), "nobody has finished the new state"
    person.select("SB1/State000")
    person.select("SB1/State099")
    person.until(card.isVisible)
    return card


def covered(person: Person) -> list[str]:
    """The states that lie below the card, even in part."""
    canvas, card = person.window.canvas, person.window.fix_card
    found = []
    for name in canvas.positions:
        rect = canvas.rect_of(person.blueprint.resolve(f"SB1/{name}"))
        assert rect is not None
        if canvas.mapFromScene(rect).boundingRect().intersects(card.geometry()):
            found.append(name)
    return found


def in_the_corners(person: Person) -> None:
    """Draw so that a state stands in each corner of the view, and leave room in between."""
    canvas = person.window.canvas
    canvas.zoom_to(1.0)
    wide, high = canvas.width(), canvas.height()
    names = list(person.blueprint["SB1"].table)
    spots = [(90, 120), (wide - 90, 120), (90, high - 120), (wide - 90, high - 170)]
    spots += [(wide // 2 + 60 * at, high - 60) for at in range(len(names) - len(spots))]
    points = [canvas.mapToScene(QPoint(*spot)) for spot in spots]
    places = {name: (at.x(), at.y()) for name, at in zip(names, points, strict=True)}
    person.window.session.edit("Move", lambda bp: editing.set_layout(bp, "SB1", places))


@pytest.mark.parametrize("size", [(1280, 800), (1440, 900), (1100, 720)])
def test_the_card_of_a_finding_covers_no_state(sit: Sit, size: tuple[int, int]) -> None:
    person = sit(SAMPLES / "hfsm.json", size)
    canvas = person.window.canvas
    canvas.camera.motion = False
    in_the_corners(person)
    card = odd_state(person)
    assert covered(person) == []
    assert canvas.rect().contains(card.geometry())
    overlays = canvas.overlays
    for part in (overlays.zoom, overlays.map, overlays.breadcrumb, overlays.legend):
        assert part.isHidden() or not part.geometry().intersects(card.geometry())


def test_the_words_of_the_card_are_whole_from_the_first(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (1280, 800))
    card = odd_state(person)
    for words in card.words:
        assert words.height() >= words.heightForWidth(words.width())


def test_the_words_of_its_button_are_whole_or_shortened(sit: Sit) -> None:
    """A long name was cut at both ends: "elete State"."""
    person = sit(SAMPLES / "hfsm.json", (1280, 800))
    card = odd_state(person)

    def is_whole() -> bool:
        fix, leave = card.fix, card.leave
        whole = fix.width() >= fix.sizeHint().width() and card.rect().contains(leave.geometry())
        return whole and fix.text().startswith(("Delete", "Give"))

    assert is_whole()
    state, long = Address("SB1", "State099"), "State099_" + "of_a_very_long_name" * 2
    person.window.session.edit("Rename", lambda bp: editing.rename(bp, state, long))
    person.until_inspected()
    person.until(card.isVisible)
    assert is_whole()
    assert long in card.fix.toolTip()


def test_the_copy_that_is_proposed_has_the_canvas_for_itself(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (1280, 800))
    card = odd_state(person)
    person.ctrl(Key.Key_D)
    copy = person.window.editor.field
    assert isinstance(copy, CopyCard)
    assert card.isHidden() or not card.geometry().intersects(copy.geometry())
    for name in ("State099", "State000"):
        rect = person.window.canvas.rect_of(Address("SB1", name))
        assert rect is not None
        node = person.window.canvas.mapFromScene(rect).boundingRect()
        assert not node.intersects(copy.geometry()), name
    person.press(Key.Key_Return)
    person.until_inspected()
    assert card.isHidden()


@pytest.mark.parametrize(
    ("state", "size"), [("State_cbb", (1280, 800)), ("State_bcc", (1000, 700))]
)
def test_the_card_leaves_both_ends_of_its_operation_free(
    sit: Sit, state: str, size: tuple[int, int]
) -> None:
    person = sit(SAMPLES / "hanoi-corrected.json", size)
    canvas = person.window.canvas
    canvas.camera.motion = False
    operations = person.blueprint["SB1"].table[state]
    old, target = next(iter(operations.items()))
    other = next(name for name in person.blueprint["SB1"].operation_names if name not in operations)
    at = Address("SB1", state, old)
    person.window.session.edit("Misprint", lambda bp: editing.rename(bp, at, other))
    person.until_inspected()
    person.window.session.select(())
    person.window.session.select((Address("SB1", state, other),))
    person.until(person.window.fix_card.isVisible)
    assert not {state, target} & set(covered(person))
