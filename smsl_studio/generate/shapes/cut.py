"""Cut: how chosen states of an SB become a sub-SB of it.

The sub-SB takes the facts in which the chosen states differ, and the facts that change exactly
when it is left. The base keeps the others, and gets one more digit, which is on in the states where
the sub-SB stands in ACTIVATING.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cached_property

from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.facts import changed_digits
from smsl_studio.generate.shapes.chosen import ChosenStates, CutRefused

Values = tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Cut:
    """One way to cut the chosen states out.

    ``digits`` are the facts of the base that the sub-SB takes, and ``done`` their values in its
    ACTIVATING state. ``on`` are the other states of the base in which it stands there; in the rest
    it stands in INITIAL.
    """

    chosen: ChosenStates
    digits: tuple[int, ...]
    done: Values
    on: frozenset[str]

    @cached_property
    def kept(self) -> tuple[int, ...]:
        """The facts that the base keeps."""
        taken = frozenset(self.digits)
        return tuple(d for d in range(self.chosen.branch.num_facts) if d not in taken)

    @cached_property
    def place(self) -> Values:
        """The facts that the base keeps, in the state that stands for the chosen ones."""
        return self.chosen.values(self.chosen.entry, self.kept)

    def is_pure(self, state: str) -> bool:
        """Whether a state outside differs from the chosen ones in the digit of the sub-SB
        alone."""
        return state in self.on and self.chosen.values(state, self.kept) == self.place

    @cached_property
    def exits(self) -> tuple[Operation, ...]:
        """The operations that only bring the sub-SB to ACTIVATING: it can be asked for them."""
        return tuple(edge for edge in self.chosen.leaving if self.is_pure(edge.target))

    @cached_property
    def returns(self) -> tuple[Operation, ...]:
        """The operations that only bring the sub-SB back to INITIAL."""
        entry = self.chosen.entry
        return tuple(
            edge
            for edge in self.chosen.around
            if edge.target == entry and self.is_pure(edge.source)
        )

    @cached_property
    def sources(self) -> dict[str, tuple[str, ...]]:
        """For each operation that leaves, the chosen states from which it does."""
        found: dict[str, tuple[str, ...]] = {}
        for edge in self.chosen.leaving:
            found[edge.name] = (*found.get(edge.name, ()), edge.source)
        return found

    @cached_property
    def guard(self) -> tuple[int, ...]:
        """The facts of the base that tell the chosen states from those in which the sub-SB stands
        in INITIAL too. CutRefused if there are none."""
        rest = [name for name in self.chosen.outside if name not in self.on]
        found: list[int] = []
        subs = self.chosen.branch.subs
        for digit in sorted(self.kept, key=lambda digit: (digit in subs, digit)):
            value = self.chosen.facts(self.chosen.entry)[digit]
            still = [name for name in rest if self.chosen.facts(name)[digit] == value]
            if len(still) < len(rest):
                found.append(digit)
                rest = still
        if rest:
            raise CutRefused(f"{rest[0]} has the same facts as {self.chosen.entry}")
        return tuple(sorted(found))

    def condition(self, states: Collection[str]) -> dict[int, str]:
        """Return fact values that all of ``states`` have, and that no other chosen state has.

        The keys are the digits of the facts in the base. As few facts as possible are taken, as far
        as a quick search finds. CutRefused if another chosen state has all the values that
        ``states`` share.
        """
        if len(states) == len(self.chosen.states):
            return {}
        rows = [self.chosen.values(state, self.digits) for state in states]
        same = {
            digit: column[0]
            for digit, column in zip(self.digits, zip(*rows, strict=True), strict=True)
            if len(set(column)) == 1
        }
        wrong = [name for name in self.chosen.states if name not in states]
        found: dict[int, str] = {}
        for digit, value in same.items():
            still = [name for name in wrong if self.chosen.facts(name)[digit] == value]
            if len(still) < len(wrong):
                found[digit], wrong = value, still
        if wrong:
            raise CutRefused(
                f"no facts tell {', '.join(states)} from {wrong[0]}, and an operation leaves only "
                "from the former"
            )
        return found


def cuts(chosen: ChosenStates) -> list[Cut]:
    """Return the ways to cut chosen states out, the best first. CutRefused if there is none."""
    found, refusals = [], []
    for on in _partitions(chosen):
        try:
            cut = _cut(chosen, on)
            _check(cut)
        except CutRefused as error:
            refusals.append(error)
        else:
            found.append(cut)
    if not found:
        raise next(
            iter(refusals),
            CutRefused("no operation leaves the chosen states with a change of their facts"),
        )
    return sorted(found, key=lambda cut: (-len(cut.exits), -len(cut.digits)))


def _partitions(chosen: ChosenStates) -> Iterator[frozenset[str]]:
    """Yield the sets of states outside in which the sub-SB may have reached ACTIVATING."""
    seen: set[frozenset[str]] = set()
    begin = chosen.values(chosen.entry, chosen.varying)
    ends = {chosen.values(edge.target, chosen.varying): edge for edge in chosen.leaving}
    if len(ends) > 1 and begin not in ends and chosen.varying:
        one, other = list(ends.values())[:2]
        if not any(_tells(chosen, digit) for digit in chosen.leaves):
            raise CutRefused(
                f"the chosen states are left with the facts of {one.target} and with those of "
                f"{other.target}, and ACTIVATING is one state",
                other.address,
            )
    options = [
        frozenset(one for one in chosen.outside if chosen.values(one, chosen.varying) == end)
        for end in ends
        if chosen.varying and end != begin
    ]
    for digit in chosen.leaves:
        value = chosen.facts(chosen.entry)[digit]
        options.append(
            frozenset(one for one in chosen.outside if chosen.facts(one)[digit] != value)
        )
    for on in options:
        if on and on not in seen:
            seen.add(on)
            if any(edge.target in on for edge in chosen.leaving):
                yield on


def _tells(chosen: ChosenStates, digit: int) -> bool:
    value = chosen.facts(chosen.entry)[digit]
    return any(chosen.facts(edge.target)[digit] != value for edge in chosen.leaving)


def _cut(chosen: ChosenStates, on: frozenset[str]) -> Cut:
    off = [name for name in chosen.outside if name not in on]
    begin = chosen.facts(chosen.entry)
    first = chosen.facts(next(name for name in chosen.outside if name in on))
    also = [
        digit
        for digit in chosen.leaves
        if first[digit] != begin[digit]
        and all(chosen.facts(name)[digit] == first[digit] for name in on)
        and all(chosen.facts(name)[digit] == begin[digit] for name in off)
    ]
    digits = tuple(sorted((*chosen.varying, *also)))
    done = tuple(first[digit] for digit in digits)
    start = chosen.values(chosen.entry, digits)
    into = {edge.target: edge.address for edge in (*chosen.around, *chosen.leaving)}
    for name in chosen.outside:
        wanted = done if name in on else start
        if chosen.values(name, digits) != wanted:
            raise CutRefused(
                f"in {name} the facts of the chosen states are neither those of "
                f"{chosen.entry} nor those after them",
                into.get(name),
            )
    if not digits:
        raise CutRefused("no fact changes when the chosen states are left")
    if any(chosen.values(name, digits) == done for name in chosen.states):
        raise CutRefused("a chosen state already has the facts with which they are left")
    return Cut(chosen, digits, done, on)


def _check(cut: Cut) -> None:
    """Raise CutRefused if an operation of the base could not be written."""
    chosen = cut.chosen
    targets: dict[str, str] = {}
    for edge in chosen.leaving:
        if edge.target not in cut.on and edge.source != chosen.entry:
            raise CutRefused(
                f"{edge.address} leaves to {edge.target}, where the facts are those of "
                f"{chosen.entry} again",
                edge.address,
            )
        if targets.setdefault(edge.name, edge.target) != edge.target:
            raise CutRefused(
                f"{edge.name} leaves to {targets[edge.name]} and to {edge.target}, and the base "
                "has one state for the chosen ones",
                edge.address,
            )
    for name, states in cut.sources.items():
        try:
            cut.condition(states)
        except CutRefused as error:
            at = next(edge.address for edge in chosen.leaving if edge.name == name)
            raise CutRefused(error.sentence, at) from None
    assert cut.guard is not None
    for edge in (*chosen.leaving, *chosen.around):
        _check_load(cut, edge)


def _check_load(cut: Cut, edge: Operation) -> None:
    """An edge that brings the facts of the sub-SB about by itself must not drive other sub-SBs."""
    branch = cut.chosen.branch
    if not is_loaded(cut, edge) or branch.operation_note(edge.source, edge.name).subs == "load":
        return
    changed = changed_digits(cut.chosen.facts(edge.source), cut.chosen.facts(edge.target))
    for digit in changed:
        if digit in branch.subs:
            raise CutRefused(
                f"{edge.address} changes the facts of the chosen states together with that of "
                f"{branch.subs[digit]}",
                edge.address,
            )


def is_loaded(cut: Cut, edge: Operation) -> bool:
    """Whether an edge of the base moves the sub-SB together with other facts, so that its function
    brings all of them about (``"subs": "load"``)."""
    chosen = cut.chosen
    if chosen.contains(edge.source):
        return edge.target in cut.on and not cut.is_pure(edge.target)
    before = edge.source in cut.on
    if chosen.contains(edge.target):
        return before and not cut.is_pure(edge.source)
    return before != (edge.target in cut.on)
