"""LabelTexts: what the labels of a sheet say, how large they are, and which have no room."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Protocol

from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.hidden_names import HiddenMarks
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.paint.edge_paint import EdgeText, boxed_width, label_size
from smsl_studio.studio.base.paint.guard_sign import DECLARED
from smsl_studio.studio.base.paint.ink import Ink
from smsl_studio.studio.base.paint.looks import Looks

KEPT = 20_000
"""How many texts are kept for all sheets. Most are the same again after an edit."""


class Labelled(Protocol):
    """The parts of a sheet that decide what its labels say."""

    picture: Picture
    ink: Ink
    looks: Looks
    version: int

    @property
    def compact(self) -> bool:
        """Whether nodes show less than their full name and facts."""

    @property
    def geometry(self) -> Geometry:
        """The lines and the places of labels."""


class LabelTexts:
    """The labels of the edges of a sheet, by edge number."""

    def __init__(self, sheet: Labelled) -> None:
        self._sheet = sheet
        self._plain: dict[tuple[int, bool], EdgeText] = {}
        self._hidden: HiddenMarks | None = None
        self._hidden_when: tuple[Geometry, int] | None = None

    def text(self, edge: int) -> EdgeText:
        """The words and signs of a label."""
        sheet = self._sheet
        compact = sheet.compact
        found = self._plain.get((edge, compact))
        if found is None:
            found = self._plain[edge, compact] = self._plain_text(edge, compact)
        looks = sheet.looks
        sign = looks.change_sign(edge)
        # The sign of a guard has one width for all its values, so labels stay where they are.
        guard = looks.guard(edge) if found.guard else ""
        if sign or guard:
            return replace(found, sign=sign, guard=guard or found.guard)
        return found

    def sizes(self, unit: float) -> Callable[[int], tuple[float, float]]:
        """Return the function that gives the size of a label (scene units)."""
        sheet = self._sheet

        def size(edge: int) -> tuple[float, float]:
            """The width and height of the label, of its box, or of the chip of its bundle."""
            if sheet.picture.bundles.count(edge):
                w, h = sheet.picture.chip_size(edge)
            elif sheet.looks.edge(edge).finding:
                w, h = boxed_width(self.text(edge), sheet.ink), 18.0
            else:
                w, h = label_size(self.text(edge), sheet.ink)
            return w * unit, h * unit

        return size

    @property
    def hidden(self) -> HiddenMarks:
        """The marks in place of names without room, for the lines as they are now."""
        when = self._sheet.geometry, self._sheet.version
        if self._hidden is None or self._hidden_when != when:
            self._hidden, self._hidden_when = HiddenMarks(when[0]), when
        return self._hidden

    def _plain_text(self, edge: int, compact: bool) -> EdgeText:
        picture = self._sheet.picture
        label = picture.label(edge)
        guard = DECLARED if picture.guards(edge) else ""
        return _same_text(label, picture.kind(edge), compact and len(label) <= 4, guard)


@lru_cache(KEPT)
def _same_text(label: str, kind: str, mono: bool, guard: str) -> EdgeText:
    """Return the same object for the same text, so that sheets are compared quickly."""
    return EdgeText(label, kind, mono, guard=guard)
