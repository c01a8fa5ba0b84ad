"""The program: picks one of its two doors, and loads only that one.

No argument, only files, or ``open``: the window. Anything else: the command line.
"""

from __future__ import annotations

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
    from smsl_studio.studio.app import main as window

    return window(files)


def _is_file_name(part: str) -> bool:
    return PurePath(part).suffix.lower() in WRITTEN_FORMS


if __name__ == "__main__":
    sys.exit(main())
