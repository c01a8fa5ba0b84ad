"""Which of its two doors the program opens, before it loads either."""

from __future__ import annotations

import pytest

from smsl_studio.__main__ import files_for_window


@pytest.mark.parametrize(
    ("argv", "files"),
    [
        ([], []),
        (["open"], []),
        (["a.json"], ["a.json"]),
        (["a.json", "dir/b.SMSL"], ["a.json", "dir/b.SMSL"]),
        (["open", "check"], ["check"]),
        (["open", "a"], ["a"]),
    ],
)
def test_the_window(argv: list[str], files: list[str]) -> None:
    assert files_for_window(argv) == files


@pytest.mark.parametrize(
    "argv",
    [["check", "a.json"], ["--help"], ["--version"], ["open", "--help"], ["chekc"], ["-"]],
)
def test_the_command_line(argv: list[str]) -> None:
    assert files_for_window(argv) is None
