"""The section "The procedure": the steps of the cheapest route, with what may be done instead."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.inspection.reading.plain_names import counted
from smsl_studio.inspection.reading.reading_grounds import ReadingGrounds
from smsl_studio.inspection.reading.sections import ReadingLine, ReadingSection, bounded
from smsl_studio.inspection.reading.step_words import StepWords
from smsl_studio.stop import heed

MOST_STEPS = 200
"""Steps of a longer route are counted and not told one by one."""
MOST_TRIED = 4_000
"""At most so many operations are tried to find other ways."""
MOST_EFFECTS = 12
"""Of an operation with more different effects the first ones are told and the others counted."""
MOST_ORDERED = 24
"""Only in a route of at most so many steps other orders are tried: it takes their cube."""
Standing = tuple[str, ...]
OtherWay = tuple[int, int, Edge]
"""An operation, with the number of the step before it and of the last step that it replaces."""
Effects = dict[tuple[tuple[int, str], ...], list[Address]]
"""What an operation changes (digits with new values), and where it does so."""


class Procedure:
    """The steps of one blueprint. The engine has carried out each order and each other way that it
    tells.
    """

    def __init__(self, words: StepWords, grounds: ReadingGrounds) -> None:
        self._words, self._names = words, words.names
        self._steps = grounds.steps or ()
        self._grounds = grounds
        self._blueprint = words.blueprint
        self._told = {edge.address for step in self._steps for edge in step.edges}
        """The operations that a step, a sub-procedure or another way tells."""
        self._ways: dict[int, list[OtherWay]] = {}
        if grounds.start is None:
            return
        hazards = guard_hazards(self._blueprint)
        self._stepper = Stepper(Hierarchy(self._blueprint), Terms(hazards=hazards))
        self._before = [dict(grounds.start)]
        for step in self._steps:
            self._before.append({**self._before[-1], **step.after})
        self._ways = self._instead(len(self._steps[:MOST_STEPS]))
        self._told.update(edge.address for some in self._ways.values() for _, _, edge in some)

    def section(self) -> ReadingSection:
        """Return the section. Without a route it says so, and the point is open."""
        grounds = self._grounds
        if grounds.steps is None:
            why = grounds.refusal or grounds.bound
            line = ReadingLine(
                "There is no way from the start to the end",
                (f"{why}." if why else "No sequence of permitted steps leads there.",),
                open_point=True,
            )
            return ReadingSection("procedure", "The procedure", (line,))
        shown = self._steps[:MOST_STEPS]
        many = len(shown) + sum(map(len, self._ways.values())) + (len(self._steps) > len(shown))
        lines = bounded(self._lines(shown), many, "step")
        lead = "The cheapest way from the start to the end, step by step."
        if not lines:
            lead = "The procedure is at its end when it starts: nothing has to be done."
        return ReadingSection("procedure", "The procedure", lines, lead)

    def others(self) -> ReadingSection:
        """Return the section with the operations that the steps do not tell, or only in some
        situations.
        """
        others = [
            edges
            for branch in self._blueprint
            for edges in self._alike(branch)
            if not self._told.issuperset(edges)
        ]
        return ReadingSection(
            "others",
            "What else may be done",
            bounded(map(self._other, others), len(others), "kind of step"),
            "Steps that the procedure permits, and does not need in these situations."
            if others
            else "",
        )

    def _alike(self, branch: StateBranch) -> Iterator[list[Address]]:
        """Yield the operations of an SB in groups of one name, one title and one who."""
        noted = "_operations" in branch.fields or self._words.levels.people_do(branch.name)
        found: dict[tuple[str, ...], list[Address]] = {}
        for state, edges in branch.table.items():
            for name, target in edges.items():
                if target not in branch.table:
                    continue
                edge = Address(branch.name, state, name)
                key = (self._names.operation(edge), self._words.who(edge)) if noted else ()
                found.setdefault((name, *key), []).append(edge)
        yield from found.values()

    def _lines(self, shown: Sequence[JointStep]) -> Iterator[ReadingLine]:
        orders = self._orders() if len(self._steps) <= MOST_ORDERED else {}
        for at, step in enumerate(shown):
            yield self._line(at, step, orders.get(at, (at, at)))
            yield from map(self._or, self._ways.get(at, ()))
        if len(self._steps) > len(shown):
            more = len(self._steps) - len(shown)
            yield ReadingLine(
                f"{counted(more, 'more step')}",
                (f"The whole way has {counted(len(self._steps), 'step')}.",),
                mark="…",
            )

    def _line(self, at: int, step: JointStep, places: tuple[int, int]) -> ReadingLine:
        """Return a step. ``places`` are the first and the last place where it may stand."""
        asked = step.asked
        title = self._names.operation(asked.address)
        own = (*self._words.sentences(asked.address), *self._parts(step))
        order, titled = (_order_words(at, places, name) for name in (_steps, self._titles))
        inner = [
            self._inner(f"{at + 1}{_letter(place)}", edge)
            for place, edge in enumerate(self._below(step))
        ]
        return ReadingLine(
            title,
            (*own, order) if order else own,
            mark=str(at + 1),
            who=self._who(asked),
            check=self._words.check(asked.address, asked.target),
            about=(asked.address,),
            inner=tuple(inner),
            unnumbered=(title, *own, titled) if order else (),
            starts=self._starts(at),
        )

    def _starts(self, at: int) -> tuple[Address, ...]:
        """Return the states in which the step at a place begins."""
        return tuple(Address(name, state) for name, state in self._before[at].items())

    def _titles(self, first: int, last: int) -> str:
        """Return the titles of the steps between two places, both included."""
        steps = self._steps[first : last + 1]
        return ", ".join(f"“{self._names.operation(step.asked.address)}”" for step in steps)

    def _who(self, edge: Edge) -> str:
        if not edge.function:
            return "Done by its sub-procedure" if edge.rises or edge.falls else ""
        return self._words.who(edge.address)

    def _below(self, step: JointStep) -> list[Edge]:
        return [edge for edge in step.edges if edge is not step.asked]

    def _parts(self, step: JointStep) -> Iterator[str]:
        if step.asked.load:
            yield "It brings the facts of its sub-procedure about by itself."

    def _inner(self, mark: str, edge: Edge) -> ReadingLine:
        return ReadingLine(
            self._names.operation(edge.address),
            tuple(self._words.sentences(edge.address)),
            mark=mark,
            who=self._who(edge) if edge.function else "Follows from the other parts of this step",
            check=self._words.check(edge.address, edge.target),
            about=(edge.address,),
        )

    def _instead(self, many: int) -> dict[int, list[OtherWay]]:
        """Return for each step the other ways that end where it ends, each carried out once."""
        place = {self._key(one): at for at, one in reversed(list(enumerate(self._before)))}
        found: dict[int, list[OtherWay]] = {}
        left = MOST_TRIED
        for at in range(many):
            for edge, step in self._possible(self._before[at], self._steps[at].asked):
                left -= 1
                if left < 0:
                    return found
                end = place.get(self._key({**self._before[at], **step.after}), -1)
                if end <= at or end > many:
                    continue
                found.setdefault(end - 1, []).append((at, end, edge))
        return found

    def _or(self, way: OtherWay) -> ReadingLine:
        at, end, edge = way
        title = f"{self._names.operation(edge.address)}, instead of"
        text = tuple(self._words.sentences(edge.address))
        return ReadingLine(
            f"{title} {_steps(at, end - 1)}",
            text,
            mark="or",
            who=self._who(edge),
            check=self._words.check(edge.address, edge.target),
            about=(edge.address,),
            unnumbered=(f"{title} {self._titles(at, end - 1)}", *text),
            starts=self._starts(at),
        )

    def _possible(self, here: Mapping[str, str], taken: Edge) -> Iterator[tuple[Edge, JointStep]]:
        for name, state in here.items():
            for edge in self._stepper.edges.out(name, state):
                heed()
                if edge.address == taken.address or edge.fails or edge.target == edge.source:
                    continue
                step = self._stepper.step(here, edge)
                if not isinstance(step, Unavailable):
                    yield edge, step

    def _orders(self) -> dict[int, tuple[int, int]]:
        """Return for each step that has other places in the order the first and the last one."""
        found = {}
        for at in range(len(self._steps)):
            first = last = at
            while first > 0 and self._works(at, first - 1):
                first -= 1
            while last < len(self._steps) - 1 and self._works(at, last + 1):
                last += 1
            if first < last:
                found[at] = first, last
        return found

    def _works(self, at: int, place: int) -> bool:
        """Return whether the route also ends as before with one step at another place."""
        order = [step.asked for step in self._steps]
        moved = order.pop(at)
        order.insert(place, moved)
        here: Mapping[str, str] = self._before[0]
        for asked in order:
            heed()
            edge = self._stepper.edges.get(Address(asked.branch, here[asked.branch], asked.name))
            if edge is None or edge.fails:
                return False
            if self._names.operation(edge.address) != self._names.operation(asked.address):
                return False
            step = self._stepper.step(here, edge)
            if isinstance(step, Unavailable):
                return False
            here = {**here, **step.after}
        return self._key(here) == self._key(self._before[-1])

    def _key(self, configuration: Mapping[str, str]) -> Standing:
        return self._stepper.key(configuration)

    def _other(self, edges: Sequence[Address]) -> ReadingLine:
        branch = self._blueprint[edges[0].branch]
        effects: Effects = {}
        for edge in edges:
            target = branch.table[edge.state][edge.operation]
            effects.setdefault(self._words.changes(edge, target), []).append(edge)
        many, of = len(edges), len(branch.table)
        where = "in every situation" if many == of else f"in {many:,} of {of:,} situations"
        several = "What it changes depends on the situation."
        return ReadingLine(
            self._names.operation(edges[0]),
            (
                *self._same(edges),
                *self._taken_back(edges),
                f"The blueprint permits it {where} of {branch.name}.",
            ),
            who=self._words.who(edges[0]),
            check=several if len(effects) > 1 else self._words.facts(branch, next(iter(effects))),
            about=tuple(edges),
            inner=tuple(self._effects(branch, effects)) if len(effects) > 1 else (),
        )

    def _taken_back(self, edges: Sequence[Address]) -> Iterator[str]:
        """Say to which state a sub-procedure goes back with all of these operations: a fact that
        falls leads it to its INITIAL.
        """
        if self._grounds.start is None:
            return
        found = [self._stepper.edges.get(edge) for edge in edges]
        known = [one for one in found if one is not None and not one.load]
        if len(known) < len(edges):
            return
        branch = self._blueprint[edges[0].branch]
        for digit in known[0].falls:
            sub = branch.subs.get(digit)
            if sub is not None and all(digit in one.falls for one in known):
                begin = self._names.state(self._blueprint[sub], self._blueprint[sub].initial)
                yield f"Its sub-procedure goes back to its beginning: {begin}."

    def _effects(self, branch: StateBranch, effects: Effects) -> Iterator[ReadingLine]:
        """Yield a line for each different effect of an operation."""
        for at, (changes, edges) in enumerate(effects.items()):
            if at == MOST_EFFECTS:
                more = sum(len(one) for one in list(effects.values())[at:])
                yield ReadingLine(f"In {counted(more, 'more situation')} it is otherwise again")
                return
            heading = f"In {counted(len(edges), 'situation')}"
            if len(edges) == 1:
                heading = f"While {self._names.state(branch, edges[0].state)}"
            yield ReadingLine(heading, check=self._words.facts(branch, changes), about=tuple(edges))

    def _same(self, edges: Sequence[Address]) -> Iterator[str]:
        """Yield the sentences that hold for all of these operations, and say if others differ."""
        different = {
            (id(self._words.note(edge)), self._words.levels.operation(edge)): edge for edge in edges
        }
        said = [tuple(self._words.sentences(edge)) for edge in different.values()]
        common = [one for one in said[0] if all(one in other for other in said)]
        yield from common
        if any(len(one) > len(common) for one in said):
            yield "In some situations more is asked."


def _letter(place: int) -> str:
    """Return a, b, ... z, then aa, ab and so on."""
    letters = ""
    place += 1
    while place:
        place, rest = divmod(place - 1, 26)
        letters = chr(ord("a") + rest) + letters
    return letters


def _order_words(at: int, places: tuple[int, int], name: Callable[[int, int], str]) -> str:
    """Return where else a step may stand. ``places`` are the first and the last place, counted from
    0. ``name`` names the steps between two places.
    """
    first, last = places
    earlier = name(first, at - 1) if first < at else ""
    later = name(at + 1, last) if at < last else ""
    if not earlier and not later:
        return ""
    if not earlier:
        return f"It may also be done after {later}."
    if not later:
        return f"It may also be done before {earlier}."
    return f"It may also be done before, between or after {earlier} and {later}."


def _steps(first: int, last: int) -> str:
    """Return ``steps 2 to 4`` for the places 1 to 3."""
    return f"step {first + 1}" if first == last else f"steps {first + 1} to {last + 1}"
