"""What the digits in the nodes of a file mean: nobody can point at a fact on paper."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.legible import one_line
from smsl_studio.picture.words import elided, width

HEAD, BREAK = "Facts from left to right: ", "; "
MOST = 24
"""No more facts than this are explained. The row of a node has no room for more."""


def facts_key(branch: StateBranch, size: float, room: float) -> Iterator[str]:
    """Yield rows of text, none wider than ``room`` at a font size (pixels), with the names of the
    facts and the meanings of their values. There are none if nobody has named or explained a fact.
    """
    facts = range(min(branch.num_facts, MOST))
    if branch.shape.opaque or not any(map(branch.fact_note, facts)):
        return
    row = HEAD
    for digit in facts:
        last = digit == branch.num_facts - 1
        words = elided(_words(branch, digit), size, room * 0.8) + ("" if last else BREAK)
        if row.strip() and row != HEAD and width(row + words.rstrip(), size) > room:
            yield row.rstrip()
            row = ""
        row += words
    yield row.rstrip() + (f" and {branch.num_facts - MOST} more" if branch.num_facts > MOST else "")


def _words(branch: StateBranch, digit: int) -> str:
    """Return the name and the values of a fact, such as ``Door (0 shut, 1 open)``."""
    note = branch.fact_note(digit)
    values = note.values if note is not None else {}
    meant = ", ".join(f"{value} {meaning}" for value, meaning in values.items() if meaning)
    name = branch.fact_name(digit)
    return one_line(f"{name} ({meant})" if meant else name)
