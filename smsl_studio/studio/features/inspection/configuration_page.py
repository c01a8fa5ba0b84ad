"""The tab Configuration: the state of each SB, the operations that are permitted, and a run to
there.
"""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import StudioError
from smsl_studio.front.views.claim_run import RunStep, steps_of
from smsl_studio.inspection.proof.verdict import Counterexample
from smsl_studio.studio.base.controls import Elided, Field, label, row, row_button
from smsl_studio.studio.base.tab_order import in_order
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.inspection.back_key import BackKey
from smsl_studio.studio.features.inspection.branch_columns import BranchColumns
from smsl_studio.studio.features.inspection.column_rows import columns_of
from smsl_studio.studio.features.inspection.explorer import Explorer
from smsl_studio.studio.features.inspection.lit_run import LitRun
from smsl_studio.studio.features.inspection.look_line import LookLine
from smsl_studio.studio.features.inspection.run_view import RunView
from smsl_studio.studio.features.inspection.state_pick import StatePick
from smsl_studio.studio.features.inspection.step_list import StepList
from smsl_studio.studio.features.inspection.typed_configuration import (
    typed_configuration,
    written_configuration,
)
from smsl_studio.studio.running.frames import split

LATE = 150
"""If the steps out of a configuration are not known after this time, the configuration is shown
without them (milliseconds)."""
END = "Nothing is permitted here."
UPPER, LOWER, HEAD = 230, 206, 62
"""Heights (pixels): the columns, the run below them, and the space around the cards of the run."""


class ConfigurationPage(QWidget):
    """Lets a person walk from configuration to configuration. It runs nothing and edits nothing.

    ``lit`` shows the walk on the drawing.
    """

    start_wanted = Signal(object)
    """tuple[str]: the next run shall start in these states (addresses)."""

    def __init__(self, session: Session, lit: LitRun, tokens: Tokens) -> None:
        super().__init__()
        self._session, self._lit, self._tokens = session, lit, tokens
        self._entered = False
        self._lit_trail: tuple[RunStep, ...] | None = None
        self._held = False
        """True while a run is shown although the explorer is still looking. The next result does
        not hide the run."""
        self._written = ""
        """The last text that was typed, if it is not yet a configuration that is shown."""
        self.explorer = Explorer(session, self)
        self.columns, self.steps = BranchColumns(tokens), StepList(tokens)
        self.run, self.looking = RunView(lit, tokens), LookLine()
        self.back_key = BackKey(self)
        self.count = Elided("")
        self.count.setProperty("role", "second")
        self.back = row_button("Back", "To where it stood before (Alt+Left)")
        self.first = row_button("To start", "To where a run starts")
        self.shortest = row_button("Shortest run to here", "The fewest operations from the start")
        self.begin = row_button("Start the run here", "Choose this as the start of the next run")
        self.field = Field()
        self.field.setAccessibleName("Configuration")
        self.field.setToolTip("States with commas between them. Enter goes there")
        self.refusal = label("", "refusal")
        self.said = label("", "hint")
        self.again = row_button("Look again", "Look at the steps once more")
        parts = (self._upper(), self.run)
        self.split = split(Qt.Orientation.Vertical, parts, (UPPER, LOWER), (1, 0))
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.split)
        self._late = QTimer(self)
        self._late.setSingleShot(True)
        self._late.setInterval(LATE)
        self._late.timeout.connect(self._show_place)
        self.run.hide()
        self.setFocusProxy(self.steps)
        in_order(self.back, [self.first, self.shortest, self.begin, self.looking.cancel, self.again,
                             self.columns, self.field, self.steps])  # fmt: skip
        self._connect()
        self._show_place()

    def _upper(self) -> QWidget:
        head = row(label("Configuration", "heading"), self.count, self.back, self.first,
                   self.shortest, self.begin, spacing=6)  # fmt: skip
        head.setContentsMargins(12, 6, 12, 4)
        left = QWidget()
        down = QVBoxLayout(left)
        down.setContentsMargins(0, 0, 0, 0)
        down.setSpacing(2)
        down.addWidget(self.columns, 1)
        for part in (self.field, self.refusal):
            line = row(part)
            line.setContentsMargins(12, 0, 12, 2)
            down.addLayout(line)
        sides = split(Qt.Orientation.Horizontal, (left, self.steps), (500, 500), (0, 0))
        told = row(self.looking, self.said, self.again)
        told.setContentsMargins(12, 0, 12, 4)
        whole = QWidget()
        column = QVBoxLayout(whole)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(head)
        column.addLayout(told)
        column.addWidget(sides, 1)
        return whole

    def _connect(self) -> None:
        explorer = self.explorer
        explorer.changed.connect(self._changed)
        explorer.refused.connect(self._refused)
        explorer.found.connect(self._show_run)
        self.back_key.pressed.connect(self._go_back)
        self.back.clicked.connect(self._go_back)
        self.first.clicked.connect(explorer.to_start)
        self.shortest.clicked.connect(explorer.find_run)
        self.begin.clicked.connect(self._begin)
        self.again.clicked.connect(explorer.look_again)
        self.looking.cancelled.connect(explorer.call_off)
        self.steps.step_wanted.connect(explorer.take)
        self.columns.picked.connect(self._place)
        self.columns.list_wanted.connect(self._pick)
        self.field.returnPressed.connect(self._typed)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for part in (self.columns, self.steps, self.run):
            part.set_tokens(tokens)
        self.back_key.watch(self)

    def enter(self) -> None:
        """Show the walk on this page and on the drawing, because the person has opened this tab."""
        self._entered, self._lit_trail = True, self.explorer.trail
        self.explorer.look()
        self._lit.show_steps(self.explorer.trail, max(len(self.explorer.trail) - 1, 0))
        self._show_place()

    def leave(self) -> None:
        """Show nothing on the drawing, because the person has left this tab."""
        if self._entered:
            self._entered = False
            self._end_run()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.explorer.stop()

    def _changed(self) -> None:
        if not self._entered:
            return
        explorer = self.explorer
        if explorer.is_outdated:
            # The drawing has changed, so the old steps may be wrong and are not shown.
            self._end_run()
            explorer.look()
            return
        if explorer.steps is None and explorer.work:
            self.looking.show_work(explorer.work)
            if not self._late.isActive():
                self._late.start()
            return
        self._show_place()

    def _show_place(self) -> None:
        """Show the configuration in which the explorer is now."""
        self._late.stop()
        explorer, trail = self.explorer, self.explorer.trail
        self.looking.show_work(explorer.work)
        steps, known = explorer.steps or (), explorer.steps is not None
        blueprint = self._session.blueprint
        stands = bool(trail) and trail[-1].configuration.keys() == blueprint.branches.keys()
        columns = columns_of(blueprint, trail, steps) if stands else ()
        self.columns.show_columns(columns, len(blueprint) - len(columns) if stands else 0)
        self.steps.show_steps(blueprint, steps, END if known and stands else "")
        self.said.setText(explorer.said)
        self.said.setVisible(bool(explorer.said))
        self.again.setVisible(stands and not known and not explorer.work)
        self.count.setText(_walked(len(trail) - 1) if stands else "")
        text = written_configuration(explorer.configuration) if stands else ""
        self.field.settle(text)
        self._refuse("")
        self.field.setEnabled(stands)
        self.back.setEnabled(explorer.can_go_back)
        for button in (self.first, self.shortest, self.begin):
            button.setEnabled(stands)
        self.back_key.watch(self)
        self._light()

    def _light(self) -> None:
        """Show the walk on the drawing.

        A run that was shown before ends, because it belongs to another configuration.
        """
        trail = self.explorer.trail
        if not self._entered or trail is self._lit_trail:
            return
        if self._held:
            self._held, self._lit_trail = False, trail
            return
        self._end_run()
        self._lit_trail = trail
        self._lit.show_steps(trail, max(len(trail) - 1, 0))
        if len(trail) > 1:
            self._lit.go(len(trail) - 1)

    def _end_run(self) -> None:
        self._lit_trail, self._held = None, False
        self.run.clear()
        self.run.hide()

    def show_steps(self, steps: tuple[RunStep, ...], title: str, bad: bool = True) -> None:
        """Show a run from the start. It stays until the person takes a step."""
        if self._entered and steps:
            # A search may still find the present configuration. Its result must not end this run.
            self._held = self.explorer.is_outdated or bool(self.explorer.work)
            hidden = self.run.isHidden()
            self.run.show()
            self.run.show_steps(self._session.blueprint, steps, title, bad)
            if hidden:
                # The run gets the height of its rows, and the columns get the rest.
                low = HEAD + self.run.strip.height()
                self.split.setSizes([max(self.split.height() - low, UPPER // 2), low])

    def _show_run(self, run: Counterexample) -> None:
        steps = steps_of(self._session.blueprint, run)
        self.show_steps(steps, "Shortest run to here", bad=False)

    def _go_back(self) -> None:
        self.explorer.back()

    def _begin(self) -> None:
        here = self.explorer.configuration
        self.start_wanted.emit(tuple(str(Address(*pair)) for pair in here.items()))

    def _place(self, name: str, state: str) -> None:
        self._written = ""
        self.explorer.place({name: state})

    def _pick(self, name: str) -> None:
        branch = self._session.blueprint.branches.get(name)
        if branch is None:
            return
        here = self.explorer.configuration.get(name, "")
        dialog = StatePick(branch, here, self._tokens, self.window())
        dialog.chosen.connect(self._place)
        dialog.open()

    def _typed(self) -> None:
        self._written = self.field.text()
        try:
            wanted = typed_configuration(self._session.blueprint, self.field.text())
        except StudioError as error:
            self._refuse(refusal_words(error))
        else:
            self.explorer.place(wanted)

    def _refused(self, words: str) -> None:
        """Say why the configuration is not possible.

        The typed text stays, so that it can be corrected.
        """
        if self._written:
            self.field.setText(self._written)
        self._refuse(words)

    def _refuse(self, words: str) -> None:
        self.refusal.setText(words)
        self.refusal.setVisible(bool(words))
        self.field.set_refused(bool(words))


def _walked(steps: int) -> str:
    return f"{counted(steps, 'operation')} since it began" if steps else "the walk begins here"
