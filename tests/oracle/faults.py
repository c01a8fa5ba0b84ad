"""Deliberate faults: for each clause, a change of the program that breaks the clause.

Each replaces one part of the program. ``numbers`` are cases for which the oracle must then name the
clause; without the fault it finds nothing in them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import pytest

from smsl_studio.blueprint import stepper
from smsl_studio.blueprint.along import Along
from smsl_studio.blueprint.check import CheckResult, Term
from smsl_studio.blueprint.configuration import start_configuration
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.joint import StepDraft
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch import dispatcher
from smsl_studio.dispatch.drive import admission as admitting
from smsl_studio.dispatch.drive import arrival, start
from smsl_studio.dispatch.drive.driver import Driver
from smsl_studio.dispatch.drive.hazard_watch import HazardWatch
from smsl_studio.dispatch.drive.review import ALLOWED, Reviewer
from smsl_studio.dispatch.drive.supervisor import Verdict
from smsl_studio.dispatch.execution import (
    carrier,
    guards,
    hazard_guard,
    safeguards,
    step_watch,
    trouble,
)
from smsl_studio.dispatch.execution.carrier import Carrier
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.safeguards import Safeguards
from smsl_studio.dispatch.execution.senses import Senses
from smsl_studio.dispatch.execution.trouble import Trouble
from smsl_studio.dispatch.route import goals
from smsl_studio.dispatch.route.course import Course
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.library import table
from smsl_studio.monitor import facts as monitor_facts
from smsl_studio.monitor.aggregate import Aggregate
from smsl_studio.monitor.ledger import Ledger
from smsl_studio.runlog.events import OperationStarted

Patch = pytest.MonkeyPatch


@dataclass(frozen=True)
class Fault:
    """A part of a clause that is broken on purpose, and where the oracle must see it."""

    clause: int
    words: str
    apply: Callable[[Patch], None]
    numbers: tuple[int, ...] = ()

    def __str__(self) -> str:
        return f"{self.clause} {self.words}"


# 1, 2, 3: sub digits, classes, start ------------------------------------------------------------


def _one_is_on(patch: Patch) -> None:
    patch.setattr(StateBranch, "is_on", lambda self, state, digit: self.facts(state)[digit] == "1")


def _nothing_disagrees(patch: Patch) -> None:
    patch.setattr(stepper, "disagreements", lambda hierarchy, configuration: ())
    patch.setattr(Along, "edges_for", lambda self, *_: ())


def _mixed_has_no_function(patch: Patch) -> None:
    whole = Edges._edge

    def less(self: Edges, *found: Any) -> Any:
        edge = whole(self, *found)
        own = edge.load or edge.kind.value != "mixed" or edge.address in self.exact
        return edge if own else replace(edge, function=False)

    patch.setattr(Edges, "_edge", less)


def _given_subs_are_ignored(patch: Patch) -> None:
    whole = start_configuration

    def roots_only(hierarchy: Any, given: Any) -> dict[str, str]:
        return whole(hierarchy, {k: v for k, v in given.items() if k in hierarchy.roots})

    patch.setattr(start, "start_configuration", roots_only)


def _start_is_not_checked(patch: Patch) -> None:
    patch.setattr(start, "check_words", lambda *_: "")
    whole = start.start_events

    def unchecked(run: LiveRun, *rest: Any) -> Any:
        with pytest.MonkeyPatch.context() as inner:
            inner.setattr(run, "checks", lambda configuration: ())
            return whole(run, *rest)

    patch.setattr("smsl_studio.dispatch.drive.start_tasks.start_events", unchecked)


# 4, 5, 6: guards, carrying out, commits ---------------------------------------------------------


def _source_is_not_checked(patch: Patch) -> None:
    patch.setattr(guards, "_sources", lambda run, step: [])


def _required_is_not_sensed(patch: Patch) -> None:
    patch.setattr(guards, "_required", lambda run, step: iter(()))
    patch.setattr(Safeguards, "_unmet", lambda self, *_: iter(()))


def _nobody_confirms(patch: Patch) -> None:
    patch.setattr(admitting, "confirmations", lambda run, step: ())


def _the_supervisor_is_not_heard(patch: Patch) -> None:
    whole = Reviewer.verdict

    def deaf(self: Reviewer, run: LiveRun, step: Any) -> Verdict:
        whole(self, run, step)
        return ALLOWED

    patch.setattr(Reviewer, "verdict", deaf)


def _avoided_edges_are_used(patch: Patch) -> None:
    patch.setattr(Terms, "closures", lambda self, edge: iter(()))


def _rises_come_first(patch: Patch) -> None:
    def turned(self: Any, script: Any, edge: Any, held: Any) -> None:
        subs = dict(self.hierarchy.subs[edge.branch])
        for digit in reversed((*edge.falls, *edge.rises)):
            branch = self.hierarchy.blueprint[subs[digit]]
            goal = branch.activating if digit in edge.rises else branch.initial
            if script.configuration[branch.name] == goal:
                continue
            if branch.name in self.plain:
                route = self._plain_route(script.configuration, branch, goal)
            else:
                route = self._sub_route(script.configuration, branch, goal, held).edges
            for part in route:
                self._carry(script, part, held)

    patch.setattr(stepper.Stepper, "_drive", turned)


def _bases_do_not_tell_that_they_start(patch: Patch) -> None:
    whole = Carrier._begin

    def silent(self: Carrier, shut: Any) -> None:
        before = len(self._run.events)
        whole(self, shut)
        told = self._run.events[before:]
        kept = [
            one
            for one in told
            if not isinstance(one, OperationStarted) or one.address == str(self.action.edge)
        ]
        self._run.events[before:] = kept

    patch.setattr(Carrier, "_begin", silent)


def _crossings_commit_alone(patch: Patch) -> None:
    patch.setattr(stepper.Stepper, "_link", lambda self, *_: None)
    patch.setattr(
        stepper.Stepper, "_last_crossing", lambda self, script, _: len(script.functions) - 1
    )


def _the_base_waits_for_the_whole_fall(patch: Patch) -> None:
    """A base edge commits only when its sub-routes have ended, and not with the last crossing."""
    patch.setattr(
        stepper.Stepper, "_last_crossing", lambda self, script, _: len(script.functions) - 1
    )


# 7, 8: outcome, failure -------------------------------------------------------------------------


def _unknown_is_good_enough(patch: Patch) -> None:
    whole = LiveRun.check

    def lenient(self: LiveRun, *rest: Any) -> CheckResult:
        found = whole(self, *rest)
        terms = tuple(replace(t, truth=True) if t.truth is None else t for t in found.terms)
        return CheckResult(found.branch, found.state, terms)

    _only_in_deciding(patch, lenient)


def _the_check_does_not_decide(patch: Patch) -> None:
    whole = LiveRun.check

    def blind(self: LiveRun, *rest: Any) -> CheckResult:
        found = whole(self, *rest)
        return CheckResult(found.branch, found.state, tuple(_true(term) for term in found.terms))

    _only_in_deciding(patch, blind)


def _true(term: Term) -> Term:
    return replace(term, truth=True)


def _only_in_deciding(patch: Patch, check: Callable[..., CheckResult]) -> None:
    whole = Carrier._decide

    def deciding(self: Carrier, looked: bool = False) -> None:
        with pytest.MonkeyPatch.context() as inner:
            inner.setattr(LiveRun, "check", check)
            whole(self, looked)

    patch.setattr(Carrier, "_decide", deciding)


def _a_told_failure_is_none(patch: Patch) -> None:
    patch.setattr(carrier, "fault_words", lambda edge, tick: "")


def _nothing_settles(patch: Patch) -> None:
    def at_once(self: Carrier, looked: bool = False) -> None:
        self._until = self._run.time
        self._decide(looked)

    patch.setattr(Carrier, "_settle", at_once)


def _nothing_is_risky(patch: Patch) -> None:
    whole = Trouble.blame
    patch.setattr(
        Trouble,
        "blame",
        lambda self, step, failure: whole(self, step, replace(failure, risky=False)),
    )


def _it_adopts_unasked(patch: Patch) -> None:
    whole = Trouble.__init__
    patch.setattr(Trouble, "__init__", lambda self, run, course, _: whole(self, run, course, True))


def _it_goes_on_from_anywhere(patch: Patch) -> None:
    patch.setattr(trouble, "stands", lambda run, configuration: True)


# 9: integrity, what must stay true, the end -----------------------------------------------------


def _integrity_is_not_watched(patch: Patch) -> None:
    patch.setattr(LiveRun, "broken", lambda self: ())


def _required_may_be_lost(patch: Patch) -> None:
    patch.setattr(Safeguards, "_unmet", lambda self, *_: iter(()))


def _critical_may_be_lost(patch: Patch) -> None:
    patch.setattr(safeguards, "lost_critical", lambda *_: ())


def _critical_is_not_asked_before(patch: Patch) -> None:
    patch.setattr(guards, "lost_critical", lambda run: ())
    patch.setattr(Driver, "_lost", lambda self: False)
    patch.setattr(Safeguards, "begin", lambda self, action: ())


def _people_are_asked_first(patch: Patch) -> None:
    patch.setattr("smsl_studio.dispatch.drive.integrity.all_theirs", lambda *_: True)


def _goals_are_believed(patch: Patch) -> None:
    patch.setattr(arrival, "_doubtful", lambda run, here: False)
    patch.setattr(Senses, "late", lambda self, since, facts: ())
    whole = arrival.Arrival.look

    def look(self: arrival.Arrival) -> None:
        with pytest.MonkeyPatch.context() as inner:
            inner.setattr(self._integrity, "lost", lambda: False)
            whole(self)

    patch.setattr(arrival.Arrival, "look", look)
    patch.setattr(LiveRun, "broken", lambda self: ())


def _goals_are_told_at_once(patch: Patch) -> None:
    whole = Driver._after

    def after(self: Driver, carrier: Carrier) -> None:
        whole(self, carrier)
        if self.carrier is None and self.ended is None and self.state.held is None:
            self.arrival._tell(self.arrival._reached)

    patch.setattr(Driver, "_after", after)


# 10, 11, 12: asked directly, goals, routes ------------------------------------------------------


def _the_dearest_goes_along(patch: Patch) -> None:
    whole = Along._singles
    patch.setattr(Along, "_singles", lambda self, *rest: whole(self, *rest)[::-1])


def _a_base_without_a_rise_is_left(patch: Patch) -> None:
    patch.setattr(Along, "_singles", lambda self, *_: [])
    patch.setattr(Along, "_take", lambda self, *_: None)


def _only_roots_may_be_asked(patch: Patch) -> None:
    whole = Planner._movers
    patch.setattr(
        Planner,
        "_movers",
        lambda self, branches: (
            [name for name in whole(self, branches) if not self.hierarchy.bases[name]]
            or whole(self, branches)
        ),
    )


def _goals_are_turned_round(patch: Patch) -> None:
    whole = goals.goals_of
    patch.setattr(start, "goals_of", lambda hierarchy, asked: whole(hierarchy, asked)[::-1])


def _contradictions_are_accepted(patch: Patch) -> None:
    patch.setattr(goals, "_contradictions", lambda hierarchy, wanted: None)


def _what_holds_is_not_left(patch: Patch) -> None:
    whole = Planner._movers

    def last_only(self: Planner, branches: Any) -> Any:
        return whole(self, list(branches)[-1:])

    patch.setattr(Planner, "_movers", last_only)


def _every_edge_costs_the_same(patch: Patch) -> None:
    whole = Edges._edge

    def flat(self: Edges, *rest: Any) -> Any:
        return replace(whole(self, *rest), cost=1.0)

    patch.setattr(Edges, "_edge", flat)


def _subs_cost_nothing(patch: Patch) -> None:
    whole = StepDraft.begin

    def begin(self: StepDraft, edge: Any, *rest: Any) -> Any:
        crossing = bool(self.carried) and edge.crossing
        return whole(self, replace(edge, cost=0.0) if crossing else edge, *rest)

    patch.setattr(StepDraft, "begin", begin)


# 13, 14, 15: unknown, table, time ---------------------------------------------------------------


def _nothing_is_stale(patch: Patch) -> None:
    whole = Ledger.__init__
    patch.setattr(Ledger, "__init__", lambda self, name, _: whole(self, name, 1e9))


def _the_first_sensor_wins(patch: Patch) -> None:
    def first(rule: Any, said: Any) -> Aggregate:
        known = [one for one in said if one.value is not None]
        return Aggregate(known[0].value if known else None, "")

    patch.setattr(monitor_facts, "aggregate", first)


def _a_cancelled_operation_moved_nothing(patch: Patch) -> None:
    patch.setattr(Senses, "doubt", lambda self, facts, reason: ())


def _load_sets_no_subs(patch: Patch) -> None:
    patch.setattr(table, "_facts_below", lambda *_: {})


def _one_fact_is_forgotten(patch: Patch) -> None:
    whole = table.facts_of

    def fewer(branch: Any, state: str) -> Any:
        found = whole(branch, state)
        return dict(list(found.items())[:-1]) if len(found) > 1 else found

    patch.setattr(table, "facts_of", fewer)


def _time_passes_in_a_pause(patch: Patch) -> None:
    whole = Driver.go_on

    def going(self: Driver) -> None:
        if self.phase == "paused" and self.ended is None:
            self._tick()
        whole(self)

    patch.setattr(Driver, "go_on", going)


def _two_steps_of_the_world(patch: Patch) -> None:
    whole = Senses.tick

    def twice(self: Senses) -> Any:
        whole(self)
        return whole(self)

    patch.setattr(Senses, "tick", twice)


# 16: hazards


def _routes_go_through_hazards(patch: Patch) -> None:
    def blind(hierarchy: Any, goals: Any, bound: Any, shut: Any, hazards: Any) -> Course:
        return Course(hierarchy, goals, bound, shut)

    patch.setattr(dispatcher, "Course", blind)


def _nothing_objects(patch: Patch) -> None:
    _routes_go_through_hazards(patch)
    patch.setattr(admitting, "objection", lambda run, step: None)


def _unknown_facts_complete_nothing(patch: Patch) -> None:
    patch.setattr(hazard_guard, "_open", lambda run, hazard, actions, changed: None)


def _later_functions_are_not_asked(patch: Patch) -> None:
    patch.setattr(carrier, "objection_to", lambda run, action: None)


def _hazards_are_not_watched_in_motion(patch: Patch) -> None:
    patch.setattr(step_watch, "newly_met", lambda run: ())


def _hazards_are_not_watched_while_idle(patch: Patch) -> None:
    patch.setattr(HazardWatch, "holds", lambda self: False)


def _a_start_in_a_hazard_is_fine(patch: Patch) -> None:
    patch.setattr(start, "_refuse_hazards", lambda hazards: None)


def _everything_is_refused_for_a_hazard(patch: Patch) -> None:
    def objects(run: Any, step: Any) -> Any:
        if not run.hazards:
            return None
        return hazard_guard.Objection(run.hazards[0].name, "it is dangerous")

    patch.setattr(admitting, "objection", objects)


FAULTS: tuple[Fault, ...] = (
    Fault(1, "on is always 1", _one_is_on, (34202,)),
    Fault(1, "bases and subs may disagree", _nothing_disagrees, (20, 21)),
    Fault(2, "a mixed edge runs no function of its own", _mixed_has_no_function, (18, 44)),
    Fault(3, "a start given for a sub is ignored", _given_subs_are_ignored, (0, 5)),
    Fault(3, "a start is not checked", _start_is_not_checked, (1354, 1368)),
    Fault(4, "the source is not checked", _source_is_not_checked, (6, 8)),
    Fault(4, "what is required is not sensed", _required_is_not_sensed, (341, 1123)),
    Fault(4, "nobody confirms", _nobody_confirms, (6, 34)),
    Fault(4, "the supervisor is not heard", _the_supervisor_is_not_heard, (24, 32)),
    Fault(4, "avoided edges are used", _avoided_edges_are_used, (24, 7)),
    Fault(5, "rises come before falls", _rises_come_first, (311, 454)),
    Fault(5, "a base does not tell that it starts", _bases_do_not_tell_that_they_start, (3, 15)),
    Fault(6, "crossings commit alone", _crossings_commit_alone, (18, 78)),
    Fault(6, "a base waits for the whole fall", _the_base_waits_for_the_whole_fall, (412, 532)),
    Fault(7, "the target's check does not decide", _the_check_does_not_decide, (6, 8)),
    Fault(7, "a told failure is none", _a_told_failure_is_none, (687, 729)),
    Fault(7, "nothing settles", _nothing_settles, (12, 15)),
    Fault(8, "nothing is risky", _nothing_is_risky, (24, 26)),
    Fault(8, "it adopts unasked", _it_adopts_unasked, (6, 8)),
    Fault(8, "it goes on from anywhere", _it_goes_on_from_anywhere, (8, 17)),
    Fault(9, "integrity is not watched", _integrity_is_not_watched, (26, 31)),
    Fault(9, "what is required may be lost", _required_may_be_lost, (207, 726)),
    Fault(9, "critical facts may be lost", _critical_may_be_lost, (162, 328)),
    Fault(9, "critical facts are not asked before", _critical_is_not_asked_before, (48, 95)),
    Fault(9, "people are asked before it holds", _people_are_asked_first, (10905, 4336)),
    Fault(9, "goals are believed", _goals_are_believed, (26, 31)),
    Fault(9, "goals are told at once", _goals_are_told_at_once, (3, 8)),
    Fault(10, "the dearest goes along", _the_dearest_goes_along, (64, 95)),
    Fault(10, "a base without a rise is left", _a_base_without_a_rise_is_left, (21, 30)),
    Fault(11, "only roots may be asked", _only_roots_may_be_asked, (20, 40)),
    Fault(11, "goals are turned round", _goals_are_turned_round, (4, 9)),
    Fault(11, "contradictions are accepted", _contradictions_are_accepted, (441, 442)),
    Fault(11, "what holds is not left", _what_holds_is_not_left, (5619,)),
    Fault(12, "every edge costs the same", _every_edge_costs_the_same, (3, 10)),
    Fault(12, "a driven sub costs nothing", _subs_cost_nothing, (3, 13)),
    Fault(13, "unknown is good enough", _unknown_is_good_enough, (17, 32)),
    Fault(13, "nothing is stale", _nothing_is_stale, (0, 6)),
    Fault(13, "the first sensor wins", _the_first_sensor_wins, (9, 16)),
    Fault(13, "a cancelled operation moved nothing", _a_cancelled_operation_moved_nothing, (623,)),
    Fault(14, "load sets no subs", _load_sets_no_subs, (8, 17)),
    Fault(14, "one fact is forgotten", _one_fact_is_forgotten, (7, 8)),
    Fault(15, "time passes in a pause", _time_passes_in_a_pause, (40, 201)),
    Fault(15, "the world steps twice", _two_steps_of_the_world, (0, 1)),
    Fault(16, "routes go through hazards", _routes_go_through_hazards, (28, 35)),
    Fault(16, "nothing objects", _nothing_objects, (28, 35)),
    Fault(16, "unknown facts complete nothing", _unknown_facts_complete_nothing, (3519, 7356)),
    Fault(16, "later functions are not asked", _later_functions_are_not_asked, (1029, 2269)),
    Fault(16, "nobody watches in motion", _hazards_are_not_watched_in_motion, (33, 1473)),
    Fault(16, "nobody watches while idle", _hazards_are_not_watched_while_idle, (79, 193)),
    Fault(16, "a start in a hazard is fine", _a_start_in_a_hazard_is_fine, (171, 262)),
    Fault(16, "everything is refused", _everything_is_refused_for_a_hazard, (22, 33)),
)
