"""The page Room as a feature: a part of the page Monitor, made when it is first shown."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from smsl_studio.studio.base.feature import Feature
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens

if TYPE_CHECKING:
    from smsl_studio.studio.features.room.page import RoomPage
    from smsl_studio.studio.running.run_session import RunSession


class RoomFeature(Feature):
    """The room of the run. ``run`` returns the run of the window."""

    def __init__(self, run: Callable[[], RunSession], tokens: Tokens) -> None:
        self._run, self._tokens = run, tokens
        self.disturb: Callable[[], None] = lambda: None
        """Opens the page on which sensors are disturbed."""
        self.edit: Callable[[str, int], None] = lambda branch, digit: None
        """Shows the form of a fact: SB, digit."""
        self.part = LatePart(self._make)

    @property
    def page(self) -> RoomPage:
        """The page."""
        return self.part()

    def _make(self) -> RoomPage:
        from smsl_studio.studio.features.room.page import RoomPage

        page = RoomPage(self._run(), self._tokens)
        page.disturb_wanted.connect(lambda: self.disturb())
        page.edit_wanted.connect(lambda branch, digit: self.edit(branch, digit))
        return page

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
