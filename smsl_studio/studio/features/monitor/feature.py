"""The monitor as one feature: a page beside the window."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.feature import Feature
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.monitor.opener import MonitorOpener
from smsl_studio.studio.running.run_session import RunSession


class MonitorFeature(Feature):
    """Every sensor and node of the run; ``parent`` is what the page lies in front of."""

    def __init__(self, run: RunSession, tokens: Tokens, parent: QWidget) -> None:
        self.opener = MonitorOpener(run, tokens, parent)

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self.opener.set_tokens(tokens)

    def stop(self) -> None:
        """The page goes with its window."""
        self.opener.close()
