"""The canvas of a run: the run's blueprint, one SB at a time, with the marks of the run."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFontMetrics, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QToolButton, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.front.views.hold_advice import ways_out
from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.front.views.run_marks import run_marks
from smsl_studio.front.views.states import short_name
from smsl_studio.graph.layout import place_states
from smsl_studio.legible import plain_text
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.canvas.branch_view import TOP
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is, capital, counted
from smsl_studio.studio.document.places import Position
from smsl_studio.studio.running.frames import laid_over, tool, tools_over, words_over
from smsl_studio.studio.running.operation_time import ShownTime
from smsl_studio.studio.running.shown import DrawnPlaces, ShownRun

TROUBLE = ("held", "failed", "no_route", "refused", "fault_hold", "stopped", "taken_over")
ADVICE = {
    "stopped": "Reset unlatches the run, End run ends it.",
    "taken_over": "Give it back in Supervise mode.",
}
"""What the person can do about a run that has not ended, by its phase. What can be done about a
hold depends on the run (``ways_out``)."""
HELD = ("fault_hold", "no_route")
SAID = ("stopped", "taken_over")
"""The phases whose sentence already names the phase."""
TALLER = 1.2
TOOLS, FOLLOW, PADDING = 180, 50, 16
"""Widths (pixels): the tools at the right, the words of one tool in them, and the space beside the
words of each SB's button."""
NARROW = 280
"""In a canvas narrower than this the tools have no words (pixels)."""
NOTHING = "There is no state to run yet. Draw the first one in Draw mode"
MOVED_ON = "The drawing has moved on. This run holds the version it started with"
RESULTS = "The drawing has moved on. These are the results of the version that ran"
ANOTHER = "{drawn} is open in Draw mode now. This is {what} of {run}"
"""The banner of a run of another file than the drawing."""
NEXT = "Play starts a run of {drawn}"
"""What is added when such a run has ended."""


class RunCanvas(QWidget):
    """Shows the blueprint of the run or its results; without a run the drawing.

    Above it is a button for each SB, with its active state. Follow switches to the SB in which an
    operation runs.
    """

    chosen = Signal(object)
    """Address: the person clicked the arrow of this operation."""
    drawing_wanted = Signal()
    """The person wants to leave the results of another version and see the drawing."""

    def __init__(
        self, session: DrawnPlaces, run: ShownRun, tokens: Tokens, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._run, self._tokens = session, run, tokens
        self._shown: tuple[Blueprint, str, Blueprint] | None = None
        """What is drawn: a blueprint, one of its SBs, and the blueprint that has the places of
        states."""
        self._branch = ""
        self._banner = self._refusal = ""
        self._time: ShownTime | None = None
        self.canvas = Canvas(tokens)
        self.canvas.editing = False
        self.canvas.tools_high = TOP
        self.canvas.overlays.breadcrumb.hide()
        self.caution: Callable[[], tuple[str, ...]] = tuple
        """Returns what the next run cannot give although its levels ask for it, in sentences."""
        self.canvas.overlays.zoom.hide()
        self.canvas.edge_clicked.connect(self.chosen)
        self.canvas.enter_wanted.connect(self.show_branch)
        self._steps = label("", "second")
        buttons = QWidget()
        self._buttons = QHBoxLayout(buttons)
        self._buttons.setContentsMargins(0, 0, 0, 0)
        self._buttons.setSpacing(2)
        self._branches: list[QToolButton] = []
        self._follow = tool("Follow", "eye", "Show the State Branch in which it runs", tokens)
        self._follow.setCheckable(True)
        self._follow.setChecked(True)
        self._follow.toggled.connect(lambda _: self._dress_follow())
        self._fit = tool("", "fit", "Fit everything (F)", tokens)
        self._fit.clicked.connect(self.canvas.fit)
        self._dress_follow()
        self.to_drawing = tool(
            "Show the drawing",
            "pencil",
            "Leave these results; the next run uses the drawing",
            tokens,
        )
        self.to_drawing.clicked.connect(self.drawing_wanted)
        tools = tools_over(self.to_drawing, self._follow, self._fit)
        whole = laid_over(self.canvas, words_over(buttons, self._steps), tools)
        self.setMinimumWidth(280)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.addWidget(whole, 0, 0)

    @property
    def branch(self) -> str:
        """The SB that is shown."""
        return self._branch

    @property
    def banner(self) -> str:
        """The text across the top; empty for none."""
        return self._banner

    @property
    def moved_on(self) -> bool:
        """Whether the drawing differs from the blueprint of the run that is shown."""
        return self._run.is_another(self._session.blueprint)

    def refresh(self) -> None:
        """Show the present state of the run.

        A hidden canvas is drawn when it is shown next. Otherwise each edit in Draw mode would also
        route the arrows here.
        """
        if self.isVisible():
            self._draw()
        self._show_banner()

    def _draw(self) -> None:
        self.to_drawing.setVisible(self.moved_on and not self._run.exists)
        blueprint = self._blueprint()
        if self._branch not in blueprint.branches:
            self._branch = next(iter(blueprint.roots), next(iter(blueprint.branches), ""))
        status = self._run.status
        if status and status.running and self._follow.isChecked() and self._run.exists:
            self._branch = status.running.branch
        self._show(blueprint)
        self._name_branches(blueprint)
        self._steps.setText(self._step_words())
        self._fit_steps()
        if self._branch and self._run.blueprint is blueprint and status is not None:
            marks = run_marks(blueprint, self._branch, status, self._run.story)
        else:
            marks = Marks()
        self._mark(marks)

    def show_time(self, shown: ShownTime | None) -> None:
        """Show how far an operation has got that takes no time of its own."""
        self._time = shown
        if self.isVisible():
            self._mark(self.canvas.marks)

    def _mark(self, marks: Marks) -> None:
        shown = self._time
        if shown is not None and marks.running is not None and marks.running[0] == shown.address:
            running = (shown.address, shown.share)
            marks = replace(marks, running=running, running_words=shown.said)
        if marks != self.canvas.marks:
            self.canvas.set_marks(marks)

    def drawing_changed(self) -> None:
        """Update the banner after an edit. A run continues with its own version and says so."""
        self._refusal = ""
        self.refresh()

    def showEvent(self, event: QShowEvent) -> None:
        """Show the present state of the run."""
        super().showEvent(event)
        self.refresh()

    def show_refusal(self, words: str) -> None:
        """Show why a run could not begin; empty hides the sentence."""
        self._refusal = words
        self._show_banner()

    def _show_banner(self) -> None:
        why = self._refusal if self._blueprint().state_count else NOTHING
        ahead = () if self._run.exists or self._refusal else self.caution()
        words = [why, self._trouble(), *self._notes(), self._moved_words(), *ahead]
        said = "\n".join(word for word in words if word)
        if said != self._banner:
            self._banner = said
            self.canvas.show_banner(said)

    def _moved_words(self) -> str:
        """The sentence that the drawing differs from what is shown; empty if it does not."""
        run = self._run
        if not self.moved_on:
            return ""
        if run.foreign and run.blueprint is not None:
            drawn, ran = (Path(one.file).name for one in (self._session.blueprint, run.blueprint))
            what = "the run" if run.exists else "the result"
            said = ANOTHER.format(drawn=drawn, what=what, run=ran)
            return said if run.exists else f"{said}. {NEXT.format(drawn=drawn)}"
        return MOVED_ON if run.exists else RESULTS

    def _notes(self) -> tuple[str, ...]:
        """Notes about the route of the run."""
        run = self._run
        if run.status is None or not run.exists or run.blueprint is not self._blueprint():
            return ()
        return run.status.notes

    def _trouble(self) -> str:
        """Why the run holds, or why it ended before its goal; empty if neither."""
        run = self._run
        if run.blueprint is not self._blueprint() or run.phase not in TROUBLE:
            return ""
        advice = "" if run.foreign else "Play starts a new run."
        if run.exists:
            held = run.phase in HELD and run.status is not None
            advice = ways_out(run.status) if held and run.status else ADVICE.get(run.phase, "")
        words = capital(run.sentence)
        if run.phase not in SAID:
            words = f"{phase_words(run.phase)[0]}: {words}"
        return f"{words} {advice}".strip()

    def say(self, words: str) -> None:
        """Show a short sentence at the pointer."""
        self.canvas.say(words)

    def show_branch(self, name: str) -> None:
        """Show another SB and stop following."""
        if name in self._blueprint().branches:
            self._branch = name
            self._follow.setChecked(False)
            self.refresh()

    def jump(self, address: Address) -> None:
        """Bring the element of an address into view."""
        if address.branch in self._blueprint().branches:
            if address.branch != self._branch:
                self.show_branch(address.branch)
            self.canvas.reveal(address)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.canvas.set_tokens(tokens)
        self._dress_follow()
        self._fit.setIcon(icon("fit", tokens))
        self.to_drawing.setIcon(icon("pencil", tokens))

    def _dress_follow(self) -> None:
        colour = self._tokens.acc if self._follow.isChecked() else self._tokens.tx2
        self._follow.setIcon(icon("eye", self._tokens, 16, colour))

    def _blueprint(self) -> Blueprint:
        """The blueprint of the run while it or its results are shown, else the drawing."""
        held = self._run.blueprint
        return held if held is not None and self._run.shown else self._session.blueprint

    def _show(self, blueprint: Blueprint) -> None:
        drawn = blueprint if self.moved_on else self._session.blueprint
        shown, before = (blueprint, self._branch, drawn), self._shown
        if before is not None and all(map(operator.is_, shown, before)):
            return
        self._shown = shown
        again = before is not None and before[:2] == shown[:2] and before[0] is blueprint
        branch = drawn.branches.get(self._branch)
        places = _filling(branch, self._places_of(drawn, branch)) if branch else None
        self.canvas.show_branch(blueprint, self._branch, places, keep_view=again)

    def _places_of(self, blueprint: Blueprint, branch: StateBranch) -> dict[str, Position]:
        """The places of the states (scene units): as in the drawing if it is of the same file."""
        if blueprint.file == self._session.blueprint.file and not self._run.foreign:
            return self._session.places.shown(branch)
        return place_states(branch)

    def _name_branches(self, blueprint: Blueprint) -> None:
        status = self._run.status if self._run.blueprint is blueprint else None
        names = list(blueprint.branches)
        states = status.configuration if status else {}
        words = self._branch_words(blueprint, states)
        while len(self._branches) < len(names):
            self._branches.append(self._button(len(self._branches)))
            self._buttons.addWidget(self._branches[-1])
        for index, button in enumerate(self._branches):
            button.setVisible(index < len(names))
            if index < len(names):
                name = names[index]
                state = states.get(name, "")
                button.setText(as_it_is(words[index]))
                button.setToolTip(
                    tip_text(f"Show {name}" + (f": {state} is active" if state else ""))
                )
                button.setAccessibleName(plain_text(f"{name}, {state} active" if state else name))
                button.setChecked(name == self._branch)
                running = status.running if status else None
                live = running is not None and running.branch == name
                _set(button, "live", live and len(names) > 1)

    def _branch_words(self, blueprint: Blueprint, states: Mapping[str, str]) -> list[str]:
        """The labels of the SB buttons: with active states if there is room beside the tools."""
        names = list(blueprint.branches)
        if len(names) < 2:
            return names
        short = {n: short_name(blueprint[n], s) for n, s in states.items() if n in names}
        full = [f"{name}  {short[name]}" if short.get(name) else name for name in names]
        metrics = QFontMetrics(text_font(13, 600))
        room = self.width() - self._tools_wide - PADDING * len(names)
        here = [words if name == self._branch else name
                for name, words in zip(names, full, strict=True)]  # fmt: skip
        for words in (full, here, names):
            if sum(map(metrics.horizontalAdvance, words)) <= room:
                return words
        middle, share = Qt.TextElideMode.ElideMiddle, max(room // len(names), 24)
        return [metrics.elidedText(plain_text(name), middle, share) for name in names]

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the labels of the SB buttons into the new width."""
        super().resizeEvent(event)
        style = Qt.ToolButtonStyle
        self._follow.setToolButtonStyle(
            style.ToolButtonIconOnly if self._is_narrow else style.ToolButtonTextBesideIcon
        )
        self._name_branches(self._blueprint())
        self._fit_steps()

    def _fit_steps(self) -> None:
        """Show the number of steps only where it does not reach the tools."""
        wide = self._steps.fontMetrics().horizontalAdvance(self._steps.text()) + PADDING
        self._steps.setVisible(
            self._buttons.sizeHint().width() + wide <= self.width() - self._tools_wide
        )

    @property
    def _tools_wide(self) -> int:
        """The width of the tools at the right (pixels)."""
        more = 0 if self.to_drawing.isHidden() else self.to_drawing.sizeHint().width()
        return TOOLS + more - (FOLLOW if self._is_narrow else 0)

    @property
    def _is_narrow(self) -> bool:
        """Whether the words on the tools are hidden, because the names of SBs need the space."""
        return self.width() < NARROW

    def _button(self, index: int) -> QToolButton:
        button = QToolButton()
        button.setProperty("role", "branch")
        button.setCheckable(True)
        button.clicked.connect(lambda: self.show_branch(list(self._blueprint().branches)[index]))
        return button

    def _step_words(self) -> str:
        status = self._run.status
        if status is None or self._run.blueprint is not self._blueprint():
            return ""
        left = len(status.route) + (status.running is not None)
        if left and self._run.exists:
            return f"operation {status.operations + 1} of {status.operations + left}"
        return counted(status.operations, "operation")


def _filling(branch: StateBranch, places: dict[str, Position]) -> dict[str, Position]:
    """The places, stretched in height if nobody placed a state, because this canvas is upright."""
    if branch.notes.layout or len(places) < 3:
        return places
    wide, high = (max(side) - min(side) for side in zip(*places.values(), strict=True))
    factor = min(max(wide / max(high, 1.0), 1.0), TALLER)
    return {name: (x, y * factor) for name, (x, y) in places.items()}


def _set(widget: QWidget, name: str, value: bool) -> None:
    if bool(widget.property(name)) != value:
        widget.setProperty(name, value)
        widget.style().unpolish(widget)
        widget.style().polish(widget)
