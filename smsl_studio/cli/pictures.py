"""Pictures as files: ``-o OUT.svg|.png|.pdf``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.errors import UsageError

if TYPE_CHECKING:
    from smsl_studio.picture.colours import Colours
    from smsl_studio.picture.panel import SvgPanel

FORMS = (".svg", ".png", ".pdf")


def add_picture(parser: ArgumentParser, required: bool) -> None:
    """``-o OUT.svg|.png|.pdf``."""
    parser.add_argument(
        "-o",
        "--output",
        required=required,
        metavar="OUT",
        help="the picture to write: .svg, .png or .pdf",
    )


def picture_form(output: str) -> str:
    """The suffix of a picture's file; UsageError for one that no picture has."""
    suffix = PurePath(output).suffix.lower()
    if suffix not in FORMS:
        raise UsageError(
            f"{output!r} is no name of a picture", advice="Let it end in .svg, .png or .pdf."
        )
    return suffix


def draw_picture(panels: Sequence[SvgPanel], title: str, output: str, colours: Colours) -> bytes:
    """The bytes of a picture for this file: panels one below another, or in a PDF one a page."""
    from smsl_studio.picture.paper import as_pdf, as_png
    from smsl_studio.picture.svg import as_svg, one_below_another

    form = picture_form(output)
    if form == ".pdf":
        return as_pdf([as_svg(panel, title, colours) for panel in panels], title)
    svg = as_svg(one_below_another(panels, colours), title, colours)
    return as_png(svg, title) if form == ".png" else svg.encode("utf-8")
