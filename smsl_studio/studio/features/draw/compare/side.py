"""One side of the compare view: its name, and a canvas that shows an SB with its changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.legible import plain_text
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.shape import Point
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.controls import Elided
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text

LEAST = 280
BOTH = "both sides"
"""The name under which the choice of bundles is kept for both sides."""


class Side(QWidget):
    """Shows one version; nothing can be edited here."""

    clicked = Signal(object)
    """Address: the person clicked this state or operation."""

    def __init__(self, tokens: Tokens, word: str, place: str, shared: SharedCollapse) -> None:
        """``word`` says which version it is. ``place`` says whether it is at the left or at the
        right.

        Both sides share ``shared``.
        """
        super().__init__()
        self._head = f"{word}, at the {place}"
        self._blueprint: Blueprint | None = None
        self._shown: tuple[str, Mapping[str, Point]] | None = None
        self.title = Elided()
        self.title.setProperty("role", "heading")
        self.title.setContentsMargins(14, 8, 14, 8)
        self.canvas = Canvas(tokens)
        self.canvas.editing = False
        self.canvas.collapse.join(shared, BOTH)
        self.canvas.setAccessibleName(plain_text(f"Canvas, {word}"))
        self.canvas.edge_clicked.connect(self.clicked)
        self.canvas.node_clicked.connect(self.clicked)
        self.setMinimumWidth(LEAST)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.title)
        column.addWidget(self.canvas, 1)

    def show_version(self, words: str) -> None:
        """Set the name of the version on this side."""
        said = f"{self._head}: {words}"
        self.title.setText(said)
        self.title.setToolTip(tip_text(said))

    def show_branch(
        self,
        blueprint: Blueprint,
        branch: str,
        places: Mapping[str, Point],
        changes: Mapping[Address, str],
    ) -> None:
        """Show an SB with its changes marked, or say that this side does not have it (empty name).

        Same arguments draw nothing anew: the older version stays routed while the drawing is
        edited.
        """
        self.canvas.set_marks(Marks(changes=changes))
        shown = branch, places
        if blueprint is not self._blueprint or shown != self._shown:
            self._blueprint, self._shown = blueprint, shown
            self.canvas.show_branch(blueprint, branch, places, keep_view=True)
        self.canvas.show_banner("" if branch else "This State Branch is not on this side")

    def light(self, address: Address | None) -> None:
        """Select the element of the chosen change; None selects nothing."""
        changes = self.canvas.marks.changes
        chosen = (address,) if address is not None else ()
        self.canvas.set_marks(Marks(selection=chosen, changes=changes))

    def light_step(self, steps: Sequence[RunStep], at: int, branch: str) -> None:
        """Show a step of a run in the shown SB. A run that is shorter stays at its end."""
        past = steps[: at + 1]
        self.canvas.set_marks(
            Marks(
                changes=self.canvas.marks.changes,
                active=past[-1].configuration.get(branch) if past else None,
                visited=frozenset(one.configuration.get(branch, "") for one in past[:-1]),
                trail=tuple(edge for one in past for edge in one.edges if edge.branch == branch),
            )
        )

    def has(self, address: Address | None) -> bool:
        """Whether this side draws the state or operation."""
        return address is not None and self.canvas.rect_of(address) is not None
