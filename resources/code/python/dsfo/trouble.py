"""Failures: the run relocalises, and then goes on, adopts a configuration or holds (clauses 8 and
9). Nothing is undone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice, product

from .carrier import Failure
from .checks import fitting
from .course import Course, goal_text
from .elements import Hazard
from .errors import PlanningError
from .goals import Goal, holds
from .hazards import met, met_words, named
from .hierarchy import disagreements
from .joint import JointStep
from .live import LiveRun

HELD, NO_ROUTE, GUARD_LOST = "held", "no_route", "guard_lost"
GOAL_UNCONFIRMED, HAZARD = "goal_unconfirmed", "hazard"
MOST = 8
"""The largest number of configurations that are named as fitting the scene."""


@dataclass(frozen=True)
class Hold:
    """Why a run cannot go on by itself. ``skipped`` are the vetoed edges of a run without a
    route.
    """

    reason: str
    details: Sequence[str] = ()
    kind: str = HELD
    skipped: Sequence[str] = field(default_factory=tuple)

    @property
    def ends(self) -> str:
        """The reason for the end of the run if nobody is there to decide."""
        return NO_ROUTE if self.kind == NO_ROUTE else HELD


class Trouble:
    """Brings a run back to a configuration that the scene confirms, or says why it must hold.

    ``candidates`` are the configurations that fitted the scene at the last look.
    """

    def __init__(self, run: LiveRun, course: Course, adopts: bool) -> None:
        self.candidates: list[dict[str, str]] = []
        self._run, self._course, self._adopts = run, course, adopts

    def blame(self, step: JointStep, failure: Failure) -> None:
        """Tag the failed operation and the edge of the root as risky, if it is to blame."""
        run = self._run
        roots = [edge for edge in step.edges if edge.branch in run.hierarchy.roots]
        for edge in dict.fromkeys((failure.edge, *roots)) if failure.risky else ():
            self._course.tag_risky(edge.address, failure.reason)
            run.tell("operation_risky", address=edge.address, reason=failure.reason)
        self._course.drop_plan()
        run.drop_pending()

    def after(self, failure: Failure) -> Hold | None:
        """Relocalise after a failure. If a move of the sub-SB alone explains the scene, it is
        adopted.
        """
        if failure.hazards:
            return self.lost(failure.lost, failure.reason, HAZARD)
        if failure.lost:
            return self.lost(failure.lost, failure.reason)
        if not failure.pending and not self._run.stands(self._run.configuration):
            alone = self._sub_alone(failure.edge.branch)
            if alone is not None:
                self.adopt(alone)
                return None
        return self.relocalise(failure.reason)

    def lost(self, facts: Sequence[str], cause: str = "", kind: str = GUARD_LOST) -> Hold:
        """Return a hold for needed facts that were lost. Nothing is adopted."""
        found = self.relocalise(adopts=False)
        details = dict.fromkeys([*facts, *(found.details if found else ())])
        return Hold(cause or "; ".join(facts), list(details), kind)

    def endangered(self, hazards: Sequence[Hazard], observes: bool) -> Hold:
        """Return a hold for hazards that are met. A run that only observes is not located."""
        facts = met_words(hazards)
        return Hold("; ".join(facts), facts, HAZARD) if observes else self.lost(facts, kind=HAZARD)

    def unconfirmed(self, goals: Sequence[Goal]) -> Hold | None:
        """Return a hold if the scene does not confirm goals at which the run believes to be."""
        found = self.relocalise()
        failed = [one for one in (self._run.check(*g) for g in goals) if one.truth is not True]
        if found is None or not failed:
            return found
        words = "; ".join(map(self._run.why_not, failed))
        reason = f"The goal is not confirmed: {words}"
        return replace(found, reason=reason, kind=GOAL_UNCONFIRMED)

    def relocalise(self, cause: str = "", adopts: bool = True) -> Hold | None:
        """Read the scene. Go on if it confirms the committed configuration; else adopt the only one
        that fits, if the terms of the run say so, or return a hold.
        """
        run, self.candidates = self._run, []
        run.drop_pending()
        run.look()
        if run.stands(run.configuration):
            run.tell("relocalised", configuration=dict(run.configuration))
            return None
        checks = run.checks(run.configuration)
        facts = [word for c in checks for word in run.words([*c.misses, *c.unknown])]
        self.candidates = self._agreeing(self._true_states)
        run.tell("mismatch", facts=facts, candidates=self.candidates)
        only = self.candidates[0] if len(self.candidates) == 1 else None
        if adopts and self._adopts and not met(run) and only is not None and run.stands(only):
            self.adopt(only)
            return None
        first = next(check for check in checks if check.truth is not True)
        return Hold(cause or run.why_not(first), facts)

    def adopt(self, configuration: Mapping[str, str]) -> None:
        """Go on from a configuration that fits the scene."""
        self.candidates = []
        self._run.relocate(configuration)
        self._course.drop_plan()
        self._run.tell("relocalised", configuration=dict(self._run.configuration))

    # which configurations fit the scene ----------------------------------------------------------

    def located(self) -> list[dict[str, str]]:
        """Return the consistent configurations that fit the scene, from the scene alone."""
        return self._agreeing(self._estimated)

    def _agreeing(
        self, states_of: Callable[[str, Mapping[str, str]], list[str]]
    ) -> list[dict[str, str]]:
        """Return the consistent configurations made of states that fit: sub-SBs first, then the
        bases decide which of its states a sub-SB may be in.
        """
        run, known = self._run, self._run.hierarchy
        believed, found = dict(run.configuration), dict[str, list[str]]()
        for name in reversed(known.order):
            found[name] = states_of(name, believed)
            if not found[name]:
                return []
            believed[name] = found[name][0]
        for name in known.order:
            for base, digit in known.bases[name]:
                # All fitting states of an SB have the same facts, so the first one decides.
                on = run.blueprint[base].is_on(found[base][0], digit)
                found[name] = [one for one in found[name] if known.is_active(name, one) == on]
            if not found[name]:
                return []
        names = list(run.configuration)
        every = product(*(found[name] for name in names))
        fitting_ones = (dict(zip(names, states, strict=True)) for states in islice(every, MOST))
        return [one for one in fitting_ones if run.stands(one)]

    def _true_states(self, name: str, believed: Mapping[str, str]) -> list[str]:
        committed = self._run.configuration[name]
        check = self._run.checking(believed).of(name, committed)
        return [committed] if check.truth is True else self._estimated(name, believed)

    def _estimated(self, name: str, believed: Mapping[str, str]) -> list[str]:
        return fitting(self._run.blueprint, name, self._run.senses.scene, believed)

    def _sub_alone(self, branch: str) -> dict[str, str] | None:
        """Return the configuration in which only this sub-SB has moved, if that explains the scene
        and it has not crossed.
        """
        run = self._run
        states = self._true_states(branch, run.configuration)
        if not run.hierarchy.bases[branch] or len(states) != 1:
            return None
        moved = {**run.configuration, branch: states[0]}
        if disagreements(run.hierarchy, moved) or not run.stands(moved):
            return None
        return moved

    # no route ------------------------------------------------------------------------------------

    def no_way(self, details: Sequence[str]) -> Hold:
        """Return a hold for a run without a route. It names the risky edges that would make one, or
        else what closes the way.
        """
        run, course = self._run, self._course
        goal = next(goal_text(one) for one in course.goals if not holds(run.configuration, [one]))
        risky = course.risky_way(run.configuration)
        if risky:
            words = [f"{edge}: {course.risky[edge]}" for edge in risky]
            return Hold(f"Only risky operations lead to {goal}: {', '.join(risky)}.", words)
        here = ", ".join(f"{name}/{state}" for name, state in run.configuration.items())
        sentence = f"Nothing permitted leads from {here} to {goal}"
        blocking = self._blocking()
        told = {line.partition(":")[0] for line in details}
        words = [
            f"{edge}: stands in the way, {reason}"
            for edge, reason in blocking.items()
            if edge not in told
        ]
        hazards = [] if blocking else self._hazards()
        if blocking:
            sentence += f"; it would with {', '.join(blocking)}"
        elif hazards:
            sentence += f"; it would through {named(hazards)}"
        return Hold(f"{sentence}.", [*words, *details], NO_ROUTE, tuple(course.vetoed))

    def _blocking(self) -> dict[str, str]:
        try:
            return self._course.blocking(self._run.configuration)
        except PlanningError:
            return {}

    def _hazards(self) -> list[Hazard]:
        try:
            return self._course.hazards_between(self._run.configuration)
        except PlanningError:
            return []
