"""SVG to PNG and PDF, without Qt and without a library of the system.

Text stays text in a PDF, so that names can be searched and copied. Fonts are the machine's; where
it has none, those that the library brings.
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
"""More than these, and many programs would not open the picture."""
_LARGEST_SCALE = 2.0
"""Pictures are as wide and high as multiples of four: halved down to a quarter of their size, no
row of pixels is lost."""


def as_pdf(svgs: Sequence[str], title: str) -> bytes:
    """One page for each picture."""
    return _compiled(svgs, title, "pdf", 144.0)


def as_png(svg: str, title: str) -> bytes:
    """At twice its size in pixels, or smaller where that would be more than anyone can open."""
    size = re.match(r'.*?width="([\d.]+)" height="([\d.]+)"', svg, re.DOTALL)
    area = float(size[1]) * float(size[2]) if size else 1e6
    scale = _LARGEST_SCALE
    while area * scale**2 > MOST_PIXELS:
        scale /= 2
    # A pixel of the picture is three quarters of a point, and a point is a pixel at 72 per inch.
    return _compiled([svg], title, "png", 96.0 * scale)


def _compiled(
    svgs: Sequence[str], title: str, form: Literal["pdf", "png"], per_inch: float
) -> bytes:
    import typst

    # The name of a file may hold bytes that are no text.
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
