"""The chosen node: what it measures now, which facts it feeds, and when they hold."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.front.views.room_view import (
    CONTESTED,
    FRESH,
    NodeTag,
    RoomFact,
    RoomView,
    age_words,
)
from smsl_studio.legible import markup, plain_text
from smsl_studio.studio.base.controls import Label, label, rule
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.theme import Tokens

NOTHING = "Choose a node on the plan"
WIDE = 396
KINDS = {"device": "device", "instrument": "instruments", "team": "team", "person": "patient"}


class NodePanel(QWidget):
    """The panel at the right of the plan."""

    disturb_wanted = Signal()
    """The person wants to disturb sensors."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._shown: object = None
        self.setFixedWidth(WIDE)
        self.setProperty("role", "panel")
        self.title, self.standing = label("", "strong"), Label(rich=True)
        self.body, self.facts, self.refused = Label(rich=True), Label(rich=True), Label(rich=True)
        for part in (self.body, self.facts, self.refused):
            part.setWordWrap(True)
        self.disturb = QPushButton("Disturb")
        self.disturb.setToolTip("Open the monitor, where every sensor can be disturbed (Ctrl+M)")
        self.disturb.clicked.connect(self.disturb_wanted)
        top = QHBoxLayout()
        top.addWidget(self.title, 1)
        top.addWidget(self.standing)
        inside, outside = QVBoxLayout(), QVBoxLayout(self)
        inside.setContentsMargins(12, 0, 12, 0)
        inside.setSpacing(10)
        inside.addWidget(self.body)
        inside.addWidget(rule())
        inside.addWidget(self.facts)
        inside.addWidget(rule())
        inside.addWidget(self.refused)
        inside.addStretch(1)
        outside.setContentsMargins(0, 10, 0, 12)
        outside.setSpacing(10)
        top.setContentsMargins(12, 0, 12, 0)
        outside.addLayout(top)
        outside.addWidget(_scrolled(inside), 1)
        below = QHBoxLayout()
        below.setContentsMargins(12, 0, 12, 0)
        below.addWidget(self.disturb)
        outside.addLayout(below)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens, self._shown = tokens, None

    def show_node(self, view: RoomView, tag: NodeTag | None) -> None:
        """Show a node of the room, or say that none is chosen."""
        facts = tuple(one for one in view.facts if tag is not None and one.key in tag.facts)
        key = (tag, facts, view.refused, self._tokens.name)
        if key == self._shown:
            return
        self._shown = key
        self.title.setText(tag.title if tag is not None else NOTHING)
        self.standing.setText(self._standing(tag) if tag is not None else "")
        self.body.setText(self._body(tag) if tag is not None else "")
        self.facts.setText("".join(map(self._fact, facts)))
        self.refused.setText(self._refused(view))
        words = f"{tag.title}: {tag.standing}, {tag.words}" if tag is not None else NOTHING
        self.setAccessibleName(plain_text(words))

    def _standing(self, tag: NodeTag) -> str:
        tokens = self._tokens
        colours = {FRESH: tokens.ok, CONTESTED: tokens.bad}
        ink = colours.get(tag.standing, tokens.unk).name()
        words = f"Fresh, {tag.words}" if tag.standing == FRESH else tag.words.capitalize()
        return f'<b style="color:{ink}">{markup(words)}</b>'

    def _body(self, tag: NodeTag) -> str:
        rows = [("Kind", KINDS[tag.kind]), ("Node", tag.name), ("Boots heard", str(tag.boots))]
        rows += tag.reads
        if tag.sources:
            late = max(one.latency for one in tag.sources)
            counted = sum(one.counted for one in tag.sources)
            lost = sum(one.repeated + one.late for one in tag.sources)
            rows.append(("Counted", f"{counted:,}; {lost:,} repeated or late"))
            rows.append(("Latency", age_words(late)))
        lines = (
            f'<tr><td style="color:{self._tokens.tx2.name()}">{markup(name)}&nbsp;&nbsp;</td>'
            f"<td>{markup(words)}</td></tr>"
            for name, words in rows
        )
        return f"<table cellspacing=0 cellpadding=2>{''.join(lines)}</table>"

    def _fact(self, fact: RoomFact) -> str:
        tokens = self._tokens
        unknown = fact.value is None
        ink = (tokens.unk if unknown else tokens.ok).name()
        said = f"unknown: {fact.reason}" if fact.value is None else f"reads {fact.value}"
        lines = "".join(
            f"<br><b>{markup(value)}</b>&nbsp; if {markup(text)}" for value, text in fact.predicates
        )
        needed = f"<br>needed by {markup(', '.join(fact.needed_by))}" if fact.needed_by else ""
        held = f' <b style="color:{ink}">held back</b>' if fact.held_back else ""
        return (
            f'<p><b>{markup(fact.name)}</b> <span style="color:{ink}">{markup(said)}</span>'
            f"{lines}{needed}{held}</p>"
        )

    def _refused(self, view: RoomView) -> str:
        if not view.refused:
            return ""
        lines = "".join(f"<br>{markup(words)}" for words in view.refused[:6])
        return f"<b>Messages that count for nothing</b>{lines}"


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
