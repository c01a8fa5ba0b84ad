"""The page Inspection: what must hold, whether it does, and the run that shows why it does not."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, QTimer
from PySide6.QtGui import QHideEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QStackedWidget, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.front.claim_rows import ClaimRow, has_claims
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.inspection.proof.verdict import FAILS
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.room import Room
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.inspector import Inspector
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.inspection.claim_edits import ClaimEdits
from smsl_studio.studio.features.inspection.claim_form import ClaimForm
from smsl_studio.studio.features.inspection.claim_model import CHANGED, NEW, STOPPED
from smsl_studio.studio.features.inspection.claim_table import ClaimTable
from smsl_studio.studio.features.inspection.configuration_page import HEAD, ConfigurationPage
from smsl_studio.studio.features.inspection.drawing_look import DrawingLook, recovery_of
from smsl_studio.studio.features.inspection.empty_page import EmptyPage
from smsl_studio.studio.features.inspection.equivalence_page import EquivalencePage
from smsl_studio.studio.features.inspection.lit_run import LitRun
from smsl_studio.studio.features.inspection.lower_part import LowerPart
from smsl_studio.studio.features.inspection.page_tools import PageTools
from smsl_studio.studio.features.inspection.recovery_table import RecoveryTable
from smsl_studio.studio.features.inspection.run_view import RunView
from smsl_studio.studio.features.inspection.tab_line import (
    CONFIGURATION,
    EQUIVALENCE,
    RECOVERABILITY,
    VERDICTS,
    TabLine,
)
from smsl_studio.studio.features.inspection.words_below import words_below
from smsl_studio.studio.running.frames import split

ANY = 16_777_215
"""The greatest width that Qt allows (pixels)."""
NO_FAILURE = (
    "No failure value is declared, so nothing can fail. A value of a fact becomes a failure in the "
    "panel Facts; the failure states and the ways out of them stand here then."
)
CLOSE = 420
"""In a panel narrower than this the tools are hidden, because the tabs need the space (pixels)."""
LEAST, LOWER = 60, 216
"""The least height of the page, and that of the run below the table (pixels)."""
PACE = 250
"""Milliseconds between two looks at how far a search for verdicts is."""
HIGH = 300
"""From this height on the sentence about all verdicts may have a line of its own (pixels)."""


class InspectionPanel(QWidget):
    """The table of hazards and properties over the run of the chosen one.

    ``tools`` stand at the right of the tab: the numbers of verdicts, and *Check again*.
    """

    def __init__(
        self,
        session: Session,
        inspector: Inspector,
        lit: LitRun,
        tools: PageTools,
        tokens: Tokens,
    ) -> None:
        super().__init__()
        self._session, self._inspector = session, inspector
        self._pace = QTimer(self)
        self._pace.setInterval(PACE)
        self._wanted: Address | None = None
        """The row that is chosen when it is answered."""
        self.setObjectName("inspection")
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Inspection")
        self.line = TabLine()
        self.tabs, self.shown = self.line.tabs, self.line.shown
        self.configuration = ConfigurationPage(session, lit, tokens)
        self.equivalence = EquivalencePage(session, lit, tokens)
        self.table = ClaimTable(tokens)
        self.run = RunView(lit, tokens)
        self.recovery, self.look = RecoveryTable(tokens), DrawingLook(session, recovery_of, self)
        self.above = QStackedWidget()
        for table in (self.table, self.recovery):
            self.above.addWidget(table)
        self.said = label("", "hint")
        self.said.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.said.setContentsMargins(14, 10, 14, 10)
        self.form = ClaimForm(tokens)
        self.writing = ClaimEdits(session, self.form)
        self.below = QStackedWidget()
        for page in (self.said, self.run, self.form):
            self.below.addWidget(page)
        parts = (self.above, self.below)
        tables = split(Qt.Orientation.Vertical, parts, (180, LOWER), (1, 0))
        self._lower = LowerPart(tables, self.below, LOWER)
        self.empty = EmptyPage()
        self.add_empty = self.empty.add
        self._pages = QStackedWidget()
        for body in (Room(self.empty), tables, self.configuration, self.equivalence):
            self._pages.addWidget(body)
        self.tools = tools
        self.sum, self.again, self.add = self.tools.sum, self.tools.again, self.tools.add
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.line)
        column.addWidget(self._pages, 1)
        self.setFocusProxy(self.table)
        self._connect()
        self._catch_up()

    def _catch_up(self) -> None:
        """Show what was inspected before this page was made."""
        self._show_page(has_claims(self._session.blueprint))
        if self._inspector.proof is not None:
            self._proved()
            return
        self._changed()
        self._listed()

    def _connect(self) -> None:
        inspector = self._inspector
        inspector.started.connect(self._changed)
        inspector.listed.connect(self._listed)
        inspector.proved.connect(self._proved)
        self._pace.timeout.connect(self._show_looking)
        inspector.found.connect(lambda _: self._show_tools())
        self._session.opened.connect(self._opened)
        self._session.broken_changed.connect(self._changed)
        self.table.row_chosen.connect(self._show_row)
        self.again.clicked.connect(self._again)
        for button in (self.add, self.add_empty):
            button.clicked.connect(self.write_new)
        self.table.edit_wanted.connect(self._edit)
        self.table.delete_wanted.connect(self.writing.delete)
        self.writing.ended.connect(self._written)
        self.tabs.currentChanged.connect(lambda _: self._tab_shown())
        self.recovery.row_chosen.connect(lambda _: self._way_chosen())
        self.look.changed.connect(self._recovered)
        inspector.found.connect(lambda _: self._look())

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.table.claims.set_tokens(tokens)
        self.recovery.set_tokens(tokens)
        self.run.set_tokens(tokens)
        self.configuration.set_tokens(tokens)
        self.equivalence.set_tokens(tokens)
        self.form.set_tokens(tokens)

    def show_verdicts(self) -> None:
        """Show the tab with all hazards and properties."""
        self.tabs.setCurrentIndex(VERDICTS)

    def show_steps(self, steps: tuple[RunStep, ...], title: str) -> None:
        """Show a run that another feature has found."""
        self.tabs.setCurrentIndex(CONFIGURATION)
        self.configuration.show_steps(steps, title)

    def write_new(self) -> None:
        """Show the form for a new hazard or property."""
        self.tabs.setCurrentIndex(0)
        self._pages.setCurrentIndex(1)
        self.run.clear()
        self.writing.begin()
        self._lower.show(self.form, LOWER)
        self.form.name.setFocus()

    def choose(self, address: Address) -> None:
        """Choose a hazard or a property, and show its run: now, or as soon as it is answered."""
        self.tabs.setCurrentIndex(0)
        self._wanted = address if self.table.claims.row_of(address) < 0 else None
        self.table.choose(address)
        self.table.scrollTo(self.table.cell.index)
        self.table.setFocus()

    def minimumSizeHint(self) -> QSize:
        """A small size, because the other panels share the dock and may be low."""
        return QSize(0, LEAST)

    def showEvent(self, event: QShowEvent) -> None:
        """Light the run of the chosen row again."""
        super().showEvent(event)
        self._look()
        self._choose_first()
        self._show_row(self.table.chosen)
        if self._apart is not None:
            self._apart.enter()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide the tools if the tabs need the space."""
        super().resizeEvent(event)
        self.line.set_room(self.height() >= HIGH)
        self.tools.setMaximumWidth(ANY if self.width() >= CLOSE else 0)

    def hideEvent(self, event: QHideEvent) -> None:
        """Light nothing on the drawing, because nobody looks at the run."""
        super().hideEvent(event)
        self._leave_pages()
        self.run.clear()

    def _edit(self, claim: ClaimRow) -> None:
        self.run.clear()
        if self.writing.begin(claim):
            self._lower.show(self.form, LOWER)
            self.form.first.setFocus()
        else:
            self.said.setText("Its condition is too long for the form. Change it in the source.")
            self.below.setCurrentWidget(self.said)

    def _written(self, address: Address | None) -> None:
        """Leave the form. The row that was written is chosen as soon as it is answered."""
        self._wanted = address
        self.below.setCurrentWidget(self.said)
        self._show_row(self.table.chosen)
        rows = bool(self.table.claims.rows) or address is not None
        self._show_page(rows)
        (self.table if rows else self.add_empty).setFocus()

    def _opened(self) -> None:
        self.writing.drop()
        self.table.show_rows(())
        self._show_page(has_claims(self._session.blueprint))

    def _listed(self) -> None:
        """Show what must hold in a file that was just opened. Nothing is answered yet."""
        rows = self._inspector.unanswered
        if rows and not self.table.claims.rows and self._session.broken is None:
            self.table.show_rows(rows)
            self._wait(NEW)
            self._show_page(True)

    def _changed(self) -> None:
        """Show every verdict as unknown until it is answered for what is drawn now."""
        self._wait(CHANGED if self.table.claims.rows else NEW)
        self._pace.start()

    def _show_looking(self) -> None:
        """Say how far the search for verdicts is."""
        if self._inspector.proof is not None or self._inspector.stopped:
            self._pace.stop()
        elif self._inspector.proving and self.isVisible():
            count = self._inspector.looked_at
            self._wait(f"Looking, {count:,} so far" if count else "Looking")

    def _wait(self, why: str) -> None:
        """Show every verdict as unknown, and why."""
        self.table.claims.wait(why)
        self._show_row(self.table.chosen)
        self._show_tools()

    def _proved(self) -> None:
        rows = self._inspector.rows
        if self._session.broken is not None:
            return
        self.table.show_rows(rows)
        if self._wanted is not None:
            self.table.choose(self._wanted)
            self.table.scrollTo(self.table.cell.index)
            self._wanted = None
        self._choose_first()
        self._show_page(bool(rows) or self.writing.open)
        self._show_tools()

    def _choose_first(self) -> None:
        """If no row is selected, select one, so that its run is shown.

        It is the first row that fails. In the tab Recoverability it is the first row of all.
        """
        if self._recovering and self.isVisible():
            self.recovery.choose_first()
            return
        claims = self.table.claims
        if self.isVisible() and self.table.chosen is None and not self.writing.open:
            fails = (one for one in claims.rows if claims.verdict(one) == FAILS)
            self.table.choose(next((one.address for one in fails), None))

    @property
    def _recovering(self) -> bool:
        """Whether the tab of recoverability is chosen."""
        return self.tabs.currentIndex() == RECOVERABILITY

    @property
    def _apart(self) -> ConfigurationPage | EquivalencePage | None:
        """The page of the chosen tab, if that page is not a table."""
        at = self.tabs.currentIndex()
        if at == CONFIGURATION:
            return self.configuration
        return self.equivalence if at == EQUIVALENCE else None

    def _leave_pages(self) -> None:
        self.configuration.leave()
        self.equivalence.leave()

    def _show_page(self, rows: bool) -> None:
        """Show the tables, or the page that says what may be written."""
        if self._apart is not None:
            self._pages.setCurrentWidget(self._apart)
        else:
            self._pages.setCurrentIndex(int(rows or self._recovering))

    def _tab_shown(self) -> None:
        if self.tabs.currentIndex() != VERDICTS and self.writing.open:
            # What is typed stays in its form, which is on the other tab.
            self.tabs.setCurrentIndex(0)
            return
        self._leave_pages()
        self.run.clear()
        self.above.setCurrentIndex(int(self._recovering))
        places = (self.table, self.recovery, self.configuration, self.equivalence)
        self.setFocusProxy(places[self.tabs.currentIndex()])
        self._show_page(bool(self.table.claims.rows) or self.writing.open)
        self._look()
        self._choose_first()
        self._show_row(self.table.chosen)
        self._show_tools()
        if self._apart is not None and self.isVisible():
            self._apart.enter()

    def _look(self) -> None:
        """Ask for the ways back, if somebody looks."""
        if self._recovering and self.isVisible() and self._session.broken is None:
            self.look.look()

    def _recovered(self) -> None:
        self.recovery.show_rows(self.look.answer or ())
        self._show_tools()
        self._choose_first()
        self._way_chosen()

    def _way_chosen(self) -> None:
        """Show the chosen way back, on its own tab only.

        On the other tabs the table may still have the rows of the former file, because the ways of
        that file are forgotten first.
        """
        if self._recovering and not self.writing.open:
            self._show_way()

    def _show_way(self) -> None:
        chosen, rows = self.recovery.chosen, self.look.answer
        if chosen is not None and chosen.run is not None and self.isVisible():
            self.run.show_way(self._session.blueprint, chosen.run)
            self._show_run()
            return
        self.run.clear()
        if rows is None:
            self.said.setText("Not known yet.")
        elif not rows:
            self.said.setText(NO_FAILURE)
        elif chosen is not None:
            self.said.setText(f"{chosen.state}: {chosen.failure}. {chosen.nearest}.")
        else:
            self.said.setText(
                "Choose a row: its way back stands here, and on the drawing. One failure at a "
                "time; everything else stands as at a start."
            )
        self.below.setCurrentWidget(self.said)

    def _again(self) -> None:
        if self._inspector.proof is None and not self._inspector.stopped:
            self._inspector.stop_looking()
            self._wait(STOPPED)
        else:
            self._inspector.look_again()
        self._show_tools()

    def _show_tools(self) -> None:
        rows, claims = self.table.claims.rows, self.table.claims
        verdicts = [claims.verdict(one) for one in rows]
        looking = self._inspector.proof is None and not self._inspector.stopped
        self.tools.show_verdicts(verdicts, claims.waiting, looking)
        if self._recovering:
            self.tools.show_ways(self.look.answer or ())

    def _show_row(self, claim: ClaimRow | None) -> None:
        waiting = self.table.claims.waiting
        if self.writing.holds(claim) or self._apart is not None:
            return
        if self._recovering:
            self._show_way()
            return
        if claim is None or waiting or claim.run is None or not self.isVisible():
            self.run.clear()
            self.said.setText(words_below(claim, waiting))
            self.below.setCurrentWidget(self.said)
            return
        self.run.show_run(self._session.blueprint, claim)
        self._show_run()

    def _show_run(self) -> None:
        """Show the run as high as its rows."""
        self._lower.show(self.run, HEAD + self.run.strip.height())
