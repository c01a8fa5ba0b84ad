"""Online generation: where no way leads to the goal, a provider proposes edges of library
operations (paper, sections on inspection and on the human-automation continuum).

A proposal counts for nothing until a person has allowed it. Then it is an edge like any other, in
this run only: guards, hazards and state checks decide about it, and no file gets it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

from smsl_studio.blueprint.address import Address, fact_text
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.drive.foresight import sensed_values
from smsl_studio.dispatch.drive.review import Reviewer
from smsl_studio.dispatch.execution.desk import Desk, who_words
from smsl_studio.dispatch.execution.price_updates import PriceUpdates
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.trouble import Hold
from smsl_studio.dispatch.people.board import Closed
from smsl_studio.dispatch.people.questions import generate_task
from smsl_studio.dispatch.route.course import Course
from smsl_studio.errors import PlanningError
from smsl_studio.host.protocol import Extending
from smsl_studio.library.prediction import Prediction
from smsl_studio.runlog.events import EdgeGenerated, ForecastTold
from smsl_studio.runlog.phase import NO_ROUTE
from smsl_studio.stop import restartable

MOST_QUESTIONS = 20
"""So often a provider is asked in one run."""


@dataclass(frozen=True)
class WayQuestion:
    """Where a run stands without a way. ``number`` counts the questions of the run from 1.

    ``facts`` are the sensed facts (``SB/digit``), ``shut`` the edges that are closed, with reasons.
    ``cost_from`` gives the cost of the way from a configuration to the goals, None if there is
    none; it heeds the listener (see ``stop``).
    """

    number: int
    blueprint: Blueprint
    configuration: Mapping[str, str]
    goals: Sequence[Address]
    facts: Mapping[str, str]
    shut: Mapping[Address, str]
    cost_from: Callable[[Mapping[str, str]], float | None]


@dataclass(frozen=True)
class EdgeProposal:
    """An edge that was proposed, inspected and foreseen. ``blueprint`` is the one of the question
    with this edge. ``digest`` is the SHA-256 of the answer, ``findings`` are what inspection finds
    because of the edge.
    """

    edge: Address
    target: str
    blueprint: Blueprint
    provider: str
    digest: str
    forecast: Prediction
    findings: tuple[str, ...] = ()

    @property
    def detail(self) -> str:
        """The forecast and the findings in words."""
        one = self.forecast
        words = f"Forecast: {one.verdict}" + (f" ({one.reason})" if one.reason else "")
        found = "; ".join(self.findings)
        return f"{words}. Findings: {found or 'none'}."


@dataclass(frozen=True)
class WayAnswer:
    """The proposals that may be shown, the best first, and a sentence about each other one."""

    proposals: tuple[EdgeProposal, ...] = ()
    refused: tuple[str, ...] = ()


class EdgeProposer(Protocol):
    """A provider of edges. ``name`` stands in the record. ``in_hardware`` says that a world that is
    hardware may have its edges, ``by_person`` that a person is the provider.
    """

    name: str
    in_hardware: bool
    by_person: bool

    def propose(self, question: WayQuestion) -> WayAnswer:
        """Return what is proposed. Stopped if the run must stop meanwhile. Whatever goes wrong else
        is a sentence of the answer.
        """
        ...

    def close(self) -> None:
        """Free what is needed for proposals. A second call does nothing."""
        ...


class Generation:
    """Asks a provider for a way, shows the proposals to people one after the other, and lets those
    count that they allow. Without a ``proposer`` it does nothing.

    ``made`` are the edges that count.
    """

    def __init__(
        self,
        run: LiveRun,
        course: Course,
        desk: Desk,
        reviewer: Reviewer,
        pricing: PriceUpdates,
        proposer: EdgeProposer | None,
    ) -> None:
        self.proposer = proposer
        self._shown: EdgeProposal | None = None
        self.made: dict[Address, EdgeProposal] = {}
        self._run, self._course, self._desk = run, course, desk
        self._reviewer, self._pricing = reviewer, pricing
        self._refused: dict[tuple[Address, str], str] = {}
        self._asked: tuple[object, WayAnswer] | None = None
        self._count = 0

    @property
    def shown(self) -> EdgeProposal | None:
        """The proposal that people are asked about, None if they are not."""
        asked = any(task.kind == "generate" for task in self._desk.tasks)
        return self._shown if asked else None

    def ask_from_now_on(self, proposer: EdgeProposer | None) -> None:
        """Ask this provider from now on. What was refused is not shown again."""
        self.close()
        self.proposer, self._asked = proposer, None

    def close(self) -> None:
        """Free the provider."""
        if self.proposer is not None:
            self.proposer.close()

    def sought(self, hold: Hold) -> Hold | None:
        """Ask for a way, because the run would hold for want of one. Return the hold, with what was
        proposed in vain, or None if people are asked about a proposal now.
        """
        if self.proposer is None or hold.kind != NO_ROUTE:
            return hold
        no = self._why_not(self.proposer)
        if no:
            return replace(hold, details=(no, *hold.details))
        answer = self._answer(self.proposer)
        told = list(answer.refused)
        for one in answer.proposals:
            no = self._refused.get((one.edge, one.target)) or self._objection(one)
            if not no:
                if self._show(one):
                    return None
                no = "nobody is there to allow it"
            told.append(f"{one.edge}: {one.provider} proposes it to {one.target}, but {no}")
        if not told:
            told = [f"{self.proposer.name} proposes nothing"]
        return replace(hold, details=(*told, *hold.details))

    def _why_not(self, proposer: EdgeProposer) -> str:
        """Return why nobody may be asked for a way now, or the empty text."""
        run = self._run
        if run.levels.generation == HUMAN and not proposer.by_person:
            return f"{proposer.name} is not asked: _levels leaves generation to people"
        if run.opened.hardware and not proposer.in_hardware:
            return (
                f"{proposer.name} is not asked: {run.opened.world} is hardware, and no policy "
                'says generated_edges = "confirmed"'
            )
        if not isinstance(run.host, Extending):
            return f"{proposer.name} is not asked: {run.opened.world} takes no further operations"
        unknown = [fact_text(*key) for key, one in run.senses.scene.readings.items()
                   if one.sensed and one.value is None]  # fmt: skip
        if unknown:
            return f"{proposer.name} is not asked: {', '.join(unknown)} is unknown"
        return ""

    def _answer(self, proposer: EdgeProposer) -> WayAnswer:
        """Return the answer for where the run stands. It is asked for once, as long as nothing that
        it depends on has changed.
        """
        run, course = self._run, self._course
        readings = run.senses.scene.readings
        facts = {fact_text(*k): one.value for k, one in readings.items() if one.value is not None}
        shut = dict(course.closed)
        key = (dict(run.configuration), facts, shut, len(self.made), proposer)
        if self._asked is not None and self._asked[0] == key:
            return self._asked[1]
        if self._count >= MOST_QUESTIONS:
            return WayAnswer(refused=(f"{proposer.name} was asked {self._count} times already",))
        question = WayQuestion(
            self._count + 1,
            run.blueprint,
            dict(run.configuration),
            course.goals,
            facts,
            shut,
            self._cost_from,
        )
        with restartable():
            answer = proposer.propose(question)
        self._asked, self._count = (key, answer), self._count + 1
        return answer

    def _cost_from(self, configuration: Mapping[str, str]) -> float | None:
        try:
            legs = self._course.planner.legs(configuration, self._course.goals)
        except PlanningError:
            return None
        return None if legs is None else sum(leg.cost for leg in legs)

    def _objection(self, one: EdgeProposal) -> str:
        """Return why a proposal must not be shown or not count, as the run stands now."""
        run, edge = self._run, one.edge
        if run.configuration.get(edge.branch) != edge.state:
            return f"the run does not stand in {edge.branch}/{edge.state}"
        facts = {key: reading.value for key, reading in run.senses.scene.readings.items()
                 if reading.sensed}  # fmt: skip
        for name, state in run.configuration.items():
            own = one.target if name == edge.branch else state
            for digit, value in enumerate(run.blueprint[name].facts(own)):
                if name == edge.branch or (name, digit) not in facts:
                    facts[name, digit] = value
        for hazard in run.hazards:
            if all(facts.get(key) == value for key, value in hazard.facts):
                return f"it meets the hazard {hazard.name}"
        return ""

    def _show(self, one: EdgeProposal) -> bool:
        """Tell the forecast of a proposal and ask people about it. Return whether anybody is
        there.
        """
        run, asked, now = self._run, one.forecast, sensed_values(self._run.senses.scene)
        question = generate_task(one.edge, one.target, one.provider, one.detail)
        facts = {key: "?" if value is None else value for key, value in asked.after.items()
                 if now.get(key) != value}  # fmt: skip
        told = ForecastTold(
            t=run.time,
            address=str(one.edge),
            verdict=asked.verdict,
            facts=facts,
            reason=asked.reason,
        )
        mark = run.mark
        nobody = self._desk.ask([question], partial(self._decided, one))
        if nobody:
            return False
        run.tell_before(mark, told)
        self._shown = one
        return True

    def _decided(self, one: EdgeProposal, closed: tuple[Closed, ...]) -> None:
        """Let a proposal count if a person has allowed it. Otherwise it is not shown again."""
        self._shown = None
        if not closed[0].yes:
            self._refused[one.edge, one.target] = "it was not allowed"
            return
        assert self.proposer is not None, "somebody has proposed it"
        no = self._why_not(self.proposer) or self._objection(one)
        no = no or self._take(one, who_words(closed[0]))
        if no:
            self._refused[one.edge, one.target] = no

    def _take(self, one: EdgeProposal, by: str) -> str:
        """Let an edge count from now on. Return why it cannot, if so."""
        run, host, edge = self._run, self._run.host, one.edge
        assert isinstance(host, Extending), "nobody is asked for a way in another host"
        bound, guarded = host.extend(edge, one.target)
        if bound is None:
            return f"the library binds nothing to it in {run.opened.world}"
        before = run.blueprint[edge.branch].facts(edge.state)
        after = run.blueprint[edge.branch].facts(one.target)
        changed = {fact_text(edge.branch, digit): value
                   for digit, value in enumerate(after) if before[digit] != value}  # fmt: skip
        hierarchy = Hierarchy(one.blueprint)
        run.extend(hierarchy, edge, bound, guarded)
        self._course.extend(hierarchy, run.bound)
        self._reviewer.extend(one.blueprint)
        if guarded:
            self._pricing.forget()
        self.made[edge] = one
        run.emit(
            EdgeGenerated(
                t=run.time,
                address=str(edge),
                target=one.target,
                function=bound.function,
                facts=changed,
                by=by,
                provider=one.provider,
                proposal=one.digest,
            )
        )
        return ""
