"""Rules about the effects of operations on facts: all edges of one name are compared (R15-R18)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from operator import eq

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import note_key
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.graph.effects import EdgeEffects, Effect, effects_of
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity, edit
from smsl_studio.inspection.rules.idle_fields import moved_sub
from smsl_studio.inspection.rules.words import fact_words, listed, some

ERROR, NOTE = Severity.ERROR, Severity.NOTE


@dataclass(frozen=True, slots=True)
class Mislabelled:
    """An edge that bears the wrong operation's name (see ``mislabelled``).

    ``others`` has the first names of operations that may have been meant. ``count`` is the number
    of all such operations.
    """

    edge: Operation
    effect: Effect
    others: tuple[str, ...]
    count: int


_TOLD = 5
"""The largest number of operations in ``Mislabelled.others``."""


def mislabelled(branch: StateBranch) -> tuple[Mislabelled, ...]:
    """Return the edges of an SB that bear another operation's name, in the order of the states.

    The effect of an edge is the set of (digit, new value) for the digits that it changes. The
    majority effect of an operation is the effect of more than half of its edges; there may be
    none. An edge is mislabelled if its effect is not empty, its operation has another majority
    effect, and an operation that is absent from its source state has exactly this majority effect.

    Two rules need the result, so it is kept with the branch, which is frozen.
    """
    kept: tuple[Mislabelled, ...] | None = branch.__dict__.get(_SLIPS)
    if kept is None:
        kept = branch.__dict__[_SLIPS] = _mislabelled(branch)
    return kept


_SLIPS = "_mislabelled"


def _mislabelled(branch: StateBranch) -> tuple[Mislabelled, ...]:
    effects = effects_of(branch)
    majority, kinds = effects.majority, effects.kinds
    odd = {
        (name, kind)
        for name, kind in effects.counts
        if kinds[kind] and majority[name] is not None and kinds[kind] != majority[name]
    }
    if not odd:
        return ()
    absent = _Absent(branch, effects.holders, majority)
    found = []
    for number, pair in enumerate(zip(effects.graph.operations, effects.of, strict=True)):
        if pair in odd:
            edge, effect = effects.edge(number), kinds[pair[1]]
            others = absent.of(edge.source, effect)
            if others[1]:
                found.append(Mislabelled(edge, effect, *others))
    return tuple(found)


class _Absent:
    """The operations that have a given majority effect and are absent from a given state."""

    def __init__(
        self,
        branch: StateBranch,
        holders: Mapping[Effect, Sequence[str]],
        majority: Mapping[str, Effect | None],
    ) -> None:
        self._branch, self._holders, self._majority = branch, holders, majority
        self._present: dict[str, Counter[Effect]] = {}
        self._found: dict[tuple[str, Effect], tuple[tuple[str, ...], int]] = {}

    def of(self, state: str, effect: Effect) -> tuple[tuple[str, ...], int]:
        """Return the first names of these operations, at most ``_TOLD``, and their number."""
        key = state, effect
        if key not in self._found:
            operations, holders = self._branch.table[state], self._holders.get(effect, [])
            if state not in self._present:
                own = (self._majority.get(name) for name in operations)
                self._present[state] = Counter(most for most in own if most)
            count = len(holders) - self._present[state][effect]
            names = (name for name in holders if name not in operations)
            self._found[key] = tuple(islice(names, min(count, _TOLD))), count
        return self._found[key]


def r15_mislabelled(blueprint: Blueprint) -> Iterator[Remark]:
    """R15: a mislabelled operation, with the operation that was probably meant."""
    for branch in blueprint:
        for slip in mislabelled(branch):
            yield Remark(
                "R15",
                ERROR,
                slip.edge.address,
                f"moves {_moves(branch, slip.effect)}",
                remedy=partial(_renaming, slip),
            )


def _renaming(slip: Mislabelled) -> tuple[str, Fix]:
    meant, left = slip.others[0], slip.count - len(slip.others)
    names = (*slip.others, f"{left:,} more") if left else slip.others
    rename = edit("rename", address=slip.edge.address, new_name=meant)
    fix = Fix(f"Rename to {meant}", rename, certain=slip.count == 1)
    return f"did you mean {listed(names, 'or')}?", fix


def _moves(branch: StateBranch, effect: Effect) -> str:
    return some((f"{fact_words(branch, digit)} to {value}" for digit, value in effect), _MANY)


_MANY = 12
"""The largest number of facts that a message names for one operation."""


def r16_conditional(blueprint: Blueprint) -> Iterator[Remark]:
    """R16: an operation whose effect on a fact differs between its edges.

    An edge may set a fact to the value that the fact already has: that is no difference. SBs whose
    state names carry no facts (opaque SBs) are passed over.
    """
    for branch in blueprint:
        if branch.shape.opaque:
            continue
        effects = effects_of(branch)
        several = _with_several_effects(effects)
        if not several:
            continue
        slips = {(slip.edge.source, slip.edge.name) for slip in mislabelled(branch)}
        edges: dict[str, list[int]] = {}
        names, sources = effects.graph.operations, effects.graph.sources
        for number, name in enumerate(names):
            if name in several and (effects.graph.names[sources[number]], name) not in slips:
                edges.setdefault(name, []).append(number)
        for own in edges.values():
            unsure = _unsure(branch, effects, own)
            if unsure:
                first = effects.edge(own[0])
                yield Remark(
                    "R16",
                    NOTE,
                    first.address,
                    f"what {first.name} does to {unsure} depends on the state",
                    "if that is not meant, give the operations different names",
                )


def _with_several_effects(effects: EdgeEffects) -> set[str]:
    """Return the operations whose edges do not all have one effect."""
    count = Counter(name for name, _ in effects.counts)
    return {name for name, kinds in count.items() if kinds > 1}


def _unsure(branch: StateBranch, effects: EdgeEffects, own: list[int]) -> str:
    """Name the facts on which the edges of one operation have different effects.

    Only facts that at least one edge changes are compared. An edge that leaves a fact at a value
    counts as equal to an edge that sets the fact to this value.
    """
    changes: dict[int, dict[str, int]] = {}
    for kind, count in Counter(effects.of[number] for number in own).items():
        for digit, value in effects.kinds[kind]:
            values = changes.setdefault(digit, {})
            values[value] = values.get(value, 0) + count
    unsure = []
    for digit, values in sorted(changes.items()):
        ways = [f"to {value}" for value in values]
        if sum(values.values()) < len(own) and _leaves(branch, effects, own, digit, values):
            ways.append("left")
        if len(ways) > 1:
            unsure.append(f"{fact_words(branch, digit)} ({some(ways, last='or')})")
    return some(unsure, _MANY) if unsure else ""


def _leaves(
    branch: StateBranch,
    effects: EdgeEffects,
    own: list[int],
    digit: int,
    values: Collection[str],
) -> bool:
    """Whether an edge leaves the fact ``digit`` at a value that no edge sets it to."""
    if all(value in values for value in branch.alphabet[digit]):
        return False
    names, targets, facts = effects.graph.names, effects.graph.targets, branch.facts
    return any(facts(names[targets[number]])[digit] not in values for number in own)


def r17_self_loops(blueprint: Blueprint) -> Iterator[Remark]:
    """R17: self loops that are not marked as repeatable. Each SB gets one finding."""
    for branch in blueprint:
        effects = effects_of(branch)
        same = map(eq, effects.graph.sources, effects.graph.targets)
        found = (effects.edge(number) for number, loop in enumerate(same) if loop)
        loops = [e for e in found if not branch.operation_note(e.source, e.name).repeatable]
        if not loops:
            continue
        words = "Mark as repeatable" if len(loops) == 1 else "Mark all as repeatable"
        yield Remark(
            "R17",
            NOTE,
            loops[0].address,
            "leads back to its own state and is not marked as repeatable",
            "mark it, so that a run may carry it out again and again",
            Fix(words, partial(_mark_repeatable, edges=loops)),
            others=[edge.address for edge in loops[1:]],
        )


_REPEATABLE = {"repeatable": True}


def _mark_repeatable(blueprint: Blueprint, edges: Sequence[Operation]) -> Blueprint:
    keys = ((edge.branch, note_key(edge.name, edge.source)) for edge in edges)
    return editing.change_notes(blueprint, "_operations", dict.fromkeys(keys, _REPEATABLE))


def r18_parallel(blueprint: Blueprint) -> Iterator[Remark]:
    """R18: parallel operations between two states, without costs to choose by. Each SB gets one
    finding."""
    for branch in blueprint:
        pairs = [pair for pair in _parallels(branch) if _costless(branch, pair)]
        if not pairs:
            continue
        first, lacking = pairs[0], _costless(branch, pairs[0])
        sub = moved_sub(branch, first[0])
        which = "" if len(lacking) == len(first) else f" at {some(lacking)}"
        if sub:
            why = f"their costs count for nothing: both only move {sub}"
            advice = f"leave one of them; until then the first name wins, and {sub} does the work"
        else:
            why = f"with no cost{which} to choose by"
            advice = (
                "give them costs in _operations; until then the fewest operations and the first "
                "name win"
            )
        yield Remark(
            "R18",
            NOTE,
            first[0].address,
            f"{some(edge.name for edge in first)} lead to {first[0].target} in parallel, {why}",
            advice,
            others=[pair[0].address for pair in pairs[1:]],
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


def _costless(branch: StateBranch, edges: list[Operation]) -> list[str]:
    """Return the names of the operations without a declared cost that counts."""
    return [
        edge.name
        for edge in edges
        if branch.operation_note(edge.source, edge.name).cost is None or moved_sub(branch, edge)
    ]
