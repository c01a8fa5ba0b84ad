"""When something of ours crashes: the work is written beside, and the person is told where."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from types import TracebackType

from smsl_studio.errors import StudioError
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.session import Session

Hook = Callable[[type[BaseException], BaseException, TracebackType | None], None]


def keep_work(session: Session, name: str, folder: Path) -> Path | None:
    """Write the blueprint that is shown into ``folder``; where it went, None where it could not."""
    stamp = datetime.now().strftime("%Y%m%d-%H%M%S")
    path = folder / "recovered" / f"{Path(name).stem}-{stamp}.json"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        save_document(session.blueprint.document, path)
    except (OSError, StudioError):
        return None
    return path


def crash_hook(keep: Callable[[], list[Path]], say: Callable[[str], None]) -> Hook:
    """An excepthook: print the trace, keep the unsaved work, say so, and go on."""

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        traceback.print_exception(kind, error, trace, file=sys.stderr)
        if issubclass(kind, KeyboardInterrupt):
            raise SystemExit(130)
        kept = keep()
        where = f" Your unsaved work was kept in {kept[0]}." if kept else ""
        say(f"Something in this program failed: {kind.__name__}.{where} Save under a new name.")

    return hook
