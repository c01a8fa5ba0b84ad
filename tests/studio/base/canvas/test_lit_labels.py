"""Labels of possible operations in a run: whole and apart, or hidden until pointed at."""

from __future__ import annotations

from itertools import combinations

import pytest
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.front.inputs import read
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.labels import meet
from smsl_studio.picture.marks import Marks
from smsl_studio.shipped import plugins_dir
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.lit_labels import by_weight, lit_labels
from smsl_studio.studio.base.theme import LIGHT
from tests.stories.at_canvas import sample

HERE = "State_0010"


def test_no_label_of_what_is_possible_is_cut_or_lies_on_another(qtbot: QtBot) -> None:
    blueprint = sample("registration.json")
    branch = blueprint["REGISTRATION"]
    canvas = Canvas(LIGHT)
    qtbot.addWidget(canvas)
    canvas.resize(606, 602)
    canvas.editing = False
    canvas.show_branch(blueprint, branch.name, place_states(branch))
    canvas.fit()
    done = Address(branch.name, "State_0000", "Op_PlanToolPose")
    possible = frozenset(Address(branch.name, HERE, name) for name in branch.table[HERE])
    marks = Marks(active=HERE, trail=(done,), possible=possible, dimmed=True)
    canvas.set_marks(marks)
    sheet = canvas.sheet
    assert sheet is not None
    assert sheet.compact
    seen = canvas.mapToScene(canvas.viewport().rect()).boundingRect()
    view = (seen.left(), seen.top(), seen.right(), seen.bottom())

    found = lit_labels(sheet, by_weight(sheet), view)

    assert {"PlanToolPose", "PlanLandmarks"} <= {label.text.text for label in found}
    for label in found:
        left, top, right, bottom = label.rect
        assert left >= view[0]
        assert right <= view[2]
        assert top >= view[1]
        assert bottom <= view[3]
    assert not any(meet(a.rect, b.rect) for a, b in combinations(found, 2))


@pytest.mark.parametrize("how", ["planned", "pruned", "held_back"])
@pytest.mark.parametrize("name", ["three-roots.json", "registration.json", "hanoi-corrected.json"])
def test_nothing_that_is_lit_is_named_over_a_name_or_a_state(
    qtbot: QtBot, name: str, how: str
) -> None:
    """In the widths of Run and of the full map, in every state of every SB."""
    blueprint = sample(name)
    canvas = Canvas(LIGHT)
    qtbot.addWidget(canvas)
    canvas.editing = False
    named = asked = 0
    for branch in blueprint:
        for size in ((560, 526), (884, 400)):
            canvas.resize(*size)
            canvas.show_branch(blueprint, branch.name, place_states(branch))
            canvas.fit(smooth=False)
            seen = canvas.mapToScene(canvas.viewport().rect()).boundingRect()
            view = (seen.left(), seen.top(), seen.right(), seen.bottom())
            for here in branch.table:
                out = frozenset(Address(branch.name, here, name) for name in branch.table[here])
                lit = {how: tuple(out) if how == "planned" else out}
                marks = Marks(active=here, possible=out, dimmed=True, **lit)  # type: ignore[arg-type]
                canvas.set_marks(marks)
                sheet = canvas.sheet
                assert sheet is not None
                found = lit_labels(sheet, by_weight(sheet), view)
                named, asked = named + len(found), asked + len(out)
                for one, other in combinations(found, 2):
                    assert not meet(one.rect, other.rect), (here, one.text, other.text)
                for one in found:
                    left, top, right, bottom = one.rect
                    hair = sheet.unit
                    inner = (left + hair, top + hair, right - hair, bottom - hair)
                    assert not sheet.states_in(*inner), (here, one.text)
    assert named > 0.8 * asked, f"only {named} of {asked} are named"


def test_what_is_only_possible_is_not_named_across_the_way_that_was_gone(qtbot: QtBot) -> None:
    blueprint = sample("registration.json")
    branch = blueprint["REGISTRATION"]
    canvas = Canvas(LIGHT)
    qtbot.addWidget(canvas)
    canvas.editing = False
    done = Address(branch.name, "State_0000", "Op_PlanToolPose")
    possible = frozenset(Address(branch.name, HERE, name) for name in branch.table[HERE])
    for size in ((560, 526), (628, 600), (884, 400)):
        canvas.resize(*size)
        canvas.show_branch(blueprint, branch.name, place_states(branch))
        canvas.fit(smooth=False)
        canvas.set_marks(Marks(active=HERE, trail=(done,), possible=possible, dimmed=True))
        sheet = canvas.sheet
        assert sheet is not None
        seen = canvas.mapToScene(canvas.viewport().rect()).boundingRect()
        # Narrow on the left, so that the side that is free is out of sight.
        view = (seen.left() + 40, seen.top(), seen.right(), seen.bottom())
        (way,) = (e for e in sheet.looks.lit_edges if sheet.edge_look(e).trail)
        shape = sheet.geometry.shape(way)
        points = [shape.at(shape.length * at / 20) for at in range(21)]
        for label in lit_labels(sheet, by_weight(sheet), view):
            if label.edge != way:
                left, top, right, bottom = label.rect
                crossed = [p for p in points if left < p[0] < right and top < p[1] < bottom]
                assert not crossed, (size, label.text)


@pytest.mark.parametrize("name", ["registration-digitization.json", "three-levels.json"])
def test_the_name_of_a_step_that_is_walked_covers_no_other_name(qtbot: QtBot, name: str) -> None:
    """In the drawing beside Inspection, after each two operations one after the other."""
    blueprint = sample(name)
    canvas = Canvas(LIGHT)
    qtbot.addWidget(canvas)
    named = 0
    for branch in blueprint:
        canvas.resize(742, 288)
        canvas.show_branch(blueprint, branch.name, place_states(branch))
        canvas.fit(smooth=False)
        seen = canvas.mapToScene(canvas.viewport().rect()).boundingRect()
        view = (seen.left(), seen.top(), seen.right(), seen.bottom())
        edges = [
            Address(branch.name, state, name)
            for state, operations in branch.table.items()
            for name in operations
        ]
        for first, then in ((a, b) for a in edges for b in edges if b.state != a.state):
            canvas.set_marks(Marks(active=then.state, trail=(first, then), walked=True))
            sheet = canvas.sheet
            assert sheet is not None
            found = lit_labels(sheet, by_weight(sheet), view)
            names = {e: sheet.geometry.label(e) for e in range(len(edges))}
            named += len(found)
            for label in found:
                for other, rect in names.items():
                    if not sheet.looks.is_lit(other) and rect is not None:
                        assert not meet(label.rect, rect), (first, then, label.text)
    assert named


def test_no_name_of_a_planned_way_is_cut_by_the_edge_of_the_view(qtbot: QtBot) -> None:
    """A long name at the last column of a wide drawing was cut in the middle."""
    blueprint = read(plugins_dir() / "chess" / "chess.json")
    branch = blueprint["SB1"]
    canvas = Canvas(LIGHT)
    qtbot.addWidget(canvas)
    canvas.resize(556, 486)
    canvas.editing = False
    canvas.show_branch(blueprint, branch.name, place_states(branch))
    canvas.fit()
    edges = list(branch.edges())
    seen = canvas.mapToScene(canvas.viewport().rect()).boundingRect()
    view = (seen.left(), seen.top(), seen.right(), seen.bottom())
    named = 0
    for first in range(0, len(edges), 12):
        planned = tuple(edge.address for edge in edges[first : first + 12])
        canvas.set_marks(Marks(planned=planned, dimmed=True))
        assert canvas.sheet is not None
        for label in lit_labels(canvas.sheet, by_weight(canvas.sheet), view):
            left, top, right, bottom = label.rect
            assert left >= view[0], label
            assert right <= view[2], label
            assert top >= view[1], label
            assert bottom <= view[3], label
            named += 1
    assert named > 40
