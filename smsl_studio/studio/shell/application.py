"""The start of the window program: one application, with a window for each file."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QApplication

from smsl_studio.shipped import resources_dir
from smsl_studio.smsl.garbage import uncollected
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import prepare, put_sheet, tokens_of
from smsl_studio.studio.document.journal.place import folder_of
from smsl_studio.studio.shell import accessible_factory
from smsl_studio.studio.shell.crash import crash_hook
from smsl_studio.studio.shell.window import Window
from smsl_studio.studio.shell.windows import Windows

if TYPE_CHECKING:
    from smsl_studio.studio.document.journal.leftovers import Left
    from smsl_studio.studio.document.journal.offer import RecoveryOffer


def open_window(paths: Sequence[str], mode: str = "draw") -> int:
    """Show a window for each file, or an empty one, until all are closed.

    Returns the exit status.
    """
    settings = Settings()
    if settings.size != 100:
        # Qt reads it once, when the application is made.
        os.environ.setdefault("QT_SCALE_FACTOR", f"{settings.size / 100:g}")
    application = make_application(sys.argv)
    from smsl_studio.host.spare import Spare

    prepare(application, tokens_of(settings.theme, application))
    spare = Spare()
    windows = Windows(application, settings, spare=spare)
    first, *_ = [make_window(windows, path, mode) for path in paths or [""]]
    QTimer.singleShot(0, first, lambda: offer_recovery(windows, first))
    sys.excepthook = crash_hook(windows.keep, windows.fail)
    stop = _let_interrupts_through(application)
    known = (getattr(signal, name, None) for name in ("SIGTERM", "SIGHUP"))
    # Under nohup SIGHUP is ignored, and it must stay ignored.
    ends = [end for end in known if end and signal.getsignal(end) is not signal.SIG_IGN]
    # A signal can arrive at any place, even while a window is painted, so the windows are closed
    # later.
    hear = partial(QTimer.singleShot, 0, application, windows.leave)
    before = [signal.signal(end, lambda *_: hear()) for end in ends]
    try:
        return application.exec()
    finally:
        stop.stop()
        windows.plugins.stop()
        spare.close()
        sys.excepthook = sys.__excepthook__
        for end, handler in zip(ends, before, strict=True):
            signal.signal(end, handler or signal.SIG_DFL)


def make_application(argv: Sequence[str]) -> QApplication:
    """The one application of this process, with its name and icon."""
    present = QApplication.instance()
    application = present if isinstance(present, QApplication) else QApplication(list(argv[:1]))
    application.setApplicationName("smsl-studio")
    application.setApplicationDisplayName("SMSL Studio")
    application.setDesktopFileName("smsl-studio")
    accessible_factory.install(application)
    application.setWindowIcon(QIcon(str(resources_dir() / "smsl-studio.svg")))
    return application


def make_window(windows: Windows, path: str = "", mode: str = "draw") -> Window:
    """Show a window with a file. If the file cannot be read, the window says why."""
    with uncollected():
        window = Window(windows)
        put_sheet(windows.application, windows.tokens)
        if not path:
            window.set_mode("draw")
        window.show()
        if path:
            window.open_path(Path(path))
    windows.plugins.look_soon()
    # A window whose file was not opened shows the start page, one with a recording Replay.
    window.set_mode(mode if mode != "draw" else window.mode)
    return window


def offer_recovery(windows: Windows, window: Window) -> RecoveryOffer | None:
    """Offer the journals of windows that crashed; None if there are none."""
    from smsl_studio.studio.document.journal.leftovers import left_behind

    found = left_behind(folder_of(windows.settings.folder))
    if not found:
        return None
    from smsl_studio.studio.document.journal.offer import RecoveryOffer
    from smsl_studio.studio.document.journal.restoration import is_saved

    left = [one for one in found if not is_saved(one.entry)]
    for one in found:
        if one not in left:
            one.drop()
    if not left:
        return None

    def recover(one: Left) -> bool:
        """Recover into the first window if nothing was done in it, else into a new window."""
        return (window if window.safety.untouched else make_window(windows)).safety.recover(one)

    def show_difference(one: Left) -> bool:
        """Show the difference between the kept work and the files."""
        return window.features.draw.show_difference(one.entry, window.tokens, offer)

    offer = RecoveryOffer(left, recover, show_difference, window)
    offer.open()
    return offer


def main(argv: Sequence[str]) -> int:
    """The command ``open``: files and ``--mode``."""
    parser = argparse.ArgumentParser(prog="smsl-studio open", description="Open the window.")
    parser.add_argument("files", nargs="*", metavar="FILE", help="blueprints to open")
    modes = ("draw", "run", "supervise", "review")
    parser.add_argument("--mode", choices=modes, default="draw", help="the mode to show")
    given = parser.parse_intermixed_args(list(argv))
    return open_window(given.files, given.mode)


def _let_interrupts_through(application: QApplication) -> QTimer:
    """Let Ctrl+C in the terminal end the program.

    Python handles a signal only while Python code runs, so a timer runs some regularly.
    """
    signal.signal(signal.SIGINT, lambda *_: application.quit())
    timer = QTimer()
    timer.timeout.connect(lambda: None)
    timer.start(300)
    return timer
