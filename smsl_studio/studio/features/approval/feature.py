"""The feature Approval. Its badge shows the approval of the open blueprint."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QTimer

from smsl_studio.front.approval_badge import UNINSPECTED, ApprovalWords, approval_words
from smsl_studio.front.former_record import may_have_record
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.feature import Feature
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.approval.badge import LOOKING, ApprovalBadge, ReasonCard
from smsl_studio.studio.running.window_parts import WindowParts

IDLE = 400
"""The record is verified after this time without an edit (milliseconds)."""


class ApprovalFeature(Feature):
    """The badge of trust.

    A second thread verifies the signatures. Until the result is known, the border is dashed, and
    the badge says that the check is running.
    """

    def __init__(self, parts: WindowParts) -> None:
        self._session, self._files = parts.session, parts.files
        self.badge = ApprovalBadge(parts.tokens)
        self.badge.clicked.connect(self.show)
        self.badges = (self.badge,)
        self._beside = Beside(parts.window)
        self._later = QTimer(parts.window)
        self._later.setSingleShot(True)
        self._later.setInterval(IDLE)
        self._later.timeout.connect(self._look)
        self.card: ReasonCard | None = None
        parts.session.blueprint_changed.connect(lambda *_: self._wait())
        parts.files.changed.connect(lambda *_: self._wait())
        self._wait()

    def actions(self) -> tuple[Action, ...]:
        """The command in the menu Blueprint that shows the reasons."""
        return (
            Action("approval_reasons", "Who has signed this", self.show, "Blueprint", "", (),
                   lambda: not self.badge.isHidden(), section=4,
                   tip="Whether the blueprint is approved, and why not"),
        )  # fmt: skip

    def show(self) -> None:
        """Show the reasons below the badge."""
        self.card = ReasonCard(self.badge.window(), self.badge.said)
        self.card.open_below(self.badge)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.badge.set_tokens(tokens)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._later.stop()
        self._beside.stop()

    def _wait(self) -> None:
        """Verify the record again once the person has made no edit for ``IDLE`` milliseconds.

        Most files have no record. Then there is nothing to verify, and the badge says so at once.
        """
        self._beside.drop()
        if not may_have_record(self._session.blueprint.file):
            self._later.stop()
            self._show(UNINSPECTED)
            return
        self._show(LOOKING)
        self._later.start()

    def _look(self) -> None:
        self._beside.do(partial(approval_words, self._session.blueprint), self._show)

    def _show(self, said: ApprovalWords) -> None:
        self.badge.show_words(said)
