"""The tip for a name in the text: the facts of a state, the target and cost of an operation."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.base.words import counted


def words(blueprint: Blueprint, address: Address) -> str:
    """What an element is, in a few lines; empty if its SB does not exist."""
    branch = blueprint.branches.get(address.branch)
    if branch is None:
        return ""
    if not address.state:
        return _branch(branch)
    if address.state not in branch.table:
        return f"{address.branch} has no state {address.state}"
    return _operation(branch, address) if address.operation else _state(branch, address.state)


def _branch(branch: StateBranch) -> str:
    size = f"{counted(len(branch.table), 'state')}, {counted(branch.edge_count, 'operation')}"
    ends = f"From {branch.initial} to {branch.activating}" if branch.table else ""
    return "\n".join(part for part in (f"{branch.name}: {size}", ends) if part)


def _state(branch: StateBranch, name: str) -> str:
    note = branch.state_note(name)
    title = f"{name}: {note.title}" if note and note.title else name
    facts = (_fact(branch, digit, value) for digit, value in enumerate(branch.facts(name)))
    said = [title, ", ".join(facts), note.note if note else ""]
    said += [word for word, one in (("Initial", branch.initial), ("Activating", branch.activating))
             if one == name]  # fmt: skip
    return "\n".join(part for part in said if part)


def _fact(branch: StateBranch, digit: int, value: str) -> str:
    note = branch.fact_note(digit)
    meaning = note.values.get(value, "") if note else ""
    return f"{branch.fact_name(digit)} {value}" + (f" ({meaning})" if meaning else "")


def _operation(branch: StateBranch, address: Address) -> str:
    target = branch.table[address.state].get(address.operation)
    if target is None:
        return f"{address.state} has no operation {address.operation}"
    title = branch.operation_note(address.state, address.operation).title
    cost = branch.cost(address.state, address.operation)
    name = f"{address.operation}: {title}" if title else address.operation
    return f"{name}\n{address.state} to {target}, cost {cost:g}"
