"""Writes a blueprint as a table in CSV: a row for each operation."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.left_out import told_of_left_out
from smsl_studio.stop import heed

COLUMNS = ("sb", "state", "operation", "target", "facts", "initial", "activating", "cost", "risk",
           "actor", "requires", "title")  # fmt: skip
_FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""What a cell must not begin with, because programs for tables would compute it."""


def as_csv(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as CSV (RFC 4180). A state without operations has one row without.

    A text that a program for tables would compute has a ``'`` before it, and a finding says so.
    """
    told_of_left_out(blueprint, findings, (), "cost, risk, actor, title and what is required")
    made = io.StringIO()
    table = csv.writer(made)
    table.writerow(COLUMNS)
    for branch in blueprint:
        for row in _rows(branch):
            heed()
            table.writerow([_cell(text, findings) for text in row])
    return made.getvalue()


def _rows(branch: StateBranch) -> Iterator[tuple[str, ...]]:
    for state, operations in branch.table.items():
        facts = " ".join(branch.facts(state))
        ends = tuple("yes" if state == one else "" for one in (branch.initial, branch.activating))
        if not operations:
            yield (branch.name, state, "", "", facts, *ends, "", "", "", "", "")
        for name, target in operations.items():
            note = branch.operation_note(state, name)
            requires = "; ".join(f"{key} = {value}" for key, value in note.requires.items())
            cost = f"{branch.cost(state, name):g}"
            said = (cost, note.risk or "", note.actor or "", requires, note.title)
            yield (branch.name, state, name, target, facts, *ends, *said)


def _cell(text: str, findings: ExchangeFindings) -> str:
    if text.startswith(_FORMULA):
        words = f"A program for tables would compute {text[:80]!r}, so a ' stands before it."
        findings.add("formula", "", words)
        return f"'{text}"
    return text
