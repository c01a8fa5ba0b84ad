"""Intent: what a drop on the canvas would do, told and sketched before it is done."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from smsl_studio.studio.base.canvas.sketch import Sketch


@dataclass(frozen=True)
class Intent:
    """``words`` says what it does. Without ``act`` nothing can be done, and they say what is
    missing.
    """

    words: str
    act: Callable[[], object] | None = None
    sketch: Sketch = field(default_factory=Sketch)
