"""Supervision as a feature: its page, and its rows of the Run menu."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Control, Feature, Page, Shell, whole
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.supervise.actions import supervise_actions
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.supervise.pane import SupervisePane
    from smsl_studio.studio.running.run_session import RunSession

PARTS = "supervise_parts"
"""The name under which the parts of Supervise that are shown are stored."""


LARGE = "supervise_large"
"""The name under which it is stored whether Supervise is large."""


class SuperviseFeature(Feature):
    """Supervise mode. Its pane is made together with the run that it shows.

    ``run`` returns the run of the window.
    """

    def __init__(self, parts: WindowParts, shell: Shell, run: Callable[[], RunSession]) -> None:
        self._parts, self._shell, self._run = parts, shell, run
        self._tokens = parts.tokens
        self.part = LatePart(self._make)
        self.pages = {"supervise": self._page}

    @property
    def pane(self) -> SupervisePane:
        """The body of Supervise mode."""
        self._run()
        return self.part()

    def _page(self) -> Page:
        return Page(self.pane, self.pane, self.pane.bar)

    def _make(self) -> SupervisePane:
        from smsl_studio.studio.features.supervise.pane import SupervisePane

        pane = SupervisePane(self._parts.session, self._run(), self._tokens, self._parts.window)
        pane.hide()
        settings = self._parts.settings
        pane.seen.restore(settings.text_of(PARTS))
        pane.seen.remember = partial(settings.store_text, PARTS)
        if settings.text_of(LARGE):
            pane.set_large(True)
        pane.remember_large = partial(settings.store_text, LARGE)
        pane.full_map.canvas.collapse.join(self._parts.collapse)
        pane.hold.way_wanted.connect(self._run().way_wanted)
        return pane

    def actions(self) -> tuple[Action, ...]:
        """The rows of supervision."""
        return supervise_actions(self, self._shell)

    # What its actions need.

    def run_exists(self) -> bool:
        """Whether there is a run."""
        return self.part.made is not None and self.part.made.run_exists()

    def is_located(self) -> bool:
        """Whether the facts of a run that was taken over fit exactly one configuration."""
        return self.part.made is not None and self.part.made.is_located()

    def is_stopped(self) -> bool:
        """Whether the run is stopped."""
        return self.part.made is not None and self.part.made.is_stopped()

    def is_mapped(self) -> bool:
        """Whether the full map of the SB is shown."""
        return self.part.made is not None and self.part.made.is_mapped()

    def is_large(self) -> bool:
        """Whether the large layout is shown."""
        return self.part.made is not None and self.part.made.is_large

    def turn_large(self) -> None:
        """Show the large layout, or the usual one again."""
        self.pane.turn_large()

    def choose_first(self) -> None:
        """Give the keyboard focus to the first card."""
        self.pane.choose_first()

    def ask_for(self, word: str) -> None:
        """Ask the person to confirm the command with this word."""
        self.pane.ask_for(word)

    # What the shell needs.

    def control(self, name: str) -> Control | None:
        """The buttons of its row and of Step in, and the question that stands there."""
        pane = self.part.made
        if pane is None:
            return None
        bar, step_in = pane.bar, pane.step_in
        own = {
            "run_play": bar.play,
            "run_stop": bar.stop,
            "run_reset": bar.reset,
            "veto": step_in.veto,
            "take_over": step_in.hand,
            "confirm": step_in.asking,
            "step_in": step_in,
            "hold": pane.hold,
            "board": pane.board,
        }
        return whole(own[name]) if name in own else None

    def is_shown(self) -> bool:
        """Whether its page is visible."""
        return self.part.made is not None and self.part.made.isVisible()

    def refresh(self) -> None:
        """Show the present state of the run, if the page exists."""
        if self.part.made is not None:
            self.part.made.refresh()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
