"""The automatic supervisors of the program: ``limit``, ``rules``, ``familiar``, ``forecast``."""

from __future__ import annotations

from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.front.agents.known_edges import known_edges, unfamiliar
from smsl_studio.front.agents.rule_table import decision, read_rules
from smsl_studio.library.operation_library import OperationLibrary
from smsl_studio.library.prediction import DIFFERS, NONE
from smsl_studio.library.supervisor_view import (
    ANSWERS,
    APPROVE,
    ASK,
    TAKE_OVER,
    VETO,
    SupervisorView,
)

Answer = tuple[str, str]
ABOVE = (ASK, VETO, TAKE_OVER)


def shipped() -> OperationLibrary:
    """Return a library with these supervisors, registered as those of a plugin are."""
    library = OperationLibrary("smsl_studio")

    @library.supervisor("limit", prepare=_check_limit)
    def limit(view: SupervisorView, risk: float = 0.5, above: str = VETO) -> Answer:
        """Approve operations up to an estimated risk. ``above`` is the answer to all others."""
        said = ", ".join(view.estimate.reasons)
        if view.estimate.risk > risk:
            return above, f"a risk of {view.estimate.risk:.0%} is above {risk:.0%}: {said}"
        return APPROVE, f"a risk of {view.estimate.risk:.0%}: {said}"

    @library.supervisor("rules", prepare=read_rules)
    def rules(view: SupervisorView, file: str) -> Answer:
        """Answer as the first rule of a TOML file that fits (see ``rule_table``)."""
        return decision(read_rules(file), view)

    @library.supervisor("familiar", prepare=_check_familiar)
    def familiar(view: SupervisorView, folder: str, slack: float = 0.1) -> Answer:
        """Ask a person about what no recorded run has: an operation from this state, a duration
        of the one before it, or a number that a source measures."""
        known = known_edges(folder)
        new = unfamiliar(view, known, slack)
        if new:
            return ASK, new
        return APPROVE, f"it stands in {known.runs} recorded runs"

    @library.supervisor("forecast", prepare=_check_forecast)
    def forecast(view: SupervisorView, differs: str = VETO, missing: str = ASK) -> Answer:
        """Veto operations whose forecast differs from the blueprint. ``missing`` is the answer
        without a forecast."""
        told = view.forecast
        if told is None or told.verdict == NONE:
            return missing, f"no forecast: {told.reason if told else 'the run makes none'}"
        if told.verdict == DIFFERS:
            return differs, told.reason
        return APPROVE, "the forecast agrees"

    return library


def _check_familiar(folder: str, slack: float = 0.1) -> None:
    if not 0 <= slack <= 100:
        raise UsageError(f"a slack of {slack:g} is not from 0 to 100")
    known_edges(folder)


def _check_forecast(differs: str = VETO, missing: str = ASK) -> None:
    for word in (differs, missing):
        if word not in ANSWERS:
            near = did_you_mean(word, ANSWERS) or f"There are {', '.join(ANSWERS)}."
            raise UsageError(f"there is no answer {word!r}", advice=near)


def _check_limit(risk: float = 0.5, above: str = VETO) -> None:
    if not 0 <= risk <= 1:
        raise UsageError(f"a risk of {risk:g} is not from 0 to 1")
    if above not in ABOVE:
        near = did_you_mean(above, ABOVE) or f"There are {', '.join(ABOVE)}."
        raise UsageError(f"there is no answer {above!r} to a higher risk", advice=near)
