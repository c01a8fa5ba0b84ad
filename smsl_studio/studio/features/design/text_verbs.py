"""Generating from text: the dialog, the bar, and taking what came."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from smsl_studio.errors import StudioError
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.words import refusal_words
from smsl_studio.studio.features.design.work import DesignWork
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.front.design.generation import GenerationRequest, NewGeneration
    from smsl_studio.studio.features.design.generation_bar import GenerationBar
    from smsl_studio.studio.features.design.page import CyclePage
    from smsl_studio.studio.features.design.request_dialog import RequestDialog


class TextVerbs(QObject):
    """What a person may do with texts. Nothing is taken by itself but into a new file."""

    taken = Signal()
    """A generation was taken, or its files were written."""

    def __init__(self, parts: WindowParts, work: DesignWork, part: LatePart[CyclePage]) -> None:
        super().__init__(parts.window)
        self._parts, self._work, self._part = parts, work, part
        self.show: Callable[[], None] = lambda: None
        """Shows the page."""
        self.dialog: RequestDialog | None = None
        self._folder: Path | None = None
        self._asked: GenerationRequest | None = None
        work.came.connect(self._came)
        work.refused.connect(self._refused)

    def connect_bar(self, bar: GenerationBar) -> None:
        """Do what the buttons of the bar ask for."""
        bar.cancel_wanted.connect(self.cancel)
        bar.take_wanted.connect(self.take)
        bar.leave_wanted.connect(self.leave)
        bar.again_wanted.connect(self._ask_again)

    def ask_new(self) -> None:
        """Ask for texts, of which a new blueprint is made."""
        from smsl_studio.front.design.generation import GenerationRequest

        self.show()
        folder = Path.home()
        self._open(GenerationRequest((), folder / "from-text.json"), known=False)

    def ask_anew(self) -> None:
        """Ask for texts again, of which the open blueprint was made."""
        from smsl_studio.front.design.generation import GenerationRequest

        path, page = self._parts.files.path, self._part()
        if path is None:
            self.ask_new()
            return
        cycle = page.cycle
        texts: tuple[Path, ...] = ()
        hardware = require = None
        if cycle is not None:
            texts = tuple(one.path for one in cycle.texts if one.path is not None)
            hardware = next((one.path for one in cycle.hardware if one.path), None)
            require = cycle.notes.require
        before = self._asked
        request = GenerationRequest(texts, path, hardware, require)
        if before is not None and before.target == path:
            request = GenerationRequest(
                texts or before.texts, path, hardware or before.hardware,
                require or before.require, before.provider, before.by_hand,
            )  # fmt: skip
        self._open(request, known=True)

    def _open(self, request: GenerationRequest, known: bool) -> None:
        from smsl_studio.studio.features.design.request_dialog import RequestDialog

        self.dialog = dialog = RequestDialog(request, known, self._parts.window)
        dialog.accepted.connect(lambda: self.generate(dialog.request))
        dialog.finished.connect(self._closed)
        dialog.open()

    def _closed(self) -> None:
        if self.dialog is not None:
            self.dialog.deleteLater()
            self.dialog = None

    def generate(self, request: GenerationRequest) -> None:
        """Run the chain; the blueprint stays as it is."""
        self._asked = request
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="smsl-generation-"))
        page = self._part()
        page.new = None
        page.refresh()
        before = self._parts.session.blueprint if self._is_here(request) else None
        page.bar.show_asking(_who(request))
        self._work.generate(request, self._folder / "new", before)

    def cancel(self) -> None:
        """Ask nobody any more."""
        self._work.cancel()
        self.leave()
        self._parts.toast.say("Cancelled. The blueprint is as it was.")

    def leave(self) -> None:
        """Forget what came; the blueprint stays as it is."""
        page = self._part()
        page.new = None
        page.bar.close_bar()
        page.refresh()

    def take(self) -> None:
        """Replace the blueprint by what came, as one step of the history."""
        from smsl_studio.front.design.base import generation_of
        from smsl_studio.front.design.generation import (
            BLUEPRINT,
            keep_generation,
            taken,
            what_is_at,
        )

        page = self._part()
        new = page.new
        if new is None or new.made.blueprint is None:
            return
        made, target = new.made.blueprint, new.request.target
        files, session, toast = self._parts.files, self._parts.session, self._parts.toast
        here = self._is_here(new.request)
        if not here and what_is_at(target)[0] == BLUEPRINT:
            # The file that is there is not written over: what came is a step of its history.
            if not files.open(target):
                return
            self.show()
            here = True
        elif not here and not files.may_leave():
            return
        if here and not session.edit("Take the new generation", lambda before: taken(
            before, generation_of(before, target), made
        )):  # fmt: skip
            return
        try:
            keep_generation(new, own=not here)
        except StudioError as error:
            toast.refuse(error)
            return
        self.leave()
        if here:
            more = " Nobody has inspected it." if new.changes else ""
            toast.offer(f"Took the new generation.{more}", "Undo", session.history.undo)
        else:
            session.history.setClean()
            files.open(new.request.target)
            self.show()
            toast.say("Made from text. Nobody has inspected it.")
        self.taken.emit()

    def forget(self) -> None:
        """Forget what waits, because another file was opened."""
        if self._part.made is not None and self._part.made.new is not None:
            self.leave()

    def stop(self) -> None:
        """Remove the folder of what was not taken."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)

    def _is_here(self, request: GenerationRequest) -> bool:
        """Whether a request is about the blueprint that is open."""
        path = self._parts.files.path
        return path is not None and path == request.target

    def _ask_again(self) -> None:
        if self._asked is not None:
            self.generate(self._asked)

    def _came(self, new: NewGeneration) -> None:
        page = self._part()
        page.new = new
        page.bar.show_came(new)
        page.refresh()
        target = new.request.target
        fresh = not self._is_here(new.request) and not os.path.lexists(target)
        if fresh and new.is_whole:
            self.take()

    def _refused(self, error: StudioError) -> None:
        self._part().bar.show_refusal(refusal_words(error))


def _who(request: GenerationRequest) -> str:
    """Who is asked, in words."""
    return {"reader": "the reader", "by-hand": "you"}.get(request.provider, request.provider)
