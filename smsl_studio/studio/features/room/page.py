"""The page Room: the plan over the facts, and the chosen node at the right."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QStackedWidget, QVBoxLayout, QWidget

from smsl_studio.errors import StudioError
from smsl_studio.front.elsewhere import room_of
from smsl_studio.front.sites.site_file import KINDS, Site, SiteRoom
from smsl_studio.front.views.room_view import (
    FRESH,
    RoomFact,
    RoomView,
    age_words,
    room_view,
)
from smsl_studio.library.bindings_file import bindings_beside
from smsl_studio.studio.base.controls import Elided, Label, label, rule
from smsl_studio.studio.base.headed_page import HeadedPage
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.room.facts_list import RoomFacts
from smsl_studio.studio.features.room.node_panel import NodePanel, RoomMoment
from smsl_studio.studio.features.room.plan import RoomPlan
from smsl_studio.studio.running.frames import split
from smsl_studio.studio.running.run_session import RunSession

WORDS = {"device": "Devices", "instrument": "Instruments", "team": "Team", "person": "Persons"}
EMPTY = "No nodes here. Start the sample site: smsl-studio nodes run FOLDER --broker HOST:PORT"
LEGEND = "solid: fresh. dashed: stale. hatched, ?: silent. cut corner: two speakers"


class RoomPage(HeadedPage):
    """The page. It follows the run while it is visible, and switches nothing."""

    disturb_wanted = Signal()
    """The person wants to disturb sensors."""
    edit_wanted = Signal(str, int)
    """SB, digit: the person wants to edit the predicate of a fact."""

    def __init__(self, run: RunSession, tokens: Tokens) -> None:
        super().__init__()
        self._run, self._tokens = run, tokens
        self._site: Site | None = None
        self._node, self._fact, self._hidden = "", "", set[str]()
        self._certificates: dict[str, str] = {}
        self.view: RoomView | None = None
        self.lock, self.silent = Label(rich=True), label("", "small")
        self.broker, self.fault = Elided(), label("", "refusal")
        self.kinds: dict[str, QPushButton] = {}
        self.plan, self.facts = RoomPlan(tokens), RoomFacts(tokens)
        self.side = NodePanel(tokens, self._certificate)
        self.setFocusProxy(self.plan)
        self.plan.chosen.connect(self.choose)
        self.facts.chosen.connect(self._choose_fact)
        self.side.disturb_wanted.connect(self.disturb_wanted)
        self.side.edit_wanted.connect(self.edit_wanted)
        self._build()
        run.changed.connect(self.refresh)
        run.opened.connect(self._new_run)
        self._new_run()

    def _build(self) -> None:
        top = QHBoxLayout(self.head)
        top.setContentsMargins(0, 0, 0, 0)
        top.setSpacing(8)
        for kind in KINDS:
            button = self.kinds[kind] = QPushButton(WORDS[kind])
            button.setProperty("role", "switch")
            button.setCheckable(True)
            button.setChecked(True)
            button.setToolTip("Show or hide these nodes. A silent node is always shown")
            button.toggled.connect(partial(self._show_kind, kind))
            top.addWidget(button)
        top.addWidget(self.fault)
        top.addWidget(self.broker, 1)
        top.addWidget(self.lock)
        top.addWidget(self.silent)
        legend = label(LEGEND, "small")
        legend.setContentsMargins(12, 2, 12, 2)
        across = split(Qt.Orientation.Vertical, (self.plan, self.facts), (480, 232), (2, 1))
        left = QWidget()
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(legend)
        column.addWidget(across, 1)
        whole = QWidget()
        row = QHBoxLayout(whole)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(left, 1)
        row.addWidget(rule(vertical=True))
        row.addWidget(self.side)
        empty = label(EMPTY, "hint")
        empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._pages = QStackedWidget()
        self._pages.addWidget(whole)
        self._pages.addWidget(empty)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(self._pages)

    def choose(self, node: str) -> None:
        """Show a node at the right."""
        self._node, self._fact = node, ""
        self.refresh()

    def refresh(self) -> None:
        """Show the room as it is now; nothing is computed while the page is hidden."""
        if not self.isVisible():
            return
        run = self._run
        remote, status, blueprint = run.remote(), run.status, run.blueprint
        if remote is None or status is None or blueprint is None:
            self._pages.setCurrentIndex(1)
            return
        self._pages.setCurrentIndex(0)
        view = self.view = room_view(blueprint, status, remote, self._site)
        if view.node(self._node) is None and view.nodes:
            self._node = view.nodes[0].name
        self.plan.show_room(view, self._room, self._hidden, self._node)
        self.facts.facts.show(view.facts)
        moment = RoomMoment(view, blueprint, run.story.history, run.time)
        self.side.show_node(moment, view.node(self._node), self._fact)
        self._fact = ""
        self._show_head(view)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for part in (self.plan, self.facts, self.side):
            part.set_tokens(tokens)
        self.refresh()

    def showEvent(self, event: QShowEvent) -> None:
        """Show the present state."""
        super().showEvent(event)
        self.refresh()

    @property
    def _room(self) -> SiteRoom:
        return self._site.room if self._site is not None else SiteRoom()

    def _show_head(self, view: RoomView) -> None:
        tokens = self._tokens
        lost = view.lost
        words = f"broker {view.broker}"
        if lost is not None and self._run.exists:
            words = f"No broker for {age_words(lost)}. Facts are unknown. Stop needs no broker"
        self.broker.setText(words)
        ink, said = (tokens.ok, "TLS") if view.secure else (tokens.risk, "Not encrypted")
        self.lock.setText(f'<b style="color:{ink.name()}">{said}</b>')
        counted = f"{len(view.nodes)} nodes, {view.silent} silent"
        self.silent.setText(counted)
        for kind, button in self.kinds.items():
            count = sum(one.kind == kind for one in view.nodes)
            button.setText(f"{WORDS[kind]} {count}")

    def _new_run(self) -> None:
        """Read the site of the run's blueprint. A site that cannot be read has no plan."""
        self._site, words = None, ""
        self._certificates.clear()
        blueprint = self._run.blueprint
        if blueprint is not None:
            try:
                self._site = room_of(blueprint.file, bindings_beside(blueprint.file))
            except StudioError as error:
                words = str(error)
        self.fault.setText(words)
        self.fault.setVisible(bool(words))
        self.refresh()

    def _show_kind(self, kind: str, shown: bool) -> None:
        (self._hidden.discard if shown else self._hidden.add)(kind)
        self.refresh()

    def _choose_fact(self, fact: RoomFact) -> None:
        """Show a fact at the right, with the node that it rests on, a bad one first."""
        view = self.view
        if not fact.nodes or view is None:
            return
        tags = [tag for name in fact.nodes if (tag := view.node(name)) is not None]
        bad = [tag.name for tag in tags if tag.standing != FRESH]
        self._node, self._fact = (*bad, fact.nodes[0])[0], fact.key
        self.refresh()

    def _certificate(self, node: str) -> str:
        """What is known of the certificate of a node; its file is read once in a run."""
        if self.view is None or not self.view.secure:
            return "none, nothing is encrypted"
        if self._site is None:
            return "not known"
        if node not in self._certificates:
            from smsl_studio.front.sites.node_certificate import certificate_words

            self._certificates[node] = certificate_words(self._site, node)
        return self._certificates[node]
