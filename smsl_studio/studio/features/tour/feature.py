"""The tour as a feature: it begins from the start page or the menu Help, and Esc leaves it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.tour.tour import Tour
    from smsl_studio.studio.running.run_session import RunSession


class TourFeature(Feature):
    """The first steps in one window. At their end, ``read_on`` opens the help pages about them."""

    def __init__(self, parts: WindowParts, shell: Shell, read_on: Callable[[], None]) -> None:
        self._parts, self._shell, self._read_on = parts, shell, read_on
        self._tokens = parts.tokens
        self._run: RunSession | None = None
        self.tour: Tour | None = None
        """The tour that is under way; None if there is none."""

    def actions(self) -> tuple[Action, ...]:
        """The rows of the menu Help."""
        return (
            Action("first_steps", "First steps", self.begin, "Help", "play", (), self._may_begin,
                   tip="Two minutes in this window: find a misprint, correct it, run, stop, steer"),
            Action("leave_tour", "Leave first steps", self.leave, "Help", "", ("Esc",),
                   lambda: self.tour is not None),
        )  # fmt: skip

    def take_actions(self, actions: Actions) -> None:
        """Keep the table, because beginning and leaving change it."""
        self._actions = actions

    def follow(self, run: RunSession) -> None:
        """Take the run of the window, which was made now."""
        self._run = run
        run.exists_changed.connect(lambda _: self._actions.refresh())
        if self.tour is not None:
            self.tour.follow(run)

    def begin(self) -> None:
        """Open the copy, after the usual question about unsaved work, and show the first step."""
        from smsl_studio.studio.features.tour.practice import sample, with_one_misprint
        from smsl_studio.studio.features.tour.tour import Tour

        if not self._parts.files.open_copy(sample(), with_one_misprint):
            return
        self._shell.set_mode("draw")
        self._shell.show_tab("Findings")
        self.tour = tour = Tour(self._parts, self._shell, self._tokens)
        tour.ended.connect(self._ended)
        tour.callout.more_wanted.connect(self._more)
        if self._run is not None:
            tour.follow(self._run)
        self._actions.refresh()

    def leave(self) -> None:
        """Leave the tour. The copy stays open."""
        if self.tour is not None:
            self.tour.end()

    def look(self) -> None:
        """Look at what is next, because another mode is shown."""
        if self.tour is not None:
            self.tour.look()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.tour is not None:
            self.tour.set_tokens(tokens)

    def _may_begin(self) -> bool:
        """Whether the tour may open its copy: no run goes on that it would have to end."""
        return self._run is None or not self._run.exists

    def _more(self) -> None:
        self.leave()
        self._read_on()

    def _ended(self) -> None:
        self.tour = None
        self._actions.refresh()
