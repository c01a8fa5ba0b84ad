"""What the buttons of a stage do: try, write, open its page."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPoint, QUrl, Signal
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QMenu

from smsl_studio.errors import StudioError
from smsl_studio.front.design import stages
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.feature import Shell
from smsl_studio.studio.base.words import as_it_is, counted
from smsl_studio.studio.features.design.text_verbs import TextVerbs
from smsl_studio.studio.features.design.work import DesignWork
from smsl_studio.studio.running.window_parts import WindowParts
from smsl_studio.world.engines import TABLE

if TYPE_CHECKING:
    from collections.abc import Callable

    from smsl_studio.front.design.cycle import DesignCycle
    from smsl_studio.front.design.notes import StageNote
    from smsl_studio.studio.features.design.functions_dialog import FunctionsDialog
    from smsl_studio.studio.features.design.page import CyclePage
    from smsl_studio.studio.features.design.text_dialog import TextDialog

OPENED = {
    stages.BRANCHES: "identify", stages.HARDWARE: "levels", stages.TESTING: "campaign_page",
    stages.INSPECTION: "show_inspection", stages.APPROVAL: "mode_review",
}  # fmt: skip
"""The action that opens the page of a stage."""
TEXTS = (".md", ".txt", ".pdf")
"""The desktop is asked to open these alone."""


class StageVerbs(QObject):
    """Does what the right side of the page asks for."""

    changed = Signal()
    """Something was written beside the blueprint."""

    def __init__(
        self, parts: WindowParts, shell: Shell, work: DesignWork, texts: TextVerbs
    ) -> None:  # fmt: skip
        super().__init__(parts.window)
        self._parts, self._shell, self._work, self._texts = parts, shell, work, texts
        self.actions: Actions | None = None
        self.loaded: Loaded | None = None
        self.tokens = parts.tokens
        self.text: TextDialog | None = None
        """The text that is open."""
        self.reading: FunctionsDialog | None = None
        """The functions that are read."""
        self.menu: QMenu | None = None
        self._page: CyclePage | None = None

    def connect_page(self, page: CyclePage) -> None:
        """Do what the buttons of a page ask for."""
        self._page, side = page, page.side
        side.act_wanted.connect(self.act)
        side.edit_wanted.connect(self.edit)
        side.open_wanted.connect(self.open)
        side.holds_wanted.connect(self._hold)
        side.read_wanted.connect(lambda _: self.read_functions())
        side.line_wanted.connect(self.read)
        side.element_wanted.connect(self.go_to)
        page.board.next.place_wanted.connect(self.go_to)

    # The three buttons.

    def act(self, number: int) -> None:
        """Do what the first button of a stage says."""
        if number == stages.TEXT:
            self._texts.ask_new()
        elif number in (stages.FSM, stages.HFSM, stages.HARDWARE):
            self._texts.ask_anew()
        elif number == stages.BRANCHES:
            self.try_cuts()
        elif number == stages.CODE:
            self.write_program()
        elif number == stages.TESTING:
            self.sweep()

    def edit(self, number: int) -> None:
        """Let a person do a stage by hand, also one that was not begun."""
        if number == stages.TEXT:
            path = self._first_text()
            if path is None:
                self._texts.ask_new()
            elif path.suffix.lower() in TEXTS:
                QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))
            else:
                # Notes come from outside, and the desktop would run a program.
                self._parts.toast.say(f"{path.name} is opened by no program from here.")
        elif number in OPENED and number != stages.BRANCHES:
            self._trigger(OPENED[number])
        else:
            self._shell.set_mode("draw")

    def open(self, number: int) -> None:
        """Show the page of a stage."""
        cycle = self._cycle
        if number == stages.TEXT:
            name = next((one.name for one in cycle.texts), "") if cycle is not None else ""
            self.read(name, 1, 0)
        elif number == stages.CODE:
            QDesktopServices.openUrl(QUrl.fromLocalFile(str(self._program().parent)))
        elif number in OPENED:
            if number in (stages.BRANCHES, stages.INSPECTION):
                self._shell.set_mode("draw")
            self._trigger(OPENED[number])
        else:
            self._shell.set_mode("draw")
            if number == stages.HFSM:
                self._shell.show_tab("Findings")

    def read(self, name: str, line: int, page: int) -> None:
        """Show a text of the consultation at a line."""
        from smsl_studio.studio.features.design.text_dialog import TextDialog

        cycle = self._cycle
        texts = (*cycle.texts, *cycle.hardware) if cycle is not None else ()
        found = next((one for one in texts if one.name == name and one.text is not None), None)
        if found is None or found.text is None:
            toast = self._parts.toast
            words = f"{name} is not here." if name else "There is no text yet."
            toast.offer(words, "Choose texts", self._texts.ask_anew, "W")
            return
        if self.text is not None:
            self.text.close()
        self.text = TextDialog(found.text, str(found.path), self.tokens, self._parts.window)
        self.text.go_to(line, page)
        self.text.show()

    def read_functions(self) -> None:
        """Show the generated functions, which a person may allow."""
        from smsl_studio.studio.features.design.functions_dialog import FunctionsDialog

        proposal = self._cycle.functions.proposal if self._cycle is not None else None
        if proposal is not None:
            self.reading = FunctionsDialog(proposal, self._parts.window)
            self.reading.allowed.connect(self._allowed)
            self.reading.open()

    def _allowed(self) -> None:
        self._shell.program.look_for_plugins()
        self._parts.toast.say("Allowed. They count in a world once their sweep has passed there.")
        self.changed.emit()

    def go_to(self, address: str) -> None:
        """Show an element in the drawing."""
        session = self._parts.session
        try:
            there = session.blueprint.resolve(address)
        except StudioError:
            self._parts.toast.say(f"{address} is not in the drawing.")
            return
        self._shell.set_mode("draw")
        session.jump(there)

    # What is tried and written.

    def try_cuts(self) -> None:
        """Let rules try which states could be a sub-SB."""
        from smsl_studio.front.design.tries import try_cuts

        cycle, blueprint = self._cycle, self._parts.session.blueprint
        if cycle is not None and self._has_place():
            self._attempt("Trying the cuts…", lambda: try_cuts(blueprint, cycle))

    def sweep(self) -> None:
        """Run every operation alone; with several worlds ask for one first."""
        from smsl_studio import front

        worlds: tuple[str, ...] = (TABLE,)
        if self.loaded is not None:
            worlds = tuple(front.worlds_for(self._parts.session.blueprint, loaded=self.loaded))
        if len(worlds) < 2:
            self.sweep_in(TABLE)
            return
        assert self._page is not None
        self.menu = QMenu(self._page)
        for world in worlds:
            chosen = self.menu.addAction(as_it_is(f"In the world {world}"))
            chosen.triggered.connect(partial(self.sweep_in, world))
        button = self._page.side.act
        self.menu.popup(button.mapToGlobal(QPoint(0, button.height())))

    def sweep_in(self, world: str) -> None:
        """Run every operation alone in a world."""
        from smsl_studio.front.design.tries import try_operations

        cycle, blueprint = self._cycle, self._parts.session.blueprint
        if cycle is not None and self._has_place():
            work = partial(try_operations, blueprint, cycle, world, "")
            self._attempt(f"Sweeping every operation in the world {world}…", work)

    def write_program(self) -> None:
        """Write the program of the blueprint into a folder beside it."""
        if not self._has_place():
            return
        from smsl_studio.front.generated_code import generate_code

        blueprint, folder = self._parts.session.blueprint, self._program()

        def told(came: object) -> None:
            """Say what was written."""
            if isinstance(came, StudioError):
                self._parts.toast.refuse(came)
                return
            written = counted(len(getattr(came, "changed", ())), "file")
            self._parts.toast.say(f"Wrote {written} into {folder.name}.")
            self.changed.emit()

        self._work.attempt(lambda: generate_code(blueprint, folder), told)

    def _hold(self, number: int) -> None:
        from smsl_studio.front.design.tries import still_holds

        cycle = self._cycle
        if cycle is not None and self._has_place():
            self._keep(still_holds(number, cycle, ""))

    def _attempt(self, words: str, work: Callable[[], StageNote]) -> None:
        def told(came: object) -> None:
            """Keep what came, and say it."""
            self._parts.toast.hide()
            if isinstance(came, StudioError):
                self._parts.toast.refuse(came)
                return
            self._keep(came)  # type: ignore[arg-type]

        self._parts.toast.offer(words, "Cancel", self._work.drop_attempt)
        self._work.attempt(work, told)

    def _keep(self, note: StageNote) -> None:
        from smsl_studio.front.design.tries import keep_note

        path = self._parts.files.path
        if path is None:
            return
        try:
            keep_note(str(path), note)
        except StudioError as error:
            self._parts.toast.refuse(error)
            return
        name = stages.WORDS[note.stage].name
        self._parts.toast.say(f"{name}: {note.words}.")
        self.changed.emit()

    # What is known.

    @property
    def _cycle(self) -> DesignCycle | None:
        return self._page.cycle if self._page is not None else None

    def _first_text(self) -> Path | None:
        cycle = self._cycle
        texts = cycle.texts if cycle is not None else ()
        return next((one.path for one in texts if one.path is not None), None)

    def _program(self) -> Path:
        path = self._parts.files.path or Path("blueprint.json")
        return path.with_name(f"{path.stem}-program")

    def _has_place(self) -> bool:
        if self._parts.files.path is None:
            self._parts.toast.say("Save the blueprint first, so that the result has a place.")
            return False
        return True

    def _trigger(self, action: str) -> None:
        if self.actions is not None:
            self.actions[action].trigger()
