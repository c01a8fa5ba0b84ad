"""Labels of what is possible in a run: whole and apart, or hidden until they are pointed at."""

from __future__ import annotations

from itertools import combinations

from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.labels import meet
from smsl_studio.studio.canvas.canvas import Canvas
from smsl_studio.studio.canvas.lit_labels import by_weight, lit_labels
from smsl_studio.studio.canvas.marks import Marks
from smsl_studio.studio.theme import LIGHT
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
