"""If the program fails, unsaved work is kept and the person is told."""

from __future__ import annotations

import pytest

from smsl_studio.studio.shell.crash import crash_hook


def test_the_hook_says_that_the_work_is_kept(capsys: pytest.CaptureFixture[str]) -> None:
    told: list[str] = []
    kept = [False, True]
    for _ in range(2):
        hook = crash_hook(kept.pop, told.append)
        try:
            raise ValueError("something of ours")
        except ValueError as error:
            hook(type(error), error, error.__traceback__)
    assert "the next start offers it" in told[0]
    assert "kept" not in told[1]
    assert "ValueError: something of ours" in capsys.readouterr().err


def test_an_interrupt_ends_the_program() -> None:
    hook = crash_hook(lambda: False, lambda _: None)
    with pytest.raises(SystemExit):
        hook(KeyboardInterrupt, KeyboardInterrupt(), None)
