"""SVG to PNG and PDF, without Qt and without a library of the system.

Text stays text in a PDF, so names can be searched and copied. The fonts are those of the machine,
or else those of the library.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from typing import Literal

from smsl_studio.errors import ConvertError

_SOURCE = b"""#set document(title: sys.inputs.title, date: none)
#set page(width: auto, height: auto, margin: 0pt, fill: none)
#for picture in json(bytes(sys.inputs.pictures)) {
  page(image(bytes(picture), format: "svg", alt: sys.inputs.title))
}
"""
MOST_PIXELS = 40e6
"""Many programs cannot open a picture with more pixels than this."""
SCALE = 2.0
"""Pictures are as wide and high as multiples of four, so the scale can be halved down to a quarter
without losing a row of pixels.
"""


def as_pdf(svgs: Sequence[str], title: str) -> bytes:
    """Return a PDF with one page for each picture. ConvertError if it cannot be written."""
    return _compiled(svgs, title, "pdf", 144.0)


def as_png(svg: str, title: str, scale: float = SCALE) -> bytes:
    """Return a PNG at ``scale`` times the picture's size (see ``png_scale``). ConvertError if it
    cannot be written.
    """
    # A pixel of the SVG is three quarters of a point, and there are 72 points in an inch.
    return _compiled([svg], title, "png", 96.0 * png_scale(svg, scale))


def png_scale(svg: str, wanted: float = SCALE) -> float:
    """Return the wanted scale of a picture, halved until it has no more than ``MOST_PIXELS``."""
    wide, high = size_of(svg)
    while wide * high * wanted**2 > MOST_PIXELS:
        wanted /= 2
    return wanted


def size_of(svg: str) -> tuple[float, float]:
    """Return the width and height of a picture (pixels)."""
    size = re.match(r'.*?width="([\d.]+)" height="([\d.]+)"', svg, re.DOTALL)
    return (float(size[1]), float(size[2])) if size else (1e3, 1e3)


def _compiled(
    svgs: Sequence[str], title: str, form: Literal["pdf", "png"], per_inch: float
) -> bytes:
    import typst

    # The name of a file may hold bytes that are not valid text.
    shown = title.encode("utf-8", "replace").decode("utf-8")
    inputs = {"pictures": json.dumps(list(svgs)), "title": shown}
    try:
        made = typst.compile(_SOURCE, format=form, ppi=per_inch, sys_inputs=inputs)
    except typst.TypstError as error:
        raise ConvertError(
            f"the picture cannot be written as {form.upper()}: {error}",
            advice="Write it as SVG instead.",
        ) from None
    return bytes(made)
