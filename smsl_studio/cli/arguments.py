"""The commands, and the arguments that several commands share."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from functools import partial
from types import MappingProxyType
from typing import IO, NoReturn

from smsl_studio.cli.output import Output
from smsl_studio.errors import UsageError
from smsl_studio.front import VERBS

MOST_DIGITS = 100
"""The largest number of digits of a seed."""


_NARROW = partial(argparse.HelpFormatter, width=80)
"""The formatter with which ``argparse`` checks added arguments. It shows nothing, so a fixed width
is enough, and ``shutil`` need not be loaded for the width of the terminal."""


COMMANDS: Mapping[str, str] = MappingProxyType(
    {
        "open": "open the window, on files if any are named",
        **{name: verb.words for name, verb in VERBS.items()},
    }
)
"""Every command with its description in one line. The module ``cli/<command>.py`` has the rest."""


class ArgumentParser(argparse.ArgumentParser):
    """The parser of one command. Wrong usage raises UsageError. Help goes to the output of data."""

    def __init__(self, name: str, out: Output) -> None:
        super().__init__(
            prog=f"smsl-studio {name}",
            description=_sentence(name),
            allow_abbrev=False,
            formatter_class=_NARROW,
        )
        self._out = out

    def error(self, message: str) -> NoReturn:
        """Raise UsageError for wrong arguments. ``argparse`` itself would end the process."""
        raise UsageError(message, advice=f"{self.prog} --help says what it takes.")

    def format_help(self) -> str:
        """Return the help in the width of the terminal."""
        self.formatter_class = argparse.HelpFormatter
        return super().format_help()

    def print_help(self, file: IO[str] | None = None) -> None:  # type: ignore[override]
        """Print the help to standard output. ``file`` is ignored."""
        self._out.line(self.format_help().rstrip())


def add_format(parser: ArgumentParser, *more: str) -> None:
    """Add ``--format text|json``, and ``more`` forms that only this command has."""
    forms = ("text", "json", *more)
    words = ", ".join(("text for people (default)", *forms[1:]))
    parser.add_argument("--format", choices=forms, default="text", help=words)


def add_limit(parser: ArgumentParser, words: str) -> None:
    """Add ``--limit N``, a whole number from 1 up. None is its default."""
    parser.add_argument("--limit", type=_limit, default=None, metavar="N", help=words)


def add_effort(parser: ArgumentParser) -> None:
    """Add ``--seconds S`` and ``--memory MB``, which limit time and memory.

    The default is no limit.
    """
    parser.add_argument(
        "--seconds", type=_seconds, default=None, metavar="S", help="look for at most S seconds"
    )
    parser.add_argument(
        "--memory", type=_limit, default=None, metavar="MB", help="take at most MB of memory"
    )


def add_world(parser: ArgumentParser, required: bool) -> None:
    """Add ``--world NAME``."""
    parser.add_argument(
        "--world",
        metavar="NAME",
        required=required,
        help="where it runs; 'table' runs any blueprint without physics (see: worlds)",
    )


def add_robot(parser: ArgumentParser) -> None:
    """Add ``--robot NAME``."""
    parser.add_argument(
        "--robot",
        default="",
        metavar="NAME",
        help="the robot, where a world has several (see: worlds); the first of them is the usual "
        "one",
    )


def add_several(parser: ArgumentParser, name: str, what: str, words: str) -> None:
    """Add an option that may be repeated."""
    parser.add_argument(
        name, action="append", default=[], metavar=what, help=f"{words}; may be repeated"
    )


def add_places(parser: ArgumentParser) -> None:
    """Add ``--goal`` and ``--start``, each of which may be repeated."""
    words = "where to go; one an SB (default: ACTIVATING of roots)"
    add_several(parser, "--goal", "SB/State", words)
    add_several(parser, "--start", "SB/State", "where to begin; one an SB (default: INITIAL)")


def add_supervisor(parser: ArgumentParser) -> None:
    """Add ``--supervisor NAME``, which may be repeated."""
    add_several(
        parser,
        "--supervisor",
        "NAME[:KEY=VALUE,...]",
        "an automatic supervisor: limit, rules, familiar, forecast, or one of a plugin; the most "
        "careful answer counts",
    )


def add_seed_and_host(parser: ArgumentParser) -> None:
    """Add ``--seed N`` and ``--host local|process``."""
    parser.add_argument(
        "--seed",
        type=_seed,
        default=0,
        metavar="N",
        help="draws the jitter of the world (default 0)",
    )
    parser.add_argument(
        "--host",
        choices=("local", "process"),
        help="run the world in this process, or in a child of it that may die without taking the "
        "run along (default: local for the world table, process for those of plugins)",
    )


def host_of(options: argparse.Namespace) -> str:
    """Return the host of a run: the named one, else a child process for worlds of plugins."""
    from smsl_studio.world.engines import REMOTE, TABLE

    chosen: str | None = options.host
    return chosen or ("local" if options.world in (TABLE, REMOTE) else "process")


def _limit(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < len(text) < 13 and int(text)):
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 1 up")
    return int(text)


def _seconds(text: str) -> float:
    whole, _, rest = text.partition(".")
    if not (text.isascii() and len(text) < 13 and (whole + rest).isdecimal() and float(text) > 0):
        raise argparse.ArgumentTypeError(f"{text!r} is no number of seconds above 0")
    return float(text)


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and len(text) <= MOST_DIGITS):
        raise argparse.ArgumentTypeError(
            f"invalid int value: {text!r} is no whole number from 0 up"
        )
    return int(text)


def overview() -> str:
    """Return the help of the program."""
    width = max(map(len, COMMANDS))
    lines = [f"  {name:<{width}}  {words}" for name, words in COMMANDS.items()]
    return "\n".join(
        [
            "usage: smsl-studio [FILE...]",
            "       smsl-studio COMMAND [--help] ...",
            "",
            "Draw, inspect and run blueprints of medical and robotic procedures.",
            "Without a command the window opens.",
            "",
            "commands:",
            *lines,
            "",
            "options:",
            "  -h, --help     show this",
            "  -V, --version  show the version",
            "",
            "Exit status: 0 good, 1 the answer is no, 2 wrong usage or unreadable input.",
        ]
    )


def _sentence(name: str) -> str:
    words = COMMANDS[name]
    return f"{words[:1].upper()}{words[1:]}."


def add_picture(parser: ArgumentParser, required: bool) -> None:
    """Add ``-o OUT.svg|.png|.pdf``."""
    parser.add_argument(
        "-o",
        "--output",
        required=required,
        metavar="OUT",
        help="the picture to write: .svg, .png or .pdf",
    )
