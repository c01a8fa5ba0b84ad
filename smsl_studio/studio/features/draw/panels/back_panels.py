"""The panels of Draw behind the first tab of each side. Each is made when it is first shown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QLabel

from smsl_studio.blueprint.address import Address
from smsl_studio.front.stored_lines import StoredLine
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.feature import DockPanel
from smsl_studio.studio.base.late_panel import LatePanel
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.draw.panels.offers import offers, operation_names
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.draw.panels.branch_table import BranchTable
    from smsl_studio.studio.features.draw.panels.history import History
    from smsl_studio.studio.features.draw.panels.library import Library
    from smsl_studio.studio.features.draw.source.pane import SourcePane


class BackPanels(QObject):
    """Library, Source, History and Table.

    It keeps what they were told before they were made: findings, offers of plugins, lines of the
    user's store, and the active states of a run. ``use`` (kind, name) uses a row of the library.
    """

    caret_moved = Signal(int, int)
    """Line and column of the caret in the source, from 1."""
    typed = Signal()
    """Somebody types in the source."""

    def __init__(self, parts: WindowParts, use: Callable[[str, str], bool]) -> None:
        super().__init__(parts.window)
        self._session, self._tokens, self._use = parts.session, parts.tokens, use
        self._loaded = Loaded()
        self._findings: tuple[Finding, ...] = ()
        self._stored: tuple[StoredLine, ...] = ()
        self._active: tuple[Address, ...] = ()
        self._shown: QLabel = label("", "small")
        self._shown.setContentsMargins(0, 0, 8, 0)
        self.library: LatePart[Library] = LatePart(self._make_library)
        self.source: LatePart[SourcePane] = LatePart(self._make_source)
        self.history: LatePart[History] = LatePart(self._make_history)
        self.table: LatePart[BranchTable] = LatePart(self._make_table)
        self._session.blueprint_changed.connect(lambda *_: self._show_offers())
        self._session.opened.connect(self._forget)

    def panels(self) -> tuple[DockPanel, ...]:
        """The places of Library, Source, History and Table."""
        return (
            DockPanel("Library", "left", LatePanel(self.library), self._shown),
            DockPanel("Source", "right", LatePanel(self.source)),
            DockPanel("History", "bottom", LatePanel(self.history)),
            DockPanel("Table", "bottom", LatePanel(self.table)),
        )

    # What the panels are told.

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Mark the elements that have these findings."""
        self._findings = tuple(findings)
        for panel in (self.library.made, self.source.made, self.table.made):
            if panel is not None:
                panel.set_findings(findings)

    def set_plugins(self, loaded: Loaded) -> None:
        """Offer the operations of the plugins in the library and in the source."""
        self._loaded = loaded
        self._show_offers()
        if self.source.made is not None:
            self.source.made.set_library(operation_names(loaded))

    def set_stored(self, lines: Sequence[StoredLine]) -> None:
        """Show what the user's store holds."""
        self._stored = tuple(lines)
        if self.library.made is not None:
            self.library.made.set_stored(lines)

    def set_active(self, addresses: Iterable[Address]) -> None:
        """Highlight the lines of the elements that are active in a run."""
        self._active = tuple(addresses)
        if self.source.made is not None:
            self.source.made.set_active(self._active)

    def set_tokens(self, tokens: Tokens) -> None:
        """Make the panels that are still missing in the colours of another theme."""
        self._tokens = tokens

    # What is asked of the panels.

    @property
    def offered(self) -> tuple[str, ...]:
        """The names or patterns of the operations that plugins offer."""
        return tuple(one.pattern for one in offers(self._loaded, self._session.blueprint))

    @property
    def pending(self) -> dict[str, str]:
        """The text typed in the source that is not yet a step of the history, by its file."""
        return self.source.made.pending if self.source.made is not None else {}

    def settle(self) -> None:
        """Take over the text that is being typed in the source."""
        if self.source.made is not None:
            self.source.made.settle()

    def tell_caret(self) -> None:
        """Emit ``caret_moved`` again, if the source has the focus."""
        if self.source.made is not None:
            self.source.made.tell_caret()

    def stop(self) -> None:
        """End all work, because the window closes."""
        if self.source.made is not None:
            self.source.made.stop()

    # How they are made.

    def _make_library(self) -> Library:
        from smsl_studio.studio.features.draw.panels.library import Library

        panel = Library(self._session, self._tokens, self._shown)
        panel.use = self._use
        panel.set_findings(self._findings)
        panel.set_offers(offers(self._loaded, self._session.blueprint))
        panel.set_stored(self._stored)
        return panel

    def _make_source(self) -> SourcePane:
        from smsl_studio.studio.features.draw.source.pane import SourcePane

        panel = SourcePane(self._session, self._tokens)
        panel.caret_moved.connect(self.caret_moved)
        panel.editor.typed.connect(lambda *_: self.typed.emit())
        panel.set_library(operation_names(self._loaded))
        panel.set_findings(self._findings)
        panel.set_active(self._active)
        return panel

    def _make_history(self) -> History:
        from smsl_studio.studio.features.draw.panels.history import History

        return History(self._session, self._tokens)

    def _make_table(self) -> BranchTable:
        from smsl_studio.studio.features.draw.panels.branch_table import BranchTable

        panel = BranchTable(self._session, self._tokens)
        panel.set_findings(self._findings)
        return panel

    def _forget(self) -> None:
        """Forget the states of a run of another file."""
        self._active = ()

    def _show_offers(self) -> None:
        if self.library.made is not None:
            self.library.made.set_offers(offers(self._loaded, self._session.blueprint))
