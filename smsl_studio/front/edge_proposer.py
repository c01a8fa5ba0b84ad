"""The proposer of a run: it asks who answers, and lets through what inspection and forecast let
through.

An answer is data. Nothing of it is run, opened or fetched: an edge of it is a name of the library,
a state where the run stands and a state that exists, or it is refused with a sentence.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, disagreements
from smsl_studio.blueprint.editing.generated_edges import with_edge
from smsl_studio.blueprint.hazards import first_met, guard_hazards
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.drive.generation import (
    EdgeProposal,
    EdgeProposer,
    WayAnswer,
    WayQuestion,
)
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import EditRefused, PlanningError, StudioError
from smsl_studio.front.attempts import bound_names, recovery_names
from smsl_studio.front.edge_answer import (
    LONGEST,
    ProposedEdge,
    answer_text,
    prompt_of,
    read_answer,
)
from smsl_studio.front.edge_sources import AskedSource, source_named, source_words
from smsl_studio.front.hosts import known_world
from smsl_studio.front.library_edges import LibraryEdges
from smsl_studio.front.request import RunRequest
from smsl_studio.front.twin import Twin, may_be_tried
from smsl_studio.front.twin_process import TwinProcess
from smsl_studio.generate.text.answers import AnswerFault
from smsl_studio.generate.text.kept_answers import AnsweredQuestion, kept_page
from smsl_studio.generate.text.provider import Unanswered
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.legible import one_line
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.prediction import DIFFERS, Prediction
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.world.engines import REMOTE, TABLE

NAMED = 200
"""At most so many characters of an answer stand in a sentence."""
MOST_TOLD = 20
"""At most so many refused edges are told."""
CONFIRMED = "confirmed"


class RunProposer:
    """Proposes edges of library operations for one run (see ``dispatch.drive.generation``)."""

    def __init__(self, request: RunRequest, loaded: Loaded | None = None) -> None:
        """UsageError if nobody of the name ``request.generate`` proposes edges."""
        source = source_named(request.generate)
        self.name = source_words(request.generate)
        self.by_person = source is not None and source.by_file
        self.in_hardware = request.trust is not None and (
            request.trust.generated_edges == CONFIRMED
        )
        self._source = None if source is None else AskedSource(source)
        self._request = replace(request, generate="")
        self._levels = Levels(request.blueprint, request.levels)
        self._loaded = loaded
        self._foreseen: dict[object, Prediction] = {}
        self._recovers: dict[str, frozenset[str]] = {}
        self._names: dict[str, tuple[str, ...]] | None = None

    @property
    def answered(self) -> Sequence[AnsweredQuestion]:
        """The questions with their answers, empty for the reader."""
        return () if self._source is None else self._source.answered

    def close(self) -> None:
        """Forget what was foreseen. Simulated worlds are freed when they have been asked."""
        self._foreseen = {}

    def propose(self, question: WayQuestion) -> WayAnswer:
        """Return the proposals that may be shown, and why the others may not."""
        try:
            names = self._library(question)
            text, model = self._answer(question, names)
        except (Unanswered, StudioError) as error:
            words = error.sentence
            return WayAnswer(refused=(f"{self.name} proposes nothing: {words}",))
        try:
            if len(text) > LONGEST:
                raise AnswerFault([f"the answer has more than {LONGEST:,} characters"])
            edges = read_answer(text)
        except AnswerFault as error:
            told = one_line("; ".join(error.faults))[:NAMED]
            return WayAnswer(refused=(f"the answer of {model} does not fit: {told}",))
        digest = sha256_hex(text.encode("utf-8", "replace"))
        found: list[EdgeProposal] = []
        refused: list[str] = []
        for one in edges:
            checked = self._checked(question, one, names, (model, digest))
            if isinstance(checked, str):
                name = one_line(one.edge)[:NAMED]
                refused.append(f"{name}: {model} proposes it, but {checked}")
            else:
                found.append(checked)
        return WayAnswer(tuple(found), tuple(refused[:MOST_TOLD]))

    # who answers -------------------------------------------------------------------------------

    def _answer(self, question: WayQuestion, names: dict[str, tuple[str, ...]]) -> tuple[str, str]:
        """Return the text of an answer, and who has given it."""
        if self._source is not None:
            found = self._source.ask(prompt_of(question, names), question.number)
            return found.text, one_line(found.model)
        table = self._request.world == TABLE
        trial = None if table or not self._may_try else partial(self.tried, question)
        library = LibraryEdges(
            question, names, self._recovers, partial(self._foresee, question), trial
        )
        leading = library.leading()
        told = [(str(one.edge), one.target, one.why) for one in leading]
        return answer_text(told), self.name

    def _library(self, question: WayQuestion) -> dict[str, tuple[str, ...]]:
        """Return the operations of each SB that the library binds in this world. In the table world
        these are those of the blueprint."""
        if self._names is None:
            world, found = self._request.world, {}
            self._known()
            for branch in question.blueprint:
                names = dict.fromkeys(branch.operation_names)
                if self._loaded is not None and world not in (TABLE, REMOTE):
                    more = bound_names(self._loaded, world, branch, recovery=True)
                    names |= dict.fromkeys(more)
                    own = recovery_names(self._loaded, world, branch)
                    self._recovers[branch.name] = own
                found[branch.name] = tuple(sorted(names))
            self._names = found
        return self._names

    def _known(self) -> None:
        request = self._request
        if self._loaded is None and request.world not in (TABLE, REMOTE):
            self._loaded = known_world(request.world, request.plugin_paths, request.host)

    @property
    def _may_try(self) -> bool:
        self._known()
        return may_be_tried(self._request.world, self._loaded)

    # what is let through -----------------------------------------------------------------------

    def _checked(
        self,
        question: WayQuestion,
        one: ProposedEdge,
        names: dict[str, tuple[str, ...]],
        given: tuple[str, str],
    ) -> EdgeProposal | str:
        """Return the proposal, or why it must not be shown. ``given`` is who has answered, and the
        digest of the answer."""
        blueprint, edge = question.blueprint, Address.read(one.edge)
        if edge is None or not edge.operation or edge.branch not in blueprint.branches:
            return "it is no address of an operation"
        no = self._misfit(question, edge, one.target, names)
        if no:
            return no
        origin = {"how": "online", "stage": "edges", "model": given[0], "answer": given[1]}
        try:
            made = with_edge(blueprint, edge, one.target, origin)
        except EditRefused as error:
            return one_line(error.sentence)
        after = {**question.configuration, edge.branch: one.target}
        hazard = first_met(guard_hazards(made), after)
        if hazard is not None:
            return f"it meets the hazard {hazard.name}"
        new = _new_findings(blueprint, made)
        errors = [
            f"{found.rule} {found.message}" for found in new if found.severity is Severity.ERROR
        ]
        if errors:
            return f"inspection finds an error: {errors[0]}"
        if not self._leads(question, made, edge):
            return "it does not lead to the goal"
        forecast = self._foresee(question, edge, one.target)
        if forecast.verdict == DIFFERS:
            return f"its forecast differs: {forecast.reason}"
        told = tuple(dict.fromkeys(f"{found.rule} ({found.severity.value})" for found in new))
        return EdgeProposal(edge, one.target, made, *given, forecast, told)

    def _misfit(
        self,
        question: WayQuestion,
        edge: Address,
        target: str,
        names: dict[str, tuple[str, ...]],
    ) -> str:
        """Return why an edge cannot be one of this run, or the empty text."""
        branch = question.blueprint[edge.branch]
        if question.configuration[edge.branch] != edge.state:
            return f"{edge.branch} stands in {question.configuration[edge.branch]}"
        if edge in question.shut:
            return f"it is {question.shut[edge]}"
        if edge.operation in branch.table[edge.state]:
            return "the blueprint has an operation of this name there"
        if edge.operation not in names[edge.branch]:
            return f"the library has no such operation in the world {self._request.world}"
        if target not in branch.table:
            return f"{one_line(target)[:NAMED]} is no state of {edge.branch}"
        before, facts = branch.facts(edge.state), branch.facts(target)
        changed = [digit for digit, value in enumerate(facts) if before[digit] != value]
        if not changed:
            return "it changes no fact"
        if any(digit in branch.subs for digit in changed):
            return "it changes a fact that a sub-SB expands"
        for row in branch.table.values():
            other = branch.facts(row[edge.operation]) if edge.operation in row else facts
            odd = [digit for digit in changed if other[digit] != facts[digit]]
            if odd:
                known = f"{branch.fact_name(odd[0])} to {other[odd[0]]}"
                return f"elsewhere {edge.operation} brings {known}"
        after = {**question.configuration, edge.branch: target}
        if disagreements(Hierarchy(question.blueprint), after):
            return "its sub-SB would disagree with its base"
        return ""

    def _leads(self, question: WayQuestion, made: Blueprint, edge: Address) -> bool:
        """Return whether a way to the goals has the edge."""
        planner = Planner(Hierarchy(made), Terms(question.shut, hazards=guard_hazards(made)))
        try:
            legs = planner.legs(question.configuration, question.goals)
        except PlanningError:
            return False
        return any(edge in leg.operations for leg in legs or ())

    # forecasts ---------------------------------------------------------------------------------

    def _foresee(self, question: WayQuestion, edge: Address, target: str) -> Prediction:
        """Return the forecast of an edge. It is made once for each place."""
        key = (tuple(question.configuration.items()), edge, target, question.number)
        if key not in self._foreseen:
            try:
                made = with_edge(question.blueprint, edge, target)
            except EditRefused as error:
                return Prediction(DIFFERS, reason=error.sentence)
            twin = self._twin(made)
            try:
                self._foreseen[key] = self._by_whom(twin, question, edge)
            finally:
                twin.close()
        return self._foreseen[key]

    def _by_whom(
        self, twin: Twin | TwinProcess, question: WayQuestion, edge: Address
    ) -> Prediction:
        from smsl_studio.dispatch.drive.foresight import BY_PERSON

        if self._levels.of(question.blueprint).operation(edge) == "human":
            return BY_PERSON
        return twin.predict(dict(question.configuration), edge)

    def _twin(self, blueprint: Blueprint) -> Twin | TwinProcess:
        """Return a simulated world beside the run, in a process of its own as that of the run."""
        make = Twin if self._request.host == "local" else TwinProcess
        return make(replace(self._request, blueprint=blueprint), self._loaded)

    def tried(
        self, question: WayQuestion, edges: Sequence[Address]
    ) -> Iterator[tuple[Address, Prediction]]:
        """Yield what each operation changes in a simulated world, from where the run stands."""
        for edge in edges:
            try:
                made = with_edge(question.blueprint, edge, edge.state)
            except EditRefused:
                continue
            twin = self._twin(made)
            try:
                yield edge, twin.predict(dict(question.configuration), edge)
            finally:
                twin.close()


def _new_findings(before: Blueprint, after: Blueprint) -> list[Finding]:
    """Return the findings that inspection has only because of the new edge."""
    known = {(one.rule, str(one.address)) for one in inspect(before)}
    return [one for one in inspect(after) if (one.rule, str(one.address)) not in known]


def kept_answers(proposer: EdgeProposer) -> str:
    """Return the file with the answers that a proposer got, empty if it asked nobody."""
    if not isinstance(proposer, RunProposer) or not proposer.answered:
        return ""
    return kept_page(proposer.answered, (), ())
