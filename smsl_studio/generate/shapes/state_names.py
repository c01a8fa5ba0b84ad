"""Chooses names for the states of an SB whose facts have changed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from smsl_studio.blueprint.facts import fact_string, shape_of
from smsl_studio.blueprint.model import StateBranch

Values = tuple[str, ...]


def named_by_facts(
    states: Iterable[str], facts: Mapping[str, Values], branch: StateBranch
) -> dict[str, str]:
    """Return a name for each state in ``facts``.

    If the old names show facts, the new names show the new facts. Else the names stay. ``states``
    are states of the SB. A state that the SB does not have yet is named like the first of them.
    """
    kept = {state: state for state in facts}
    if branch.shape.width != 1 or branch.shape.opaque:
        return kept
    named = {}
    for state in facts:
        of = state if state in branch.table else next(iter(states))
        text = fact_string(of, branch.shape.written)
        named[state] = of[: len(of) - len(text)] + "".join(facts[state])
    shape = shape_of(named.values(), written_count(branch, facts))
    fits = not shape.opaque and all(shape.values(named[s]) == facts[s] for s in facts)
    return named if fits and len(set(named.values())) == len(named) else kept


def written_count(branch: StateBranch, facts: Mapping[str, Values]) -> int | None:
    """Return the new NUM_FACTS, or None if the SB was written without it."""
    return None if branch.header.num_facts is None else len(next(iter(facts.values())))


def free_name_beside(name: str, taken: Iterable[str]) -> str:
    """Return ``name``, or with a number behind it if ``taken`` has it already."""
    found, number = name, 1
    while found in set(taken):
        number += 1
        found = f"{name}_{number}"
    return found
