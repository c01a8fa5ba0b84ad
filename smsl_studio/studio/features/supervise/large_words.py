"""What the large layout of Supervise says: few words, which are read from two metres."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.fact_rows import FactRow
from smsl_studio.front.views.forecast_words import operation_name
from smsl_studio.front.views.partial import OperationCard, PartialView
from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.features.supervise.card import ACTORS, BADGES, CardForecast
from smsl_studio.studio.features.supervise.facts import check_view

GOOD, BAD, UNKNOWN, QUIET, BUSY = "good", "held", "unknown", "quiet", "busy"
KINDS = {"agrees": GOOD, "differs": BAD, "unknown": UNKNOWN, "transit": BUSY}
FIRST = "F5 starts a run, in the world that is chosen in Run."
SIGNS = {GOOD: "agrees", BAD: "differs", UNKNOWN: "unknown", BUSY: "moving"}


@dataclass(frozen=True)
class LargeFact:
    """A fact: its name, what is sensed (``?`` for nothing), and the kind of its words."""

    name: str
    value: str
    kind: str
    words: str


@dataclass(frozen=True)
class LargeWords:
    """The words, in the order in which they are read. Each of them may be empty.

    ``ahead`` is the operation that is proposed, chosen or under way. ``forecast`` has the kind of
    its words, too.
    """

    phase: str
    kind: str
    question: str = ""
    state: str = ""
    title: str = ""
    facts: tuple[LargeFact, ...] = ()
    ahead: str = ""
    target: str = ""
    about: str = ""
    forecast: tuple[str, str] = ("", QUIET)

    @property
    def said(self) -> str:
        """All of it as one text, for assistive tools."""
        facts = (f"{one.name} {one.value}, {one.words}" for one in self.facts)
        told = (self.phase, self.question, self.state, self.title, *facts)
        more = (self.ahead, self.target, self.about, self.forecast[0])
        return ". ".join(one for one in (*told, *more) if one)


@dataclass(frozen=True)
class LargeRun:
    """A run as it stands. ``sentence`` says how it ended, once it is ``over``."""

    blueprint: Blueprint | None
    status: DispatchStatus | None
    phase: str
    over: bool = False
    sentence: str = ""
    asked: str = ""
    """The question of a decision that waits for Enter; empty for none."""


def large_words(
    run: LargeRun,
    view: PartialView | None,
    subject: Address | None,
    forecast: CardForecast | None,
) -> LargeWords:
    """Return the words for a run that stands so. ``subject`` is the operation at hand."""
    blueprint, status, phase, over = run.blueprint, run.status, run.phase, run.over
    words, kind = phase_words(phase, over)
    if blueprint is None or status is None or view is None:
        return LargeWords(words, kind, capital(run.sentence) if over else "" if phase else FIRST)
    question = run.asked or (status.tasks[0].question if status.tasks else "")
    if over:
        question = capital(run.sentence)
    elif not question and phase in ("fault_hold", "no_route", "stopped", "held", "failed"):
        question = status.sentence
    checked = check_view(blueprint, status, view.branch, phase == "failed")
    rows = checked.rows if checked is not None else ()
    card = view.card(subject) if not over else None
    told = forecast if card is not None and forecast and forecast.edge == card.address else None
    return LargeWords(
        words,
        kind,
        question,
        view.state,
        view.title,
        tuple(_fact(row) for row in rows if not row.group),
        operation_name(blueprint, card.address) if card is not None else "",
        _target(card) if card is not None else "",
        _about(card) if card is not None else "",
        (told.sentence.capitalize(), GOOD if told.agrees else BAD) if told else ("", QUIET),
    )


def _fact(row: FactRow) -> LargeFact:
    kind = KINDS.get(row.quality, QUIET)
    value = "?" if row.sensed is None else row.sensed
    return LargeFact(row.name, value, kind, SIGNS.get(kind, "believed"))


def _target(card: OperationCard) -> str:
    return f"stays in {card.target}" if card.stays else f"to {card.target}"


def _about(card: OperationCard) -> str:
    """Return how the operation stands, its risk, and who acts."""
    stands = BADGES.get(card.standing, "next" if card.on_route else "possible")
    risk = f"risk {card.risk}" if card.risk else "risk not rated"
    return ", ".join((stands, risk, ACTORS.get(card.actor, card.actor)))
