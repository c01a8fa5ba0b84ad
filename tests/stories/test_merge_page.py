"""The page Merge: conflicts are chosen one by one, taken back, and the file is saved."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.merge import merge
from smsl_studio.blueprint.merge.columns import ColumnLine, Row
from smsl_studio.studio.features.merge.columns_view import folded
from smsl_studio.studio.features.merge.conflict_list import MOST
from smsl_studio.studio.features.merge.page import MergePage
from tests.blueprint.merge.test_merge import BASE, changed
from tests.blueprint.values import read
from tests.front.test_marked_files import marked
from tests.stories.conftest import Sit
from tests.stories.person import Person

OURS = changed(("A|S0|go", "S2"), ("A|_states|S2|title", "mine"), ("A|S2|more", "S0"))
THEIRS = changed(("A|S0|go", None), ("A|_states|S2|title", "theirs"), ("B|X1|down", "X0"))


def merged_file(
    tmp_path: Path, ours: dict[str, Any] = OURS, theirs: dict[str, Any] = THEIRS
) -> Path:
    path = tmp_path / "plan.json"
    done = merge(read(BASE), read(ours), read(theirs))
    path.write_text(done.blueprint.document.text)
    return path


def at_page(person: Person) -> MergePage:
    """Click the tab Merge; the page it shows."""
    bar = person.window.page_row.bar
    person.qtbot.waitUntil(bar.isVisible)
    person.click(bar, bar.tabRect(person.window.page_row.tabs.names.index("Merge")).center())
    page = person.window.features.merge.part.made
    assert page is not None
    person.until(page.isVisible)
    return page


def card(page: MergePage, address: str) -> Any:
    return next(one for one in page.list.cards if one.conflict.address == address)


def test_a_file_without_conflicts_has_no_row_of_pages(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "plain.json"
    path.write_text(json.dumps(BASE))
    person = sit(path)
    assert not person.window.page_row.isVisible()
    assert not person.window.features.merge.badge.isVisible()
    assert person.window.mode_bar.run.isEnabled()
    assert not person.window.actions_table["merge_page"].isEnabled()


def test_conflicts_are_chosen_taken_back_and_saved(sit: Sit, tmp_path: Path) -> None:
    path = merged_file(tmp_path)
    person = sit(path)
    window = person.window
    assert window.features.merge.badge.text() == "2 conflicts open"
    assert not window.mode_bar.run.isEnabled()
    assert "2 conflicts are open" in window.mode_bar.run.toolTip()
    page = at_page(person)
    assert window.mode == "merge"
    assert not page.list.save.isEnabled()
    assert page.list.words == "2 conflicts to choose. Then the file can be saved."
    go, title = card(page, "A/S0/go"), card(page, "A/S2")
    person.click(go.buttons["theirs"])
    assert "go" not in person.blueprint["A"].table["S0"]
    assert person.steps() == ["Take theirs for A/S0/go"]
    assert go.buttons["theirs"].isChecked()
    assert page.list.current == title.conflict, "the next one is selected"
    person.click(title.buttons["base"])
    assert page.list.save.isEnabled()
    assert window.features.merge.badge.isHidden()
    assert window.mode_bar.run.isEnabled()
    person.ctrl(Qt.Key.Key_Z)
    assert not page.list.save.isEnabled()
    assert not title.buttons["base"].isChecked()
    assert page.list.words.startswith("1 conflict to choose")
    assert page.list.current == title.conflict, "what an undo opened is selected"
    person.click(title.buttons["theirs"])
    person.click(go.buttons["ours"])
    assert person.blueprint["A"].table["S0"]["go"] == "S2", "it can be decided anew"
    person.click(page.list.save)
    saved = json.loads(path.read_text())
    assert "_conflicts" not in saved
    assert saved["A"]["_states"]["S2"]["title"] == "theirs"
    assert saved["A"]["S0"]["go"] == "S2"
    assert saved["B"]["X1"]["down"] == "X0"
    assert window.mode == "draw"
    assert not window.page_row.isVisible()


def test_leaving_it_open_keeps_the_conflicts_in_the_file(sit: Sit, tmp_path: Path) -> None:
    path = merged_file(tmp_path)
    person = sit(path)
    page = at_page(person)
    person.click(card(page, "A/S0/go").buttons["theirs"])
    person.click(page.list.leave)
    assert person.window.mode == "draw"
    assert person.window.page_row.isVisible()
    person.ctrl(Qt.Key.Key_S)
    (left,) = json.loads(path.read_text())["_conflicts"]
    assert left["path"] == ["A", "_states", "S2", "title"]
    assert person.window.features.merge.badge.text() == "1 conflict open"


def test_focus_previews_a_version_with_its_findings_and_changes_nothing(
    sit: Sit, tmp_path: Path
) -> None:
    base, ours, theirs = (
        {key: one[key] for key in "AB"}
        for one in (BASE, changed(("A|S0|go", "Gone")), changed(("A|S0|go", None)))
    )
    path = tmp_path / "plan.json"
    path.write_text(merge(read(base), read(ours), read(theirs)).blueprint.document.text)
    person = sit(path)
    page = at_page(person)
    before = person.blueprint
    go = card(page, "A/S0/go")
    go.buttons["ours"].setFocus()
    person.until(lambda: "errors" in page.list.preview.text())
    assert page.list.preview.text().startswith("Conflict 1. Preview: Mine. 3 errors")
    assert "R02 A/S0/go: leads to Gone" in page.list.preview.text().splitlines()[1]
    go.buttons["base"].setFocus()
    person.until(lambda: page.list.preview.text().startswith("Conflict 1. Preview: Base. 0 errors"))
    assert person.blueprint is before
    drawing = page.list.drawing
    assert drawing.targets == ("S1", "Gone"), "of the base first; what mine has is dotted"
    assert drawing.words == "Base: go, target, S0, S1"
    person.press(Qt.Key.Key_Space)
    assert person.blueprint["A"].table["S0"]["go"] == "S1"


def test_the_drawing_shows_marks_numbers_and_what_a_click_is_about(
    sit: Sit, tmp_path: Path
) -> None:
    person = sit(merged_file(tmp_path))
    page = at_page(person)
    marks = page.drawing.canvas.marks
    numbers = {str(one): number for one, number in marks.conflicts.items()}
    assert numbers == {"A/S0/go to S2": "1", "A/S0/go to S1": "1", "A/S2": "2"}
    assert marks.changes[Address("A", "S0", "go to S1")] == "T-"
    assert marks.changes[Address("A", "S0", "go to S2")] == "M~"
    page.drawing.clicked.emit(Address("A", "S2"))
    current = page.list.current
    assert current is not None
    assert current.address == "A/S2"
    person.click(page.drawing.result)
    assert page.drawing.canvas.marks.changes == {}
    assert page.drawing.picture is not None
    assert page.drawing.picture.blueprint["A"].table["S0"]["go"] == "S2"
    person.click(page.drawing.switches["theirs"])
    assert not page.drawing.result.isChecked()


def test_the_source_stands_in_three_columns(sit: Sit, tmp_path: Path) -> None:
    person = sit(merged_file(tmp_path))
    page = at_page(person)
    page.select(card(page, "A/S0/go").conflict)
    rows = page.source.columns.rows
    texts = [[one.text.strip() if one else None for one in row] for row in rows]
    assert ['"go": "S2",', None, '"go": "S1",'] in texts
    (about,) = [row for row in rows if page.source.columns.is_about(row)]
    assert about[1] is None


def test_long_runs_of_equal_lines_are_folded() -> None:
    def row(number: int, other: str = "") -> Row:
        mine = ColumnLine(number, f"line {number}")
        return mine, ColumnLine(number, other) if other else mine, mine

    rows = tuple(row(number, "changed" if number == 10 else "") for number in range(30))
    found = folded(rows, lambda _: False)
    assert found == (rows[0], 6, *rows[7:14], 15, rows[29])
    assert folded(rows[5:15], lambda _: False) == rows[5:15], "few lines are not folded"
    assert folded((), lambda _: False) == ()


def test_entries_alone_say_what_is_not_known(sit: Sit, tmp_path: Path) -> None:
    person = sit(merged_file(tmp_path))
    page = at_page(person)
    rows = [row.text for row in page.list.merged.rows.rows]
    assert rows == ["Not known: the file tells the conflicts alone"]


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A folder in which git has stopped in a merge of plan.json."""
    run = git(tmp_path)
    run("init", "-q", "-b", "main")
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(BASE, indent=1))
    run("add", ".")
    run("commit", "-qm", "base")
    run("checkout", "-qb", "other")
    path.write_text(json.dumps(THEIRS, indent=1))
    run("commit", "-qam", "theirs")
    run("checkout", "-q", "main")
    path.write_text(json.dumps(OURS, indent=1))
    run("commit", "-qam", "ours")
    run("merge", "other")
    return path


def git(folder: Path) -> Any:
    names = {"GIT_AUTHOR_NAME": "A", "GIT_AUTHOR_EMAIL": "a@b", "GIT_COMMITTER_NAME": "A",
             "GIT_COMMITTER_EMAIL": "a@b", "GIT_CONFIG_NOSYSTEM": "1"}  # fmt: skip

    def run(*arguments: str) -> None:
        subprocess.run(
            ["git", *arguments], cwd=folder, env=os.environ | names, check=False,
            capture_output=True,
        )  # fmt: skip

    return run


def test_git_still_has_the_versions_so_the_page_says_what_merged_by_itself(
    sit: Sit, repository: Path
) -> None:
    done = merge(read(BASE), read(OURS), read(THEIRS))
    repository.write_text(done.blueprint.document.text)
    person = sit(repository)
    page = at_page(person)
    person.until(lambda: len(page.list.merged.rows.rows) > 1)
    rows = [row.text for row in page.list.merged.rows.rows]
    assert rows == ["Mine, 1 change", "more", "Theirs, 1 change", "down"]
    sides = page.list.findChildren(QLabel)
    assert "1 mine, 1 theirs" in [one.text() for one in sides]
    who = page.source.columns.who
    assert [words.partition(", ")[0] for words in who[:2]] == ["A", "A"]
    assert len(who[2].partition(", ")[0]) == 9, "the commit of the base"
    drawing = page.drawing
    person.until(lambda: drawing.canvas.camera.fitted)
    assert "pale" in drawing.words
    person.click(drawing.all)
    assert not drawing.canvas.marks.dimmed
    person.click(drawing.all)
    assert drawing.canvas.marks.dimmed
    person.click_row(page.list.merged, "down")
    assert page.drawing.canvas.marks.selection == (Address("B", "X1", "down"),)
    assert page.drawing.canvas.marks.changes[Address("B", "X1", "down")] == "T+"


def test_a_rename_in_the_drawing_keeps_what_was_chosen(sit: Sit, tmp_path: Path) -> None:
    person = sit(merged_file(tmp_path))
    page = at_page(person)
    person.click(card(page, "A/S0/go").buttons["theirs"])
    from smsl_studio.blueprint import editing

    person.window.session.edit("x", lambda bp: editing.rename(bp, Address("A", "S2"), "End"))
    assert [one.conflict.address for one in page.list.cards] == ["A/S0/go", "A/End"]
    assert len(person.window.features.merge.merge.open_ones) == 1


def test_a_run_waits_until_all_are_chosen(sit: Sit, tmp_path: Path) -> None:
    person = sit(merged_file(tmp_path))
    person.press(Qt.Key.Key_F5)
    pane = person.window.features.run.pane
    assert not pane.run.exists
    assert "2 conflicts are open" in pane.canvas.canvas.overlays.banner.text


def test_hundreds_of_conflicts_show_the_first_and_count_the_rest(sit: Sit, tmp_path: Path) -> None:
    states = {f"S{n}": {"go": "S0"} for n in range(200)}
    base, ours, theirs = (
        {"A": {name: {"go": target} for name in states}} for target in ("S0", "S1", "S2")
    )
    path = tmp_path / "many.json"
    path.write_text(merge(read(base), read(ours), read(theirs)).blueprint.document.text)
    person = sit(path)
    page = at_page(person)
    assert len(page.list.cards) == MOST
    person.click(page.list.cards[0].buttons["theirs"])
    assert page.list.cards[-1].number == MOST + 1


def test_another_file_takes_the_page_away(sit: Sit, tmp_path: Path) -> None:
    person = sit(merged_file(tmp_path))
    at_page(person)
    plain = tmp_path / "plain.json"
    plain.write_text(json.dumps(BASE))
    person.window.open_path(plain)
    assert person.window.mode == "draw"
    assert not person.window.page_row.isVisible()
    assert person.window.mode_bar.run.isEnabled()


def test_everything_on_the_page_has_a_name(sit: Sit, tmp_path: Path) -> None:
    page = at_page(sit(merged_file(tmp_path)))
    for one in page.list.cards:
        for button in one.buttons.values():
            assert button.accessibleName().startswith("Take ")
            assert isinstance(button, QWidget)


def marked_file(tmp_path: Path, style: str = "--diff3") -> Path:
    path = tmp_path / "marked.json"
    path.write_text(marked(tmp_path, style, BASE, OURS, THEIRS))
    return path


def test_a_file_with_markers_says_what_it_is_and_is_merged_by_meaning(
    sit: Sit, tmp_path: Path
) -> None:
    path = marked_file(tmp_path)
    before = path.read_text()
    person = sit(path)
    window = person.window
    assert "marked.json has the conflict markers of a merge by lines" in window.toast.words
    assert window.toast.severity == "W", "a file that is no blueprint is not good news"
    page = at_page(person)
    assert not window.toast.words, "the page says the same itself"
    assert "in 3 places" in page.notice.words or "in 2 places" in page.notice.words
    person.click(page.notice.merge)
    person.until(lambda: bool(page.list.cards))
    assert {one.conflict.address for one in page.list.cards} == {"A/S0/go", "A/S2"}
    assert person.steps() == ["Merge by meaning"]
    assert window.files.edited
    assert path.read_text() == before
    rows = [row.text for row in page.list.merged.rows.rows]
    assert rows == ["Lines outside the markers: git had merged them already"]
    person.ctrl(Qt.Key.Key_Z)
    assert window.session.texts[window.session.blueprint.file] == before, "nothing is lost"
    assert page.notice.isVisible()
    person.click(page.notice.merge)
    person.until(lambda: len(window.features.merge.merge.open_ones) == 2)
    for one in list(page.list.cards):
        person.click(one.buttons["theirs"])
    person.click(page.list.save)
    assert json.loads(path.read_text())["A"]["_states"]["S2"]["title"] == "theirs"


def test_markers_without_a_base_offer_two_versions(sit: Sit, tmp_path: Path) -> None:
    person = sit(marked_file(tmp_path, ""))
    page = at_page(person)
    person.click(page.notice.merge)
    person.until(lambda: bool(page.list.cards))
    assert not card(page, "A/S0/go").buttons["base"].isEnabled()
    assert not page.drawing.switches["base"].isEnabled()
    rows = [row.text for row in page.list.merged.rows.rows]
    assert rows[0] == "No base: every difference is a conflict"


def test_markers_that_do_not_belong_together_are_told(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "odd.json"
    path.write_text("{\n<<<<<<< a\n<<<<<<< b\n}\n")
    person = sit(path)
    page = at_page(person)
    assert "Line 3" in page.notice.words
    assert not page.notice.merge.isEnabled()


def test_a_side_that_cannot_be_read_is_told_on_the_page(sit: Sit, tmp_path: Path) -> None:
    path = marked_file(tmp_path)
    path.write_text(path.read_text().replace('"title": "theirs"', '"title" "theirs"'))
    person = sit(path)
    page = at_page(person)
    person.click(page.notice.merge)
    person.until(lambda: "Theirs cannot be read" in page.notice.words)
    assert page.notice.merge.isEnabled()


def test_f1_explains_the_page_and_its_names_are_shown_as_text(sit: Sit, tmp_path: Path) -> None:
    odd = "<b>S\u202e&amp;</b>" + "x" * 80
    base = {"A": {"S0": {"go": "S0"}, odd: {"go": "S0"}}}
    ours, theirs = (
        {"A": {**base["A"], odd: {"go": target}}} for target in (odd, "<img src=x onerror=1>")
    )
    path = tmp_path / "odd.json"
    path.write_text(merge(read(base), read(ours), read(theirs)).blueprint.document.text)
    person = sit(path, (1280, 800))
    page = at_page(person)
    (one,) = page.list.cards
    one.buttons["theirs"].setFocus()
    person.until(lambda: "error" in page.list.preview.text())
    assert page.list.preview.textFormat() == Qt.TextFormat.PlainText
    assert page.width() <= 1280
    person.press(Qt.Key.Key_F1)
    person.until(lambda: bool(person.window.features.help.windows))


def test_the_next_open_conflict_follows_and_the_last_one_stays(sit: Sit, tmp_path: Path) -> None:
    person = sit(merged_file(tmp_path))
    page = at_page(person)
    first, second = page.list.cards
    person.click(second.buttons["ours"])
    assert page.list.current == first.conflict
    person.click(first.buttons["base"])
    assert page.list.current == first.conflict
    assert page.drawing.canvas.marks.conflicts[Address("A", "S2")] == "\u2713"


def test_what_was_typed_while_it_merged_is_not_replaced(sit: Sit, tmp_path: Path) -> None:
    path = marked_file(tmp_path)
    person = sit(path)
    page = at_page(person)
    session = person.window.session
    person.click(page.notice.merge)
    session.write("typed", path.read_text().replace('"mine"', '"typed"'))
    person.click(page.notice.merge)
    person.until(lambda: bool(page.list.cards))
    assert person.steps() == ["typed", "Merge by meaning"]
    assert card(page, "A/S2").conflict.ours == "typed"
