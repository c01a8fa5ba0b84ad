"""Where a state stands in the drawing, in words, with the button that pins it there."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.arrangement import MOST_STATES
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.layers import by_steps
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, row
from smsl_studio.studio.base.lines.line import labelled

Places = Mapping[str, tuple[float, float]]
PIN = "Fix the state at its place; Tidy leaves it there (K)"
UNPIN = "Let Tidy move the state again (Shift+K)"


class PlaceLine(QWidget):
    """Says where a state stands and whether it is pinned."""

    verb_wanted = Signal(str)
    """The id of a window action: pin, unpin."""

    def __init__(self) -> None:
        super().__init__()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        self.words = Elided("")
        self.button = QPushButton("Pin")
        self.button.clicked.connect(self._ask)
        self._pinned = False
        inner = QWidget()
        line = row(self.words, self.button)
        line.setContentsMargins(0, 0, 0, 0)
        inner.setLayout(line)
        column.addLayout(labelled("Place", inner))

    def show_state(self, branch: StateBranch, state: str, places: Places) -> None:
        """Show the place of a state. ``places`` has those of all states of its SB."""
        self._pinned = state in branch.notes.pinned
        words = place_words(branch, state, places)
        self.words.setText(words)
        told = f"Place: {words}{', pinned' if self._pinned else ''}"
        self.words.setAccessibleName(plain_text(told))
        self.button.setText("Unpin" if self._pinned else "Pin")
        self.button.setToolTip(UNPIN if self._pinned else PIN)

    def _ask(self) -> None:
        self.verb_wanted.emit("unpin" if self._pinned else "pin")


def place_words(branch: StateBranch, state: str, places: Places) -> str:
    """The level of a state and its row there, both counted from 1, such as "Level 3, row 4".

    The initial state is level 1, and each operation away from it is a level more. In a large SB the
    words are the coordinates of the state (pixels at 100 % zoom).
    """
    if len(branch.table) > MOST_STATES:
        x, y = places[state]
        return f"{x:g}, {y:g}"
    graph = graph_of(branch)
    steps = by_steps(graph, graph.index.get(branch.initial, 0))
    own = graph.index[state]
    beside = [name for name in graph.names if steps[graph.index[name]] == steps[own]]
    order = sorted(beside, key=lambda name: (places[name][1], places[name][0]))
    return f"Level {steps[own] + 1}, row {order.index(state) + 1}"
