"""The lambda notation of the paper (Eq. 2 to 5) for facts, states and operations."""

from __future__ import annotations

from smsl_studio.blueprint.address import fact_text, split_fact
from smsl_studio.blueprint.check import sub_below
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.blueprint.predicates.predicate_text import written_source
from smsl_studio.blueprint.predicates.shown import shown_predicate
from smsl_studio.errors import AddressError


def notation_of(blueprint: Blueprint, address: str) -> tuple[str, ...]:
    """Return an SB, a state, an operation or a fact (``SB/digit``) in the notation of the paper.

    Each line is one definition. Facts count from 1, as in the paper. AddressError if nothing
    stands at the address.
    """
    fact = split_fact(address)
    branch = blueprint.branches.get(fact[0]) if fact else None
    if fact is not None and branch is not None and address not in branch.table:
        if fact[1] >= branch.num_facts:
            last = (
                f"the last fact of {branch.name} is {fact_text(branch.name, branch.num_facts - 1)}"
            )
            raise AddressError(f"there is no fact {address}: {last}", advice="Count from 0.")
        return _fact(blueprint, branch, fact[1])
    found = blueprint.resolve(address)
    branch = blueprint[found.branch]
    if not found.state:
        facts = range(branch.num_facts if branch.table else 0)
        return tuple(line for digit in facts for line in _fact(blueprint, branch, digit))
    check = _state(branch, found.state)
    if not found.operation:
        return (check,)
    target = branch.table[found.state][found.operation]
    head = f"{found.operation} = λs. C_{found.state}(s) → C_{target}(s)"
    return head, check, *((_state(branch, target),) if target in branch.table else ())


def _state(branch: StateBranch, state: str) -> str:
    facts = enumerate(branch.facts(state), 1)
    terms = " ∧ ".join(f"f_{number}(s) = {value}" for number, value in facts)
    return f"C_{state} = λs. [{terms}]"


def _fact(blueprint: Blueprint, branch: StateBranch, digit: int) -> tuple[str, ...]:
    name = f"f_{digit + 1}"
    sub = sub_below(blueprint, branch, digit)
    if sub is not None:
        return (f"{name} = λs. C_{sub.activating}(s_{sub.name})",)
    sense, note = branch.notes.senses.get(digit), branch.fact_note(digit)
    if sense is not None and sense.fault is None:
        return tuple(_predicates(name, sense))
    if sense is not None:
        return (f"{name} is unknown: {sense.fault.sentence if sense.fault else ''}",)
    sensors = ", ".join(map(written_source, note.sensors)) if note and note.sensors else ""
    key = fact_text(branch.name, digit)
    return (f"{name} = λs. sense({sensors or f'the sensors of {key}'}, s)",)


def _predicates(name: str, sense: FactSense) -> list[str]:
    sources = ", ".join(written_source(one.name) for one in sense.sources)
    said = [f"{name} = λs. F(sense({sources}, s))"]
    return said + [f"F = {one.value} if {shown_predicate(one.text)}" for one in sense.predicates]
