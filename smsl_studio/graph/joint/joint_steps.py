"""The steps of a blueprint and its conditions, as sets of configurations."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.properties.meaning import Meaning, States
from smsl_studio.blueprint.terms import Terms
from smsl_studio.graph.joint.diagram import Diagram, Relation
from smsl_studio.graph.joint.failed import failed_moves
from smsl_studio.graph.joint.force_order import force_order
from smsl_studio.graph.joint.products import JointBox, JointMoves, TooLarge, joined
from smsl_studio.graph.joint.products_of import ANY_EDGE, ProductSteps
from smsl_studio.graph.joint.shut import without_shut

MOST_BRANCHES = 200
"""The largest number of SBs. A diagram has one level for each SB."""

MOST_BOXES = 64
"""The largest number of boxes that one condition may need."""


class JointSteps:
    """All steps of a blueprint, as products.

    If ``shut`` is given, only the steps remain that a route may take. They do not lead into a
    failure state, and they do not meet a condition of ``shut``. With ``failures`` a run may also
    begin where one SB has failed; the products in ``failed`` lead there. TooLarge if a limit is
    met, RunRefused if there is no start.
    """

    def __init__(
        self,
        hierarchy: Hierarchy,
        shut: Sequence[Meaning] | None = None,
        failures: bool = False,
    ) -> None:
        begun = start_configuration(hierarchy, {})
        if len(hierarchy.order) > MOST_BRANCHES:
            raise TooLarge(f"{MOST_BRANCHES} SBs")
        self._written = ProductSteps(hierarchy, ANY_EDGE if shut is None else Terms())
        self.numbers, products = self._written.numbers, self._written.products()
        self.products, self.asked = products.steps, products.asked
        if shut:
            boxes = [box for one in shut for box in self.boxes(one, True)]
            start = None if failures else self.numbers.coded(begun)
            self.asked = without_shut(self.asked, boxes, self.numbers, start)
            self.products = joined(one.moves for one in self.asked)
        self._passed, self._rough = products.passed, products.rough
        self.levels = force_order(len(hierarchy.order), self.products)
        self.start = self.numbers.coded(begun)
        self.failed = list(failed_moves(hierarchy, self.numbers)) if failures else []

    def diagram(self) -> Diagram:
        """Return an empty diagram for sets of configurations."""
        return Diagram(self.numbers.sizes, self.levels)

    def coded(self, configuration: Mapping[str, str]) -> tuple[int, ...]:
        """Return a configuration as numbers: for each SB the number of its state."""
        return self.numbers.coded(configuration)

    def boxes(self, meaning: Meaning, holds: bool) -> list[JointBox]:
        """Return boxes whose union has exactly the configurations in which a condition holds.

        If ``holds`` is False, return those in which it does not hold. TooLarge if there are more
        than ``MOST_BOXES``.
        """
        if isinstance(meaning, States):
            at = self.numbers.at[meaning.branch]
            states = {self.numbers.number[at][one] for one in meaning.states}
            if not holds:
                states = set(range(len(self.numbers.states[at]))) - states
            return [{at: frozenset(states)}] if states else []
        parts = [self.boxes(part, holds) for part in meaning.parts]
        if meaning.every != holds:
            found = [box for part in parts for box in part]
        else:
            found = [{}]
            for part in parts:
                found = [one for a in found for b in part if (one := _both(a, b)) is not None]
                if len(found) > MOST_BOXES:
                    break
        if len(found) > MOST_BOXES:
            raise TooLarge(f"{MOST_BOXES} parts of a condition")
        return found

    def meant(self, diagram: Diagram, meaning: Meaning) -> int:
        """Return the set of all configurations that meet a condition."""
        if isinstance(meaning, States):
            at = self.numbers.at[meaning.branch]
            return diagram.box({at: {self.numbers.number[at][one] for one in meaning.states}})
        found = diagram.box({}) if meaning.every else 0
        join = diagram.both if meaning.every else diagram.union
        for part in meaning.parts:
            found = join(found, self.meant(diagram, part), diagram.height - 1)
        return found

    def passing(self, diagram: Diagram, wanted: int, branches: Collection[str], within: int) -> int:
        """Return the configurations from which one step passes through a configuration of
        ``wanted``.

        They are all in ``within`` and not in ``wanted``. ``branches`` are the SBs on which
        ``wanted`` depends. TooLarge if the exact answer would take too much work.
        """
        seen = {self.numbers.at[name] for name in branches}
        asked = wanted, within, seen
        if self._rough and _before(diagram, self._rough, *asked):
            self._passed, self._rough = [*self._passed, *self._written.exactly_passed()], []
        return _before(diagram, self._passed, *asked)


def _before(
    diagram: Diagram, products: Sequence[JointMoves], wanted: int, within: int, seen: set[int]
) -> int:
    found, top = 0, diagram.height - 1
    for one in products:
        if any(a != b for at in seen & one.keys() for a, b in one[at]):
            image = diagram.image(wanted, Relation(one, diagram.levels, True))
            reached = diagram.both(image, within, top)
            found = diagram.union(found, diagram.without(reached, wanted, top), top)
    return found


def _both(one: JointBox, other: JointBox) -> JointBox | None:
    """Return the intersection of two boxes, or None if it is empty."""
    found = dict(one)
    for at, states in other.items():
        found[at] = states & found[at] if at in found else states
    return found if all(found.values()) else None
