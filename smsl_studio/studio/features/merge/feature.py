"""The page Merge as a feature: its tab, its badge, and the versions that git still has."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.merge.choice import refusal_of_open
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.feature import Feature, ModePage, Page, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.features.merge.badge import ConflictBadge
from smsl_studio.studio.features.merge.marked_source import MarkedSource
from smsl_studio.studio.features.merge.open_merge import OpenMerge
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.blueprint.merge.sides import MergeSides
    from smsl_studio.front.marked_files import MarkedMerge
    from smsl_studio.studio.features.merge.page import MergePage

PAGE = "merge"


class MergeFeature(Feature):
    """Offers the page while the open blueprint has conflicts. The page is made when it is shown."""

    def __init__(self, parts: WindowParts, shell: Shell) -> None:
        self._parts, self._shell, self._tokens = parts, shell, parts.tokens
        self.merge = OpenMerge(parts.session, parts.files, parts.window)
        self.badge = ConflictBadge(parts.tokens)
        self.badge.clicked.connect(self.show)
        self.badges = (self.badge,)
        self.part = LatePart(self._make)
        self.mode_pages = (ModePage(PAGE, "Merge", self._page),)
        self._offered: int | None = None
        self._beside = Beside(parts.window)
        self._asked: Path | None = None
        self.marked = MarkedSource(parts.session, parts.files, parts.window)
        self.marked.merged.connect(self._merged)
        self.marked.refused.connect(self._not_merged)
        parts.session.opened.connect(self._forget)
        parts.session.broken_changed.connect(self._follow)
        self.merge.changed.connect(self._follow)

    def actions(self) -> tuple[Action, ...]:
        """The row of the menu Blueprint."""
        return (
            Action("merge_page", "Conflicts of the merge", self.show, "Blueprint", "", (),
                   lambda: self.merge.exists or self.marked.exists, section=4,
                   tip="Choose between mine, theirs and base"),
        )  # fmt: skip

    def show(self) -> None:
        """Show the page, if there is one."""
        if self.merge.exists or self.marked.exists:
            self._shell.set_mode(PAGE)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.badge.set_tokens(tokens)
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()
        self.marked.stop()
        if self.part.made is not None:
            self.part.made.stop()

    def _page(self) -> Page:
        return Page(self.part(), self.part().drawing.canvas)

    def _make(self) -> MergePage:
        from smsl_studio.studio.features.merge.page import MergePage

        page = MergePage(self._parts.session, self.merge, self._tokens)
        page.save_wanted.connect(self._save)
        # The page says itself what the message offers.
        page.opened.connect(self._parts.toast.hide)
        page.leave_wanted.connect(self._leave)
        page.merge_wanted.connect(self._merge_marked)
        self._tell_marked(page)
        return page

    def _forget(self) -> None:
        self._asked = None
        self._beside.drop()
        self._offer(None)

    def _follow(self) -> None:
        merge, marked = self.merge, self.marked
        was_offered = self._offered is not None
        if merge.exists:
            self._offer(len(merge.conflicts))
        else:
            self._offer(marked.places if marked.exists else None)
        if self.part.made is not None:
            self._tell_marked(self.part.made)
        if marked.exists and not was_offered:
            self._parts.toast.offer(f"{marked.words}.", "Show Merge", self.show, "W")
        self._look_in_git()

    def _tell_marked(self, page: MergePage) -> None:
        marked = self.marked
        if marked.exists:
            page.notice.show_marked(marked.words, marked.fault, not marked.fault)
        if not self.merge.exists:
            page.refresh()

    def _merge_marked(self) -> None:
        self._parts.files.settling.emit()
        self.part().notice.show_busy(True)
        self.marked.merge()

    def _not_merged(self, words: str) -> None:
        notice = self.part().notice
        notice.show_busy(False)
        notice.show_error(words)

    def _merged(self, done: MarkedMerge) -> None:
        self.part().notice.show_busy(False)
        if self.merge.exists:
            self.merge.know(done.sides)
        else:
            self._parts.toast.say("Merged by meaning. No conflict is left. Save keeps it.")

    def _offer(self, count: int | None) -> None:
        left = len(self.merge.open_ones) if count is not None else 0
        self.badge.show_number(left)
        refusal = refusal_of_open(self._parts.session.blueprint) if left else None
        self._shell.hold_run(refusal_words(refusal) if refusal else "")
        if count != self._offered:
            self._offered = count
            self._shell.show_page(PAGE, count)

    def _look_in_git(self) -> None:
        """Ask git for the versions while its own merge of the file is not ended."""
        path, sides = self._parts.files.path, self.merge.sides
        if path is None or sides is None or sides.known or self._asked == path:
            return
        from smsl_studio.front.merge_versions import versions_in_git

        self._asked = path
        self._beside.do(partial(versions_in_git, path), partial(self._found, path))

    def _found(self, path: Path, sides: MergeSides | None) -> None:
        if sides is not None and path == self._parts.files.path and self.merge.exists:
            self.merge.know(sides)

    def _save(self) -> None:
        if not self.merge.open_ones and self._parts.files.save():
            self._parts.toast.say("Saved the merged file. No conflict is open.")

    def _leave(self) -> None:
        left = len(self.merge.open_ones)
        self._shell.set_mode("draw")
        stay = "stays" if left == 1 else "stay"
        self._parts.toast.say(f"{counted(left, 'conflict')} {stay} open in the file.")
