"""Edits that add a whole pattern: a recovery, more tries of an operation, a sub-SB."""

from __future__ import annotations

from string import ascii_lowercase
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.editing.additions import add_branch, add_operation, add_state
from smsl_studio.blueprint.editing.draft import Draft, branch_of, existing
from smsl_studio.blueprint.editing.headers import attach_sub, set_header
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import FreeNames, fresh_branch_name, name_with_facts
from smsl_studio.errors import EditRefused

Json = Any
Made = tuple[Blueprint, tuple[Address, ...]]
"""The blueprint after an edit, and the addresses of what was added."""
TRIES = 2
"""So many further tries an operation gets."""


def add_recovery(
    blueprint: Blueprint, address: Address, at: tuple[float, float] | None = None
) -> Made:
    """Add a failure state of a state, and an operation that leads back.

    The failure state has the facts of the state, but for one that has a failure value. The value is
    declared in ``_facts`` if it is not yet. EditRefused if ``address`` is no state, or if all facts
    have a sub-SB.
    """
    branch, state = _state_of(blueprint, address)
    digit, value, name = _failure(branch, state)
    after = add_state(blueprint, branch.name, name, at)
    operation = FreeNames(branch.operation_names).take(f"{_prefix(branch)}Recover")
    after = add_operation(after, branch.name, name, operation, state)
    draft = Draft(after)
    if branch.shape.width == 0 and not branch.shape.opaque:
        facts = list(branch.facts(state))
        facts[digit] = value
        draft.table(branch.name, "_states")[name] = {"facts": facts}
    _declare_failure(draft, branch, digit, value)
    made = Address(branch.name, name), Address(branch.name, name, operation)
    return draft.done(), made


def add_tries(blueprint: Blueprint, address: Address) -> Made:
    """Add parallel operations, each at a higher cost, with the annotations of this one.

    After a failure the route goes on to the next of them, and after the last the run holds.
    EditRefused if ``address`` is no operation or leads back to its own state.
    """
    edge = existing(blueprint, address)
    branch = branch_of(blueprint, edge.branch)
    if not edge.operation:
        raise EditRefused(f"{address} is no operation", advice="Choose the operation to try again.")
    target = branch.table[edge.state][edge.operation]
    if target == edge.state:
        raise EditRefused(
            f"{edge.operation} leads back to {edge.state}, so it can be tried again anyway",
            advice="Choose an operation that leads to another state.",
        )
    names = FreeNames(branch.operation_names)
    added = [names.take(f"{edge.operation}_try{n}") for n in range(2, TRIES + 2)]
    note, cost = _written_note(branch, edge), branch.cost(edge.state, edge.operation)
    after = blueprint
    for name in added:
        after = add_operation(after, branch.name, edge.state, name, target)
    draft = Draft(after)
    table = draft.table(branch.name, "_operations")
    own = note_key(edge.operation, edge.state)
    if branch.operation_note(edge.state, edge.operation).cost is None:
        table[own] = {**_entry(table, own), "cost": 1}
    title = note.get("title") or edge.operation
    for number, name in enumerate(added, start=2):
        words = {**note, "title": f"{title}, try {number}", "cost": _whole(cost + number - 1)}
        table[note_key(name, edge.state)] = words
    return draft.done(), tuple(Address(branch.name, edge.state, name) for name in added)


def expand_fact(blueprint: Blueprint, base: str, digit: int) -> Made:
    """Let a new SB of two states expand a fact: an operation leads from INITIAL to ACTIVATING, and
    one leads back. EditRefused as for ``attach_sub``.
    """
    name = fresh_branch_name(blueprint)
    after = add_branch(blueprint, name, blueprint.home(branch_of(blueprint, base).name).file)
    for number in (0, 1):
        after = add_state(after, name, f"State{number}")
    for number in (0, 1):
        after = add_operation(
            after, name, f"State{number}", f"Operation{number}", f"State{1 - number}"
        )
    after = set_header(after, name, "INITIAL", "State0")
    after = set_header(after, name, "ACTIVATING", "State1")
    after = set_header(after, name, "NUM_FACTS", 1)
    after = attach_sub(after, base, digit, name)
    return after, (Address(name, "State0"), Address(name, "State1"))


def free_digit(branch: StateBranch) -> int:
    """The first fact that a sub-SB can expand; -1 if there is none."""
    for digit, values in enumerate(branch.alphabet):
        note = branch.fact_note(digit)
        if digit not in branch.subs and len(values) <= 2 and not (note and note.sensors):
            return digit
    return -1


def _state_of(blueprint: Blueprint, address: Address) -> tuple[StateBranch, str]:
    found = existing(blueprint, address)
    if not found.state or found.operation:
        raise EditRefused(f"{address} is no state", advice="Choose a state.")
    return branch_of(blueprint, found.branch), found.state


def _failure(branch: StateBranch, state: str) -> tuple[int, str, str]:
    """The digit, its failure value and the name of the failure state of a state."""
    shape, facts = branch.shape, branch.facts(state)
    if shape.opaque:
        name = FreeNames({*branch.table, *branch.fields}).take(f"{state}_failed")
        return 0, name, name
    free = [digit for digit in reversed(range(len(facts))) if digit not in branch.subs]
    wanted = [(d, v) for d in free for v in _declared(branch, d) if v != facts[d]]
    wanted += [(d, v) for d in free[:1] for v in _unused(branch, d)]
    others = {branch.facts(name) for name in branch.table}
    for digit, value in wanted:
        values = (*facts[:digit], value, *facts[digit + 1 :])
        name = _named(branch, state, values)
        if values not in others and name not in branch.table:
            return digit, value, name
    raise EditRefused(
        f"no fact of {state} can have a failure value",
        advice="Add a fact that has no sub-SB." if not free else "Add a fact first.",
    )


def _declared(branch: StateBranch, digit: int) -> tuple[str, ...]:
    note = branch.fact_note(digit)
    return note.failure if note is not None else ()


def _unused(branch: StateBranch, digit: int) -> list[str]:
    wide = max(branch.shape.width, 1)
    letters = (letter * wide for letter in f"xfe{ascii_lowercase}")
    return [value for value in letters if value not in branch.alphabet[digit]]


def _named(branch: StateBranch, state: str, values: tuple[str, ...]) -> str:
    if branch.shape.width == 0:
        return FreeNames({*branch.table, *branch.fields}).take(f"{state}_failed")
    return name_with_facts(branch, state, values)


def _declare_failure(draft: Draft, branch: StateBranch, digit: int, value: str) -> None:
    """Write the failure value into ``_facts``. What is on stays on."""
    note = branch.fact_note(digit)
    if value in _declared(branch, digit):
        return
    table = draft.table(branch.name, "_facts")
    entry = _entry(table, str(digit))
    entry["values"] = {**_entry(entry, "values"), value: "failed"}
    if (note is None or note.on is None) and not branch.shape.opaque:
        entry["on"] = branch.on_value(digit)
    entry["failure"] = [*_declared(branch, digit), value]
    table[str(digit)] = entry


def _written_note(branch: StateBranch, edge: Address) -> dict[str, Json]:
    """The annotations of an edge as they are written, those of its own over those of its name."""
    table = _map(branch.fields.get("_operations"))
    keys = note_key(edge.operation), note_key(edge.operation, edge.state)
    return {word: value for key in keys for word, value in _map(table.get(key)).items()}


def _prefix(branch: StateBranch) -> str:
    names = branch.operation_names
    return "Op_" if names and all(name.startswith("Op_") for name in names) else ""


def _entry(table: dict[str, Json], key: str) -> dict[str, Json]:
    """A copy of a map in a table, empty if there is none. EditRefused if it is no map."""
    found = table.get(key, {})
    if not isinstance(found, dict):
        raise EditRefused(
            f"{key} is no map, so nothing can be added to it",
            advice="Write it as { ... } in the text.",
        )
    return dict(found)


def _whole(number: float) -> float:
    return int(number) if number == int(number) else number


def _map(value: Json) -> dict[str, Json]:
    return dict(value) if isinstance(value, dict) else {}
