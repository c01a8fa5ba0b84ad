"""DrawnStage: a stage with notes and groups that can be selected and moved."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Signal

from smsl_studio.picture.drawn_parts import Members
from smsl_studio.studio.base.canvas.drawn_painter import MARGIN
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.canvas.moved_stage import MovedStage
from smsl_studio.studio.base.canvas.sheet import POOL


class DrawnStage(MovedStage):
    """The scene of a canvas with its notes and groups."""

    drawn_wanted = Signal(object)
    """DrawnKey: select this note or group."""
    drawn_edit_wanted = Signal(object)
    """DrawnKey: edit the words of this note, or the title of this group, in place."""
    drawn_nudge_wanted = Signal(float, float)
    """(dx, dy) in scene units: move the selected note or group (arrow keys)."""
    drawn_menu_wanted = Signal(object, object)
    """(DrawnKey, point of the screen): open the menu of a note or group."""
    note_wanted = Signal(QPointF)
    """Add a note at this scene point."""
    note_moved = Signal(str, QPointF)
    """(key, scene point): the user dragged the upper left corner of this note there."""

    def drawn_at(self, at: QPointF) -> DrawnKey | None:
        """The note or the title of a group at a scene point.

        It is None if something else lies above it. Nodes lie above notes and titles. Labels and
        everything that is highlighted lie above titles. Lines lie below the words of a title.
        """
        sheet = self.sheet
        if sheet is None or not sheet.drawn or sheet.state_at(at.x(), at.y()) >= 0:
            return None
        found = sheet.drawn.at(at.x(), at.y())
        if found is None or found.kind == "note":
            return found
        edge = sheet.edge_at(at.x(), at.y())
        below = edge >= 0 and not sheet.looks.is_lit(edge) and sheet.drawn.words_at(at.x(), at.y())
        name = sheet.geometry.label(edge) if below else None
        named = name is not None and name[0] <= at.x() <= name[2] and name[1] <= at.y() <= name[3]
        return found if edge < 0 or (below and not named) else None

    def drag_note(self, key: DrawnKey, x: float, y: float) -> None:
        """Show a note with its upper left corner at a scene point during a drag."""
        self.update_drawn(key)
        if self.sheet is not None:
            self.sheet.drawn.lay_aside(self.sheet.drawn.number(key), x, y)
        self.update_drawn(key)

    def drop_note(self, key: DrawnKey) -> None:
        """Show a note where it belongs, after a drag."""
        self.update_drawn(key)
        if self.sheet is not None:
            self.sheet.drawn.lay_back()
        self.update_drawn(key)

    def show_members(self, members: Members | None) -> None:
        """Show other states in the groups during a drag. None shows those of the blueprint."""
        sheet = self.sheet
        if sheet is None or not sheet.drawn:
            return
        before = sheet.drawn.members
        after = sheet.drawn.parts.members if members is None else members
        changed = [
            DrawnKey("group", key)
            for key, old, new in zip(sheet.drawn.parts.group_keys, before, after, strict=True)
            if not np.array_equal(old, new)
        ]
        for key in changed:
            self.update_drawn(key)
        sheet.drawn.put_members(members)
        for key in changed:
            self.update_drawn(key)

    def choose_drawn(self, chosen: DrawnKey | None) -> None:
        """Show a note or a group as selected; None for none."""
        before, self.drawn.chosen = self.drawn.chosen, chosen
        for key in {before, chosen} if before != chosen else ():
            self.update_drawn(key)

    def mark_drawn(self, found: frozenset[DrawnKey]) -> None:
        """Show a lens at the notes and groups that a search has found."""
        before, self.drawn.found = self.drawn.found, found
        changed = before ^ found
        if len(changed) > POOL:
            self._repaint()
        for key in changed if len(changed) <= POOL else ():
            self.update_drawn(key)

    def update_drawn(self, key: DrawnKey | None) -> None:
        """Repaint a note or a group."""
        sheet = self.sheet
        rect = sheet.drawn.rect(key) if sheet is not None and key is not None else None
        if sheet is None or key is None or rect is None:
            return
        if key.kind == "note":
            state = int(sheet.drawn.parts.states[sheet.drawn.number(key)])
            if state >= 0:
                x, y = sheet.at[state].tolist()
                rect = rect.united(QRectF(x, y, 1.0, 1.0))
        pad = MARGIN / self.zoom
        self._repaint(rect.adjusted(-pad, -pad, pad, pad))
