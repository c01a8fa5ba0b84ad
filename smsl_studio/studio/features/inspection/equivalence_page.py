"""The tab Equivalence: compares the behaviour of versions, and that of states."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QLayout, QVBoxLayout, QWidget

from smsl_studio.errors import StudioError
from smsl_studio.studio.base.controls import Label, label, row, row_button
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import capital, counted, refusal_words, series
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.inspection.claim_model import CHANGED
from smsl_studio.studio.features.inspection.drawing_look import DrawingLook, same_in
from smsl_studio.studio.features.inspection.equivalence_look import (
    ComparedRuns,
    EquivalenceLook,
)
from smsl_studio.studio.features.inspection.lit_run import LitRun
from smsl_studio.studio.features.inspection.look_line import LookLine
from smsl_studio.studio.features.inspection.run_view import RunView
from smsl_studio.studio.running.frames import split

if TYPE_CHECKING:
    from smsl_studio.generate.shapes.same_states import SameStates
    from smsl_studio.studio.document.versions import Version

    Choose = Callable[[Callable[[Version], object]], object]
    """Asks the person for a version, and calls the function with it."""

NOTHING = (
    "Choose a version. The answer is “Same behaviour”, or the shortest run after which the two "
    "differ."
)
MOST = 300
"""The largest number of rows of states that are shown."""
UPPER, LOWER = 230, 206


class EquivalencePage(QWidget):
    """Compares the behaviour of the drawing with another version, and of its states with each
    other.

    ``lit`` shows a run on the drawing.
    """

    play_wanted = Signal(object, object)
    """(Version, runs): open the compare view, and walk both sides through their runs."""
    merge_wanted = Signal(object)
    """SameStates: merge these states into one."""

    def __init__(self, session: Session, lit: LitRun, tokens: Tokens) -> None:
        super().__init__()
        self._session, self._tokens = session, tokens
        self._entered = False
        self.look, self.same = EquivalenceLook(session, self), DrawingLook(session, same_in, self)
        self.choices: tuple[Choose, ...] = ()
        """Three functions: they ask for a file, take the saved version, and ask for a revision.
        Another feature sets them."""
        self.has_file: Callable[[], bool] = lambda: False
        """Whether the drawing has a file. Only then are there earlier versions."""
        self.file = row_button("File…", "Compare the behaviour with that of a file")
        self.saved = row_button("Saved version", "Compare with what was saved or read last")
        self.revision = row_button("Revision…", "Compare with a commit of git")
        self.mark, self.verdict = Label(), label("", "heading")
        self.reason = label("", "second")
        self.reason.setWordWrap(True)
        self.both = row_button("Show on both sides", "Walk the run in the compare view")
        self.again = row_button("Compare again", "Compare what is drawn now")
        self.looking = LookLine()
        self.rows = RowsView(tokens)
        self.rows.setAccessibleName("States that behave alike")
        self.why = label("", "hint")
        self.merge = row_button("Merge…", "Show what it would be with one state for them")
        self.run = RunView(lit, tokens)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        parts = (self._upper(), self.run)
        column.addWidget(split(Qt.Orientation.Vertical, parts, (UPPER, LOWER), (1, 0)))
        self.run.hide()
        self.setFocusProxy(self.file)
        self._connect()
        self._show_answer()
        self._show_same()

    def _upper(self) -> QWidget:
        choose = row(label("Compare with", "second"), self.file, self.saved,
                     self.revision, None, spacing=6)  # fmt: skip
        left = _column(
            choose, row(self.looking), row(self.mark, self.verdict, None), self.reason,
            row(self.both, self.again, None),
        )  # fmt: skip
        right = _column(
            row(label("States that cannot be told apart", "heading"), None, self.merge),
            self.why,
            self.rows,
        )
        return split(Qt.Orientation.Horizontal, (left, right), (540, 460), (0, 0))

    def _connect(self) -> None:
        for at, button in enumerate((self.file, self.saved, self.revision)):
            button.clicked.connect(lambda _=False, at=at: self.choices[at](self.look.compare))
        self.look.changed.connect(self._show_answer)
        self.same.changed.connect(self._same_changed)
        self.looking.cancelled.connect(self.look.call_off)
        self.again.clicked.connect(self.look.again)
        self.both.clicked.connect(self._play)
        self.merge.clicked.connect(self._merge)
        self.rows.activated.connect(lambda _: self._merge())
        self.rows.selectionModel().currentChanged.connect(lambda *_: self._show_chosen())

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.rows.set_tokens(tokens)
        self.run.set_tokens(tokens)
        self._show_verdict()

    def enter(self) -> None:
        """Show the run on this page and on the drawing, because the person has opened this tab."""
        self._entered = True
        for button in (self.saved, self.revision):
            button.setEnabled(self.has_file())
        self.same.look()
        self._show_answer()

    def leave(self) -> None:
        """Show nothing on the drawing, because the person has left this tab."""
        if self._entered:
            self._entered = False
            self.run.clear()
            self.run.hide()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.look.stop()
        self.same.stop()

    @property
    def chosen(self) -> SameStates | None:
        """The states in the selected row. None if no row is selected."""
        same: SameStates | None = self.rows.current_payload
        return same

    # The comparison with a version.

    def _show_answer(self) -> None:
        answer = self.look.answer
        self._show_verdict()
        self._show_run(answer if isinstance(answer, ComparedRuns) else None)

    def _show_verdict(self) -> None:
        look = self.look
        answer, version = look.answer, look.version
        name = version.words if version else ""
        self.looking.show_work(f"Comparing with {name}" if look.works else "")
        sign, ink, words, reason = self._said(answer)
        if answer is None:
            old = "Stopped comparing" if look.stopped else CHANGED
            words = "" if look.works or version is None else f"{name}: {old}"
            reason = NOTHING if version is None else ""
            sign, ink = "unknown", self._tokens.unk
        self.mark.setPixmap(pixmap(sign, ink, self._tokens.surf, 16, self.devicePixelRatioF()))
        self.mark.setVisible(bool(words))
        self.verdict.setText(words)
        self.reason.setText(reason)
        self.again.setVisible(version is not None and not look.works)
        self.both.setVisible(isinstance(answer, ComparedRuns) and answer.told.equal is False)

    def _said(self, answer: ComparedRuns | StudioError | None) -> tuple[str, QColor, str, str]:
        """The icon and its colour, the verdict and the reason, for an answer."""
        tokens, version = self._tokens, self.look.version
        name = version.words if version else ""
        if isinstance(answer, StudioError):
            return "unknown", tokens.unk, f"{name}: not compared", refusal_words(answer)
        told = answer.told if answer is not None else None
        if told is None:
            return "unknown", tokens.unk, "", ""
        if told.equal is None:
            return "unknown", tokens.unk, f"{name}: unknown", capital(told.reason)
        if told.equal:
            count = counted(told.configurations[1], "configuration")
            return "check", tokens.ok, f"Same behaviour as {name}", f"{count}, all."
        return "error", tokens.bad, f"Another behaviour than {name}", capital(told.reason)

    def _show_run(self, answer: ComparedRuns | None) -> None:
        if not self._entered:
            return  # another tab may show a run on the drawing
        if answer is None or answer.told.equal is not False or not answer.told.path:
            self.run.clear()
            self.run.hide()
            return
        self.run.show()
        words = "Shortest run to a difference"
        self.run.show_steps(self._session.blueprint, answer.after, words, bad=True)

    def _play(self) -> None:
        answer, version = self.look.answer, self.look.version
        if isinstance(answer, ComparedRuns) and version is not None:
            self.play_wanted.emit(version, (answer.before, answer.after))

    # The states that behave alike.

    def _same_changed(self) -> None:
        if self._entered and self.same.answer is None:
            self.same.look()
        self._show_same()

    def _show_same(self) -> None:
        answer = self.same.answer
        found = answer if isinstance(answer, tuple) else ()
        rows = [_row(one, len(self._session.blueprint) > 1) for one in found[:MOST]]
        if len(found) > MOST:
            rows.append(ListRow(f"and {len(found) - MOST:,} more", kind="section"))
        self.rows.show_rows(rows)
        self._show_chosen()

    def _show_chosen(self) -> None:
        chosen, answer = self.chosen, self.same.answer
        self.merge.setEnabled(chosen is not None and not chosen.why_not)
        if chosen is not None:
            words = chosen.why_not or "the same facts, and the same operations from there on"
            self.why.setText(capital(f"{series(chosen.states)}: {words}"))
        elif isinstance(answer, StudioError):
            self.why.setText(refusal_words(answer))
        elif answer is None:
            self.why.setText("Not known yet.")
        elif answer:
            self.why.setText("Choose a row to see why.")
        else:
            self.why.setText("There are none: whatever happens, each state shows which it is.")

    def _merge(self) -> None:
        chosen = self.chosen
        if chosen is not None and not chosen.why_not:
            self.merge_wanted.emit(chosen)


def _row(same: SameStates, several: bool) -> ListRow:
    names = series(same.states[:6])
    more = f" and {len(same.states) - 6:,} more" if len(same.states) > 6 else ""
    branch = f"{same.branch}: " if several else ""
    icon = "minus" if same.why_not else "mixed"
    right = "differ in facts" if same.facts else "not merged" if same.why_not else "can be merged"
    return ListRow(f"{branch}{names}{more}", same, icon, right=right, accent=not same.why_not)


def _column(*parts: QWidget | QLayout) -> QWidget:
    """A widget that holds the parts in one column."""
    made = QWidget()
    down = QVBoxLayout(made)
    down.setContentsMargins(12, 8, 12, 8)
    down.setSpacing(8)
    for part in parts:
        if isinstance(part, QWidget):
            down.addWidget(part, int(isinstance(part, RowsView)))
        else:
            down.addLayout(part)
    if not any(isinstance(part, RowsView) for part in parts):
        down.addStretch(1)
    return made
