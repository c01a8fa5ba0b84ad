"""All configurations of a blueprint that can be reached, as one set, with their shortest runs."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.properties.meaning import Meaning, States
from smsl_studio.graph.joint.diagram import Diagram, Relation
from smsl_studio.graph.joint.force_order import force_order
from smsl_studio.graph.joint.products import JointBox, JointMoves, TooLarge, guarded
from smsl_studio.graph.joint.products_of import ProductSteps
from smsl_studio.graph.joint.saturation import Saturation

MOST_BRANCHES = 200
"""The largest number of SBs: so deep may a diagram be."""

MOST_BOXES = 64
"""The largest number of boxes of a condition."""


class JointReach:
    """What can be reached from the start of a blueprint.

    TooLarge if a bound is met, RunRefused if there is no start.
    """

    def __init__(self, hierarchy: Hierarchy) -> None:
        start = start_configuration(hierarchy, {})
        if len(hierarchy.order) > MOST_BRANCHES:
            raise TooLarge(f"{MOST_BRANCHES} SBs")
        self._written = ProductSteps(hierarchy)
        self.numbers, products = self._written.numbers, self._written.products()
        self._steps, self._passed, self._rough = products.steps, products.passed, products.rough
        levels = force_order(len(hierarchy.order), self._steps)
        self.diagram = Diagram(self.numbers.sizes, levels)
        self._top = self.diagram.height - 1
        self._onward = [Relation(one, levels) for one in self._steps]
        self._back = [Relation(one, levels, True) for one in self._steps]
        self.start = self.numbers.coded(start)
        self.whole = Saturation(self.diagram, self._onward).reached(self.start)
        self.count = self.diagram.count(self.whole)
        self.diagram.keep()

    def boxes(self, meaning: Meaning, holds: bool) -> list[JointBox]:
        """Return boxes that together have all configurations in which a condition holds, or does
        not hold. TooLarge if they are many.
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

    def meant(self, meaning: Meaning) -> int:
        """Return the set of all configurations that meet a condition."""
        if isinstance(meaning, States):
            at = self.numbers.at[meaning.branch]
            return self.diagram.box({at: {self.numbers.number[at][one] for one in meaning.states}})
        found = self.diagram.box({}) if meaning.every else 0
        join = self.diagram.both if meaning.every else self.diagram.union
        for part in meaning.parts:
            found = join(found, self.meant(part), self._top)
        return found

    def can_meet(self, wanted: int) -> bool:
        """Return whether a configuration of a set can be reached."""
        return bool(self.diagram.both(self.whole, wanted, self._top))

    def passing(self, wanted: int, branches: Collection[str]) -> int:
        """Return the configurations outside of a set out of which a step passes one of it.

        ``branches`` are the SBs that the set depends on. TooLarge if what steps pass takes too much
        to be worked out exactly.
        """
        seen = {self.numbers.at[name] for name in branches}
        if self._rough and self._before(wanted, self._rough, seen):
            self._passed, self._rough = [*self._passed, *self._written.exactly_passed()], []
        return self._before(wanted, self._passed, seen)

    def _before(self, wanted: int, products: Sequence[JointMoves], seen: set[int]) -> int:
        found, diagram, top = 0, self.diagram, self._top
        for one in products:
            if any(a != b for at in seen & one.keys() for a, b in one[at]):
                image = diagram.image(wanted, Relation(one, diagram.levels, True))
                reached = diagram.both(image, self.whole, top)
                found = diagram.union(found, diagram.without(reached, wanted, top), top)
        return found

    def avoiding(self, boxes: Iterable[JointBox]) -> JointPaths:
        """Return the steps that begin in some boxes alone."""
        products = guarded(self._steps, boxes)
        levels = self.diagram.levels
        forth = [Relation(one, levels) for one in products]
        return JointPaths(self, forth, [Relation(one, levels, True) for one in products])

    @property
    def paths(self) -> JointPaths:
        """All steps."""
        return JointPaths(self, self._onward, self._back)

    def has(self, found: int, configuration: Mapping[str, str]) -> bool:
        """Return whether a configuration is in a set."""
        return self.diagram.has(found, self.numbers.coded(configuration))


class JointPaths:
    """Paths from the start by some relations, ``forth`` and ``back``."""

    def __init__(
        self, reach: JointReach, forth: Sequence[Relation], back: Sequence[Relation]
    ) -> None:
        self._reach, self._forth, self._back = reach, forth, back
        self._diagram, self._top = reach.diagram, reach.diagram.height - 1

    def reached(self) -> int:
        """Return what can be reached from the start."""
        return Saturation(self._diagram, self._forth).reached(self._reach.start)

    def leading_to(self, wanted: int, within: int | None) -> int:
        """Return from where a set can be reached, with at most ``within`` steps."""
        if within is None:
            return Saturation(self._diagram, self._back).closed(wanted)
        found = wanted
        for _ in range(within):
            before = found
            found = self._diagram.union(found, self._image(found, self._back), self._top)
            if found == before:
                break
        return found

    def nearest(self, hits: int, passing: int) -> tuple[list[int], bool]:
        """Return the sets of configurations on shortest runs, step by step from the start.

        The last set has the nearest of ``hits``. If one of ``passing`` is nearer by more than a
        step, the last set has those, and True is returned. One of them must be reached.
        """
        diagram, top = self._diagram, self._top
        layers = [diagram.point(self._reach.start)]
        seen = layers[0]
        while True:
            ends = diagram.both(layers[-1], hits, top)
            if ends:
                return self._ways(layers, ends), False
            met = diagram.both(layers[-1], passing, top)
            further = diagram.without(self._image(layers[-1], self._forth), seen, top)
            if met and not diagram.both(further, hits, top):
                return self._ways(layers, met), True
            if not further:
                raise TooLarge("the run that was expected")
            layers.append(further)
            seen = diagram.union(seen, further, top)

    def _ways(self, layers: Sequence[int], ends: int) -> list[int]:
        ways = [ends]
        for layer in reversed(layers[:-1]):
            before = self._image(ways[-1], self._back)
            ways.append(self._diagram.both(layer, before, self._top))
        ways.reverse()
        return ways

    def _image(self, found: int, relations: Sequence[Relation]) -> int:
        """Return where one step of any of the relations leads."""
        images = [self._diagram.image(found, one) for one in relations]
        images = [one for one in images if one]
        while len(images) > 1:
            pairs = zip(images[::2], [*images[1::2], 0], strict=False)
            images = [self._diagram.union(a, b, self._top) for a, b in pairs]
        return images[0] if images else 0


def _both(one: JointBox, other: JointBox) -> JointBox | None:
    """Return what is in both of two boxes, None if there is nothing."""
    found = dict(one)
    for at, states in other.items():
        found[at] = states & found[at] if at in found else states
    return found if all(found.values()) else None
