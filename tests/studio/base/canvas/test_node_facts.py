"""A node shows its facts, and the number of facts for which it has no room."""

from __future__ import annotations

import json
from itertools import pairwise

import pytest
from PySide6.QtGui import QImage, QPainter
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.picture import Face, Picture
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.base.paint.ink import Ink
from smsl_studio.studio.base.paint.node_paint import NodeLook, chip_places, full_width, paint_node
from smsl_studio.studio.base.theme import LIGHT


def face_of(facts: int) -> Face:
    document = parse_json(json.dumps({"S": {"State_" + "1" * facts: {}}}), "a.json")
    return Picture(read_blueprint(document), "S").face(0)


@pytest.mark.parametrize("width", [108.0, 92.0])
@pytest.mark.parametrize("facts", range(1, 14))
def test_facts_and_the_count_of_the_rest_stand_within_the_node(
    facts: int, width: float, qtbot: QtBot
) -> None:
    ink = Ink(LIGHT)
    face = face_of(facts)
    places = chip_places(face, ink, width)
    rest = facts - len(places)
    right = places[-1].right() + (4.0 + ink.chip.width(f"+{rest}") if rest else 0.0)
    assert places[0].left() >= -width / 2 + 5.9
    assert right <= width / 2 - 5.9
    assert all(a.right() < b.left() for a, b in pairwise(places))
    if facts <= 3:
        assert not rest


def test_the_count_of_the_rest_is_drawn(qtbot: QtBot) -> None:
    ink = Ink(LIGHT)
    face = face_of(12)
    width = full_width(face, ink)
    places = chip_places(face, ink, width)
    assert len(places) < 12
    picture = QImage(int(width) + 80, 120, QImage.Format.Format_RGB32)
    picture.fill(LIGHT.canvas)
    painter = QPainter(picture)
    painter.translate(picture.width() / 2, picture.height() / 2)
    paint_node(painter, face, width, False, NodeLook(), ink)
    painter.end()
    left, right = int(places[-1].right()) + 3, int(width / 2) - 5
    top = int(places[-1].top())
    seen = {
        picture.pixelColor(picture.width() // 2 + x, picture.height() // 2 + y).name()
        for x in range(left, right)
        for y in range(top, top + 18)
    }
    assert len(seen) > 2, "nothing is written behind the last fact"
