"""The tour in a window: sees what the person did, and shows the next step."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QRect, QTimer, Signal
from PySide6.QtWidgets import QWidget
from shiboken6 import isValid

from smsl_studio.runlog.events import Event
from smsl_studio.runlog.regulation import Commanded
from smsl_studio.studio.base.feature import Shell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.tour.callout import Callout, Ring
from smsl_studio.studio.features.tour.placement import beside, without_control
from smsl_studio.studio.features.tour.practice import Misprint
from smsl_studio.studio.features.tour.steps import TourState, TourStep, step_of
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.window_parts import WindowParts

DECISIONS = frozenset(
    {"veto", "prune", "restore", "ask", "set_cost", "take_over", "adopt", "accept"}
)
"""The commands that count as a decision of the supervisor."""
EDGE = 12
"""The least distance between a callout and the edge of the window (pixels)."""
_MOVES = (QEvent.Type.Move, QEvent.Type.Resize, QEvent.Type.Show, QEvent.Type.Hide)


class Tour(QObject):
    """One tour, from its begin until somebody leaves it. It takes no click from the window.

    The steps follow from the drawing, the selection, the mode and the run, and never from time.
    """

    ended = Signal()
    """The tour was left, or another file was opened."""

    def __init__(self, parts: WindowParts, shell: Shell, tokens: Tokens) -> None:
        super().__init__(parts.window)
        session = self._session = parts.session
        self._shell, self._window = shell, parts.window
        self._misprint = Misprint(session.blueprint)
        self._run: RunSession | None = None
        self._moves = self._finished = self._stopped = self._decided = False
        self.step: TourStep | None = None
        self.callout, self.ring = Callout(tokens, parts.window), Ring(tokens, parts.window)
        self.callout.left.connect(self.end)
        self._watched: list[QWidget] = []
        # Many widgets move at once when the window changes. All is placed once, after them.
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.setInterval(0)
        self._later.timeout.connect(self._place)
        for signal in (session.selection_changed, session.blueprint_changed,
                       parts.inspector.found):  # fmt: skip
            signal.connect(self.look)
        session.opened.connect(self.end)
        self._window.installEventFilter(self)
        self.look()

    def follow(self, run: RunSession) -> None:
        """See what happens in the run of the window."""
        self._run = run
        run.changed.connect(self._step)
        run.exists_changed.connect(self._begun_or_ended)
        run.events_told.connect(self._hear)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.callout.set_tokens(tokens)
        self.ring.set_tokens(tokens)

    def end(self, *_: object) -> None:
        """Leave the tour. The copy stays open, and a run goes on."""
        self._later.stop()
        self._window.removeEventFilter(self)
        self._unwatch()
        for part in (self.callout, self.ring):
            part.hide()
            part.deleteLater()
        self.ended.emit()
        self.deleteLater()

    # What is seen.

    @property
    def seen(self) -> TourState:
        """What is there now."""
        session, run = self._session, self._run
        mended = self._misprint.is_mended(session.blueprint)
        return TourState(
            self._shell.mode,
            chosen=self._misprint.address in session.selection,
            mended=mended,
            gone=not mended and not self._misprint.is_there(session.blueprint),
            exists=run is not None and run.exists,
            phase=run.phase if run is not None else "",
            moves=self._moves,
            finished=self._finished,
            stopped=self._stopped,
            decided=self._decided,
        )

    @property
    def is_settled(self) -> bool:
        """Whether callout and ring stand where they belong now."""
        return not self._later.isActive()

    def look(self, *_: object) -> None:
        """Show the step that is next, and point at its control where it is now."""
        self._step()
        self._later.start()

    def _step(self) -> None:
        step = step_of(self.seen)
        if step is not self.step:
            self.step = step
            self.callout.show_step(step)
            self._later.start()

    def _begun_or_ended(self, _: bool) -> None:
        self._moves = False
        self._step()

    def _hear(self, events: tuple[Event, ...]) -> None:
        for event in events:
            self._moves |= event.event == "operation_started"
            self._finished |= event.event == "run_finished"
            if isinstance(event, Commanded) and not event.refused:
                self._stopped |= event.command == "stop"
                self._decided |= self._stopped and event.command in DECISIONS
        self._step()

    # Where it points.

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the controls when they, or the parts around them, move, come or go."""
        if event.type() in _MOVES:
            self._later.start()
        return super().eventFilter(watched, event)

    def _place(self) -> None:
        """Put ring and callout where the control is now."""
        self._unwatch()
        self._watch(self._window)
        names = self.step.controls if self.step is not None else ()
        target = next(iter(self._boxes(names)), QRect())
        spared = self._boxes(self.step.spared if self.step is not None else ())
        room, size = self._window.rect().adjusted(EDGE, EDGE, -EDGE, -EDGE), self.callout.body
        self.ring.setVisible(not target.isEmpty())
        if target.isEmpty():
            place = without_control(size, room)
        else:
            place = beside(target, size, room, spared)
            self.ring.surround(target)
        self.callout.stand(place, target)
        for part in (self.ring, self.callout):
            part.raise_()
        self.callout.show()

    def _boxes(self, names: Sequence[str]) -> list[QRect]:
        """The boxes of the visible controls of these names, in the window."""
        found = [self._box(*control) for name in names for control in self._shell.controls(name)]
        return [box for box in found if not box.isEmpty()]

    def _box(self, widget: QWidget, part: QRect) -> QRect:
        """The box of a control in the window; empty if it is not visible."""
        self._watch(widget)
        if not widget.isVisible():
            return QRect()
        box = QRect(widget.mapTo(self._window, part.topLeft()), part.size())
        return box.intersected(self._window.rect())

    def _watch(self, widget: QWidget | None) -> None:
        """Listen to the moves of a control and of everything around it."""
        while widget is not None and widget not in self._watched:
            widget.installEventFilter(self)
            self._watched.append(widget)
            widget = None if widget is self._window else widget.parentWidget()

    def _unwatch(self) -> None:
        for widget in self._watched:
            if isValid(widget):
                widget.removeEventFilter(self)
        self._watched.clear()
