"""The search in the drawing: it finds as one types, marks the hits, and goes from hit to hit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject, QTimer

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.picture.levels import Level
from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.paint.drawn_paint import READABLE
from smsl_studio.studio.document.inspector import Inspector
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.find.bar import DrawingFindBar
from smsl_studio.studio.features.draw.find.destinations import Destinations
from smsl_studio.studio.features.draw.find.drawing_index import EVERYTHING, DrawingIndex
from smsl_studio.studio.features.draw.find.hits import DrawnPlace, Hits, Occurrence, There
from smsl_studio.studio.features.draw.find.value_filter import (
    conditions,
    filtered,
    why_nothing,
)

LEAST_ZOOM = 0.7
"""The zoom to which a view rises in which a hit cannot be read."""
WAIT = 60
"""Milliseconds after an edit before its drawing is searched again."""


class _Begin:
    """Where a person was when a search began."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        self.branch, self.selection = session.branch, session.selection
        self.drawn, self.stand = canvas.drawn.chosen, canvas.camera.stand


class DrawingSearch(QObject):
    """Searches for what is typed in the bar, as long as the bar is open.

    Typing stays in the SB that is shown; a step goes to any SB. An edit changes the hits, but
    neither the view nor the selection.
    """

    def __init__(
        self, session: Session, canvas: Canvas, bar: DrawingFindBar, inspector: Inspector,
        going: Destinations,
    ) -> None:  # fmt: skip
        super().__init__(bar)
        self._session, self._canvas, self.bar = session, canvas, bar
        self._inspector, self._going = inspector, going
        self._index, self.hits = DrawingIndex(), Hits()
        self.current: int | None = None
        """The number of the hit that is shown, from 0; None while none is."""
        self.offered: Callable[[], tuple[str, ...]] = tuple
        """The operations that plugins offer."""
        self.show_drawn: Callable[[DrawnKey, float], None] = lambda key, least: None
        """Selects a note or group of the SB that is shown, and scrolls to it."""
        self._begun: _Begin | None = None
        self._told = ""
        self._again = _timer(self, WAIT, self.look)
        # It waits until no key is left to be read, so typing calls off what it makes obsolete.
        self._soon = _timer(self, 0, self._typed)
        bar.typed.connect(self._soon.start)
        bar.step_wanted.connect(self.step)
        bar.closed.connect(self.close)
        session.blueprint_changed.connect(lambda *_: self._changed())
        session.branch_changed.connect(lambda _: self._mark())
        inspector.found.connect(lambda _: self._changed())
        session.opened.connect(self._forget)

    def open(self) -> None:
        """Open the bar with the text that was typed last. A selected hit is the shown one."""
        if self.bar.isHidden():
            self._begun = _Begin(self._session, self._canvas)
        self.bar.open_bar(self._example())
        self.look()
        if self.current is None and self._session.selection:
            self.current = self.hits.place(self._session.selection[0])
            self._mark()
            self._say()

    def close(self) -> None:
        """Close the bar. View and selection stay as they are."""
        self._told = ""
        self.bar.hide()
        self._again.stop()
        self._soon.stop()
        self.hits, self.current = Hits(), None
        self._mark()
        self._canvas.setFocus()

    def can_go_back(self) -> bool:
        """Whether a search has begun in this file."""
        return self._begun is not None

    def go_back(self) -> None:
        """Close the bar, and show SB, selection, zoom and place as they were when it was opened."""
        begun, self._begun = self._begun, None
        if begun is None:
            return
        if not self.bar.isHidden():
            self.close()
            self._settle_page()
        self._session.show_branch(begun.branch)
        self._session.select(begun.selection)
        if self._session.branch == begun.branch:
            if begun.drawn is not None:
                self._canvas.drawn_wanted.emit(begun.drawn)
            self._canvas.camera.look_back(begun.stand)
        self._canvas.setFocus()

    def look(self) -> None:
        """Search again. The hit that is shown stays the same if it is still one."""
        if self.bar.isHidden():
            return
        self._again.stop()
        there = self._shown()
        self._find()
        self.current = self.hits.place(there) if there is not None else None
        self._mark()
        self._say()

    def step(self, by: int) -> None:
        """Go to the next hit (1) or the one before (-1); after the last comes the first."""
        if self._soon.isActive():
            self._typed()
        elif self._again.isActive():
            self.look()
        if not len(self.hits):
            return
        if self.current is not None:
            self._go((self.current + by) % len(self.hits))
        else:
            here = self._nearest()
            self._go(here if here is not None else 0 if by > 0 else len(self.hits) - 1)

    @property
    def due(self) -> bool:
        """Whether a search waits for its moment, after a key or an edit."""
        return self._soon.isActive() or self._again.isActive()

    # Inside

    def _settle_page(self) -> None:
        """Give the canvas the room of the closed bar now, because the view depends on its size."""
        page = self.bar.parentWidget()
        layout = page.layout() if page is not None else None
        if layout is not None:
            layout.activate()

    def _forget(self) -> None:
        self._begun = None

    def _least(self, readable: bool) -> float:
        """The zoom that a hit needs: the present one, if it can be read at it."""
        return self._canvas.zoom if readable else LEAST_ZOOM

    def _shown(self) -> There | None:
        """Where the hit is that is shown."""
        return self.hits[self.current].there if self.current is not None else None

    def _typed(self) -> None:
        """Search, and show the hit that stands nearest in the SB that is shown."""
        self._soon.stop()
        if self.bar.isHidden():
            return
        there = self._shown()
        self._find()
        self.current = None
        at = self.hits.place(there) if there is not None else None
        at = self._nearest() if at is None else at
        if at is None:
            self._mark()
            self._say()
        else:
            self._go(at)

    def _find(self) -> None:
        blueprint, typed = self._session.blueprint, self.bar.field.text()
        self._index.show(blueprint)
        scope = self.bar.scope.currentIndex()
        if scope == EVERYTHING:
            self._index.show_findings(self._inspector.findings)
        wanted = conditions(typed)
        self.hits = Hits.of_states(filtered(blueprint, wanted)) if wanted else Hits()
        if not len(self.hits):
            offered = self.offered() if scope == EVERYTHING else ()
            self.hits = self._index.find(typed, scope, offered)

    def _nearest(self) -> int | None:
        """The hit that is selected, else the first in the SB that is shown."""
        for address in self._session.selection:
            at = self.hits.place(address)
            if at is not None:
                return at
        return self.hits.first_in(self._session.branch)

    def _go(self, at: int) -> None:
        self.current = at
        hit, session = self.hits[at], self._session
        there = hit.there
        if isinstance(there, Address):
            if there.branch in session.blueprint.branches:
                session.show_branch(there.branch)
                session.select((there,) if there.state else ())
            self._mark()
            sheet = self._canvas.sheet
            readable = sheet is not None and sheet.level >= Level.COMPACT
            least = self._least(readable)
            if self._canvas.zoom < least or not self._canvas.shows_whole(there):
                self._canvas.show_in_middle(there, least)
        else:
            self._mark()
            self._show_aside(hit)
        self._say()

    def _show_aside(self, hit: Occurrence) -> None:
        """Show a note or group, or show a fact, a hazard or an operation of the library in its
        panel.
        """
        if isinstance(hit.there, DrawnPlace):
            self._session.show_branch(hit.there.branch)
            self.show_drawn(hit.there.key, self._least(self._canvas.zoom >= READABLE))
        elif isinstance(hit.there, tuple):
            self._going.show_fact(*hit.there)
        elif hit.kind == "Hazard":
            self._going.show_hazard(hit.there)  # type: ignore[arg-type]
        else:
            self._going.show_offered(str(hit.there))
        self.bar.field.setFocus()

    def _changed(self) -> None:
        if not self.bar.isHidden():
            self._again.start()

    def _mark(self) -> None:
        """Mark the hits in the SB that is shown."""
        there = self._shown()
        hit = there if isinstance(there, Address) and there.state else None
        self._canvas.mark_drawn(self.hits.drawn_in(self._session.branch))
        marks, found = self._canvas.marks, self.hits.in_branch(self._session.branch)
        if (marks.found, marks.hit) != (found, hit):
            self._canvas.set_marks(replace(marks, found=found, hit=hit))

    def _say(self) -> None:
        """Show the number of the hit and where it was found, and let a reader read both."""
        self._show_words()
        there = self._shown()
        where = self._canvas.describe(there) if isinstance(there, Address) and there.state else ""
        said = self.bar.count.text(), where, self.bar.found.words
        told = ". ".join(part for part in said if part)
        if told != self._told:
            self._told = told
            announce(self.bar, told)

    def _show_words(self) -> None:
        typed, hits, total = self.bar.field.text().strip(), self.hits, f"{len(self.hits):,}"
        total += " or more" if hits.more else ""
        words = self.bar.found
        if self.current is not None:
            self.bar.show_count(f"{self.current + 1:,} of {total}", True)
            words.show_hit(hits[self.current])
            return
        self.bar.show_count("" if not typed else total if len(hits) else "0 of 0", bool(len(hits)))
        if not typed:
            words.show_words("")
        elif not len(hits):
            words.show_words(self._none(typed), "Nothing has it")
        elif hits.first_in(self._session.branch) is None:
            where = hits.branch(0)
            goes = f"Enter goes to {where}" if where else "Enter shows the first"
            words.show_words(f"None in {self._session.branch}. {goes}", goes)
        else:
            words.show_words("Enter shows the first")

    def _none(self, typed: str) -> str:
        wanted = conditions(typed)
        if wanted:
            return why_nothing(self._session.blueprint, self._session.branch, wanted)
        scope = self.bar.scope.currentIndex()
        of = ("No state or operation", "No state, operation, fact or note", "Nothing here")[scope]
        return f"{of} has “{typed[:60]}”"

    def _example(self) -> str:
        """A filter for the SB that is shown, such as "Disk 1 = a"; empty if it has no facts."""
        branch = self._session.blueprint.branches.get(self._session.branch)
        first = next(iter(branch.table), None) if branch is not None else None
        if branch is None or first is None or not told_facts(branch):
            return ""
        values = branch.facts(first)
        return f"{branch.fact_name(0)[:20]} = {values[0][:8]}" if values else ""


def _timer(parent: QObject, wait: int, call: Callable[[], None]) -> QTimer:
    """A timer that calls once, after ``wait`` milliseconds."""
    made = QTimer(parent)
    made.setSingleShot(True)
    made.setInterval(wait)
    made.timeout.connect(call)
    return made
