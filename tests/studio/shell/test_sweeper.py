"""Garbage is collected in the thread of the windows: a widget freed elsewhere crashes Qt."""

from __future__ import annotations

import gc
import threading
import weakref

from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.shell.windows import Windows


def test_a_widget_that_holds_itself_is_freed_in_this_thread(
    qapp: QApplication, qtbot: QtBot
) -> None:
    gc.enable()
    windows = Windows(qapp, Settings())
    here, ends = threading.get_ident(), list[bool]()
    widget = QWidget()
    widget.held = [widget]  # type: ignore[attr-defined]
    weakref.finalize(widget, lambda: ends.append(threading.get_ident() == here))
    del widget
    # Enough for Python's own collector, which would run in that thread.
    maker = threading.Thread(target=lambda: [[number] for number in range(200_000)])
    maker.start()
    maker.join()
    kept = [[number] for number in range(20_000)]
    qtbot.waitUntil(lambda: bool(ends))
    assert ends == [True]
    assert kept
    assert not gc.isenabled()
    windows.deleteLater()
