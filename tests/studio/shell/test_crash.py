"""If the program fails, unsaved work is kept and the person is told, with a report to be read."""

from __future__ import annotations

import sys
from datetime import datetime
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.shell.crash import crash_hook
from smsl_studio.studio.shell.crash_page import CrashPage
from smsl_studio.studio.shell.crash_report import MOST, report
from tests.stories.conftest import Sit, sit

__all__ = ["sit"]


def test_the_hook_says_that_the_work_is_kept(capsys: pytest.CaptureFixture[str]) -> None:
    told: list[str] = []
    kept = [False, True]
    for _ in range(2):
        hook = crash_hook(kept.pop, lambda sentence, _: told.append(sentence))
        try:
            raise ValueError("something of ours")
        except ValueError as error:
            hook(type(error), error, error.__traceback__)
    assert "the next start offers it" in told[0]
    assert "kept" not in told[1]
    assert "ValueError: something of ours" in capsys.readouterr().err


def test_an_interrupt_ends_the_program() -> None:
    hook = crash_hook(lambda: False, lambda *_: None)
    with pytest.raises(SystemExit):
        hook(KeyboardInterrupt, KeyboardInterrupt(), None)


WHEN = datetime(2026, 11, 25, 12, 0).astimezone()


def test_a_report_names_the_error_and_no_home_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", "/home/ada.lovelace")
    trace = 'File "/home/ada.lovelace/x.py", line 1\n/home/ada.lovelace2/y\nValueError: no'
    told = report(trace, WHEN)
    assert "What:   ValueError: no" in told
    assert "When:   2026-11-25T12:00:00" in told
    assert '"~/x.py"' in told
    assert "/home/ada.lovelace2/y" in told
    assert len(report("x" * 10 * MOST, WHEN)) < 2 * MOST


def test_a_person_reads_the_report_before_keeping_it(
    sit: Sit, qapp: QApplication, tmp_path: Path
) -> None:
    person = sit()
    window = person.window
    assert not window.actions_table["failure"].isEnabled()
    hook = crash_hook(person.windows.keep, person.windows.fail)
    try:
        raise ValueError("something of ours")
    except ValueError as error:
        hook(type(error), error, error.__traceback__)
    assert "failed: ValueError." in window.toast.words
    person.click(window.toast.button)
    (page,) = window.findChildren(CrashPage)
    assert "something of ours" in page.text.toPlainText()
    assert "sends it nowhere" in page.text.toPlainText()
    assert not list(tmp_path.iterdir()), "nothing is written before"

    page.text.setPlainText("what I want to tell")
    page.ask = lambda name: str(tmp_path / "nowhere" / name)
    page.keep.click()
    assert "was not written" in page.refusal.text()
    page.ask = lambda name: str(tmp_path / name)
    page.keep.click()
    (kept,) = tmp_path.iterdir()
    assert kept.name.startswith("smsl-studio-failure-")
    assert kept.read_text() == "what I want to tell"
    page.copy.click()
    assert qapp.clipboard().text() == "what I want to tell"
    page.leave.click()
    assert window.actions_table["failure"].isEnabled(), "the menu shows it again"
    assert sys.excepthook is not hook
