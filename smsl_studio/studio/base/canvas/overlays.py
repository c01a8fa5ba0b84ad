"""The widgets that float over the canvas: breadcrumb, zoom control, legends, banner, map.

They are children of the view. Children of its viewport would scroll with the picture.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, QRect, QSize, QTimer
from PySide6.QtGui import QCursor
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.picture.levels import Level
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.canvas.branch_view import TOP, BranchView
from smsl_studio.studio.base.canvas.bundle_card import BundleCard
from smsl_studio.studio.base.canvas.covered import (
    along_the_rim,
    is_clear_of_dense,
    on_drawing,
    on_fitted,
    on_names,
    on_picture,
    on_states,
)
from smsl_studio.studio.base.canvas.hover_pad import HoverPad
from smsl_studio.studio.base.canvas.mini_map import MiniMap
from smsl_studio.studio.base.canvas.zoom_control import ZoomControl
from smsl_studio.studio.base.overlays.breadcrumb import Breadcrumb
from smsl_studio.studio.base.overlays.dense_legend import DenseLegend
from smsl_studio.studio.base.overlays.focus_outline import FocusRing
from smsl_studio.studio.base.overlays.key import Key
from smsl_studio.studio.base.overlays.legend import Legend, RunLegend
from smsl_studio.studio.base.overlays.notice import Banner, EmptyHint, PointerNote
from smsl_studio.studio.base.theme import Tokens

EDGE = 14
WIDE, TALL = 720, 420
"""In a view smaller than this (pixels) there is no mini-map."""
LOWEST = 140
"""A view lower than this shows no tools over the drawing (pixels)."""
SPOKEN = 6000
"""How long a sentence at the pointer stays (ms)."""


class Overlays:
    """Owns and places the floating widgets of one canvas."""

    def __init__(self, canvas: BranchView, tokens: Tokens, busy: Callable[[], bool]) -> None:
        """``busy`` says whether a gesture is in progress."""
        self._canvas = canvas
        self._dimmed = False
        self.breadcrumb = Breadcrumb(canvas, tokens)
        self.zoom = ZoomControl(canvas, tokens)
        self.legend = Legend(canvas, tokens)
        self.run_legend = RunLegend(canvas, tokens)
        self.run_legend.hide()
        self.map = MiniMap(canvas, tokens)
        self.key = Key(canvas, tokens)
        self.pad = HoverPad(canvas, tokens, busy)
        self.bundle = BundleCard(canvas, tokens)
        self.dense = DenseLegend(canvas, tokens)
        self.banner = Banner(canvas, tokens)
        self.word = PointerNote(canvas, tokens)
        self.empty = EmptyHint(canvas, canvas.viewport(), tokens)
        self.ring = FocusRing(canvas, tokens)
        self._hush = QTimer(canvas)
        self._hush.setSingleShot(True)
        self._hush.setInterval(SPOKEN)
        self._hush.timeout.connect(self.hush)
        self.breadcrumb.clicked.connect(self._crumb)
        self.zoom.left.connect(self.fitted)
        self.dense.collapse_wanted.connect(canvas.collapse_wanted)
        self.dense.lane_wanted.connect(self._list_lane)
        self.dense.bundle_wanted.connect(lambda: self.bundle.step(1))

    def set_tokens(self, tokens: Tokens) -> None:
        """Give all floating widgets the colours of another theme."""
        notes = self.banner, self.word, self.empty
        for widget in (self.zoom, self.map, self.pad, self.bundle, self.dense, *notes):
            widget.set_tokens(tokens)
        for plain in (self.breadcrumb, self.legend, self.run_legend, self.key, self.ring):
            plain.tokens = tokens
            plain.update()

    def show_branch(self, blueprint: Blueprint, branch: str) -> None:
        """Show the path to an SB, and the legend for the signs in its picture."""
        self.breadcrumb.show_branch(blueprint, branch)
        sheet = self._canvas.sheet
        kinds: set[str] = set()
        if sheet is not None and sheet.picture.branch.subs:
            edges = range(min(len(sheet.picture.operations), 5000))
            kinds = {sheet.picture.kind(e) for e in edges} - {""}
        if sheet is not None and sheet.picture.guarded:
            kinds |= {"guard"}
        if sheet is not None:
            self.legend.show_branch(sheet.picture.branch, kinds)
        self.show_dense()
        self.show_empty()
        # During a run the run's own header and buttons take the place of the breadcrumb.
        self.breadcrumb.setVisible(self._canvas.editing)
        self.map.update()
        self.place()

    def show_marks(self, marks: Marks) -> None:
        """Show the legend that fits the marks: during a run that of the run."""
        sheet = self._canvas.sheet
        self.bundle.follow(moved=False)
        self.pad.choose(marks.selection)
        if self.show_dense():
            self._place_dense()
        guarded = sheet is not None and bool(sheet.picture.guarded)
        anew = self.run_legend.show_kinds(guarded, bool(marks.risky))
        # A merge dims what did not change, but its signs are not those of a run.
        dimmed = marks.dimmed and not (marks.changes or marks.conflicts)
        changed = dimmed != self._dimmed or (anew and dimmed)
        self._dimmed = dimmed
        if changed or self._legends_in_the_way():
            self._place_legend()

    def show_dense(self) -> bool:
        """Show what is collapsed, or was; returns whether the legend has another size."""
        sheet, before = self._canvas.sheet, (self.dense.empty, self.dense.size())
        if sheet is None or not self._canvas.crowded:
            self.dense.show_counts(False, 0, 0)
        else:
            every, now = sheet.picture.all_bundles.members, sheet.picture.bundles
            lane = sheet.picture.all_bundles.lane
            pairs = {first: own for first, own in every.items() if first != lane}
            whole = sum(own == now.members.get(first) for first, own in pairs.items())
            opened, back = len(pairs) - whole, len(sheet.picture.all_bundles.back)
            self.dense.show_counts(sheet.picture.collapsed, len(pairs), opened, back)
            quiet = sheet.looks.quiet
            # A run and a comparison dim all elements that they do not mark.
            mixed = len(sheet.picture.mixed) if self._canvas.editing else 0
            self.dense.show_mixed(mixed, bool(quiet))
        return before != (self.dense.empty, self.dense.size())

    def _list_lane(self) -> None:
        """Open the card of the lane back to the start."""
        sheet = self._canvas.sheet
        lane = sheet.picture.bundles.lane if sheet is not None else -1
        if lane >= 0:
            self.bundle.open(lane)

    def show_zoom(self, zoom: float) -> None:
        """Show the zoom; 1.0 is 100 %."""
        self.zoom.show_zoom(zoom)
        self._explain()

    def show_empty(self) -> None:
        """Show how to begin, if the SB has no states."""
        sheet = self._canvas.sheet
        nothing = sheet is None or not len(sheet.picture)
        # A banner already tells why nothing can be drawn.
        self.empty.setVisible(nothing and self._canvas.editing and not self.banner.text)

    def _explain(self) -> None:
        """Explain the short texts of compact nodes and labels while they are shown."""
        sheet = self._canvas.sheet
        compact = sheet is not None and sheet.level is Level.COMPACT and self._has_tools
        self.key.show_picture(sheet.picture if sheet is not None else None, compact)
        self._place_key()

    def _place_key(self) -> None:
        """Put the key where it covers nothing, best at the top right, else hide it."""
        key, canvas, size = self.key, self._canvas, self.key.size()
        right = max(canvas.width() - size.width() - EDGE, 0)
        foot = canvas.height() - size.height() - EDGE
        below = min(self.breadcrumb.geometry().bottom() + 6, foot)
        places = (QPoint(right, 12), QPoint(right, below), QPoint(EDGE, foot))
        free = (at for at in places if not self._taken(at, size, key))
        place = next((at for at in free if not on_drawing(canvas, at, size)), None)
        key.setVisible(bool(key.rows) and place is not None)
        key.move(place or key.pos())

    def fitted(self) -> None:
        """A movement of the camera has ended: place the widgets for the new view."""
        self._count_outside()
        self._place_breadcrumb()
        self._place_zoom()
        self._place_legend()

    def _place_breadcrumb(self) -> None:
        """Put the breadcrumb into the upper left corner, without numbers where it would cover
        something, else into the lower left one. In a low view without a place it is not seen."""
        crumb, canvas = self.breadcrumb, self._canvas
        corner, foot = QPoint(EDGE, 10), QPoint(EDGE, canvas.height() - 26 - EDGE)
        for at, brief in ((corner, False), (corner, True), (foot, False), (foot, True)):
            crumb.set_brief(brief)
            area = QRect(at, crumb.sizeHint())
            others = (self.zoom, self.map)
            taken = any(not w.isHidden() and w.geometry().intersects(area) for w in others)
            if not taken and not on_picture(canvas, at, area.size()):
                break
        else:
            at = corner if canvas.height() >= LOWEST else QPoint(0, -LOWEST)
        crumb.setGeometry(QRect(at, crumb.sizeHint()))
        self._place_key()

    def _place_dense(self) -> None:
        """Put the legend of a dense drawing where it covers no state, best at the bottom left."""
        dense, canvas = self.dense, self._canvas
        room = canvas.width() - 2 * EDGE
        dense.fit(room)
        size, foot = dense.sizeHint(), canvas.height() - dense.height() - EDGE
        middle = (canvas.width() - size.width()) // 2
        below = 48 + (self.banner.height() + 4 if self.banner.text else 0)
        places = [QPoint(x, y) for y in (foot, below) for x in (EDGE, middle)]
        places += along_the_rim(QRect(EDGE, below, room, canvas.height() - EDGE - below), size)
        # An empty legend needs no place: each one that is tried looks at all nodes.
        free = (at for at in places if not dense.empty and not self._taken(at, size, dense))
        clear = next((at for at in free if is_clear_of_dense(canvas, at, size)), None)
        dense.setVisible(clear is not None and size.width() <= room)
        if clear is not None:
            dense.move(clear)

    def _place_legend(self) -> None:
        """Put the legend in a corner where it covers nothing, or hide it."""
        self._place_dense()
        legend: Legend | RunLegend = self.run_legend if self._dimmed else self.legend
        (self.legend if self._dimmed else self.run_legend).hide()
        legend.resize(legend.sizeHint())
        canvas, size = self._canvas, legend.sizeHint()
        left, top = EDGE + 3, 48 + (self.banner.height() + 4 if self.banner.text else 0)
        right = canvas.width() - size.width() - EDGE
        bottom = canvas.height() - size.height() - EDGE
        corners = [QPoint(left, bottom), QPoint(right, top), QPoint(left, top)]
        if self._dimmed:
            corners = [*reversed(corners), QPoint(right, bottom)]
        free = (c for c in corners if not self._taken(c, size) and not on_picture(canvas, c, size))
        clear = (c for c in free if not on_names(canvas, QRect(c, size)))
        place = next((c for c in clear if canvas.rect().contains(QRect(c, size))), None)
        legend.setVisible(place is not None and not legend.empty)
        if place is not None:
            legend.move(place)

    def _legends_in_the_way(self) -> bool:
        """Whether a legend lies on a name that is lit now, or waits for a free place."""
        canvas, used = self._canvas, [self.run_legend if self._dimmed else self.legend]
        waits = any(p.isHidden() or on_names(canvas, p.geometry()) for p in used if not p.empty)
        dense = self.dense if not canvas.editing and not self.dense.empty else None
        return waits or (dense is not None and on_names(canvas, dense.geometry()))

    def _taken(self, corner: QPoint, size: QSize, itself: QWidget | None = None) -> bool:
        """Whether another floating widget is there."""
        area = QRect(corner, size)
        others = (self.zoom, self.map, self.key, self.breadcrumb, self.dense, self.banner)
        shown = (one for one in others if one is not itself and not one.isHidden())
        return any(one.geometry().intersects(area) for one in shown)

    def floats(self) -> list[QRect]:
        """The places of the permanent floating widgets that are shown, in pixels of the view."""
        parts = (self.breadcrumb, self.banner, self.zoom, self.map, self.key, self.legend,
                 self.dense)  # fmt: skip
        return [part.geometry() for part in parts if not part.isHidden()]

    def floats_in(self, area: QRect) -> bool:
        """Whether a permanent floating widget is in this area of the view (pixels)."""
        return any(area.intersects(place) for place in self.floats())

    def spare(self, area: QRect) -> None:
        """Cover nothing of a new state that is being named (pixels of the view)."""
        self.legend.spare(area)
        self._place_breadcrumb()
        self._place_zoom(anew=True)

    def show_banner(self, text: str) -> None:
        """Show a sentence across the top; empty hides the banner."""
        if text == self.banner.text:
            return
        self.banner.show_text(text)
        self.show_empty()
        self.place()
        self._canvas.look_again()

    def foot_room(self, area: QRect) -> int:
        """How far an area has to rise to be clear of zoom and map in the lower half (pixels)."""
        half = self._canvas.height() // 2
        parts = [part for part in (self.zoom, self.map) if not part.isHidden()]
        tops = [part.y() for part in parts if part.y() > half and part.geometry().intersects(area)]
        return max(area.bottom() - min(tops) + 8, 0) if tops else 0

    def top_room(self) -> int:
        """The height at the top that the breadcrumb and a banner cover (pixels)."""
        return TOP + (self.banner.height() + 8 if self.banner.text else 0)

    def say(self, text: str, at: QPoint | None = None) -> None:
        """Show a sentence beside the pointer, or beside a point of the viewport (pixels)."""
        canvas = self._canvas
        if at is None:
            at = canvas.mapFromGlobal(QCursor.pos())
            if not canvas.rect().contains(at):
                at = canvas.rect().center()
        self.word.say(text)
        x = min(max(at.x() + 16, 8), max(canvas.width() - self.word.width() - 8, 8))
        y = min(max(at.y() + 18, 8), max(canvas.height() - self.word.height() - 8, 8))
        self.word.move(x, y)
        self._hush.start()
        self.word.placed.emit()

    def hush(self) -> None:
        """Hide the sentence at the pointer."""
        self.word.hide()

    def forget(self) -> None:
        """Hide the sentence and the hover pad: their states may be gone or elsewhere now."""
        self.hush()
        self.pad.go()
        self.bundle.go()

    def hover(self, address: Address | None) -> None:
        """Pass the element under the pointer to the hover pad; None for none."""
        self.pad.hover(address)

    def view_moved(self) -> None:
        """Update the widgets after a scroll or zoom."""
        self.pad.go()
        self.bundle.follow()
        self.picture_changed()
        if not self._canvas.camera.fitted:
            self._place_legend()

    def picture_changed(self) -> None:
        """Update the widgets after states moved or changed their look."""
        self._count_outside()
        self._place_breadcrumb()
        if not self.map.isHidden():
            self.map.update()
        if self._canvas.editing and not self._canvas.camera.fitted:
            self._place_zoom()

    def _count_outside(self) -> None:
        """Show how many states are outside the view; the zoom control grows for that."""
        self.zoom.show_outside(self._canvas.outside)
        if self.zoom.size() != self.zoom.sizeHint():
            self.zoom.resize(self.zoom.sizeHint())
            self._place_zoom()

    @property
    def _has_tools(self) -> bool:
        """Whether tools are shown over the drawing: it can be edited, and there is space."""
        return self._canvas.editing and self._canvas.height() >= LOWEST

    def _place_zoom(self, anew: bool = False) -> None:
        """Put the zoom control where it covers no node. With the pointer on it, only ``anew``."""
        canvas, zoom, map_ = self._canvas, self.zoom, self.map
        if zoom.held and not anew:
            return
        right, bottom = canvas.width() - EDGE, canvas.height() - EDGE
        several = canvas.sheet is not None and len(canvas.sheet.picture) > 1
        roomy = canvas.width() >= WIDE and canvas.height() >= TALL
        at = QPoint(right - map_.width(), bottom - map_.height())
        shown = canvas.editing and several and roomy and not on_fitted(canvas, at, map_.size())
        map_.move(at)
        map_.setVisible(shown)
        map_.show_over(on_states(canvas, at, map_.size()))
        right = at.x() - 12 if shown else right
        home, size = QPoint(right - zoom.width(), bottom - zoom.height()), zoom.size()
        # If it would cover the picture, it goes below the breadcrumb, or at the right of it.
        beside = QPoint(canvas.width() - EDGE - zoom.width(), 7)
        clear = not self.key.rows and self.breadcrumb.geometry().right() < beside.x()
        below = QPoint(EDGE - 2, 44 + (self.banner.height() + 6 if self.banner.text else 0))
        places = [home, below, *([beside] if clear else [])]
        rim = along_the_rim(QRect(EDGE, 7, canvas.width() - 2 * EDGE, bottom - 7), size)
        if not canvas.camera.fitted:
            # While the view moves it stays where it covers nothing.
            rest = [zoom.pos()] * (not anew) + places[1:] + rim
            places = [home, *(p for p in rest if not self._taken(p, size, zoom))]
        place = next((p for p in places if not on_picture(canvas, p, size)), None)
        if place is None and canvas.camera.fitted:
            free = (p for p in rim if not self._taken(p, size, zoom))
            last = beside if clear else home
            place = next((p for p in free if not on_states(canvas, p, size)), last)
        zoom.setVisible(self._has_tools and place is not None)
        zoom.move(place or home)

    def place(self) -> None:
        """Place all widgets for the present size of the view."""
        canvas = self._canvas
        width, height = canvas.width(), canvas.height()
        self.ring.place(width, height)
        self._place_breadcrumb()
        self.zoom.show_outside(canvas.outside)
        self.zoom.resize(self.zoom.sizeHint())
        self.map.resize(self.map.sizeHint())
        self.banner.fit(width - 2 * EDGE)
        self.banner.move((width - self.banner.width()) // 2, 44)
        self._explain()
        self._place_zoom(anew=True)
        self._place_legend()
        self.empty.fit(width - 2 * EDGE)
        self.empty.move((width - self.empty.width()) // 2, (height - self.empty.height()) // 2)

    def _crumb(self, branch: str) -> None:
        roots = self._canvas.sheet.picture.blueprint.roots if self._canvas.sheet else ()
        self._canvas.enter_wanted.emit(branch or next(iter(roots), ""))
