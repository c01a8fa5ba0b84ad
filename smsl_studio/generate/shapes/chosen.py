"""Some states of an SB, chosen to become an SB of their own, and the edges around them."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cached_property

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.errors import EditRefused
from smsl_studio.stop import heed


class CutRefused(EditRefused):
    """Some states cannot become an SB of their own.

    ``at`` is the operation that shows it, and ``run`` has the names of the operations of a shortest
    run that shows it.
    """

    def __init__(
        self,
        sentence: str,
        at: Address | None = None,
        advice: str = "",
        run: tuple[str, ...] = (),
    ) -> None:
        super().__init__(sentence, None, advice or "Choose other states; identify lists cuts.")
        self.at, self.run = at, run


class ChosenStates:
    """The chosen states of an SB. CutRefused if they cannot be cut out in any way.

    ``states`` are in file order, ``outside`` are all others. ``entry`` is the one state that edges
    enter; INITIAL counts as entered.
    """

    def __init__(self, branch: StateBranch, states: Collection[str]) -> None:
        self.branch = branch
        self.states = tuple(name for name in branch.table if name in states)
        self.outside = tuple(name for name in branch.table if name not in states)
        self._inside = frozenset(self.states)
        self._must_have_facts()
        if not self.outside:
            raise CutRefused(f"all states of {branch.name} are chosen, so no base would be left")
        if branch.activating in self._inside:
            raise CutRefused(
                f"{branch.activating} is ACTIVATING of {branch.name}, and must stay a state of it"
            )
        self.entry = self._one_entry()

    def facts(self, state: str) -> tuple[str, ...]:
        """Return the facts of a state."""
        return self.branch.facts(state)

    def values(self, state: str, digits: Collection[int]) -> tuple[str, ...]:
        """Return some facts of a state."""
        facts = self.branch.facts(state)
        return tuple(facts[digit] for digit in digits)

    def contains(self, state: str) -> bool:
        """Whether a state is chosen."""
        return state in self._inside

    @cached_property
    def leaving(self) -> tuple[Operation, ...]:
        """The operations from a chosen state to another one."""
        return tuple(
            edge
            for edge in self._edges(self.states)
            if edge.target in self.branch.table and not self.contains(edge.target)
        )

    @cached_property
    def inner(self) -> tuple[Operation, ...]:
        """The operations between chosen states."""
        return tuple(edge for edge in self._edges(self.states) if self.contains(edge.target))

    @cached_property
    def around(self) -> tuple[Operation, ...]:
        """The operations from states that are not chosen."""
        return tuple(edge for edge in self._edges(self.outside) if edge.target in self.branch.table)

    @cached_property
    def varying(self) -> tuple[int, ...]:
        """The digits in which the chosen states differ. CutRefused for a digit with a sub-SB."""
        columns = zip(*(self.facts(name) for name in self.states), strict=True)
        found = tuple(digit for digit, column in enumerate(columns) if len(set(column)) > 1)
        for digit in found:
            if digit in self.branch.subs:
                raise CutRefused(
                    f"the chosen states differ in the fact of {self.branch.subs[digit]}, "
                    f"which has to stay in {self.branch.name}"
                )
        return found

    @cached_property
    def leaves(self) -> tuple[int, ...]:
        """The digits without a sub-SB in which all chosen states are alike."""
        others = frozenset((*self.branch.subs, *self.varying))
        return tuple(digit for digit in range(self.branch.num_facts) if digit not in others)

    def _edges(self, states: Collection[str]) -> Iterator[Operation]:
        name = self.branch.name
        for state in states:
            heed()
            for operation, target in self.branch.table[state].items():
                yield Operation(name, state, operation, target)

    def _must_have_facts(self) -> None:
        branch = self.branch
        if branch.shape.opaque or any(
            len(branch.facts(name)) != branch.num_facts for name in branch.table
        ):
            raise CutRefused(
                f"the states of {branch.name} do not all have the same facts",
                advice="Correct the names of the states first, or give facts in _states.",
            )

    def _one_entry(self) -> str:
        found: dict[str, Address | None] = {}
        if self.branch.initial in self._inside:
            found[self.branch.initial] = None
        for edge in self._edges(self.outside):
            if self.contains(edge.target):
                found.setdefault(edge.target, edge.address)
        if not found:
            raise CutRefused("nothing enters the chosen states")
        if len(found) > 1:
            first, second = list(found)[:2]
            raise CutRefused(
                f"the chosen states are entered at {first} and at {second}, and INITIAL is one "
                "state",
                found[second],
            )
        return next(iter(found))
