"""The program decides between command line and window before it loads either."""

from __future__ import annotations

import pytest

from smsl_studio.__main__ import main, window_arguments


@pytest.mark.parametrize(
    ("argv", "wanted"),
    [
        ([], []),
        (["open"], []),
        (["a.json"], ["a.json"]),
        (["a.json", "dir/b.SMSL"], ["a.json", "dir/b.SMSL"]),
        (["run.jsonl"], ["run.jsonl"]),
        (["open", "check"], ["check"]),
        (["open", "a"], ["a"]),
        (["open", "--mode", "run", "a.json"], ["--mode", "run", "a.json"]),
    ],
)
def test_the_window(argv: list[str], wanted: list[str]) -> None:
    assert window_arguments(argv) == wanted


@pytest.mark.parametrize(
    "argv",
    [
        ["check", "a.json"],
        ["--help"],
        ["--version"],
        ["open", "--help"],
        ["chekc"],
        ["-"],
        ["--x.json"],
    ],
)
def test_the_command_line(argv: list[str]) -> None:
    assert window_arguments(argv) is None


def test_without_a_display_the_program_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("QT_QPA_PLATFORM", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    assert main(["open"]) == 2
    assert "there is no display here" in capsys.readouterr().err
