"""The facts of an SB as a table of text (TSV), as spreadsheets copy and paste it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from typing import Any

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.editing.digits import count_of, more_facts
from smsl_studio.blueprint.editing.draft import branch_of
from smsl_studio.blueprint.editing.notes import change_notes
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import EditRefused

Json = Any

COLUMNS = ("digit", "name", "values", "on", "failure", "critical", "sensors", "max_age", "unit")
SPELLINGS = {"sensor": "sensors", "max. age": "max_age", "max age": "max_age", "age": "max_age",
             "fact": "name", "meaning": "values", "meanings": "values"}  # fmt: skip
LONGEST = 1_000_000
"""The most characters of a pasted table."""
MOST = 64
"""The most facts that one paste adds."""
YES, NO = ("yes", "true", "x", "1"), ("no", "false", "0", "-")
_PARTS = re.compile(r'\s*("(?:[^"\\]|\\.)*"|[^;]*)\s*(?:;|$)')


def table_of(branch: StateBranch) -> str:
    """Return the facts of an SB as a table with its words above the columns."""
    rows = ["\t".join(COLUMNS)]
    for digit in range(count_of(branch)):
        note = branch.fact_note(digit) or FactNote()
        values = (f"{value} = {meaning}" for value, meaning in note.values.items())
        age = "" if note.max_age is None else f"{note.max_age:g}"
        cells = (str(digit), note.name, _joined(values), note.on or "", _joined(note.failure),
                 "yes" if note.critical else "", _joined(note.sensors), age, note.unit)  # fmt: skip
        rows.append("\t".join(map(_cell, cells)))
    return "\n".join(rows) + "\n"


def read_table(branch: StateBranch, text: str) -> dict[int, dict[str, Json]]:
    """Return what a table says of each digit. Empty cells say nothing.

    The first row may name the columns. Otherwise they are those of ``table_of``, with or without
    the digit. EditRefused for a text that is no such table.
    """
    if len(text) > LONGEST:
        raise EditRefused("the pasted text is too long for a table of facts",
                          advice="Copy only the rows of the facts.")  # fmt: skip
    rows = [line.split("\t") for line in text.splitlines() if line.strip()]
    if not rows:
        raise EditRefused("there is no table to paste", advice="Copy the rows of a table first.")
    columns = [SPELLINGS.get(word, word) for word in (c.strip().casefold() for c in rows[0])]
    if "name" in columns and set(columns) <= {*COLUMNS, ""}:
        del rows[0]
    else:
        numbered = all(row[0].strip().isdecimal() for row in rows)
        columns = list(COLUMNS if numbered else COLUMNS[1:])
    found: dict[int, dict[str, Json]] = {}
    for at, row in enumerate(rows):
        cells = dict(zip(columns, map(_plain, row), strict=False))
        digit = _digit(cells.pop("digit", ""), at)
        if digit >= count_of(branch) + MOST:
            raise EditRefused(f"the pasted table has a fact {digit}, and {branch.name} has "
                              f"{count_of(branch)} facts",
                              advice=f"Paste at most {MOST} more.")  # fmt: skip
        found[digit] = {word: _read(word, cell) for word, cell in cells.items() if word and cell}
    return found


def fill_facts(blueprint: Blueprint, branch: str, fact_rows: str) -> Blueprint:
    """Fill facts from a table. Facts that the SB does not have yet are added behind the others.

    EditRefused for a text that is no table of facts.
    """
    found = branch_of(blueprint, branch)
    rows = read_table(found, fact_rows)
    missing = max(0, max(rows, default=-1) + 1 - count_of(found))
    after = more_facts(blueprint, branch, missing) if missing else blueprint
    changes: dict[tuple[str, str], Mapping[str, Json]]
    changes = {(branch, str(digit)): words for digit, words in rows.items() if words}
    return change_notes(after, "_facts", changes) if changes else after


def _digit(cell: str, at: int) -> int:
    if not cell:
        return at
    if not (cell.isascii() and cell.isdecimal() and len(cell) < 7):
        raise EditRefused(f"{cell!r} is no digit of a fact", advice="Count digits from 0.")
    return int(cell)


def _read(word: str, cell: str) -> Json:
    if word == "values":
        pairs = (entry.partition("=") for entry in _split(cell))
        return {value.strip(): meaning.strip() for value, _, meaning in pairs if value.strip()}
    if word in ("failure", "sensors"):
        return _split(cell.replace(",", ";") if ";" not in cell and '"' not in cell else cell)
    if word == "critical":
        if cell.casefold() not in YES + NO:
            raise EditRefused(f"{cell!r} does not say whether a fact is critical",
                              advice="Write yes or no.")  # fmt: skip
        return cell.casefold() in YES
    if word == "max_age":
        try:
            return float(cell.removesuffix("s").strip())
        except ValueError:
            raise EditRefused(
                f"{cell!r} is no number of seconds", advice="Write a number such as 0.5."
            ) from None
    return cell


def _joined(entries: Iterable[str]) -> str:
    """Entries with semicolons between. One that could be read as several is in quotes."""
    return "; ".join(
        json.dumps(one, ensure_ascii=False)
        if re.search(r'[;,"]', one) or one != one.strip() or not one
        else one
        for one in entries
    )


def _split(cell: str) -> list[str]:
    found = []
    for part in _PARTS.findall(cell):
        entry = _unquoted(part.strip())
        if entry or part:
            found.append(entry)
    return found


def _cell(text: str) -> str:
    """A cell in one line. It is in quotes if it holds a tab or a line end, or begins with one."""
    odd = text != text.strip() or text[:1] == '"' or len(text.splitlines()) > 1 or "\t" in text
    return json.dumps(text) if odd else text


def _plain(cell: str) -> str:
    return _unquoted(cell.strip())


def _unquoted(text: str) -> str:
    if len(text) < 2 or text[0] != '"' or text[-1] != '"':
        return text
    try:
        return str(json.loads(text))
    except ValueError:
        return text
