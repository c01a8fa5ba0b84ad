"""Rules about the effects of operations on facts: all edges of one name are compared (R15-R18)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import note_key
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.facts import changed_digits
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity, edit
from smsl_studio.inspection.rules.words import fact_words, listed, some

ERROR, NOTE = Severity.ERROR, Severity.NOTE
Effect = tuple[tuple[int, str], ...]
"""(digit, new value) for each digit that an edge changes. Digits count from 0."""


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
    effects: dict[str, list[tuple[Operation, Effect]]] = {}
    for edge, effect in _effects(branch):
        effects.setdefault(edge.name, []).append((edge, effect))
    majority = {name: _majority([effect for _, effect in own]) for name, own in effects.items()}
    holders: dict[Effect, list[str]] = {}
    for name, most in majority.items():
        if most:
            holders.setdefault(most, []).append(name)
    absent = _Absent(branch, holders, majority)
    found = [
        Mislabelled(edge, effect, *others)
        for name, own in effects.items()
        for edge, effect in own
        if effect
        and majority[name] is not None
        and effect != majority[name]
        and (others := absent.of(edge.source, effect))[1]
    ]
    order = {state: number for number, state in enumerate(branch.table)}
    return tuple(sorted(found, key=lambda slip: order[slip.edge.source]))


def _effects(branch: StateBranch) -> Iterator[tuple[Operation, Effect]]:
    """Yield every edge to a state of the SB with its effect. The effect is computed once for each
    pair of states."""
    known: dict[tuple[str, str], Effect] = {}
    for edge in branch.edges():
        if edge.target in branch.table:
            ends = edge.source, edge.target
            effect = known.get(ends)
            if effect is None:
                before, after = branch.facts(edge.source), branch.facts(edge.target)
                effect = tuple((digit, after[digit]) for digit in changed_digits(before, after))
                known[ends] = effect
            yield edge, effect


def _majority(effects: list[Effect]) -> Effect | None:
    effect, count = Counter(effects).most_common(1)[0]
    return effect if 2 * count > len(effects) else None


class _Absent:
    """The operations that have a given majority effect and are absent from a given state."""

    def __init__(
        self,
        branch: StateBranch,
        holders: dict[Effect, list[str]],
        majority: dict[str, Effect | None],
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
        slips = {(slip.edge.source, slip.edge.name) for slip in mislabelled(branch)}
        edges: dict[str, list[tuple[Operation, Effect]]] = {}
        for edge, effect in _effects(branch):
            if (edge.source, edge.name) not in slips:
                edges.setdefault(edge.name, []).append((edge, effect))
        for own in edges.values():
            unsure = _unsure(branch, own)
            if unsure:
                first = own[0][0]
                yield Remark(
                    "R16",
                    NOTE,
                    first.address,
                    f"what {first.name} does to {unsure} depends on the state",
                    "if that is not meant, give the operations different names",
                )


def _unsure(branch: StateBranch, own: list[tuple[Operation, Effect]]) -> str:
    """Name the facts on which the edges of one operation have different effects.

    Only facts that at least one edge changes are compared. An edge that leaves a fact at a value
    counts as equal to an edge that sets the fact to this value.
    """
    changes: dict[int, dict[str, int]] = {}
    for _, effect in own:
        for digit, value in effect:
            values = changes.setdefault(digit, {})
            values[value] = values.get(value, 0) + 1
    unsure = []
    for digit, values in sorted(changes.items()):
        ways = [f"to {value}" for value in values]
        if sum(values.values()) < len(own) and _leaves(branch, own, digit, values):
            ways.append("left")
        if len(ways) > 1:
            unsure.append(f"{fact_words(branch, digit)} ({some(ways, last='or')})")
    return some(unsure, _MANY) if unsure else ""


def _leaves(
    branch: StateBranch,
    own: list[tuple[Operation, Effect]],
    digit: int,
    values: Collection[str],
) -> bool:
    """Whether an edge leaves the fact ``digit`` at a value that no edge sets it to."""
    facts = branch.facts
    return any(facts(edge.target)[digit] not in values for edge, _ in own)


def r17_self_loops(blueprint: Blueprint) -> Iterator[Remark]:
    """R17: self loops that are not marked as repeatable. Each SB gets one finding."""
    for branch in blueprint:
        loops = [
            edge
            for edge in branch.edges()
            if edge.target == edge.source
            and not branch.operation_note(edge.source, edge.name).repeatable
        ]
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
        pairs = [pair for pair in _parallels(branch) if _without_cost(branch, pair)]
        if not pairs:
            continue
        first = pairs[0]
        yield Remark(
            "R18",
            NOTE,
            first[0].address,
            f"{some(edge.name for edge in first)} lead to {first[0].target} in parallel, "
            "with no cost to choose by",
            "give them costs in _operations; until then the fewest operations and the first "
            "name win",
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


def _without_cost(branch: StateBranch, edges: list[Operation]) -> bool:
    return any(branch.operation_note(edge.source, edge.name).cost is None for edge in edges)
