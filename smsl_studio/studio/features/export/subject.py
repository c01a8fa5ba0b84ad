"""Subject: what of a blueprint is drawn, and the pictures of it as SVG and as files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import PurePath

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.outputs import panels_of, picture_bytes, svg_pages, title_of
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.colours import DARK, LIGHT, Colours
from smsl_studio.picture.crowd import crowd_of
from smsl_studio.picture.figure import Figure, Rect
from smsl_studio.picture.panel import SvgPanel
from smsl_studio.picture.part import (
    PicturePart,
    chosen_part,
    collapsed_part,
    part_in,
    whole_part,
)
from smsl_studio.picture.part_svg import draw_frame, draw_part
from smsl_studio.picture.picture import Picture
from smsl_studio.stop import heed

VIEW, SELECTION, BRANCH, ALL = "view", "selection", "branch", "all"
PAPER = "paper"
COLOURS: Mapping[str, Colours] = {
    "light": LIGHT,
    "dark": DARK,
    PAPER: {**LIGHT, "canvas": "#FFFFFF"},
}
"""The colours by theme. On paper the ground stays white."""


@dataclass(frozen=True)
class Subject:
    """What is drawn of a blueprint: ``view``, ``selection``, ``branch`` or ``all``.

    ``branch`` is the SB that is shown, ``view`` the visible part of its drawing (left, top, right,
    bottom, in scene units). The blueprint is that of the moment at which the picture was asked for.
    ``shortened`` is true if the canvas is zoomed out, so that it shows less of names and facts than
    the picture. ``collapsed`` draws operations between the same two states as one line. ``foot`` is
    the line below each page, which says whether people have signed.
    """

    what: str
    blueprint: Blueprint
    branch: str
    selection: tuple[Address, ...]
    view: Rect
    shortened: bool = False
    collapsed: bool = False
    foot: str = ""

    def pages(self, theme: str) -> list[str]:
        """The pictures as SVG, one for each page of a PDF or of paper."""
        if self.what in (BRANCH, ALL):
            return svg_pages(self._panels(theme), self.title, COLOURS[theme], True, self.foot)
        return [self._detail(COLOURS[theme])]

    def svg(self, theme: str) -> str:
        """The one picture of an SVG or PNG file."""
        if self.what in (BRANCH, ALL):
            return svg_pages(self._panels(theme), self.title, COLOURS[theme], False, self.foot)[0]
        return self._detail(COLOURS[theme])

    def file(self, output: PurePath, theme: str, scale: float) -> bytes:
        """The bytes of a file with the suffix of ``output``."""
        is_pdf = output.suffix.lower() == ".pdf"
        svgs = self.pages(theme) if is_pdf else [self.svg(theme)]
        heed()
        raw = picture_bytes(svgs, self.title, output, scale)
        heed()
        return raw

    def parts(self) -> list[PicturePart]:
        """The states and operations, for a diagram."""
        if self.what == ALL:
            return [whole_part(self._picture(name)) for name in self.blueprint.branches]
        picture = self._picture(self.branch)
        if self.what == SELECTION:
            return [chosen_part(picture, self.selection)]
        return [whole_part(picture)]

    @property
    def title(self) -> str:
        """The title of the picture, which is read aloud."""
        return title_of(self.blueprint)

    @property
    def _branches(self) -> list[str]:
        return [self.branch] if self.what == BRANCH else list(self.blueprint.branches)

    def _panels(self, theme: str) -> list[SvgPanel]:
        return panels_of(self.blueprint, self._branches, COLOURS[theme], self.collapsed)

    def _picture(self, name: str) -> Picture:
        return Picture(self.blueprint, name, crowd_of(self.blueprint, [name]))

    def _detail(self, colours: Colours) -> str:
        picture = self._picture(self.branch)
        chosen = chosen_part(picture, self.selection if self.what == SELECTION else ())
        if self.collapsed:
            picture = collapsed_part(picture, chosen)
        figure = Figure(picture, place_states(picture.branch))
        heed()
        if self.what == SELECTION:
            return draw_part(figure, chosen, self.title, colours, self.foot)
        left, top, right, bottom = (side * figure.scale for side in self.view)
        frame = left, top, right, bottom
        return draw_frame(figure, part_in(figure, frame), frame, self.title, colours, self.foot)
