"""What happens after an unexpected error: the journal is written, and the person is told."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable
from types import TracebackType

from smsl_studio.legible import whole_text

Hook = Callable[[type[BaseException], BaseException, TracebackType | None], None]


def crash_hook(keep: Callable[[], bool], say: Callable[[str, str], None]) -> Hook:
    """An excepthook that prints the trace, keeps unsaved work, tells the person, and goes on.

    ``keep`` writes the journals and returns whether there is unsaved work. ``say`` shows a
    sentence, and the trace as text to those who want to read it.
    """

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        """Print the error, keep unsaved work, and tell the person."""
        told = whole_text("".join(traceback.format_exception(kind, error, trace)))
        print(told, file=sys.stderr)
        if issubclass(kind, KeyboardInterrupt):
            raise SystemExit(130)
        kept = " Your unsaved work is kept: the next start offers it." if keep() else ""
        say(
            f"Something in this program failed: {kind.__name__}.{kept} Save under a new name.", told
        )

    return hook
