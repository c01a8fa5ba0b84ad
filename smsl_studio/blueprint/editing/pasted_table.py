"""Pasting a table: rows of state, operation and target, as spreadsheets copy them (TSV)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.additions import recount
from smsl_studio.blueprint.editing.draft import Draft, branch_of, free_name
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import EditRefused

COLUMNS = ("state", "operation", "target")
SPELLINGS = {"from": "state", "source": "state", "source state": "state", "op": "operation",
             "action": "operation", "event": "operation", "transition": "operation",
             "to": "target", "next": "target", "next state": "target",
             "target state": "target"}  # fmt: skip
LONGEST = 300_000
"""The most characters of a pasted table."""
TOLD = 3
"""So many rows with a fault are told; the number of the others follows."""
ADVICE = "The columns are state, operation, target."


class TableRow(NamedTuple):
    """One row. Operation and target are both empty in a row that only names a state."""

    number: int
    state: str
    operation: str
    target: str


@dataclass(frozen=True)
class PastedTable:
    """What a table brings to an SB.

    ``states`` are new, also those that stand only as a target; ``operations`` are new as well.
    ``known`` counts the operations that the SB has already.
    """

    states: tuple[str, ...]
    operations: tuple[TableRow, ...]
    known: int


def is_table(text: str) -> bool:
    """Return whether a text looks like a table: its first row has a tab between two cells."""
    first = next((line for line in text[:LONGEST].splitlines() if line.strip()), "")
    head, tab, rest = first.partition("\t")
    head, begin = head.strip(), first.strip()[:1]
    return bool(tab and head and rest.strip()) and begin not in "{[#/(" and head[-1] not in ":{["


def read_states(branch: StateBranch, text: str) -> PastedTable:
    """Return what a table would bring to an SB.

    The first row may name the columns. Names mean the states of the SB where it has them.
    EditRefused for a text that is no such table. It names the rows that do not fit.
    """
    faults: list[str] = []
    states: dict[str, None] = {}
    edges: dict[tuple[str, str], TableRow] = {}
    known = 0
    for row in _rows(text, faults):
        states |= dict.fromkeys(filter(None, (row.state, row.target)))
        if not row.operation:
            continue
        here = branch.table.get(row.state, {}).get(row.operation)
        before = edges.get((row.state, row.operation))
        if before is not None and before.target != row.target:
            faults.append(f"row {row.number}: {row.operation} of {row.state} leads to "
                          f"{before.target} in row {before.number}")  # fmt: skip
        elif here not in (None, row.target):
            faults.append(f"row {row.number}: {row.state} has an operation {row.operation} "
                          f"already, to {here}")  # fmt: skip
        elif here is not None:
            known += 1
        else:
            edges.setdefault((row.state, row.operation), row)
    fresh = tuple(state for state in states if state not in branch.table)
    if faults:
        rest = f"; and {len(faults) - TOLD:,} more rows" if len(faults) > TOLD else ""
        raise EditRefused(f"the table does not fit: {'; '.join(faults[:TOLD])}{rest}",
                          advice=ADVICE)  # fmt: skip
    if not (states or edges):
        raise EditRefused("there is no row to paste", advice=ADVICE)
    return PastedTable(fresh, tuple(edges.values()), known)


def paste_states(
    blueprint: Blueprint, branch: str, table_text: str
) -> tuple[Blueprint, tuple[Address, ...]]:
    """Put the states and operations of a table into an SB. Return the addresses of the new ones.

    The states of the SB keep what they have. New states get no places. EditRefused as
    ``read_states``, and if the SB has all of it already.
    """
    found = branch_of(blueprint, branch)
    table = read_states(found, table_text)
    if not (table.states or table.operations):
        raise EditRefused(f"{branch} has all states and operations of the table already",
                          advice="Nothing has to be pasted.")  # fmt: skip
    draft = Draft(blueprint)
    inner = draft.at(branch)
    for state in table.states:
        inner[state] = {}
    for row in table.operations:
        draft.at(branch, row.state)[row.operation] = row.target
    recount(draft, branch, len(table.states))
    made = [Address(branch, state) for state in table.states]
    made += [Address(branch, row.state, row.operation) for row in table.operations]
    return draft.done(), tuple(made)


def _rows(text: str, faults: list[str]) -> Iterator[TableRow]:
    """Yield the rows that can be read. The faults of the others are added to ``faults``."""
    if len(text) > LONGEST:
        raise EditRefused(f"the pasted table has more than {LONGEST:,} characters",
                          advice="Paste it in parts, or write a file.")  # fmt: skip
    lines = [(at, line.split("\t")) for at, line in enumerate(text.splitlines(), 1) if line.strip()]
    columns = list(COLUMNS)
    if lines:
        named = [SPELLINGS.get(c.strip().casefold(), c.strip().casefold()) for c in lines[0][1]]
        if "state" in named and set(named) <= {*COLUMNS, ""}:
            columns = named
            del lines[0]
    for at, cells in lines:
        texts = [_plain(cell) for cell in cells]
        found = dict(zip(columns, texts, strict=False))
        row = TableRow(at, *(found.get(column, "") for column in COLUMNS))
        fault = _fault(row, [text for text in texts[len(columns) :] if text])
        if fault:
            faults.append(f"row {at}: {fault}")
        else:
            yield row


def _fault(row: TableRow, beyond: list[str]) -> str:
    """Return what is wrong with a row; empty if nothing is."""
    if beyond:
        return f"{beyond[0][:40]!r} stands behind the last column"
    if not row.state:
        return "no state"
    if bool(row.operation) != bool(row.target):
        return "an operation without a target" if row.operation else "a target without an operation"
    try:
        for name, what in zip(row[1:], ("a state", "an operation", "a state"), strict=True):
            if name:
                free_name(name, (), what)
    except EditRefused as error:
        return error.sentence
    return ""


def _plain(cell: str) -> str:
    """Return a cell without white space around it, and without the quotes of a spreadsheet."""
    text = cell.strip()
    if len(text) > 1 and text[0] == text[-1] == '"':
        return text[1:-1].replace('""', '"')
    return text
