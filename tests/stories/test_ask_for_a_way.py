"""A run without a way: the person asks for one, sees it on the canvas, allows it and keeps it."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from smsl_studio.runlog.events import EdgeGenerated
from smsl_studio.studio.features.run.way_dialog import WayDialog
from tests.stories.at_tasks import SURGEON, AtTasks
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, address

EDGE = address("SB1/State_aa/Op_1b")


def cut(folder: Path) -> Path:
    """Hanoi with two disks, in which nothing leads on from where it begins."""
    values = json.loads((SAMPLES / "hanoi-2.json").read_text("utf-8"))
    values["SB1"]["State_aa"] = {}
    path = folder / "cut.json"
    path.write_text(json.dumps(values, indent=4))
    return path


def ask(at: AtTasks) -> None:
    """Press the button of the hold in Supervise, and ask the library."""
    hold = at.person.window.features.supervise.pane.hold
    at.person.until(hold.way.isVisible)
    at.person.click(hold.way)
    at.person.until(lambda: bool(at.person.window.findChildren(WayDialog)))
    dialog = at.person.window.findChildren(WayDialog)[-1]
    assert dialog.provider == "reader"
    QTest.mouseClick(dialog.use, Qt.MouseButton.LeftButton)
    at.person.come_back()


def test_a_way_is_asked_for_shown_allowed_and_kept(sit: Sit, tmp_path: Path) -> None:
    path = cut(tmp_path)
    person = sit(path)
    before = path.read_bytes()
    at = AtTasks(person, SURGEON)
    at.start()
    at.until_phase("no_route")
    ask(at)
    person.until(lambda: at.card.card is not None)
    assert "Op_1b from State_aa to State_ba" in at.shown.question
    assert "Forecast: agrees" in at.shown.detail
    view = person.window.features.supervise.pane.view
    assert view is not None
    assert [one.standing for one in view.cards] == ["proposed"]
    # It is drawn as a difference, and does not count yet.
    person.ctrl(Qt.Key.Key_2)
    canvas = person.window.features.run.pane.canvas
    person.until(lambda: canvas.canvas.marks.changes == {EDGE: "?+"})
    assert canvas.canvas.rect_of(EDGE) is not None
    assert not canvas.moved_on
    assert EDGE.operation not in person.blueprint["SB1"].table["State_aa"]
    person.ctrl(Qt.Key.Key_3)
    at.answer_as(SURGEON)
    at.choose("Allow")
    at.decide()
    person.until(lambda: at.run.over)
    assert at.run.phase == "goal_reached"
    assert [one.by for one in at.events if isinstance(one, EdgeGenerated)] == [SURGEON.name]
    assert path.read_bytes() == before
    # It may be kept, as one step of the history.
    toast = person.window.toast
    person.until(toast.button.isVisible)
    person.click(toast.button)
    assert person.blueprint["SB1"].table["State_aa"] == {"Op_1b": "State_ba"}
    assert person.steps()[-1] == "Keep 1 operation of the run"
    person.ctrl(Qt.Key.Key_1)
    person.ctrl(Qt.Key.Key_Z)
    assert person.blueprint["SB1"].table["State_aa"] == {}


def test_what_is_refused_leaves_the_hold(sit: Sit, tmp_path: Path) -> None:
    at = AtTasks(sit(cut(tmp_path)), SURGEON)
    at.start()
    at.until_phase("no_route")
    ask(at)
    for _ in range(3):
        at.person.until(lambda: at.card.card is not None)
        asked = len(at.outcomes)
        at.answer_as(SURGEON)
        at.choose("Refuse")
        at.decide()
        at.person.qtbot.waitUntil(lambda: len(at.outcomes) > asked)  # noqa: B023
        at.person.until(lambda: at.run.phase in ("no_route", "waiting"))
        if at.run.phase == "no_route":
            break
    at.until_phase("no_route")
    assert at.run.status is not None
    assert at.run.status.proposed is None
    assert any("was not allowed" in one for one in at.run.status.details)
