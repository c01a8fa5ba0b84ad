"""A window with blueprints that have far too many of one thing: texts stay short, work linear."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import MOST
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.features.draw.panels import library
from tests.bombs.table import BY_NAME
from tests.bombs.test_work import steps
from tests.stories.conftest import Sit
from tests.stories.person import Person

SIZE = 60_000
BOMBS = ("repeated_subs", "many_facts", "long_sbs")


def bomb(folder: Path, name: str, size: int) -> Path:
    path = folder / f"{name}-{size}.json"
    path.write_text(BY_NAME[name].sized("json", size))
    return path


@pytest.mark.parametrize("name", BOMBS)
def test_no_text_is_longer_than_a_person_reads(sit: Sit, tmp_path: Path, name: str) -> None:
    person = sit(bomb(tmp_path, name, SIZE))
    person.until(lambda: person.window.inspector.current)
    for widget in person.window.findChildren(QWidget):
        texts = [widget.toolTip(), widget.accessibleName(), widget.accessibleDescription()]
        texts += [widget.text()] if isinstance(widget, QLabel) else []
        assert max(map(len, texts)) <= MOST, widget


def opened(person: Person, path: Path) -> int:
    """Open a file and draw it; how many lines of Python that takes."""

    def work() -> None:
        person.window.open_path(path)
        for _ in range(3):
            QApplication.processEvents()

    return steps(work)


def test_operations_of_many_sbs_take_work_in_proportion(sit: Sit, tmp_path: Path) -> None:
    person = sit()
    counts = []
    for n in (100, 150, 300):
        path = tmp_path / f"{n}.json"
        path.write_text(json.dumps({f"B{i}": {"S": {f"o{i}": "S"}} for i in range(n)}))
        counts.append(opened(person, path))
        person.until_inspected()
    assert counts[2] <= 2.3 * counts[1]


def test_of_very_many_operations_the_library_lists_the_first(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "many.json"
    names = [f"Op_{at:05}" for at in range(library.MOST + 345)]
    path.write_text(json.dumps({"B": {"S": dict.fromkeys(names, "S")}}))
    shown = sit(path).window.library
    texts = [row.text for row in shown.list.rows.rows if isinstance(row.payload, str)]
    assert texts == names[: library.MOST]
    said = next(row.text for row in shown.list.rows.rows if row.text.startswith("and "))
    assert said == "and 345 more: filter them by a part of their name"
    shown.filter.setText(names[-1])
    found = [row.text for row in shown.list.rows.rows if isinstance(row.payload, str)]
    assert found == names[-1:]


def test_a_file_that_is_opened_is_drawn_once(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit()
    drawn: list[str] = []

    def counted(blueprint: Blueprint, branch: str, *, words: bool) -> Picture:
        drawn.append(branch)
        return Picture(blueprint, branch, words=words)

    monkeypatch.setattr("smsl_studio.studio.base.canvas.canvas.Picture", counted)
    for name, first in (("states_in_a_ring", "B"), ("long_sbs", "0" * 9_000)):
        person.window.open_path(bomb(tmp_path, name, SIZE))
        person.until_inspected()
        assert drawn == [first]
        assert person.window.canvas.camera.keeps == "opening"
        drawn.clear()
