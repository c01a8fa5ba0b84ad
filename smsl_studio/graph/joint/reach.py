"""All configurations of a blueprint that can be reached, as one set, with their shortest runs."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial
from math import prod

from smsl_studio.blueprint.properties.meaning import Meaning
from smsl_studio.graph.joint.diagram import Relation
from smsl_studio.graph.joint.goals import FoundRun, SearchGoals
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.products import JointBox, TooLarge, guarded
from smsl_studio.graph.joint.saturation import Saturation

IN_ARRAYS = 1 << 26
"""If the product of all state counts is at most this, all configurations fit into arrays."""

LEAST_WORK, SHARE = 200_000, 8
"""If arrays are possible, the diagram is given up after ``LEAST_WORK`` looks at nodes, or after one
look for each ``SHARE`` configurations if that is more."""


class JointReach:
    """The set of all configurations that can be reached by some steps from their start.

    With ``soon`` the diagram is given up early if all configurations fit into arrays. TooLarge if a
    limit is met.
    """

    def __init__(self, steps: JointSteps, soon: bool = False) -> None:
        self.steps, self.start, self.diagram = steps, steps.start, steps.diagram()
        self._top = self.diagram.height - 1
        self._onward = [Relation(one, steps.levels) for one in steps.products]
        self._back = [Relation(one, steps.levels, True) for one in steps.products]
        product = prod(self.diagram.sizes)
        if soon and product <= IN_ARRAYS:
            self.diagram.allow(max(LEAST_WORK, product // SHARE))
        saturation = Saturation(self.diagram, self._onward)
        self.whole = saturation.reached(self.start)
        self.begun = self.diagram.point(self.start)
        """The set of all configurations in which a run may begin."""
        for one in steps.failed:
            image = self.diagram.image(self.whole, Relation(one, steps.levels))
            self.begun = self.diagram.union(self.begun, image, self._top)
        if steps.failed:
            self.whole = saturation.closed(self.begun)
        self.count = self.diagram.count(self.whole)
        self.diagram.keep()

    def meant(self, meaning: Meaning) -> int:
        """Return the set of all configurations that meet a condition."""
        return self.steps.meant(self.diagram, meaning)

    def can_meet(self, wanted: int) -> bool:
        """Return whether a configuration of a set can be reached."""
        return bool(self.diagram.both(self.whole, wanted, self._top))

    def passing(self, wanted: int, branches: Collection[str]) -> int:
        """Return the configurations that can be reached and from which one step passes through
        ``wanted``.

        They are not in ``wanted`` themselves. ``branches`` are the SBs on which ``wanted`` depends.
        TooLarge if the exact answer would take too much work.
        """
        return self.steps.passing(self.diagram, wanted, branches, self.whole)

    def avoiding(self, boxes: Iterable[JointBox]) -> JointPaths:
        """Return the steps that begin in some boxes alone."""
        products = guarded(self.steps.products, boxes)
        levels = self.diagram.levels
        forth = [Relation(one, levels) for one in products]
        return JointPaths(self, forth, [Relation(one, levels, True) for one in products])

    def in_arrays(self, goals: SearchGoals) -> FoundRun | None:
        """Return the shortest run to a goal, found with arrays, or None.

        Of several shortest runs it is the first one by its addresses. TooLarge if that takes too
        much work.
        """
        # Only this needs numpy, so it is loaded here.
        from smsl_studio.graph.joint.array_runs import shortest_run

        return shortest_run(self.steps, goals, (self.diagram, self.whole))

    @property
    def paths(self) -> JointPaths:
        """All steps."""
        return JointPaths(self, self._onward, self._back)

    def has(self, found: int, configuration: Mapping[str, str]) -> bool:
        """Return whether a configuration is in a set."""
        return self.diagram.has(found, self.steps.coded(configuration))


class JointPaths:
    """Paths from the start by some relations, ``forth`` and ``back``."""

    def __init__(
        self, reach: JointReach, forth: Sequence[Relation], back: Sequence[Relation]
    ) -> None:
        self._reach, self._forth, self._back = reach, forth, back
        self._diagram, self._top = reach.diagram, reach.diagram.height - 1

    def reached(self) -> int:
        """Return the set that can be reached from all configurations in which a run may begin."""
        return Saturation(self._diagram, self._forth).closed(self._reach.begun)

    def onward(self, found: int) -> int:
        """Return the set of configurations after one step from ``found``."""
        return self._image(found, self._forth)

    def backward(self, found: int) -> int:
        """Return the set of configurations from which one step leads into ``found``."""
        return self._image(found, self._back)

    def reached_from(self, found: int) -> int:
        """Return the set that can be reached from ``found``."""
        return Saturation(self._diagram, self._forth).closed(found)

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

    def nearest(self, hits: int, passing: int, most: int | None = None) -> tuple[list[int], bool]:
        """Return the sets of configurations on the shortest runs, one set for each step.

        The last set has the nearest configurations of ``hits``. If a configuration of ``passing``
        is nearer by more than one step, the last set has those of ``passing``, and the second
        result is True. The caller knows that one of them can be reached. TooLarge after ``most``
        steps.
        """
        diagram, top = self._diagram, self._top
        layers = [self._reach.begun]
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
            if most is not None and len(layers) > most:
                raise TooLarge(f"{most:,} steps")
            layers.append(further)
            seen = diagram.union(seen, further, top)

    def approaches(self, wanted: int) -> Iterator[tuple[Callable[[int], list[int]], int]]:
        """Yield the configurations of ``wanted`` by their distance from the start, the nearest
        first.

        Each item has the configurations at one distance. The function beside them takes some of
        these, and returns the sets of configurations on the shortest runs to them, one set for each
        step.
        """
        diagram, top = self._diagram, self._top
        layers = [self._reach.begun]
        seen = layers[0]
        while layers[-1]:
            found = diagram.both(layers[-1], wanted, top)
            if found:
                yield partial(self._ways, tuple(layers)), found
            further = self._image(layers[-1], self._forth)
            layers.append(diagram.without(further, seen, top))
            seen = diagram.union(seen, layers[-1], top)

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
