"""When something of ours crashes: the work is written beside, and the person is told where."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable
from datetime import datetime
from itertools import chain, count
from pathlib import Path
from types import TracebackType

from smsl_studio.errors import StudioError
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.session import Session

STEM = 60
"""So many characters of a file's name are kept: no folder takes a name of any length."""
Hook = Callable[[type[BaseException], BaseException, TracebackType | None], None]


def keep_work(session: Session, name: str, folder: Path) -> Path | None:
    """Write the blueprint that is shown into ``folder``; where it went, None where it could not."""
    stamp = datetime.now().strftime("%Y%m%d-%H%M%S")
    folder = folder / "recovered"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        path = _free(folder, f"{Path(name).stem[:STEM]}-{stamp}")
        save_document(session.blueprint.document, path)
    except (OSError, StudioError):
        return None
    return path


def _free(folder: Path, name: str) -> Path:
    """A path that is not taken: two windows may hold files of one name."""
    names = chain([name], (f"{name}-{number}" for number in count(2)))
    paths = (folder / f"{each}.json" for each in names)
    return next(path for path in paths if not path.exists())


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
