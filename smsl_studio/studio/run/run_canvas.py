"""The canvas of a run: the frozen blueprint, one SB at a time, with what glows and trails on it."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.studio.canvas.canvas import Canvas
from smsl_studio.studio.canvas.marks import Marks
from smsl_studio.studio.controls import label
from smsl_studio.studio.icons import icon
from smsl_studio.studio.run import view
from smsl_studio.studio.run.run_session import RunSession
from smsl_studio.studio.session import Session
from smsl_studio.studio.theme import Tokens

MOVED_ON = "The drawing has moved on. This run holds the version it started with"


class RunCanvas(QWidget):
    """Shows the run's own snapshot while there is one, else the drawing as it is now.

    One button an SB stands above it, with the SB's active state; Follow shows the SB in which an
    operation runs.
    """

    chosen = Signal(object)
    """The address of an operation whose arrow was clicked."""

    def __init__(
        self, session: Session, run: RunSession, tokens: Tokens, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._run, self._tokens = session, run, tokens
        self._shown: tuple[Blueprint, str] | None = None
        self._branch = ""
        self._places: dict[str, dict[str, tuple[float, float]]] = {}
        self.canvas = Canvas(tokens)
        self.canvas.editing = False
        self.canvas.edge_clicked.connect(self.chosen)
        self.canvas.enter_wanted.connect(self.show_branch)
        self._step = label("", "small")
        self._branches = QHBoxLayout()
        self._branches.setSpacing(2)
        self._follow = self._tool("Follow", "eye", "Show the State Branch in which something runs")
        self._follow.setCheckable(True)
        self._follow.setChecked(True)
        self._fit = self._tool("", "fit", "Show everything (F)")
        self._fit.clicked.connect(self.canvas.fit)
        head = QWidget()
        head.setFixedHeight(44)
        across = QHBoxLayout(head)
        across.setContentsMargins(12, 0, 8, 0)
        across.addLayout(self._branches)
        across.addWidget(self._step)
        across.addStretch(1)
        across.addWidget(self._follow)
        across.addWidget(self._fit)
        self._banner = QLabel()
        self._banner.setProperty("role", "banner")
        self._banner.setWordWrap(True)
        self._banner.hide()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for part in (head, self._banner):
            column.addWidget(part)
        column.addWidget(self.canvas, 1)

    @property
    def branch(self) -> str:
        """The SB that is shown."""
        return self._branch

    def refresh(self) -> None:
        """Show the run as it stands now."""
        blueprint = self._blueprint()
        if self._branch not in blueprint.branches:
            self._branch = next(iter(blueprint.roots), next(iter(blueprint.branches), ""))
        status = self._run.status
        if status and status.running and self._follow.isChecked() and self._run.exists:
            self._branch = status.running.branch
        self._show(blueprint)
        self._name_branches(blueprint)
        self._step.setText(self._steps())
        if self._branch and self._run.blueprint is blueprint and status is not None:
            marks = view.marks(blueprint, self._branch, status, self._run.story)
        else:
            marks = Marks()
        self.canvas.set_marks(marks)

    def drawing_changed(self) -> None:
        """The drawing was edited: a run that is there goes on with its own version, and says so."""
        held = self._run.blueprint
        moved = held is not None and held is not self._session.blueprint
        if self._run.exists and moved and held != self._session.blueprint:
            self.show_banner(MOVED_ON)
        else:
            self.show_banner("")
        self.refresh()

    def show_banner(self, words: str) -> None:
        """Say one thing above the canvas; the empty text takes it away."""
        self._banner.setText(words)
        self._banner.setVisible(bool(words))

    def show_branch(self, name: str) -> None:
        """Show another SB and stop following."""
        if name in self._blueprint().branches:
            self._branch = name
            self._follow.setChecked(False)
            self.refresh()

    def jump(self, address: Address) -> None:
        """Show where an address stands."""
        if address.branch in self._blueprint().branches:
            if address.branch != self._branch:
                self.show_branch(address.branch)
            self.canvas.reveal(address)

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self.canvas.set_tokens(tokens)
        self._follow.setIcon(icon("eye", tokens))
        self._fit.setIcon(icon("fit", tokens))

    def _blueprint(self) -> Blueprint:
        """The run's snapshot while a run is there or was the last of this drawing."""
        held = self._run.blueprint
        if held is not None and (self._run.exists or held is self._session.blueprint):
            return held
        return self._session.blueprint

    def _show(self, blueprint: Blueprint) -> None:
        if not self._branch:
            return
        if self._shown is not None and self._shown[0] is blueprint:
            if self._shown[1] == self._branch:
                return
        else:
            self._places = {}
        branch = blueprint[self._branch]
        if self._branch not in self._places:
            self._places[self._branch] = place_states(branch, former=branch.notes.layout)
        self._shown = (blueprint, self._branch)
        self.canvas.show_branch(blueprint, self._branch, self._places[self._branch])
        self.canvas.fit()

    def _name_branches(self, blueprint: Blueprint) -> None:
        status = self._run.status if self._run.blueprint is blueprint else None
        names = []
        for branch in blueprint:
            state = status.configuration.get(branch.name, "") if status else ""
            names.append((branch.name, view.short_name(branch, state) if state else ""))
        while self._branches.count() < len(names):
            self._branches.addWidget(self._branch_button(self._branches.count()))
        for index in range(self._branches.count()):
            button = self._branches.itemAt(index).widget()
            assert isinstance(button, QToolButton)
            button.setVisible(index < len(names))
            if index < len(names):
                name, state = names[index]
                button.setText(f"{name}  {state}" if state and len(names) > 1 else name)
                button.setAccessibleName(f"{name}, {state} active" if state else name)
                button.setChecked(name == self._branch)

    def _branch_button(self, index: int) -> QToolButton:
        button = QToolButton()
        button.setProperty("role", "tool")
        button.setCheckable(True)
        button.setToolTip("Show this State Branch")
        button.clicked.connect(lambda: self.show_branch(list(self._blueprint().branches)[index]))
        return button

    def _steps(self) -> str:
        status = self._run.status
        if status is None or not self._run.blueprint:
            return ""
        left = len(status.route)
        whole = status.operations + left
        return (
            f"step {min(status.operations + 1, whole)} of {whole}"
            if left
            else (f"{status.operations} operations" if status.operations != 1 else "1 operation")
        )

    def _tool(self, words: str, name: str, tip: str) -> QToolButton:
        tool = QToolButton()
        tool.setProperty("role", "tool")
        tool.setText(words)
        tool.setIcon(icon(name, self._tokens))
        tool.setIconSize(QSize(16, 16))
        tool.setToolButtonStyle(
            Qt.ToolButtonStyle.ToolButtonTextBesideIcon
            if words
            else Qt.ToolButtonStyle.ToolButtonIconOnly
        )
        tool.setFixedHeight(28)
        tool.setToolTip(tip)
        tool.setAccessibleName(words or tip)
        return tool
