"""Pictures and diagrams of the drawing as a feature: its rows in the menus File and Edit."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.front.approval_badge import UNINSPECTED, ApprovalWords
from smsl_studio.legible import plain_text
from smsl_studio.picture.levels import Level
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.export.copies import CopyVerbs
    from smsl_studio.studio.features.export.export_dialog import ExportDialog, FileChoices
    from smsl_studio.studio.features.export.subject import Subject


class ExportFeature(Feature):
    """Writes, copies and prints the drawing. ``canvas`` knows what is in view."""

    def __init__(self, parts: WindowParts, shell: Shell, canvas: Canvas) -> None:
        self._parts, self._shell, self._canvas = parts, shell, canvas
        self._tokens = parts.tokens
        self._choices: FileChoices | None = None
        self.copies = LatePart(self._make_copies)
        self.trust: Callable[[], ApprovalWords] = lambda: UNINSPECTED
        """Returns what the badge of trust says now."""

    def actions(self) -> tuple[Action, ...]:
        """The rows of the menus."""
        can = self._can
        return (
            Action("export_picture", "Export picture…", self.export, "File", "",
                   ("Ctrl+Shift+E",), can, section=1,
                   tip="Write the view, the selection or State Branches as SVG, PNG or PDF"),
            Action("print", "Print…", self.print, "File", "", ("Ctrl+P",), can, section=1,
                   tip="Print on one sheet, or on several as a poster, with a preview"),
            Action("copy_picture", "Copy as picture", self.copy_picture, "Edit", "",
                   ("Ctrl+Shift+C",), can, section=1,
                   tip="Copy the selection, or else this State Branch, as PNG and SVG"),
            Action("copy_mermaid", "Copy as Mermaid", lambda: self.copies().mermaid(), "Edit", "",
                   (), can, section=1,
                   tip="Copy the selection, or else this State Branch, as text that wikis draw"),
            Action("copy_dot", "Copy as DOT", lambda: self.copies().dot(), "Edit", "", (), can,
                   section=1,
                   tip="Copy the selection, or else this State Branch, as text for Graphviz"),
        )  # fmt: skip

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme, also for the next picture."""
        self._tokens, self._choices = tokens, None

    def stop(self) -> None:
        """End the work, because the window closes."""
        if self.copies.made is not None:
            self.copies.made.stop()

    def export(self) -> None:
        """Open the dialog for a file."""
        from smsl_studio.studio.features.export.export_dialog import ExportDialog, FileChoices

        choices = self._choices or FileChoices(theme=self._tokens.name)
        path = self._parts.files.path
        folder = path.parent if path is not None else Path.home()
        dialog = ExportDialog(self._subjects(), choices, folder, self._tokens, self._parts.window)
        dialog.written.connect(lambda path: self._written(dialog, path))
        dialog.show()

    def print(self) -> None:
        """Open the dialog for paper."""
        from smsl_studio.studio.features.export.print_dialog import PrintDialog

        dialog = PrintDialog(self._subjects(), self._tokens, self._parts.window)
        dialog.printed.connect(self._parts.toast.say)
        dialog.show()

    def copy_picture(self) -> None:
        """Copy the selection, or else the SB, in the colours of the window."""
        self.copies().picture(self._tokens.name)

    def _can(self) -> bool:
        session = self._parts.session
        return self._shell.mode == "draw" and session.branch in session.blueprint.branches

    def _subjects(self) -> dict[str, Subject]:
        """What can be drawn now, by its kind."""
        from smsl_studio.studio.features.export.subject import ALL, BRANCH, SELECTION, VIEW

        kinds = [BRANCH, VIEW, ALL]
        if self._selected():
            kinds.insert(1, SELECTION)
        return {what: self._subject(what) for what in kinds}

    def _subject(self, what: str) -> Subject:
        from smsl_studio.studio.features.export.subject import Subject

        session, seen = self._parts.session, self._canvas.seen
        view = seen.left(), seen.top(), seen.right(), seen.bottom()
        sheet = self._canvas.sheet
        shortened = sheet is not None and sheet.level < Level.FULL
        chosen = session.selection
        return Subject(
            what,
            session.blueprint,
            session.branch,
            chosen,
            view,
            shortened,
            self._canvas.collapsed,
            self.trust().foot,
        )

    def _copied(self) -> Subject:
        from smsl_studio.studio.features.export.subject import BRANCH, SELECTION

        return self._subject(SELECTION if self._selected() else BRANCH)

    def _selected(self) -> bool:
        """Whether something of the SB that is shown is selected."""
        session = self._parts.session
        return any(one.state and one.branch == session.branch for one in session.selection)

    def _make_copies(self) -> CopyVerbs:
        from smsl_studio.studio.features.export.copies import CopyVerbs

        return CopyVerbs(self._copied, self._parts.toast, self._parts.window)

    def _written(self, dialog: ExportDialog, path: Path) -> None:
        self._choices = dialog.choices
        self._parts.toast.say(plain_text(f"Wrote {path.name}."))
