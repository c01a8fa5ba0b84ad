"""States in words: short names, and the choices of starts and goals."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch

Choices = list[tuple[str, str]]


def choices(blueprint: Blueprint) -> tuple[Choices, Choices]:
    """Return the choices of starts and of goals, as (words, address). The default comes first."""
    roots = [blueprint[name] for name in blueprint.roots if blueprint[name].table]
    subs = [branch for branch in blueprint if branch not in roots]
    if len(roots) == 1:
        (root,) = roots
        states = _states(root, several=len(blueprint) > 1)
        starts = _first(states, str(Address(root.name, root.initial)))
        goals = _first(states, str(Address(root.name, root.activating)))
    else:
        states = [pair for root in roots for pair in _states(root, several=True)]
        starts, goals = [("each INITIAL", ""), *states], [("each ACTIVATING", ""), *states]
    return starts, [*goals, *(pair for sub in subs for pair in _states(sub, several=True))]


def _states(branch: StateBranch, several: bool) -> Choices:
    prefix = f"{branch.name}/" if several else ""
    return [
        (prefix + short_name(branch, state), str(Address(branch.name, state)))
        for state in branch.table
    ]


def _first(states: Choices, default: str) -> Choices:
    return sorted(states, key=lambda pair: pair[1] != default)


def short_name(branch: StateBranch, state: str) -> str:
    """Return the facts of a state if its name ends with them, else its name."""
    facts = "".join(branch.facts(state)) if state in branch.table else ""
    return facts if facts and state.endswith(facts) else state
