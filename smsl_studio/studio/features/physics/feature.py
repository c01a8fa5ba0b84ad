"""The page Physics as a feature: its tab, its row in the menu, and what it keeps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.errors import SaveError, StudioError, UsageError
from smsl_studio.library.loaded import Loaded
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, ModePage, Page, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.files.opened_file import OpenedFile
from smsl_studio.studio.running.window_parts import WindowParts
from smsl_studio.world.engines import TABLE

if TYPE_CHECKING:
    from smsl_studio.front.exploration_child import ExplorationRequest
    from smsl_studio.studio.features.physics.page import PhysicsPage
    from smsl_studio.studio.features.physics.work import PhysicsWork

PAGE = "physics"
MOST_BOUND = 5_000
"""For a drawing with more operations nobody looks in which world they have functions."""


class PhysicsFeature(Feature):
    """Offers the page after it was asked for once. It is made when it is first shown."""

    def __init__(self, parts: WindowParts, shell: Shell, inner: str) -> None:
        """``inner`` is the submenu of its row."""
        self._parts, self._shell, self._inner = parts, shell, inner
        self._tokens = parts.tokens
        self._worlds: tuple[str, ...] = ()
        self._loaded: Loaded | None = None
        self.work: PhysicsWork | None = None
        self.part: LatePart[PhysicsPage] = LatePart(self._make)
        self.mode_pages = (ModePage(PAGE, "Physics", self._page),)

    def actions(self) -> tuple[Action, ...]:
        """The row of the menu Blueprint."""
        return (
            Action("physics_page", "Explore physics", self.show, "Blueprint", "", (), section=4,
                   inner=self._inner,
                   tip="Let a simulated world try every operation, and see what it permits",
                   also="explore world robot generate"),
        )  # fmt: skip

    def show(self) -> None:
        """Show the page."""
        if not self._parts.files.is_open:
            self._parts.files.new()
        self._offer_suitable(self.part())
        self._shell.show_page(PAGE, 0)
        self._shell.set_mode(PAGE)

    def set_plugins(self, loaded: Loaded, known: bool) -> None:
        """Offer the worlds that have operations."""
        self._worlds = tuple(name for name in loaded.worlds if name != TABLE) if known else ()
        self._loaded = loaded if known else None
        if self.part.made is not None:
            self.part.made.show_worlds(self._worlds)
            self._offer_suitable(self.part.made)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    def stop(self) -> None:
        """End all work, because the window closes. What was tried is kept."""
        if self.work is not None:
            self.work.shut()

    def _page(self) -> Page:
        page = self.part()
        return Page(page, page.turn)

    def _make(self) -> PhysicsPage:
        from smsl_studio.studio.features.physics.page import PhysicsPage
        from smsl_studio.studio.features.physics.work import PhysicsWork

        self.work = PhysicsWork(self._parts.window)
        page = PhysicsPage(self.work, self._tokens)
        page.show_worlds(self._worlds)
        page.explore_wanted.connect(self._turn)
        page.keep_wanted.connect(self._keep)
        self.work.refused.connect(self._parts.toast.refuse)
        return page

    def _offer_suitable(self, page: PhysicsPage) -> None:
        """Choose the world in which the drawing can run, if there is one."""
        from smsl_studio.front.suitable_worlds import worlds_for

        drawn = self._parts.session.blueprint
        if self._loaded is not None and drawn.operation_count <= MOST_BOUND:
            first, *_ = worlds_for(drawn, loaded=self._loaded)
            page.offer(first)

    def _turn(self) -> None:
        """Begin, pause, or go on."""
        from smsl_studio.studio.features.physics.work import PAUSED, RUNNING

        assert self.work is not None
        if self.work.phase == RUNNING:
            self.work.pause()
        elif self.work.phase == PAUSED:
            self.work.resume()
        else:
            try:
                self.work.start(self._request())
            except StudioError as error:
                self._parts.toast.refuse(error)

    def _request(self) -> ExplorationRequest:
        """Return what is asked for. UsageError if the drawing has no start of one SB."""
        from smsl_studio.front.exploration_child import ExplorationRequest

        page, blueprint = self.part(), self._parts.session.blueprint
        branches = list(blueprint)
        if len(branches) != 1 or branches[0].initial not in branches[0].table:
            raise UsageError(
                "physics is explored from the drawing's INITIAL state, in one State Branch",
                advice="Open a blueprint of one State Branch with the start and its facts.",
            )
        folder = self._parts.settings.folder / "explorations"
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            words = f"{folder} cannot be made: {error.strerror or error}"
            raise SaveError(words, advice="Is the disk full?") from None
        world, repeats = page.world.currentText(), page.repeats.value()
        own = f"{world} {repeats} {blueprint.document.text}"
        part = folder / f"{sha256_hex(own.encode())[:16]}.part"
        return ExplorationRequest(blueprint, world, part, repeats)

    def _keep(self) -> None:
        """Open what was found so far as a new blueprint, which nobody has inspected."""
        made, files = self.part().made, self._parts.files
        files.asking.emit()
        if made is None or not files.may_leave():
            return
        files.show(OpenedFile(made.blueprint), None, made.blueprint.file)
        self._shell.set_mode("draw")
        self._parts.toast.say("Made from physics. Nobody has inspected it yet.")
