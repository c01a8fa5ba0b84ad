"""The breadcrumb above the drawing."""

from __future__ import annotations

import json

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtGui import QImage, QPainter, QRegion
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.base.overlays.breadcrumb import Breadcrumb
from smsl_studio.studio.base.theme import DARK, LIGHT, Tokens


@pytest.mark.parametrize("tokens", [LIGHT, DARK], ids=lambda tokens: tokens.name)
def test_what_lies_below_is_not_seen_through_the_names(qtbot: QtBot, tokens: Tokens) -> None:
    view = QWidget()
    qtbot.addWidget(view)
    view.resize(600, 100)
    crumb = Breadcrumb(view, tokens)
    crumb.show_branch(read_blueprint(parse_json('{"SB1": {"State_0": {}}}', "a.json")), "SB1")
    picture = QImage(crumb.size(), QImage.Format.Format_ARGB32)
    picture.fill(tokens.slate)
    painter = QPainter(picture)
    crumb.render(painter, QPoint(), QRegion(), QWidget.RenderFlag.DrawChildren)
    painter.end()
    seen = picture.pixelColor(crumb.place_of(0).toRect().right() + 2, 3)
    wanted = tokens.canvas
    assert abs(seen.lightness() - wanted.lightness()) < 24, seen.name()


def test_what_is_drawn_in_a_grid_because_it_is_so_large_says_so(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    view = QWidget()
    qtbot.addWidget(view)
    crumb = Breadcrumb(view, LIGHT)
    chain = {f"S{i}": {"go": f"S{i + 1}"} for i in range(70)}
    blueprint = read_blueprint(parse_json(json.dumps({"B": {**chain, "S70": {}}}), "a.json"))
    crumb.show_branch(blueprint, "B")
    assert crumb.note == "71 states, 70 operations"
    monkeypatch.setattr("smsl_studio.graph.layout.MOST_SPREAD", 70)
    crumb.show_branch(blueprint, "B")
    assert crumb.note.endswith(", very many, so in columns from S0")
