"""LibraryVerbs: what a line of the library does on the canvas, by a drop, by Enter or by a menu."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QMenu

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.feature import Shell
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.intent import Intent
from smsl_studio.studio.features.draw.canvas.library_drop import Drop, LibraryDrop
from smsl_studio.studio.features.draw.canvas.operation_drop import OperationDrop
from smsl_studio.studio.features.draw.canvas.template_drop import TEMPLATES, TemplateDrop


class LibraryVerbs:
    """Uses operations and templates of the library at what is selected.

    ``drop`` watches the canvas for those that are dragged.
    """

    def __init__(self, editor: CanvasEditor) -> None:
        self._editor, self._session = editor, editor.session
        self.drop = LibraryDrop(editor.canvas, self._drop_for)

    def use(self, kind: str, name: str) -> bool:
        """Use it at the selected elements. False if an operation has no selected states."""
        if kind == "template":
            self.insert(name)
            return True
        drop = OperationDrop(self._editor, name)
        chosen = drop.selected()
        if len(chosen) not in (1, 2):
            return False
        self._act(drop.on_state(*chosen) if len(chosen) == 1 else drop.between(*chosen))
        return True

    def insert(self, template: str) -> None:
        """Use a template at the selected element; without one say what it needs."""
        chosen, shown = self._session.selection, self._session.branch
        one = len(chosen) == 1 and chosen[0].branch == shown
        drop = TemplateDrop(self._editor, template)
        self._act(drop.on(chosen[0] if one else Address(shown)))

    def _act(self, intent: Intent) -> None:
        if intent.act is not None:
            intent.act()
        else:
            self._editor.canvas.say(intent.words)

    def _drop_for(self, kind: str, name: str) -> Drop:
        if kind == "template":
            return TemplateDrop(self._editor, name)
        return OperationDrop(self._editor, name)


def template_actions(verbs: LibraryVerbs, shell: Shell) -> tuple[Action, ...]:
    """One action for each template. They stand in the menu Insert template."""
    return tuple(
        Action(f"template_{key}", f"Insert template: {one.name}", partial(verbs.insert, key),
               icon=one.icon, tip=one.tip, enabled=lambda: shell.mode == "draw")
        for key, one in TEMPLATES.items()
    )  # fmt: skip


def fill_templates(actions: Actions, menu: QMenu) -> None:
    """Fill the menu Insert template."""
    menu.clear()
    actions.refresh()
    for key, one in TEMPLATES.items():
        action = actions[f"template_{key}"]
        line = menu.addAction(action.icon(), one.name, action.trigger)
        line.setToolTip(tip_text(one.tip))
        line.setEnabled(action.isEnabled())
