"""The page Design cycle as a feature: its tab, its rows in the menus, and what its buttons do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer

from smsl_studio.blueprint.project import project_of
from smsl_studio.front.approval_badge import is_generated
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.feature import Feature, ModePage, Page, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.design.stage_verbs import StageVerbs
from smsl_studio.studio.features.design.text_verbs import TextVerbs
from smsl_studio.studio.features.design.work import DesignWork
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.front.design.cycle import DesignCycle
    from smsl_studio.studio.features.design.page import CyclePage

PAGE = "cycle"
IDLE, WATCH = 250, 2000
"""The cycle is found out after this time without an edit; files are looked at so often (ms)."""


class DesignFeature(Feature):
    """Offers the page for what was generated, and after it was asked for once."""

    def __init__(self, parts: WindowParts, shell: Shell, inner: str) -> None:
        """``inner`` is the submenu of its rows."""
        self._parts, self._shell, self._inner = parts, shell, inner
        self._tokens, self._loaded = parts.tokens, None
        self._seen: tuple[object, ...] = ()
        self._is_seen = False
        self.part: LatePart[CyclePage] = LatePart(self._make)
        self.mode_pages = (ModePage(PAGE, "Design cycle", self._page),)
        self.work = DesignWork(parts.window)
        self.texts = TextVerbs(parts, self.work, self.part)
        self.texts.show = self.show
        self.texts.taken.connect(self._look)
        self.verbs = StageVerbs(parts, shell, self.work, self.texts)
        self.verbs.changed.connect(self._look)
        self.work.found.connect(self._found)
        self._later, self._watch = QTimer(parts.window), QTimer(parts.window)
        self._later.setSingleShot(True)
        self._later.setInterval(IDLE)
        self._later.timeout.connect(self._look)
        self._watch.setInterval(WATCH)
        self._watch.timeout.connect(self._look_outside)
        parts.session.opened.connect(self._opened)
        parts.session.blueprint_changed.connect(lambda *_: self._wait())
        parts.files.changed.connect(self._wait)

    def actions(self) -> tuple[Action, ...]:
        """The rows of the menu Blueprint."""
        return (
            Action("cycle_page", "Design cycle", self.show, "Blueprint", "", (), section=4,
                   inner=self._inner,
                   tip="The stages from the text to the approval, and what is to be done next",
                   also="stages consultation testing hardware"),
            Action("from_text", "From text…", self.texts.ask_new, "Blueprint", "", (), section=4,
                   inner=self._inner, tip="Make a blueprint of what people have written",
                   also="generate expert words"),
        )  # fmt: skip

    def take_actions(self, actions: Actions) -> None:
        """Keep the actions that open the pages of other stages."""
        self.verbs.actions = actions

    def show(self) -> None:
        """Show the page. Without an open file a new drawing is begun beside it."""
        if not self._parts.files.is_open:
            self._parts.files.new()
        self._shell.show_page(PAGE, 0)
        self._shell.set_mode(PAGE)

    def set_plugins(self, loaded: Loaded, known: bool) -> None:
        """Receive what the installed plugins offer."""
        self.verbs.loaded = loaded if known else None
        self._wait()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = self.verbs.tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._later.stop()
        self._watch.stop()
        self.work.stop()
        self.texts.stop()

    def _page(self) -> Page:
        page = self.part()
        return Page(page, page)

    def _make(self) -> CyclePage:
        from smsl_studio.studio.features.design.page import CyclePage

        page = CyclePage(self._tokens)
        page.looked_at.connect(self._show_seen)
        self.texts.connect_bar(page.bar)
        self.verbs.connect_page(page)
        return page

    def _opened(self) -> None:
        """Offer the page for a blueprint that was computed."""
        self.texts.forget()
        if is_generated(self._parts.session.blueprint):
            self._shell.show_page(PAGE, 0)

    # The cycle as it is now.

    def _show_seen(self, seen: bool) -> None:
        self._is_seen = seen
        if seen:
            self._watch.start()
            self._look()
        else:
            self._watch.stop()

    def _wait(self) -> None:
        if self._is_seen:
            self._later.start()

    def _look(self) -> None:
        if not self._is_seen:
            return
        self._seen = self._stamps()
        blueprint, path = self._parts.session.blueprint, self._parts.files.path
        policy = self._parts.settings.policy_of(project_of(blueprint.file))
        self.work.find(blueprint, path, self.verbs.loaded, policy)

    def _look_outside(self) -> None:
        """Look again if somebody has changed a file beside the blueprint, or a text."""
        if self._seen != self._stamps():
            self._look()

    def _stamps(self) -> tuple[object, ...]:
        from smsl_studio.front.design.found import stamps_of

        cycle = self.part.made.cycle if self.part.made is not None else None
        texts = [one.path for one in (*cycle.texts, *cycle.hardware)] if cycle is not None else []
        return stamps_of(self._parts.files.path, texts)

    def _found(self, cycle: DesignCycle, blueprint: Blueprint) -> None:
        page = self.part.made
        if page is not None and blueprint is self._parts.session.blueprint:
            page.show_cycle(cycle, blueprint)
