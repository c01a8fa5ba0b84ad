"""Walks through configurations by hand.

Tells which operations are permitted, and why not the others.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.configuration import (
    Configuration,
    Hierarchy,
    start_configuration,
)
from smsl_studio.blueprint.edges import Edge, EdgeKind
from smsl_studio.blueprint.hazards import guard_hazards, met_on_the_way
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.stop import heed


@dataclass(frozen=True)
class OnwardStep:
    """An operation of an active state, permitted or refused.

    ``target`` is the state to which it leads. ``after`` has the new state of each SB that moves.
    ``edges`` are all operations that it carries out. ``hazard`` is the name of a hazard that it
    meets, or empty. ``reasons`` are sentences that say why the operation is refused; then ``after``
    and ``edges`` are empty.
    """

    address: Address
    target: str
    after: Mapping[str, str]
    edges: tuple[Address, ...] = ()
    reasons: tuple[str, ...] = ()
    hazard: str = ""

    @property
    def permitted(self) -> bool:
        """Whether the operation is permitted here."""
        return not self.reasons


class ConfigurationWalk:
    """Computes the steps out of any configuration of a blueprint.

    Steps that meet a hazard or lead into a failure state are permitted, too. RunRefused if the SBs
    refer to each other in a circle.
    """

    def __init__(self, blueprint: Blueprint) -> None:
        self.blueprint = blueprint
        self._hierarchy = Hierarchy(blueprint)
        self._stepper = Stepper(self._hierarchy, Terms(failing=None))
        self._hazards = guard_hazards(blueprint)

    def start(self) -> dict[str, str]:
        """Return the configuration in which a run starts. RunRefused if there is none."""
        return self._in_order(start_configuration(self._hierarchy, {}))

    def placed(self, wanted: Configuration, otherwise: Configuration) -> dict[str, str]:
        """Return a configuration in which some SBs are in the ``wanted`` states.

        All other SBs keep their states from ``otherwise``. Only a sub-SB below a wanted SB may
        change, if it would not agree with the facts of its base. RunRefused if no configuration has
        the wanted states.
        """
        stay = {name: state for name, state in otherwise.items() if name not in wanted}
        moved = [name for name in wanted if wanted[name] != otherwise.get(name)]
        below = {sub for name in moved for sub in self._hierarchy.tree(name)}
        for name in self._hierarchy.order:
            if name in below and name in stay and self._must_follow(name, {**stay, **wanted}):
                tree = self._hierarchy.tree(name)
                stay = {one: state for one, state in stay.items() if one not in tree}
        return self._in_order(start_configuration(self._hierarchy, {**stay, **wanted}))

    def _must_follow(self, sub: str, here: Configuration) -> bool:
        """Return whether a sub-SB must change, because it does not agree with one of its bases."""
        done = here[sub] == self.blueprint[sub].activating
        bases = self._hierarchy.bases[sub]
        return any(self.blueprint[b].is_on(here[b], d) != done for b, d in bases if b in here)

    def steps(self, here: Configuration) -> tuple[OnwardStep, ...]:
        """Return every operation of the active states, sorted by address, permitted ones first.

        This can take long, because sub-SBs may have to search their routes. It heeds a stop.
        """
        found = [self._step(here, edge) for edge in self._edges(here)]
        return tuple(sorted(found, key=lambda one: (not one.permitted, str(one.address))))

    def _edges(self, here: Configuration) -> Iterator[Edge]:
        for name in self._hierarchy.order:
            yield from self._stepper.edges.out(name, here[name])

    def _step(self, here: Configuration, edge: Edge) -> OnwardStep:
        heed()
        step = self._stepper.step(here, edge)
        if isinstance(step, Unavailable):
            reasons = tuple(self._reasons(here, edge)) or step.reasons
            return OnwardStep(edge.address, edge.target, {}, reasons=reasons)
        hazard = next(met_on_the_way(self._hazards, here, step), None)
        edges = tuple(one.address for one in step.edges)
        name = hazard.name if hazard is not None else ""
        return OnwardStep(edge.address, edge.target, dict(step.after), edges, hazard=name)

    def _reasons(self, here: Configuration, edge: Edge) -> Iterator[str]:
        """Yield the usual reasons why an operation is refused, with the names of facts."""
        for name, digit, value in edge.requires:
            if digit < 0:
                return
            held = self.blueprint[name].facts(here[name])[digit]
            if held != value:
                fact = self._fact(name, digit)
                yield f"it requires {fact} to be {value}, and it is {held}"
        if edge.crossing:
            yield from self._no_base(here, edge)

    def _no_base(self, here: Configuration, edge: Edge) -> Iterator[str]:
        """Yield a sentence for each base that has no operation for a crossing of its sub-SB."""
        kind = EdgeKind.RISE if edge.crossing > 0 else EdgeKind.FALL
        sub = self.blueprint[edge.branch]
        what = "reaches" if edge.crossing > 0 else "leaves"
        for base, digit in self._hierarchy.bases[edge.branch]:
            out = self._stepper.edges.out(base, here[base])
            alone = (one for one in out if one.kind is kind and not one.load)
            if not any(digit in (*one.rises, *one.falls) for one in alone):
                yield (
                    f"it {what} {sub.activating}, the ACTIVATING state of {sub.name}, and "
                    f"{base} has no operation out of {here[base]} that changes "
                    f"{self._fact(base, digit)} alone"
                )

    def _fact(self, branch: str, digit: int) -> str:
        name = self.blueprint[branch].fact_name(digit)
        return f"{branch}/{name}" if len(self.blueprint.branches) > 1 else name

    def _in_order(self, configuration: Configuration) -> dict[str, str]:
        return {name: configuration[name] for name in self.blueprint.branches}
