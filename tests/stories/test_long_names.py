"""Names that are too long for their place are shortened, and push nothing out of sight."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import Qt

from smsl_studio.blueprint.address import Address
from tests.stories.conftest import Sit
from tests.stories.test_recovery import add, die, offer_to

LONG = f"{'a-name-that-nobody-would-choose-' * 6}end.json"


def long_file(folder: Path) -> Path:
    path = folder / LONG
    path.write_text('{"SB1": {"State_0": {"Op": "State_1"}, "State_1": {}}}')
    return path


def test_the_path_over_the_canvas_keeps_the_state_branch_in_sight(sit: Sit, tmp_path: Path) -> None:
    person = sit(long_file(tmp_path), (1280, 800))
    canvas = person.window.canvas
    crumb = canvas.overlays.breadcrumb
    assert crumb.geometry().right() <= canvas.width()
    assert crumb.place_of(1).width() > 20
    person.window.resize(1920, 1080)
    person.until(lambda: crumb.place_of(0).width() > 900)
    assert crumb.geometry().right() <= canvas.width()


def test_a_short_path_is_as_wide_as_its_names(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text('{"SB1": {"State_0": {}}}')
    crumb = sit(path, (1280, 800)).window.canvas.overlays.breadcrumb
    assert crumb.place_of(0).width() < 60


def test_the_offer_to_recover_shortens_names_and_folders(sit: Sit, tmp_path: Path) -> None:
    folder = tmp_path.joinpath(*["deep-" * 40] * 5)
    folder.mkdir(parents=True)
    first = sit(long_file(folder))
    add(first, "State_9")
    die(first)
    offer = offer_to(sit())
    (row,) = offer.rows.values()
    assert row.name.mapTo(offer, row.name.rect().topRight()).x() <= offer.width() - 20
    assert row.name.toolTip() == LONG
    assert row.name.width() > 200, "a long folder leaves the name its room"


def test_a_long_sentence_gives_way_before_what_stands_beside_it(sit: Sit) -> None:
    person = sit(size=(1280, 800))
    line = person.window.status_line
    line.show_mode("run")
    why = "SB1/State_aaa does not check true: " + "Fact 1 of SB1 reads c, not a. " * 5
    short = (
        "World hanoi",
        "Seed 0",
        "Simulated 60.0 s",
        "Paced at real time",
        "Frozen copy, drawing unchanged",
    )
    line.show_run(((*short, why), ("Alive, 1.4 ms", "Recording", "Simulation only")))
    person.qtbot.waitUntil(lambda: line.run[5].width() > 100)
    for part in (*line.run[:5], *line.run_right):
        assert part.width() >= part.fontMetrics().horizontalAdvance(part.text()), part.text()
    assert why in line.words


def test_a_message_about_a_name_of_10_000_characters_can_be_read(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "names.json"
    name = f"State{'x' * 9_992}000"
    path.write_text(json.dumps({"SB1": {name: {}, "State1": {name: name}}}))
    person = sit(path)
    toast = person.window.toast
    person.window.session.select((Address("SB1", name),))
    person.ctrl(Qt.Key.Key_C)
    assert toast.words.startswith("Copied Statexxx")
    assert toast.words.endswith("xxx000.")
    assert len(toast.words) < 100
    assert toast.height() < 100
    assert toast.width() <= person.window.width()


def test_an_empty_window_has_no_empty_parts_in_its_status_line(sit: Sit) -> None:
    line = sit().window.status_line
    assert not [part for part in (*line.run, *line.run_right) if part.isVisible()]
