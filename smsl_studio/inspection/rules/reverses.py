"""The rule about a missing reverse (R28): where all similar edges can be undone, but one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import partial

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import FreeNames
from smsl_studio.graph.effects import EdgeEffects, effect, effects_of
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity, edit
from smsl_studio.inspection.rules.words import fact_words, some

Digits = tuple[int, ...]

ENOUGH = 4
"""So many other edges must change the same facts and have their reverse. Fewer show no custom."""


def r28_missing_reverse(blueprint: Blueprint) -> Iterator[Remark]:
    """R28: the only edge without its reverse among the edges that change the same facts.

    Edges of failure states are left out, because nothing leads into a failure on purpose. So are
    edges into a state without operations: it is final, or R12 reports it. SBs whose states carry no
    facts (opaque SBs) are passed over.
    """
    for branch in blueprint:
        if branch.shape.opaque:
            continue
        effects = effects_of(branch)
        alone = _alone(branch, effects)
        if not alone:
            continue
        reversible = _reversible(effects)
        for digits, edges in alone.items():
            ends = {(edge.source, edge.target) for edge in edges}
            if len(ends) == 1 and reversible[digits] >= ENOUGH:
                yield _remark(branch, effects, edges, digits, reversible[digits])


def _alone(branch: StateBranch, effects: EdgeEffects) -> dict[Digits, list[Operation]]:
    """Return the edges without a reverse by the facts that they change."""
    failing, found = failing_states(branch), dict[Digits, list[Operation]]()
    for number in effects.one_way:
        edge = effects.edge(number)
        final = not branch.table[edge.target]
        if not final and edge.source not in failing and edge.target not in failing:
            found.setdefault(_digits(effects, effects.of[number]), []).append(edge)
    return found


def _reversible(effects: EdgeEffects) -> Counter[Digits]:
    """Count the edges that have their reverse, by the facts that they change."""
    kinds = Counter(effects.of)
    kinds.subtract(effects.of[number] for number in effects.one_way)
    found: Counter[Digits] = Counter()
    for kind, count in kinds.items():
        found[_digits(effects, kind)] += count
    return found


def _digits(effects: EdgeEffects, kind: int) -> Digits:
    return tuple(digit for digit, _ in effects.kinds[kind])


def _remark(
    branch: StateBranch, effects: EdgeEffects, edges: list[Operation], digits: Digits, others: int
) -> Remark:
    edge = edges[0]
    facts = some(fact_words(branch, digit) for digit in digits)
    return Remark(
        "R28",
        Severity.WARNING,
        edge.address,
        f"nothing leads back from {edge.target}, although all {others:,} other operations that "
        f"change {facts} have a reverse",
        others=[other.address for other in edges[1:]],
        remedy=partial(_reverse, branch, effects, edge),
    )


def _reverse(branch: StateBranch, effects: EdgeEffects, edge: Operation) -> tuple[str, Fix]:
    """Return the advice and the fix for an operation without a reverse.

    An operation that reverses it in other states may be in this state too. Then it leads to a wrong
    state here, and the fix corrects its target. Else the fix adds the missing operation.
    """
    there = branch.table[edge.target]
    holders = effects.holders.get(effect(branch, edge.target, edge.source), ())
    astray = next((name for name in holders if name in there), "")
    if astray:
        where = Address(branch.name, edge.target, astray)
        lead = edit("retarget", address=(where,), target=edge.source)
        words = f"{astray} of {edge.target} does this elsewhere, and leads to {there[astray]} here"
        return f"{words}; did you mean {edge.source}?", Fix(f"Lead it to {edge.source}", lead)
    known = list(holders)
    name = known[0] if known else FreeNames(branch.operation_names).take(f"{edge.name}_back")
    add = edit(
        "add_operation", branch=branch.name, state=edge.target, name=name, target=edge.source
    )
    where = Address(branch.name, edge.target, name)
    return f"add {where} if it was forgotten", Fix(f"Add {name} in {edge.target}", add)
