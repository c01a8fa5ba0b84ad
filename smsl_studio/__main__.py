"""The program: it starts the window or the command line, and loads only this one.

Without arguments, with only files, or with ``open`` it starts the window. Any other argument starts
the command line.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import PurePath

from smsl_studio.legible import one_line
from smsl_studio.stop import let_garbage_be

SHOWN = (".json", ".smsl", ".yaml", ".yml", ".jsonl")
"""The suffixes of files that the window shows: blueprints, and logs of runs."""


def window_arguments(argv: Sequence[str]) -> list[str] | None:
    """Return the arguments of the window (files and its options), or None for the command line."""
    if argv[:1] == ["open"]:
        rest = list(argv[1:])
        return None if {"-h", "--help"} & set(rest) else rest
    return list(argv) if all(_is_file_name(part) for part in argv) else None


def main(argv: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status: 0 good, 1 the answer is no, 2 wrong usage or
    unreadable input, 130 stopped."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    wanted = window_arguments(arguments)
    if wanted is None:
        return _command_line(arguments, alone=argv is None)
    return _open_window(wanted)


def _command_line(arguments: list[str], alone: bool) -> int:
    """Run a command. ``alone`` says that this process does nothing else."""
    try:
        from smsl_studio.cli import main as command
        from smsl_studio.cli import program
    except KeyboardInterrupt:  # the command line is not loaded yet, so it cannot report the stop
        return 130
    return program(arguments) if alone else command(arguments)


def _open_window(arguments: list[str]) -> int:
    missing = _missing_display()
    if missing:
        return _no_window(missing)
    try:
        window = load_window()
    except ImportError as error:
        if (error.name or "").startswith("smsl_studio"):
            raise  # a fault of this program, not of this machine
        return _no_window(f"Qt cannot be loaded: {error}")
    return window(arguments)


def load_window() -> Callable[[Sequence[str]], int]:
    """Import the window program and return its ``main``. ImportError if Qt cannot be loaded.

    What is imported stays, so Python's collector is kept away from it, now and later. The windows
    collect by themselves (``studio/shell/sweeper.py``).
    """
    let_garbage_be()
    from smsl_studio.studio.shell.application import main as window

    gc.freeze()
    return window


def _missing_display() -> str:
    """Say why no window can be shown here. Without this check Qt would abort the process."""
    asked = ("QT_QPA_PLATFORM", "DISPLAY", "WAYLAND_DISPLAY")
    if sys.platform != "linux" or any(os.environ.get(name) for name in asked):
        return ""
    return "there is no display here (neither DISPLAY nor WAYLAND_DISPLAY is set)"


def _no_window(reason: str) -> int:
    print(one_line(f"smsl-studio: no window: {reason}."), file=sys.stderr)
    print("The command line works without one: smsl-studio --help", file=sys.stderr)
    return 2


def _is_file_name(part: str) -> bool:
    return not part.startswith("-") and PurePath(part).suffix.lower() in SHOWN


if __name__ == "__main__":
    sys.exit(main())
