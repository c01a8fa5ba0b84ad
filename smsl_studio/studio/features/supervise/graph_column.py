"""The partial view of Supervise with its head; in its place the full map, or why there is none."""

from __future__ import annotations

from PySide6.QtWidgets import QStackedWidget, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.partial import PartialView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.supervise.board import Board
from smsl_studio.studio.features.supervise.facts import sensed_marks
from smsl_studio.studio.features.supervise.head import HIGH, LOW, PartialHead
from smsl_studio.studio.features.supervise.notice import Notice
from smsl_studio.studio.running.run_canvas import RunCanvas
from smsl_studio.studio.running.run_session import RunSession


class GraphColumn(QWidget):
    """Shows the partial view of one SB of the run."""

    def __init__(self, session: Session, run: RunSession, tokens: Tokens) -> None:
        super().__init__()
        self._session, self._run = session, run
        self._came = False
        self.head, self.board = PartialHead(tokens), Board(tokens)
        self.full_map = RunCanvas(session, run, tokens)
        self.notice = Notice()
        self.pages = QStackedWidget()
        for page in (self.board, self.full_map, self.notice):
            self.pages.addWidget(page)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.head)
        column.addWidget(self.pages, 1)
        self.board.columns_moved.connect(lambda _: self._place_heads())

    def show_view(self, view: PartialView | None, branch: str, picked: Address | None) -> None:
        """Show the view of an SB; ``picked`` is the operation that is chosen."""
        run, status, blueprint = self._run, self._run.status, self._run.blueprint
        exists = run.exists and status is not None
        mapped = exists and status is not None and status.full_map and blueprint is not None
        shown = view if run.exists else None
        self._came = view is not None and view.via is not None
        self.pages.setCurrentWidget(
            self.full_map if mapped else self.board if shown is not None else self.notice
        )
        sensed = sensed_marks(blueprint, status, branch) if blueprint and status else ()
        self.board.show_view(blueprint, shown, picked, sensed)
        self._place_heads()
        self.head.setFixedHeight(LOW if mapped else HIGH)
        names = list(status.configuration) if exists and status is not None and not mapped else []
        live = status.running.branch if status is not None and status.running else ""
        self.head.show_branches(names, branch, live)
        self.head.show_map(mapped, exists)
        if mapped:
            self.full_map.refresh()
        self.notice.show_run(run, self._session.blueprint)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.head, self.board, self.full_map):
            part.set_tokens(tokens)

    def _place_heads(self) -> None:
        shown = self.pages.currentWidget() is self.board
        columns = self.board.columns if shown else None
        self.head.show_columns(columns, self._came, self.board.shift)
