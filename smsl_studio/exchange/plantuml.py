"""Writes the states and operations of a blueprint as a state diagram of PlantUML."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.left_out import told_of_left_out
from smsl_studio.legible import one_line
from smsl_studio.stop import heed

_PLAIN = frozenset(" _-.,()=+")
"""Characters that mean nothing in a label, besides letters and digits."""


def as_plantuml(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as a diagram of PlantUML. Several SBs are a composite state each.

    INITIAL has the arrow from the start, ACTIVATING a bold border. A target that is no state is
    dashed. No name means anything: other characters than letters and digits are written as numbers.
    """
    told_of_left_out(blueprint, findings)
    lines = ["@startuml", "hide empty description"]
    several = len(blueprint) > 1
    first = 0
    for at, branch in enumerate(blueprint):
        indent = "  " if several else ""
        if several:
            lines.append(f'state "{_text(branch.name)}" as b{at} {{')
        lines.extend(indent + line for line in _branch(branch, first))
        first += len(branch.table) + branch.edge_count
        if several:
            lines.append("}")
    return "\n".join([*lines, "@enduml", ""])


def _branch(branch: StateBranch, first: int) -> Iterator[str]:
    ids = {state: f"s{number}" for number, state in enumerate(branch.table, first)}
    for state, known in ids.items():
        looks = " ##[bold]" if state == branch.activating else ""
        yield f'state "{_text(state)}" as {known}{looks}'
        if state == branch.initial:
            yield f"[*] --> {known}"
    for edge in branch.edges():
        heed()
        if edge.target not in ids:
            ids[edge.target] = f"s{first + len(ids)}"
            yield f'state "{_text(edge.target)}" as {ids[edge.target]} ##[dashed]'
        yield f"{ids[edge.source]} --> {ids[edge.target]} : {_text(edge.name)}"


def _text(text: str) -> str:
    return "".join(
        char if char.isalnum() or char in _PLAIN else f"<U+{ord(char):04X}>"
        for char in one_line(text)
    )
