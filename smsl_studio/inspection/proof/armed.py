"""Shows that ``after [F, G]`` fails, with sets of configurations.

It fails if a run reaches a goal after F, and G has not held since F. Such a run is called *armed*.
The search keeps two sets for each step: the configurations at the end of armed runs, and those at
the end of all other runs.
"""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.graph.joint.goals import FoundRun
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.graph.joint.reach import JointReach
from smsl_studio.inspection.proof.armed_sets import ArmedSets, MarkedSet
from smsl_studio.inspection.proof.many_starts import ManyStarts
from smsl_studio.inspection.proof.space import Space
from smsl_studio.stop import heed


class ArmedSearch:
    """Searches the shortest run to ``goal`` that is armed at its end.

    A run is armed by a configuration of ``arming``, and disarmed by one of ``disarming``. No
    configuration is in both.
    """

    def __init__(self, reach: JointReach, arming: int, disarming: int, goal: int) -> None:
        self._reach, self._diagram = reach, reach.diagram
        self._top = reach.diagram.height - 1
        self._arming, self._disarming, self._goal = arming, disarming, goal
        self._sets = ArmedSets(self._diagram, arming, disarming)

    def ways(self) -> list[MarkedSet]:
        """Return the sets of configurations on the shortest runs, one for each step.

        The caller knows that there is such a run.
        """
        diagram, top = self._diagram, self._top
        begun = self._reach.begun
        plain, armed = (cut(begun, self._arming, top) for cut in (diagram.without, diagram.both))
        layers = [MarkedSet(plain, armed)]
        seen = layers[0]
        while True:
            heed()
            ends = diagram.both(layers[-1].armed, self._goal, top)
            if ends:
                return self._back(layers, MarkedSet(0, ends))
            plain, armed = self._further(layers[-1])
            layer = MarkedSet(
                diagram.without(plain, seen.plain, top), diagram.without(armed, seen.armed, top)
            )
            if not any(layer):
                raise TooLarge("the run that was expected")
            layers.append(layer)
            seen = MarkedSet(
                diagram.union(seen.plain, layer.plain, top),
                diagram.union(seen.armed, layer.armed, top),
            )

    def _further(self, layer: MarkedSet) -> MarkedSet:
        paths = self._reach.paths
        return self._sets.after(paths.onward(layer.plain), paths.onward(layer.armed))

    def _back(self, layers: Sequence[MarkedSet], ends: MarkedSet) -> list[MarkedSet]:
        diagram, top, paths = self._diagram, self._top, self._reach.paths
        ways = [ends]
        for layer in reversed(layers[:-1]):
            heed()
            to_plain, to_armed = self._sets.before(*ways[-1])
            ways.append(
                MarkedSet(
                    diagram.both(layer.plain, paths.backward(to_plain), top),
                    diagram.both(layer.armed, paths.backward(to_armed), top),
                )
            )
        ways.reverse()
        return ways

    def run(self, space: Space) -> FoundRun:
        """Return the first of the shortest runs by its addresses. ``space`` computes its steps."""
        ways = self.ways()
        if self._reach.steps.failed:
            return ManyStarts(self._reach, self._arming, self._disarming).run(ways)
        here = space.whole(space.start())
        is_armed = bool(ways[0].armed)
        path: list[Address] = []
        for plain, armed in ways[1:]:
            for address in space.operations(here):
                heed()
                step = space.joint_step(here, address)
                if step is None:
                    continue
                after = {**here, **step.after}
                marked = self._marked(after, is_armed)
                if self._reach.has(armed if marked else plain, after):
                    path.append(address)
                    here, is_armed = after, marked
                    break
            else:
                raise AssertionError("a way in the diagram is none of the stepper")
        return FoundRun(path, here, False)

    def _marked(self, configuration: dict[str, str], was: bool) -> bool:
        if self._reach.has(self._disarming, configuration):
            return False
        return was or self._reach.has(self._arming, configuration)
