"""The page Physics: the world and its buttons above, the graph that grows, and what differs from
the drawing."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal, SignalInstance
from PySide6.QtWidgets import (
    QComboBox,
    QPushButton,
    QSpinBox,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.signs import ADDED
from smsl_studio.front.generated import Generated
from smsl_studio.front.physics import PhysicsDifference, against, explored_blueprint
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.controls import Elided, label
from smsl_studio.studio.base.panels import empty_panel
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.physics.work import DONE, NONE, PAUSED, RUNNING, PhysicsWork
from smsl_studio.studio.running.frames import head, split

EMPTY = "Nothing is explored yet."
EXPLAINED = (
    "Explore tries every operation of the world in every state that it finds, and the graph grows "
    "here while it does. It begins at the INITIAL state of the drawing. What was found becomes a "
    "new blueprint, to be inspected; the drawing does not change."
)
MOST = 500
"""So many differences are listed."""


class PhysicsPage(QWidget):
    """Shows an exploration. The drawing does not change: what was found becomes a new one."""

    explore_wanted, keep_wanted = Signal(), Signal()

    def __init__(self, work: PhysicsWork, tokens: Tokens) -> None:
        super().__init__()
        self._work = work
        self._made: Generated | None = None
        self.setAccessibleName("Physics")
        self.world, self.repeats = QComboBox(), QSpinBox()
        self.world.setAccessibleName("World")
        self.world.setToolTip(tip_text("The simulated world that is tried out"))
        self.repeats.setRange(1, 20)
        self.repeats.setPrefix("each ")
        self.repeats.setSuffix(" ×")
        self.repeats.setAccessibleName("Repeats")
        self.repeats.setToolTip(tip_text("How often each operation must succeed, with other seeds"))
        self.turn = self._button("Explore", "primary", self.explore_wanted)
        self.anew = self._button("Forget", "", None)
        self.anew.setToolTip(tip_text("Forget all that was tried, and begin anew"))
        self.anew.clicked.connect(work.forget)
        self.keep = self._button("Keep as blueprint", "", self.keep_wanted)
        self.keep.setToolTip(tip_text("Open what was found so far as a new blueprint, "
                                      "to be inspected"))  # fmt: skip
        self.sum, self.count = Elided(EMPTY), label("", "second")
        self.canvas = Canvas(tokens)
        self.canvas.editing = False
        self.canvas.collapse.join(SharedCollapse(self))
        self.canvas.setAccessibleName("What the world permits")
        self.empty, self._shown = _empty_page(), QStackedWidget()
        self.list = RowsView(tokens, self)
        self.list.setAccessibleName("Differences to the drawing")
        self.why = label("", "hint")
        self.why.setWordWrap(True)
        self.why.setContentsMargins(12, 4, 12, 8)
        self._build()
        work.changed.connect(self.refresh)
        self.refresh()

    def _button(self, words: str, role: str, wanted: SignalInstance | None) -> QPushButton:
        made = QPushButton(words)
        made.setAutoDefault(False)
        if role:
            made.setProperty("role", role)
        if wanted is not None:
            made.clicked.connect(wanted)
        return made

    def _build(self) -> None:
        middle, between = empty_panel()
        between.addWidget(head("World", self.world, self.repeats, self.turn, self.anew, self.sum))
        for part in (self.empty, self.canvas):
            self._shown.addWidget(part)
        between.addWidget(self._shown, 1)
        side, column = empty_panel()
        column.addWidget(head("Differences to the drawing", None, self.count))
        column.addWidget(self.list, 1)
        column.addWidget(self.why)
        column.addWidget(head("", None, self.keep))
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(split(Qt.Orientation.Horizontal, (middle, side), (900, 380), (3, 1)))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.canvas, self.list):
            part.set_tokens(tokens)

    @property
    def made(self) -> Generated | None:
        """The blueprint of what was found so far."""
        return self._made

    def show_worlds(self, names: tuple[str, ...]) -> None:
        """Offer these worlds. A chosen one stays chosen."""
        chosen = self.world.currentText()
        self.world.clear()
        self.world.addItems(names)
        self.world.setCurrentText(chosen)
        self.refresh()

    def offer(self, world: str) -> None:
        """Choose a world, while nothing is explored."""
        if self._work.phase == NONE and self.world.findText(world) >= 0:
            self.world.setCurrentText(world)

    def refresh(self) -> None:
        """Show what the exploration has found so far."""
        work = self._work
        self.world.setEnabled(work.phase == NONE)
        self.repeats.setEnabled(work.phase == NONE)
        words = {RUNNING: "Pause", PAUSED: "Go on"}.get(work.phase, "Explore")
        self.turn.setText(words)
        self.turn.setEnabled(self.world.count() > 0 and work.phase != DONE)
        self.turn.setToolTip(tip_text(TIPS[work.phase]))
        self.anew.setVisible(work.phase in (PAUSED, DONE))
        self.keep.setEnabled(work.tried > 0)
        if work.request is None:
            self._made = None
            self.sum.setText("")
            self.canvas.show_sheet(None)
            self._shown.setCurrentWidget(self.empty)
            self._show_differences(None)
            return
        request = work.request
        made = self._made = explored_blueprint(work.found, request.start, request.world)
        self.sum.setText(self._sum_words(made))
        self._shown.setCurrentWidget(self.canvas)
        (branch,) = made.blueprint
        same = self.canvas.sheet is not None
        self.canvas.show_branch(made.blueprint, branch.name, keep_view=same)
        self.canvas.fit(smooth=False)
        self._show_differences(against(made.blueprint, request.start, work.found.idle))

    def _sum_words(self, made: Generated) -> str:
        work = self._work
        states, operations = counted(made.states, "state"), counted(made.operations, "operation")
        tried = "all tried" if work.phase == DONE else f"{work.tried:,} tried"
        ends = {PAUSED: "Paused. ", DONE: "Done. "}.get(work.phase, "")
        more = ". There are further states" if made.whole is False else ""
        return f"{ends}{states}, {tried}, {operations}{more}"

    def _show_differences(self, difference: PhysicsDifference | None) -> None:
        """List what physics permits and the drawing lacks. What is missing counts where a state was
        tried, so it is only listed at the end."""
        if difference is None:
            self.list.show_rows([])
            self.count.setText("")
            self.why.setText("")
            return
        missing = difference.missing if self._work.phase == DONE else ()
        rows = [_row("False", one, "Physics permits it, and the drawing has it not so.", "W")
                for one in difference.false]  # fmt: skip
        rows += [_row("Missing", one, "The drawing has it, and physics does not permit it.", "E")
                 for one in missing]  # fmt: skip
        self.list.show_rows(rows[:MOST])
        self.count.setText(f"{len(difference.false)} false, {len(missing)} missing")
        new = {Address(*one.split("/")): ADDED for one in difference.false}
        self.canvas.set_marks(Marks(changes=new))
        if rows:
            self.why.setText(f"{counted(difference.edges, 'operation')} found.")
        elif self._work.phase == DONE:
            self.why.setText(f"Physics and drawing agree: {difference.edges:,} operations.")
        else:
            self.why.setText("Nothing differs so far. What is missing is said at the end.")


TIPS = {
    NONE: "Try every operation in every state that is found, in a process of its own",
    RUNNING: "End the process. What was tried is kept",
    PAUSED: "Go on with the states that were not tried",
    DONE: "All states that were found have been tried",
}


def _empty_page() -> QWidget:
    """Say what an exploration does, while there is none."""
    page, column = empty_panel()
    column.setContentsMargins(14, 14, 14, 14)
    column.setSpacing(8)
    text = label(EXPLAINED, "second")
    text.setWordWrap(True)
    text.setMaximumWidth(640)
    column.addWidget(label(EMPTY, "heading"))
    column.addWidget(text)
    column.addStretch(1)
    return page


def _row(kind: str, address: str, why: str, severity: str) -> ListRow:
    words = f"{kind}: {address}"
    return ListRow(words, address, severity=severity, tip=f"{words}. {why}")
