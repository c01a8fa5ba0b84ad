"""When the program fails: unsaved work is kept, and the person is told where."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.files import empty_blueprint
from smsl_studio.studio.recovery import crash_hook, keep_work
from smsl_studio.studio.session import Session


def test_the_work_is_kept_as_it_is_shown(qapp: QApplication, tmp_path: Path) -> None:
    session = Session(empty_blueprint())
    session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State0"))
    kept = keep_work(session, "drawing.json", tmp_path / "home")
    assert kept is not None
    assert kept.name.startswith("drawing-")
    assert read_document(kept).text == session.blueprint.document.text


def test_a_folder_that_cannot_be_written_is_no_second_crash(
    qapp: QApplication, tmp_path: Path
) -> None:
    (tmp_path / "recovered").write_text("a file in the way")
    assert keep_work(Session(empty_blueprint()), "a.json", tmp_path) is None


def test_the_hook_says_where_the_work_is(capsys: pytest.CaptureFixture[str]) -> None:
    told: list[str] = []
    hook = crash_hook(lambda: [Path("/home/x/recovered/a.json")], told.append)
    try:
        raise ValueError("something of ours")
    except ValueError as error:
        hook(type(error), error, error.__traceback__)
    assert "/home/x/recovered/a.json" in told[0]
    assert "ValueError: something of ours" in capsys.readouterr().err


def test_an_interrupt_ends_the_program() -> None:
    hook = crash_hook(list, lambda _: None)
    with pytest.raises(SystemExit):
        hook(KeyboardInterrupt, KeyboardInterrupt(), None)


def test_windows_with_files_of_one_name_are_kept_apart(qapp: QApplication, tmp_path: Path) -> None:
    kept = {keep_work(Session(empty_blueprint()), "a" * 300 + ".json", tmp_path) for _ in range(3)}
    assert None not in kept
    assert len(kept) == 3
