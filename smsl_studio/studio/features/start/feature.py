"""The start page as a feature: a page that shows until something is open."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.feature import Feature, Page, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.start.page import StartPage


class StartFeature(Feature):
    """The page of the mode ``start``, which stands for Draw mode as long as nothing is open."""

    def __init__(self, parts: WindowParts, shell: Shell) -> None:
        self._parts, self._shell, self._tokens = parts, shell, parts.tokens
        self.part = LatePart(self._make)
        self.pages = {"start": self._page}
        parts.files.begun.connect(self._leave)

    def take_actions(self, actions: Actions) -> None:
        """Keep the actions that the cards stand for."""
        self._actions = actions

    def _page(self) -> Page:
        return Page(self.part(), self.part())

    def _make(self) -> StartPage:
        from smsl_studio.studio.features.start.page import StartPage

        files, settings = self._parts.files, self._parts.settings
        page = StartPage(settings, self._tokens)
        column = page.column
        column.new_wanted.connect(self._actions["new"].trigger)
        column.open_wanted.connect(self._actions["open"].trigger)
        column.try_wanted.connect(self._actions["first_steps"].trigger)
        column.help_wanted.connect(self._actions["help_pages"].trigger)
        column.rules_wanted.connect(self._actions["rules_page"].trigger)
        column.texts_wanted.connect(self._actions["from_text"].trigger)
        column.file_wanted.connect(lambda path: files.open(path))
        column.sample_wanted.connect(lambda path: files.open_copy(path))
        for changed in (files.changed, files.refused):
            changed.connect(page.look)
        return page

    def _leave(self) -> None:
        """Show the drawing, because there is one now."""
        if self.part.made is not None:
            self.part.made.stop()
        if self._shell.mode == "start":
            self._shell.set_mode("draw")

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    def stop(self) -> None:
        """End the drawing of thumbnails, because the window closes."""
        if self.part.made is not None:
            self.part.made.stop()
