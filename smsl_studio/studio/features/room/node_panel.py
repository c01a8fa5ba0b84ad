"""The chosen node: what it measures, a fact that it feeds with its plot, and its last events."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import split_fact
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.measure_traces import measured_of
from smsl_studio.front.views.room_events import RoomEvent, room_events
from smsl_studio.front.views.room_view import (
    CONTESTED,
    FRESH,
    NodeTag,
    RoomFact,
    RoomView,
    age_words,
)
from smsl_studio.legible import markup, plain_text
from smsl_studio.runlog.history import RunHistory
from smsl_studio.studio.base.controls import Label, label, row, rule
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.room.fact_part import FactPart
from smsl_studio.studio.running.measure_plot import MeasurePlot

NOTHING = "Choose a node on the plan"
WIDE = 396
KINDS = {"device": "device", "instrument": "instruments", "team": "team", "person": "patient"}


@dataclass(frozen=True)
class RoomMoment:
    """What the panel shows of a run: the room, the blueprint, the history and the time."""

    view: RoomView
    blueprint: Blueprint
    history: RunHistory
    now: float


class NodePanel(QWidget):
    """The panel at the right of the plan. ``certificate`` returns words about that of a node."""

    disturb_wanted = Signal()
    """The person wants to disturb sensors."""
    edit_wanted = Signal(str, int)
    """SB, digit: the person wants to edit the predicate of a fact."""

    def __init__(self, tokens: Tokens, certificate: Callable[[str], str]) -> None:
        super().__init__()
        self._tokens, self._certificate = tokens, certificate
        self._moment: RoomMoment | None = None
        self._tag: NodeTag | None = None
        self.setFixedWidth(WIDE)
        self.setProperty("role", "panel")
        self.title, self.standing = label("", "strong"), Label(rich=True)
        self.body, self.events, self.refused = Label(rich=True), Label(rich=True), Label(rich=True)
        for part in (self.body, self.events, self.refused):
            part.setWordWrap(True)
        self.fact = FactPart(tokens)
        self.fact.turned.connect(self._show_fact)
        self.plot = MeasurePlot(tokens, low=True)
        self.disturb = QPushButton("Disturb")
        self.disturb.setToolTip("Show the sensors, where every one can be disturbed")
        self.disturb.clicked.connect(self.disturb_wanted)
        self.edit = QPushButton("Edit the predicate")
        self.edit.setToolTip("Show the form of the fact in Draw")
        self.edit.clicked.connect(self._edit)
        self._build()

    def _build(self) -> None:
        top = row(self.title, None, self.standing)
        top.setContentsMargins(12, 0, 12, 0)
        inside, outside = QVBoxLayout(), QVBoxLayout(self)
        inside.setContentsMargins(0, 0, 0, 0)
        inside.setSpacing(8)
        self._line = rule()
        for part in (self.body, rule(), self.fact, self.plot, self._line, self.events,
                     self.refused):  # fmt: skip
            inside.addWidget(part)
            if part not in (self.plot, self._line) and isinstance(part, Label | FactPart):
                part.setContentsMargins(12, 0, 12, 0)
        inside.addStretch(1)
        outside.setContentsMargins(0, 10, 0, 12)
        outside.setSpacing(8)
        outside.addLayout(top)
        outside.addWidget(_scrolled(inside), 1)
        below = QHBoxLayout()
        below.setContentsMargins(12, 0, 12, 0)
        below.addWidget(self.disturb)
        below.addWidget(self.edit)
        outside.addLayout(below)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.fact.set_tokens(tokens)
        self.plot.set_tokens(tokens)

    def show_node(self, moment: RoomMoment, tag: NodeTag | None, fact: str = "") -> None:
        """Show a node of the room, or say that none is chosen. ``fact`` is the key of the fact that
        is shown of it, if it feeds that one."""
        self._moment, self._tag = moment, tag
        view = moment.view
        self.title.setText(tag.title if tag is not None else NOTHING)
        self.standing.setText(self._standing(tag) if tag is not None else "")
        self.body.setText(self._body(tag) if tag is not None else "")
        facts = view.of(tag)
        self.fact.show_facts(moment.blueprint, facts, fact)
        self._show_fact()
        self.events.setText(self._events(room_events(facts, moment.history)))
        self.refused.setText(self._refused(view))
        words = f"{tag.title}: {tag.standing}, {tag.words}" if tag is not None else NOTHING
        self.setAccessibleName(plain_text(words))

    def _show_fact(self) -> None:
        """Plot the source of the shown fact that this node speaks for."""
        moment, fact, tag = self._moment, self.fact.fact, self._tag
        key = split_fact(fact.key) if fact is not None else None
        self.edit.setEnabled(bool(fact is not None and fact.predicates))
        if moment is None or fact is None or key is None or tag is None:
            self.plot.show_measured(None)
            return
        before = self.plot.fact
        self.fact.show_facts(moment.blueprint, moment.view.of(tag), fact.key)
        measured = measured_of(moment.blueprint, key, moment.history, moment.now)
        self.plot.show_measured(measured)
        own = [one for one in tag.sources if one.fact == key]
        # A tag that was never read has nothing to plot.
        own.sort(key=lambda one: (one.said.value is None, one.sample is None))
        if before != key and own:
            self.plot.choose(own[0].said.source)

    def _edit(self) -> None:
        fact: RoomFact | None = self.fact.fact
        key = split_fact(fact.key) if fact is not None else None
        if key is not None:
            self.edit_wanted.emit(*key)

    def _standing(self, tag: NodeTag) -> str:
        tokens = self._tokens
        colours = {FRESH: tokens.ok, CONTESTED: tokens.bad}
        ink = colours.get(tag.standing, tokens.unk).name()
        words = f"Fresh, {tag.words}" if tag.standing == FRESH else tag.words.capitalize()
        return f'<b style="color:{ink}">{markup(words)}</b>'

    def _body(self, tag: NodeTag) -> str:
        rows = [("Node", f"{tag.name}, {KINDS[tag.kind]}"), *_reads(tag)]
        rows.append(("Certificate", self._certificate(tag.name)))
        rate = f"{tag.site.rate:g} Hz, " if tag.site is not None else ""
        if tag.sources:
            late = max(one.latency for one in tag.sources)
            counted = sum(one.counted for one in tag.sources)
            lost = sum(one.repeated + one.late for one in tag.sources)
            rows.append(("Samples", f"{rate}{counted:,}; {lost:,} late or repeated"))
            rows.append(("Latency", f"{age_words(late)}; boots heard: {tag.boots}"))
        lines = (
            f'<tr><td style="color:{self._tokens.tx2.name()}">{markup(name)}&nbsp;&nbsp;</td>'
            f"<td>{markup(words)}</td></tr>"
            for name, words in rows
        )
        return f"<table cellspacing=0 cellpadding=2>{''.join(lines)}</table>"

    def _events(self, events: tuple[RoomEvent, ...]) -> str:
        tokens = self._tokens
        lines = (
            f'<tr><td style="color:{tokens.tx2.name()}">{one.time:.1f} s&nbsp;&nbsp;</td>'
            f'<td style="color:{(tokens.tx if one.known else tokens.unk).name()}">'
            f"{markup(one.words)}</td></tr>"
            for one in events
        )
        table = f"<table cellspacing=0 cellpadding=2>{''.join(lines)}</table>" if events else ""
        return f"<b>Last events</b>{table or '<br>none yet'}"

    def _refused(self, view: RoomView) -> str:
        if not view.refused:
            return ""
        lines = "".join(f"<br>{markup(words)}" for words in view.refused[:6])
        return f"<b>Messages that count for nothing</b>{lines}"


def _reads(tag: NodeTag) -> list[tuple[str, str]]:
    """Sources with what they read. The fact stands there only where one name reads two things."""
    said: dict[str, dict[str, str]] = {}
    for name, words in tag.reads:
        said.setdefault(name.partition(" of ")[0], {})[name] = words
    rows: list[tuple[str, str]] = []
    for short, all_of in said.items():
        alike = len(set(all_of.values())) == 1
        rows += [(short, next(iter(all_of.values())))] if alike else all_of.items()
    return rows


def _scrolled(column: QVBoxLayout) -> QScrollArea:
    """A column that scrolls where the window is low."""
    inside = QWidget()
    inside.setProperty("role", "panel")
    inside.setLayout(column)
    area = QScrollArea()
    area.setWidgetResizable(True)
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setAccessibleName("The chosen node")
    area.setWidget(inside)
    FocusLine(area)
    return area
