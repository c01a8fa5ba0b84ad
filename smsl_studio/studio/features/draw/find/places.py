"""The searchable lines of a blueprint: SBs, states, operations, facts and hazards."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.draw.find.haystack import EXACT, Haystack, Hit


@dataclass(frozen=True)
class Target:
    """A place that was found: its kind, its name, where it is (in words), and how to get there.

    ``there`` is an address, a fact as (SB, digit) or the name of a hazard.
    """

    kind: str
    text: str
    where: str
    there: Address | tuple[str, int] | str
    title: str = ""


@dataclass(frozen=True)
class _BranchLines:
    """The lines of one SB, and what each of them stands for.

    They are reused while the SB is unchanged.
    """

    branch: StateBranch
    states: tuple[str, ...]
    state_lines: tuple[str, ...]
    operations: tuple[tuple[str, str, int], ...]
    """(name, first state that has it, number of states that have it)."""
    operation_lines: tuple[str, ...]
    fact_lines: tuple[str, ...]


@dataclass
class PlaceIndex:
    """The search index of one blueprint."""

    _blueprint: Blueprint | None = None
    _parts: dict[str, _BranchLines] = field(default_factory=dict)
    _stacks: list[tuple[Haystack, Callable[[int], Target]]] = field(default_factory=list)

    def show(self, blueprint: Blueprint) -> None:
        """Index a blueprint; the lines of unchanged SBs are reused."""
        if blueprint is self._blueprint:
            return
        self._blueprint = blueprint
        self._parts = {branch.name: self._part(branch) for branch in blueprint}
        parts = list(self._parts.values())
        states = [(part, at) for part in parts for at in range(len(part.states))]
        operations = [(part, at) for part in parts for at in range(len(part.operations))]
        facts = [(part, at) for part in parts for at in range(len(part.fact_lines))]
        hazards = blueprint.hazards
        names = list(blueprint.branches)

        def hazard(at: int) -> Target:
            """The target of a line of hazards."""
            return Target("Hazard", hazards[at].name, "hazard", hazards[at].name)

        self._stacks = [
            (Haystack(names), lambda at: _branch(blueprint, names[at])),
            (Haystack([line for part in parts for line in part.state_lines]),
             lambda at: _state(*states[at])),
            (Haystack([line for part in parts for line in part.operation_lines]),
             lambda at: _operation(*operations[at])),
            (Haystack([line for part in parts for line in part.fact_lines]),
             lambda at: _fact(*facts[at])),
            (Haystack([one.name for one in hazards]), hazard),
        ]  # fmt: skip

    def find(self, typed: str, most: int) -> list[tuple[Hit, Target]]:
        """The best places for the typed text, in order. An address finds its own element first."""
        found = [(Hit(EXACT, -1, 0), target) for target in self._addressed(typed)]
        ranked = [
            (hit, kind, target_of)
            for kind, (stack, target_of) in enumerate(self._stacks)
            for hit in stack.find(typed, most)
        ]
        ranked.sort(key=lambda one: (one[0].tier, one[1], one[0].length, one[0].line))
        found += [(hit, target_of(hit.line)) for hit, _, target_of in ranked[:most]]
        return found

    def _part(self, branch: StateBranch) -> _BranchLines:
        former = self._parts.get(branch.name)
        return former if former is not None and former.branch is branch else _part_of(branch)

    def _addressed(self, typed: str) -> Iterator[Target]:
        """The operations that match ``State/Operation`` or ``SB/State/Operation``."""
        blueprint, parts = self._blueprint, Address.split(typed.strip())
        if blueprint is None or len(parts) < 2 or not all(parts):
            return
        for branch in blueprint:
            below = parts[1:] if parts[0] == branch.name else parts
            operations = branch.table.get(below[0])
            if operations is None or len(below) > 2:
                continue
            if len(below) == 2:
                names = [n for n in operations if n.lower().startswith(below[1].lower())]
                for name in names[:20]:
                    there = Address(branch.name, below[0], name)
                    yield Target("Operation", name, f"{branch.name} / {below[0]}", there)


def _part_of(branch: StateBranch) -> _BranchLines:
    noted, shape = branch.notes.states, branch.shape
    given = shape.width == 0 and not shape.opaque
    lines = list(branch.table)
    if noted or given:
        lines = [
            "\t".join((name, noted[name].title if name in noted else "",
                       "".join(branch.facts(name)) if given else ""))
            for name in lines
        ]  # fmt: skip
    first: dict[str, str] = {}
    counts: dict[str, int] = {}
    for state, operations in branch.table.items():
        for name in operations:
            first.setdefault(name, state)
            counts[name] = counts.get(name, 0) + 1
    titles = branch.notes.operations
    operation_lines = []
    for name in first:
        note = titles.get(note_key(name))
        operation_lines.append(f"{name}\t{note.title}" if note and note.title else name)
    digits = range(told_facts(branch) if branch.table else 0)
    return _BranchLines(
        branch,
        tuple(branch.table),
        tuple(lines),
        tuple((name, state, counts[name]) for name, state in first.items()),
        tuple(operation_lines),
        # A sign before the SB: its name alone must not find all its facts as a prefix.
        tuple(f"{branch.fact_name(digit)}\t#{branch.name}/{digit}" for digit in digits),
    )


def _branch(blueprint: Blueprint, name: str) -> Target:
    states = counted(len(blueprint[name].table), "state")
    return Target("State Branch", name, f"State Branch, {states}", Address(name))


def _state(part: _BranchLines, at: int) -> Target:
    name, branch = part.states[at], part.branch
    note = branch.state_note(name)
    return Target(
        "State", name, branch.name, Address(branch.name, name), note.title if note else ""
    )


def _operation(part: _BranchLines, at: int) -> Target:
    name, state, count = part.operations[at]
    branch = part.branch
    where = f"{branch.name} / {state}" if count == 1 else f"{branch.name}, {count:,} states"
    title = branch.operation_note(state, name).title
    return Target("Operation", name, where, Address(branch.name, state, name), title)


def _fact(part: _BranchLines, digit: int) -> Target:
    branch = part.branch
    return Target("Fact", branch.fact_name(digit), f"digit {digit} of {branch.name}",
                  (branch.name, digit))  # fmt: skip
