"""A person lets a world try every operation, and watches the graph grow."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from smsl_studio.studio.features.physics.page import PhysicsPage
from tests.front.test_physics import BOARD, SWITCHES
from tests.plugin_folder import write_plugin
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

AtPhysics = Callable[[], tuple[Person, PhysicsPage]]


@pytest.fixture
def at_physics(sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> AtPhysics:
    """Open the page beside a board of two switches, whose drawing has two mistakes."""
    folder = tmp_path / "plugins"
    write_plugin(folder, "switches", SWITCHES)
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(folder))
    path = tmp_path / "board.json"
    path.write_text(json.dumps(BOARD), "utf-8")

    def sat() -> tuple[Person, PhysicsPage]:
        person = sit(path)
        person.window.actions_table["physics_page"].trigger()
        page = person.window.features.physics.part()
        page.world.setCurrentText("switches")
        return person, page

    return sat


def test_the_world_in_which_the_drawing_can_run_is_offered_first(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.window.actions_table["physics_page"].trigger()
    page = person.window.features.physics.part()
    person.until(lambda: page.world.currentText() == "hanoi")
    assert page.world.itemText(0) == "chess"


def test_the_graph_grows_is_paused_goes_on_and_is_kept(at_physics: AtPhysics) -> None:
    person, page = at_physics()
    work = person.window.features.physics.work
    assert work is not None
    assert person.window.mode == "physics"
    assert page.empty.isVisible()
    assert not page.keep.isEnabled()
    person.click(page.turn)
    person.until(lambda: work.tried > 0)
    assert page.keep.isEnabled()
    if work.phase == "running":
        person.click(page.turn)
        assert page.sum.text().startswith("Paused. ")
        tried = work.tried
        assert page.turn.text() == "Go on"
        person.click(page.turn)
        person.until(lambda: work.tried >= tried)
    person.until(lambda: work.phase == "done")
    assert page.sum.text() == "Done. 4 states, all tried, 6 operations"
    assert page.canvas.sheet is not None
    assert len(page.canvas.sheet.picture.names) == 4
    assert [row.text for row in page.list.rows.rows] == [
        "False: BOARD/State_01/Op_11", "Missing: BOARD/State_00/Op_21",
    ]  # fmt: skip
    assert person.blueprint.fields.get("_origin") is None, "the drawing is as it was"
    person.click(page.keep)
    assert person.window.mode == "draw"
    assert person.blueprint.fields["_origin"]["how"] == "explore"
    assert person.blueprint.operation_count == 6


def test_what_was_tried_is_known_to_the_next_window_until_it_is_forgotten(
    at_physics: AtPhysics, home: Path
) -> None:
    person, page = at_physics()
    physics = person.window.features.physics
    person.click(page.turn)
    person.until(lambda: physics.work is not None and physics.work.phase == "done")
    (part,) = home.rglob("explorations/*.part")
    assert part.read_bytes().count(b"\n") == 5
    person.window.close()
    person, page = at_physics()
    physics = person.window.features.physics
    person.click(page.turn)
    person.until(lambda: physics.work is not None and physics.work.phase == "done")
    assert part.read_bytes().count(b"\n") == 5, "nothing was tried again"
    person.click(page.anew)
    assert not part.exists()
    assert page.empty.isVisible()
    assert not page.canvas.isVisible()


def test_a_drawing_without_one_start_is_refused_and_so_is_a_world_that_does_not_suit(
    sit: Sit,
) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.window.actions_table["physics_page"].trigger()
    physics = person.window.features.physics
    page = physics.part()
    person.click(page.turn)
    assert "one State Branch" in person.window.toast.words
    person.window.open_path(SAMPLES / "hanoi-2.json")
    person.window.actions_table["physics_page"].trigger()
    page.world.setCurrentText("river")
    person.click(page.turn)
    person.until(lambda: physics.work is not None and physics.work.phase == "")
    assert "river" in person.window.toast.words
