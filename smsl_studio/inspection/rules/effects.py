"""Rules about what operations do to facts, seen over all edges of one name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.editing import rename, set_note
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.inspection.finding import Finding, Fix, Severity
from smsl_studio.inspection.rules.wording import counted, fact_words, listed, some

ERROR, NOTE = Severity.ERROR, Severity.NOTE
Facts = tuple[str, ...]
Effect = tuple[tuple[int, str], ...]
"""(digit, new value) for each digit an edge changes."""


@dataclass(frozen=True, slots=True)
class Mislabelled:
    """An edge whose effect is the majority effect of other operations, absent from its state."""

    edge: Operation
    effect: Effect
    others: tuple[str, ...]


def mislabelled(branch: StateBranch) -> tuple[Mislabelled, ...]:
    """The edges of an SB that bear another operation's name.

    The effect of an edge is the set of (digit, new value) for the digits it changes; the majority
    effect of an operation is the one held by more than half of its edges, else none. An edge is
    mislabelled if its effect is not empty, its operation has another majority effect, and some
    operation absent from its source state has exactly this effect as its majority.
    """
    facts = {state: branch.facts(state) for state in branch.table}
    effects: dict[str, list[tuple[Operation, Effect]]] = {}
    for edge in branch.edges():
        if edge.target in facts:
            effect = _effect(facts[edge.source], facts[edge.target])
            effects.setdefault(edge.name, []).append((edge, effect))
    majority = {name: _majority([effect for _, effect in own]) for name, own in effects.items()}
    holders: dict[Effect, list[str]] = {}
    for name, most in majority.items():
        if most:
            holders.setdefault(most, []).append(name)
    found = [
        Mislabelled(edge, effect, others)
        for name, own in effects.items()
        for edge, effect in own
        if effect
        and majority[name] is not None
        and effect != majority[name]
        and (others := _absent(holders.get(effect, []), branch, edge.source))
    ]
    order = {state: number for number, state in enumerate(branch.table)}
    return tuple(sorted(found, key=lambda slip: order[slip.edge.source]))


def _effect(before: tuple[str, ...], after: tuple[str, ...]) -> Effect:
    if before == after:
        return ()
    pairs = enumerate(zip(before, after, strict=True))
    return tuple((digit, new) for digit, (old, new) in pairs if old != new)


def _majority(effects: list[Effect]) -> Effect | None:
    effect, count = Counter(effects).most_common(1)[0]
    return effect if 2 * count > len(effects) else None


def _absent(names: list[str], branch: StateBranch, state: str) -> tuple[str, ...]:
    return tuple(name for name in names if name not in branch.table[state])


def r15_mislabelled(blueprint: Blueprint) -> Iterator[Finding]:
    """A mislabelled operation, and which one was meant."""
    for branch in blueprint:
        for slip in mislabelled(branch):
            meant = slip.others[0]
            yield Finding.at(
                blueprint,
                "R15",
                ERROR,
                slip.edge.address,
                f"moves {_moves(branch, slip.effect)}",
                advice=f"did you mean {listed(slip.others, 'or')}?",
                fix=Fix(
                    f"Rename to {meant}",
                    partial(rename, address=slip.edge.address, new_name=meant),
                ),
            )


def _moves(branch: StateBranch, effect: Effect) -> str:
    return listed(f"{fact_words(branch, digit)} to {value}" for digit, value in effect)


def r16_conditional(blueprint: Blueprint) -> Iterator[Finding]:
    """A conditional effect: an operation whose effect on a fact differs between its edges.

    Setting a fact to a value it has already is no difference. Opaque states have no facts that
    could be told apart.
    """
    for branch in blueprint:
        if branch.shape.opaque:
            continue
        facts = {state: branch.facts(state) for state in branch.table}
        slips = {slip.edge for slip in mislabelled(branch)}
        edges: dict[str, list[Operation]] = {}
        for edge in branch.edges():
            if edge.target in branch.table and edge not in slips:
                edges.setdefault(edge.name, []).append(edge)
        for own in edges.values():
            ends = [(facts[edge.source], facts[edge.target]) for edge in own]
            unsure = [
                f"{fact_words(branch, digit)} ({outcome})"
                for digit in range(branch.num_facts)
                if (outcome := _outcomes(ends, digit))
            ]
            if unsure:
                yield Finding.at(
                    blueprint,
                    "R16",
                    NOTE,
                    own[0].address,
                    f"what {own[0].name} does to {listed(unsure)} depends on the state",
                    advice="if that is not meant, give the operations different names",
                )


def _outcomes(ends: list[tuple[Facts, Facts]], digit: int) -> str:
    """The different ends one operation brings a fact to, or the empty text where it is one end."""
    changed: dict[str, None] = {}
    kept: dict[str, None] = {}
    for before, after in ends:
        (kept if before[digit] == after[digit] else changed)[after[digit]] = None
    if not changed:
        return ""
    ways = [f"to {value}" for value in changed]
    if any(value not in changed for value in kept):
        ways.append("left")
    return listed(ways, "or") if len(ways) > 1 else ""


def r17_self_loops(blueprint: Blueprint) -> Iterator[Finding]:
    """Self loops that are not marked as repeatable: one finding an SB."""
    for branch in blueprint:
        loops = [
            edge
            for edge in branch.edges()
            if edge.target == edge.source
            and not branch.operation_note(edge.source, edge.name).repeatable
        ]
        if not loops:
            continue
        more = f"; {len(loops) - 1} more like it" if len(loops) > 1 else ""
        words = "Mark as repeatable" if len(loops) == 1 else "Mark all as repeatable"
        yield Finding.at(
            blueprint,
            "R17",
            NOTE,
            loops[0].address,
            f"leads back to its own state and is not marked as repeatable{more}",
            advice="mark it, so that a run may carry it out again and again",
            fix=Fix(words, partial(_mark_repeatable, edges=tuple(edge.address for edge in loops))),
        )


def _mark_repeatable(blueprint: Blueprint, edges: tuple[Address, ...]) -> Blueprint:
    for address in edges:
        table = blueprint[address.branch].fields.get("_operations", {})
        key = note_key(address.operation, address.state)
        note = table.get(key, {}) if isinstance(table, dict) else {}
        own = dict(note) if isinstance(note, dict) else {}
        blueprint = set_note(
            blueprint, address.branch, "_operations", key, {**own, "repeatable": True}
        )
    return blueprint


def r18_parallel(blueprint: Blueprint) -> Iterator[Finding]:
    """Parallel operations between two states with no cost to choose by: one finding an SB."""
    for branch in blueprint:
        pairs = [pair for pair in _parallels(branch) if _without_cost(branch, pair)]
        if not pairs:
            continue
        first = pairs[0]
        more = f"; {counted(len(pairs) - 1, 'more pair')} of states" if len(pairs) > 1 else ""
        yield Finding.at(
            blueprint,
            "R18",
            NOTE,
            first[0].address,
            f"{some(edge.name for edge in first)} lead to {first[0].target} in parallel, "
            f"with no cost to choose by{more}",
            advice="give them costs in _operations; until then the fewest operations and the first "
            "name win",
        )


def _parallels(branch: StateBranch) -> Iterator[list[Operation]]:
    for state, operations in branch.table.items():
        if len(set(operations.values())) == len(operations):
            continue
        by_target: dict[str, list[Operation]] = {}
        for name, target in operations.items():
            if target != state and target in branch.table:
                edge = Operation(branch.name, state, name, target)
                by_target.setdefault(target, []).append(edge)
        yield from (edges for edges in by_target.values() if len(edges) > 1)


def _without_cost(branch: StateBranch, edges: list[Operation]) -> bool:
    return any(branch.operation_note(edge.source, edge.name).cost is None for edge in edges)
