"""A hazard from its form to a run: found, walked, played, avoided, refused by hand, and held."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt

from smsl_studio.runlog.events import Committed, FaultInjected, HazardMet, Held, OperationRefused
from smsl_studio.studio.features.run.fault_dialog import FaultDialog
from tests.stories.at_run import PATIENCE, AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.stories.test_inspection_page import answered, cells, no_offers, page

Key = Qt.Key
NAME = "Disk 1 alone on b"
FIRST = "SB1/State_aa/Op_1b"
DETOUR = ["Op_1c", "Op_2b", "Op_1a", "Op_2c", "Op_1c"]
"""The way around the hazard. Without it the run takes Op_1b, Op_2c, Op_1c."""


def _written(sit: Sit, folder: Path) -> Person:
    """Somebody who writes a hazard for two disks with the form, and looks at its verdict."""
    file = folder / "two.json"
    file.write_bytes((SAMPLES / "hanoi-2.json").read_bytes())
    person = sit(file)
    answered(person)
    person.ctrl(Key.Key_I)
    form = page(person).form
    person.click(page(person).add_empty)
    person.type(NAME)
    person.click(form.first)
    person.type("SB1/0 = b and SB1/1 = a")
    no_offers(person)
    person.click(form.apply)
    answered(person)
    return person


def _play(person: Person, world: str) -> AtRun:
    """Play the run that is shown, in a world, until its operation is refused."""
    run = AtRun(person)
    run.choose(world=world)
    person.ctrl(Key.Key_1)
    person.click(page(person).run.play)
    person.qtbot.waitUntil(
        lambda: any(isinstance(one, OperationRefused) for one in run.events), timeout=PATIENCE
    )
    (said,) = (one for one in run.events if isinstance(one, OperationRefused))
    assert (str(said.address), said.hazard) == (FIRST, NAME)
    return run


def _ways(run: AtRun) -> list[str]:
    done = (one for one in run.events if isinstance(one, Committed))
    return [edge.rpartition("/")[2] for one in done for edge in one.operations]


def _let_it_go_on(run: AtRun) -> None:
    """Let the run go on by itself, as fast as it goes."""
    run.as_fast_as_it_goes()
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")


def test_a_hazard_is_found_walked_refused_avoided_and_held(sit: Sit, tmp_path: Path) -> None:
    person = _written(sit, tmp_path)
    assert cells(person, NAME)[0] == "Fails"
    run_view = page(person).run
    assert run_view.isVisible()
    person.click(run_view.step)
    marks = person.window.canvas.marks
    assert (marks.active, [str(one) for one in marks.trail]) == ("State_ba", [FIRST])

    run = _play(person, "table")
    run.click_arrow(FIRST)
    person.until(lambda: NAME in run.word())
    assert run.active() == {"SB1": "State_aa"}
    _let_it_go_on(run)
    assert _ways(run) == DETOUR

    person.click(run.pane.transport.by_hand)
    run.events.clear()
    person.press(Key.Key_F5)
    run.until_phase("Ready")
    person.press(Key.Key_I, (Qt.KeyboardModifier.ControlModifier,
                             Qt.KeyboardModifier.ShiftModifier))  # fmt: skip
    dialog = person.window.features.run.faults
    assert isinstance(dialog, FaultDialog)
    person.until(dialog.isVisible)
    person.choose(dialog.fault, "A fact changes, until an operation writes it")
    person.choose(dialog.value, "b")
    person.click(dialog.inject)
    person.until(lambda: any(isinstance(one, Held) for one in run.events))
    (put,) = (one.t for one in run.events if isinstance(one, FaultInjected))
    (met,) = (one for one in run.events if isinstance(one, HazardMet))
    (held,) = (one for one in run.events if isinstance(one, Held))
    assert (met.name, held.kind, held.t) == (NAME, "hazard", met.t)
    assert met.t - put <= 0.05 + 1e-9, "within one tick"
    person.click(dialog.close_button)
    run.until_phase("Fault hold")
    assert NAME in run.pane.canvas.banner


def test_in_physics_it_is_refused_by_hand_and_the_run_goes_the_other_way(
    sit: Sit, tmp_path: Path
) -> None:
    run = _play(_written(sit, tmp_path), "hanoi")
    _let_it_go_on(run)
    assert _ways(run) == DETOUR
