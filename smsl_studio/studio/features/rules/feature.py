"""The page Rules as a feature: its tab, its rows in the menus, and its file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.errors import StudioError
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.feature import Feature, ModePage, Page, Shell
from smsl_studio.studio.base.file_dialogs import ask_to_open, ask_to_save
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.files.opened_file import OpenedFile
from smsl_studio.studio.features.rules.refusals import keep_refusals, refusals_of
from smsl_studio.studio.features.rules.rules_file import ENDING, RulesFile, first_text
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.generate.examples.learnt import Learnt
    from smsl_studio.studio.features.rules.page import RulesPage

PAGE = "rules"
KINDS = "Rules (*.toml);;All files (*)"
BY_RULES = "Rules and examples"
"""The submenu with all that makes or completes a drawing by rules."""


class RulesFeature(Feature):
    """Offers the page after it was asked for once. It is made when it is first shown."""

    def __init__(self, parts: WindowParts, shell: Shell) -> None:
        self._parts, self._shell, self._tokens = parts, shell, parts.tokens
        self.part: LatePart[RulesPage] = LatePart(self._make)
        self._beside = Beside(parts.window)
        self.mode_pages = (ModePage(PAGE, "Rules", self._page),)

    def actions(self) -> tuple[Action, ...]:
        """The rows of the menus File and Blueprint."""
        return (
            Action("rules_page", "Rules", self.show, "Blueprint", "", (), section=4,
                   inner=BY_RULES,
                   tip="Write rules, and see which states and operations they give"),
            Action("complete_drawing", "Complete from examples", self.complete, "Blueprint", "", (),
                   section=4, inner=BY_RULES,
                   tip="Suggest what is missing or odd by the drawing's own rules"),
            Action("open_rules", "Open rules…", self.open, "File", "", (), section=1,
                   tip="Open a file of rules on the page Rules"),
        )  # fmt: skip

    def open_path(self, path: Path) -> bool:
        """Open a file of rules."""
        if not path.name.lower().endswith(ENDING):
            return False
        self.show()
        self._open(path)
        return True

    def show(self) -> None:
        """Show the page. Without an open file a new drawing is begun beside it."""
        if not self._parts.files.is_open:
            self._parts.files.new()
        first = self.part.made is None
        self._shell.show_page(PAGE, 0)
        self._shell.set_mode(PAGE)
        if first:
            self._begin()

    def complete(self) -> None:
        """Show the page, and suggest what the drawing lacks by its own rules, and what is odd."""
        self.show()
        self._learn()

    def open(self) -> None:
        """Ask for a file of rules and open it."""
        name = ask_to_open(self._parts.window, "Open rules", str(self._folder()), KINDS)
        if name:
            self.show()
            self._open(Path(name))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    def stop(self) -> None:
        """Keep the text for the next time, and end all work, because the window closes."""
        self._beside.stop()
        if self.part.made is not None:
            self.part.made.stop()

    def _page(self) -> Page:
        page = self.part()
        return Page(page, page.text)

    def _make(self) -> RulesPage:
        from smsl_studio.studio.features.rules.page import RulesPage

        page = RulesPage(self._parts.session, RulesFile(self._parts.settings), self._tokens)
        page.open_wanted.connect(self.open)
        page.save_wanted.connect(self.save)
        page.learn_wanted.connect(self._learn)
        page.write_wanted.connect(self._write)
        page.side.refusals_changed.connect(self._keep_refusals)
        self._parts.session.opened.connect(self._show_refusals)
        self._parts.files.changed.connect(self._keep_refusals)
        page.side.set_refused(refusals_of(self._parts.settings, self._parts.files.path))
        return page

    def _show_refusals(self) -> None:
        """Show what was refused in the drawing that was opened."""
        settings, path = self._parts.settings, self._parts.files.path
        self.part().side.set_refused(refusals_of(settings, path))

    def _keep_refusals(self) -> None:
        """Store what is refused, as soon as the drawing has a file."""
        path = self._parts.files.path
        if path is not None:
            keep_refusals(self._parts.settings, path, self.part().side.refused)

    def _begin(self) -> None:
        """Show the text that was not saved the last time, or one to begin with."""
        page, session = self.part(), self._parts.session
        text, kept = page.file.open(None)
        shown = session.blueprint.branches.get(session.branch)
        page.text.setPlainText(text if kept else first_text(shown))
        if kept:
            self._parts.toast.say("Brought back the rules that were not saved.")

    def _open(self, path: Path) -> None:
        page = self.part()
        page.keep()
        try:
            text, kept = page.file.open(path)
        except StudioError as error:
            self._parts.toast.refuse(error)
            return
        page.begin_anew()
        page.text.setPlainText(text)
        page.follow()
        if kept:
            self._parts.toast.say(f"Brought back what was not saved in {path.name}.")

    def save(self) -> bool:
        """Save the rules; ask for a place if there is none yet. False if they are not saved."""
        page = self.part()
        path = page.file.path
        if path is None:
            suggested = str(self._folder() / f"{Path(self._parts.files.name).stem}{ENDING}")
            name, _ = ask_to_save(self._parts.window, "Save rules", suggested, KINDS)
            if not name:
                return False
            path = Path(name)
            if path.suffix.lower() != ".toml":
                path = path.with_name(f"{path.name}{ENDING}")
        try:
            page.file.save(page.text.toPlainText(), path)
        except StudioError as error:
            self._parts.toast.refuse(error)
            return False
        page.keep()
        self._parts.toast.say(f"Saved {path.name}.")
        return True

    def _learn(self) -> None:
        """Replace the text by the rules that make the drawing, as one step of its undo."""
        blueprint = self._parts.session.blueprint

        def tried() -> Learnt | StudioError:
            from smsl_studio.front.examples import learn

            try:
                return learn(blueprint)
            except StudioError as error:
                return error

        self._beside.drop()
        self._parts.toast.offer("Looking for rules…", "Cancel", self._beside.drop)
        self._beside.do(tried, self._show_learnt)

    def _show_learnt(self, came: Learnt | StudioError) -> None:
        page = self.part()
        page.refuse(came if isinstance(came, StudioError) else None)
        if isinstance(came, StudioError):
            self._parts.toast.refuse(came)
            return
        page.begin_anew()
        page.text.replace_all(came.text)
        odd = len(came.exceptions)
        more = f" {counted(odd, 'suggestion')} at the right side." if odd else ""
        self._parts.toast.say(f"These rules make the drawing.{more} Ctrl+Z brings the text back.")

    def _write(self) -> None:
        """Open what the rules give as a new blueprint, which nobody has inspected."""
        answer, files = self.part().answer, self._parts.files
        made = answer.draft.blueprint if answer is not None else None
        files.asking.emit()
        if made is None or not files.may_leave():
            return
        files.show(OpenedFile(made), None, made.file)
        self._shell.set_mode("draw")
        self._parts.toast.say("Made from rules. Nobody has inspected it yet.")

    def _folder(self) -> Path:
        path = self._parts.files.path
        return path.parent if path is not None else Path.home()
