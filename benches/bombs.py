"""Blueprints with far too many of one thing, in each written form, for every command and the
window.

Each of the 40 bombs of ``tests/bombs`` is made at 1 MB in JSON, YAML and native SMSL. The real
program gets each file with each command. A call is reported if it takes more than 2 CPU seconds or
600 MB of address space for each MB of file (at least one MB), or more than 15 s or 1.5 GB. For the
window, the 2 s and 600 MB come on top of what an empty window takes (about 1.5 s and 490 MB; on a
slow machine 4 s). A last row scales the result to the machine on which the promise was made, by a
measure of speed. A command that reads two files is measured by both.

``--size=8`` takes files of 8 MB; ``--bombs=sub_chain,trap``, ``--forms=json`` and
``--commands=run,window`` choose. Address space is read from Linux.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from benches.blasts.measured import SECONDS, SPACE, Measured, measured
from benches.row import Row
from tests.bombs.spelling import FORMS
from tests.bombs.table import BY_NAME
from tests.cli.calls import calls

BOMBS = (
    *("small_sbs", "paired_sbs", "careful_sbs", "states_in_a_ring", "unreachable_tree", "trap"),
    *("operations_of_one_state", "operations_to_all", "parallel_operations", "dangling"),
    *("alike_states", "expanding_names", "long_states", "long_operations", "long_sbs"),
    *("many_facts", "mislabelled", "conditional", "known_subs", "unknown_subs", "near_subs"),
    *("repeated_subs", "sub_chain", "sub_cycle", "sub_cycles", "sub_diamonds", "shared_sub"),
    *("header_keys", "header_keys_each", "true_notes", "odd_notes", "requirements_of_all"),
    *("hazards", "levels", "unknown_fields", "deep_values", "strange_text", "nested_maps"),
    *("doubled_everywhere", "lost_quotes"),
)
MB = 1_000_000
COMMANDS = {
    **{name: " ".join(words) for name, words in calls().items()},
    "convert": "convert FILE -o FORM",
    "route": "route FILE --sb SB --from FROM --to TO",
    "run": "run FILE --world table --log OUT.jsonl",
    "replay": "replay OUT.jsonl",
    "window": "window FILE",
}
"""Every command as the tests call it. A replay reads what the run before it has written."""
NEXT = dict(zip(FORMS, (*FORMS[1:], FORMS[0]), strict=True))
"""The form to which a file of each form is converted."""
EMPTY = 1.5
"""The CPU time (s) of an empty window on the machine on which the promise was made."""

AT_A_TIME = 2
"""The number of processes at a time. CPU time is measured, so they may run side by side."""


class Taken(NamedTuple):
    """The time and space that one command took on one bomb."""

    bomb: str
    form: str
    command: str
    megabytes: float
    took: Measured

    @property
    def wrong(self) -> str:
        """Say what is beyond the promise. The text is empty if nothing is."""
        if self.took.wrong:
            return self.took.wrong
        if self.seconds > 2 or self.took.seconds > SECONDS:
            return f"{self.seconds:.2f} CPU s a MB, {self.took.seconds:.2f} s in all"
        if self.space > 600 or self.took.space > SPACE:
            return f"{self.space:,.0f} MB a MB, {self.took.space / MB:,.0f} MB in all"
        return ""

    def is_beyond(self, pace: float) -> bool:
        """Whether it is beyond the promise on a machine that is ``pace`` times as fast."""
        late = self.seconds / pace > 2 or self.took.seconds / pace > SECONDS
        return bool(self.took.wrong) or late or self.space > 600 or self.took.space > SPACE

    @property
    def seconds(self) -> float:
        """CPU seconds for each MB of the file."""
        return (self.took.seconds - self.took.begun[0]) / max(self.megabytes, 1.0)

    @property
    def space(self) -> float:
        """MB of address space for each MB of the file."""
        return (self.took.space - self.took.begun[1]) / MB / max(self.megabytes, 1.0)


def rows() -> Iterator[Row]:
    """Yield two rows for each command (worst time, worst space), and one row for all excesses."""
    bombs, forms = _option("bombs", BOMBS), _option("forms", FORMS)
    commands, size = _option("commands", COMMANDS), float(_option("size", ("1",))[0])
    pairs = [(bomb, form) for bomb in bombs for form in forms if form in BY_NAME[bomb].forms]
    with ThreadPoolExecutor(AT_A_TIME) as pool:
        found = pool.map(lambda pair: list(_blasts(pair[0], pair[1], size, commands)), pairs)
        taken = []
        for one in (one for several in found for one in several):
            taken.append(one)
            if one.wrong:
                print(one.bomb, one.form, one.command, one.wrong, file=sys.stderr, flush=True)
    for command in commands:
        mine = [one for one in taken if one.command == command]
        words = f"{command}, {len(mine)} files of {size:g} MB, for each MB: the worst"
        slow, wide = max(mine, key=lambda one: one.seconds), max(mine, key=lambda one: one.space)
        typical = median(one.seconds for one in mine), median(one.space for one in mine)
        yield Row(
            f"{words} ({slow.bomb}, {slow.form})",
            slow.seconds,
            "CPU s",
            (("median", typical[0]), *_empty(mine)),
            "at most 2",
        )
        yield Row(
            f"{words} ({wide.bomb}, {wide.form})",
            wide.space,
            "MB",
            (("median", typical[1]),),
            "at most 600",
        )
    beyond = sum(bool(one.wrong) for one in taken)
    yield Row(f"{len(taken)} commands on bombs: beyond the promise", beyond, "", (), "0")
    empty = _empty([one for one in taken if one.command == "window"])
    if empty:
        pace = empty[0][1] / EMPTY
        scaled = sum(one.is_beyond(pace) for one in taken)
        yield Row(
            f"the same, in seconds of a machine on which an empty window takes {EMPTY} CPU s",
            scaled,
            "",
            (("this machine is slower by", pace),),
            "0",
        )


def _empty(taken: list[Taken]) -> tuple[tuple[str, float], ...]:
    """Return the cost of the window before it reads a file. It shows the speed of the machine."""
    begun = [one.took.begun[0] for one in taken]
    return (("empty window", median(begun)),) if begun and all(begun) else ()


def _blasts(name: str, form: str, size: float, commands: tuple[str, ...]) -> Iterator[Taken]:
    """Run every command on one bomb in one form."""
    bomb = BY_NAME[name]
    with TemporaryDirectory() as made:
        folder = Path(made)
        for file, share in (("bomb", 1.0), ("other", 0.9)):
            text = bomb.sized(form, int(size * share * MB))
            (folder / f"{file}.{form}").write_bytes(text.encode("utf-8", "surrogatepass"))
        sizes = {
            file: (folder / f"{file}.{form}").stat().st_size / MB for file in ("bomb", "other")
        }
        at = _state(name)
        words = {"FILE": f"bomb.{form}", "OTHER": f"other.{form}", "OUT": f"out-{form}"}
        words |= {"FORM": f"form.{NEXT[form]}", "SB": at[0], "FROM": at[1], "TO": at[2]}
        for command in commands:
            arguments = [_put(part, words) for part in COMMANDS[command].split()]
            more = {"SMSL_STUDIO_HOME": str(folder / "home"), "PYTHONPATH": str(Path.cwd())}
            took = measured(["benches.blasts.program", *arguments], folder, more)
            read = sizes["bomb"] + (sizes["other"] if "OTHER" in COMMANDS[command] else 0.0)
            yield Taken(name, form, command, read, took)


def _put(part: str, words: dict[str, str]) -> str:
    stem, dot, suffix = part.partition(".")
    return words.get(stem, stem) + dot + suffix


def _state(name: str) -> tuple[str, str, str]:
    """Return an SB with states, and its first and last state."""
    values = _values(name)
    for branch, table in values.items():
        if isinstance(table, dict) and not branch.startswith("_"):
            states = [key for key in table if key != "HEADER" and not key.startswith("_")]
            if states:
                return branch, states[0], states[-1]
    return "B", "S", "T"


def _values(name: str) -> dict[str, Any]:
    from tests.bombs import shapes

    make = getattr(shapes, name, None)
    found: dict[str, Any] = make(50) if make is not None else {}
    return found


def _option(name: str, otherwise: Iterable[str]) -> tuple[str, ...]:
    given = [one.partition("=")[2] for one in sys.argv if one.startswith(f"--{name}=")]
    return tuple(given[-1].split(",")) if given else tuple(otherwise)
