"""Locks at labels during a run: never over a highlighted mark, and of equal width in any state."""

from __future__ import annotations

from itertools import combinations

import pytest
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.guards import guarded_edges
from smsl_studio.picture.labels import meet
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.lit_labels import LitLabel, by_weight, lit_labels
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.theme import LIGHT
from tests.stories.at_canvas import sample

HERE = "State_1100"
SB = "REGISTRATION"


def _canvas(qtbot: QtBot, size: tuple[int, int]) -> Canvas:
    blueprint = sample("registration-people.json")
    canvas = Canvas(LIGHT)
    qtbot.addWidget(canvas)
    canvas.resize(*size)
    canvas.editing = False
    canvas.show_branch(blueprint, SB, place_states(blueprint[SB]))
    canvas.fit()
    return canvas


def _marks(canvas: Canvas, how: str) -> Marks:
    assert canvas.sheet is not None
    branch = canvas.sheet.picture.branch
    edges = list(guarded_edges(branch))
    held = frozenset(edge for edge in edges if edge.state == HERE and how == "unknown")
    possible = frozenset(Address(SB, HERE, name) for name in branch.table[HERE])
    guards = dict.fromkeys(edges, (how, "needs something"))
    return Marks(active=HERE, possible=possible - held, held_back=held, guards=guards, dimmed=True)


def _labels(canvas: Canvas, sheet: Sheet) -> list[LitLabel]:
    seen = canvas.mapToScene(canvas.viewport().rect()).boundingRect()
    view = (seen.left(), seen.top(), seen.right(), seen.bottom())
    return lit_labels(sheet, by_weight(sheet), view)


@pytest.mark.parametrize("size", [(606, 602), (1040, 620), (1500, 900)])
@pytest.mark.parametrize("how", ["true", "false", "unknown"])
def test_no_lock_lies_on_another_label(qtbot: QtBot, size: tuple[int, int], how: str) -> None:
    canvas = _canvas(qtbot, size)
    canvas.set_marks(_marks(canvas, how))
    sheet = canvas.sheet
    assert sheet is not None
    found = _labels(canvas, sheet)
    locked = [label for label in found if label.text.guard]
    assert locked
    assert {label.text.guard for label in locked} == {how}
    for one, other in combinations(found, 2):
        if one.text.guard or other.text.guard:
            assert not meet(one.rect, other.rect), (one.text, other.text)


def test_a_fact_that_turns_moves_no_label(qtbot: QtBot) -> None:
    canvas = _canvas(qtbot, (1500, 900))
    sheet = canvas.sheet
    assert sheet is not None
    places = []
    for how in ("true", "false", "unknown"):
        canvas.set_marks(_marks(canvas, how))
        edges = range(len(sheet.picture.operations))
        places.append([sheet.geometry.label(edge) for edge in edges])
    assert places[0] == places[1] == places[2]


def test_the_legend_of_a_run_names_locks_and_what_is_held_back_where_they_occur(
    qtbot: QtBot,
) -> None:
    canvas = _canvas(qtbot, (884, 400))
    canvas.set_marks(_marks(canvas, "unknown"))
    legend = canvas.overlays.run_legend
    assert legend.words[5:] == ("held back, unknown", "needs met", "needs not met")
    assert "needs not met" in legend.accessibleName()
    plain = sample("registration.json")
    canvas.show_branch(plain, SB, place_states(plain[SB]))
    risky = frozenset([Address(SB, HERE, next(iter(plain[SB].table[HERE])))])
    canvas.set_marks(Marks(active=HERE, risky=risky, dimmed=True))
    assert legend.words[5:] == ("risky",)
