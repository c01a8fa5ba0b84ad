"""The monitor as a feature: a page in a window of its own."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.feature import Feature
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens

if TYPE_CHECKING:
    from smsl_studio.studio.features.monitor.opener import MonitorOpener
    from smsl_studio.studio.running.run_session import RunSession


class MonitorFeature(Feature):
    """The page with every sensor and node of the run.

    ``run`` returns the run of the window, and the widget in front of which the page opens.
    """

    def __init__(self, run: Callable[[], tuple[RunSession, QWidget]], tokens: Tokens) -> None:
        self._run, self._tokens = run, tokens
        self.part = LatePart(self._make)

    @property
    def opener(self) -> MonitorOpener:
        """The object that opens and keeps the page."""
        return self.part()

    def _make(self) -> MonitorOpener:
        from smsl_studio.studio.features.monitor.opener import MonitorOpener

        run, parent = self._run()
        return MonitorOpener(run, self._tokens, parent)

    def toggle(self) -> None:
        """Show the page; close it if it is in front already."""
        self.opener.toggle()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    def stop(self) -> None:
        """Close the page, because its window closes."""
        if self.part.made is not None:
            self.part.made.close()
