"""The program: picks one of its two doors, and loads only that one.

No argument, only files, or ``open``: the window. Anything else: the command line.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import PurePath

WRITTEN_FORMS = (".json", ".smsl", ".yaml", ".yml")


def files_for_window(argv: Sequence[str]) -> list[str] | None:
    """The files the window should open with, or None where the command line is meant."""
    rest = list(argv[1:] if argv[:1] == ["open"] else argv)
    if any(part.startswith("-") for part in rest):
        return None
    if len(rest) == len(argv) and not all(_is_file_name(part) for part in rest):
        return None
    return rest


def main(argv: Sequence[str] | None = None) -> int:
    """Run the program; the exit status (0 good, 1 the answer is no, 2 cannot)."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    files = files_for_window(arguments)
    if files is None:
        from smsl_studio.cli import main as command_line

        return command_line(arguments)
    return _open_window(files)


def _open_window(files: list[str]) -> int:
    missing = _missing_display()
    if missing:
        return _no_window(missing)
    try:
        from smsl_studio.studio.app import main as window
    except ImportError as error:
        if (error.name or "").startswith("smsl_studio"):
            raise  # a fault of ours, not of this machine
        return _no_window(f"Qt cannot be loaded: {error}")
    return window(files)


def _missing_display() -> str:
    """Why no window can be shown here; Qt would abort the process without another word."""
    asked = ("QT_QPA_PLATFORM", "DISPLAY", "WAYLAND_DISPLAY")
    if sys.platform != "linux" or any(os.environ.get(name) for name in asked):
        return ""
    return "there is no display here (neither DISPLAY nor WAYLAND_DISPLAY is set)"


def _no_window(reason: str) -> int:
    print(f"smsl-studio: no window: {reason}.", file=sys.stderr)
    print("The command line works without one: smsl-studio --help", file=sys.stderr)
    return 2


def _is_file_name(part: str) -> bool:
    return PurePath(part).suffix.lower() in WRITTEN_FORMS


if __name__ == "__main__":
    sys.exit(main())
