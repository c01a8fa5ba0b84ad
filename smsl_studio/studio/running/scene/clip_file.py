"""The bytes of a clip. Only this file imports Pillow, and only when a clip is saved."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from io import BytesIO

from PIL import Image

from smsl_studio.stop import heed

FORMATS = {".gif": "GIF", ".webp": "WEBP"}
"""The formats of clips by the suffix of the file."""

LAST_MS = 1500
"""How long (ms) the last picture stays before a clip begins again."""


class ClipFrame:
    """One picture of a clip: rows of red, green and blue bytes."""

    def __init__(self, pixels: bytes, width: int, height: int) -> None:
        self.pixels, self.size = pixels, (width, height)

    def image(self, colours: int) -> Image.Image:
        """Return it as an image, with a palette of so many colours; 0 keeps all colours."""
        found = Image.frombytes("RGB", self.size, self.pixels)
        return found.quantize(colours, dither=Image.Dither.NONE) if colours else found


def clip_bytes(frames: Sequence[ClipFrame], suffix: str, each_ms: int) -> bytes:
    """Return a clip that is shown again and again, each picture for ``each_ms`` milliseconds.

    ``frames`` is not empty, and all have one size. Stopped if it is called off (see ``stop``).
    """
    form = FORMATS[suffix]
    colours = 128 if form == "GIF" else 0
    first, *rest = frames

    def further() -> Iterator[Image.Image]:
        for frame in rest:
            heed()
            yield frame.image(colours)

    out = BytesIO()
    times = [*[each_ms] * len(rest), LAST_MS]
    more = {"quality": 80, "method": 2} if form == "WEBP" else {"optimize": False}
    first.image(colours).save(
        out, form, save_all=True, append_images=further(), duration=times, loop=0, **more
    )
    return out.getvalue()
