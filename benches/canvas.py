"""The canvas against one item for every node and edge: repaint, drag, highlight at three sizes."""

from __future__ import annotations

import os
from collections.abc import Iterator

from benches.row import Row, median_ms

SIZES = (3, 6, 8)
VIEW = (1280, 800)


def rows() -> Iterator[Row]:
    """Measure milliseconds at 27, 729 and 6,561 states, in a view of 1280 by 800 pixels."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtWidgets import QApplication

    application = QApplication.instance() or QApplication([])
    for disks in SIZES:
        yield from _rows(disks)
    application.processEvents()


def _rows(disks: int) -> Iterator[Row]:
    from benches.canvas_sides import Ours, Peer
    from smsl_studio.generate.rules import hanoi

    blueprint = hanoi(disks)
    ours, peer = Ours(blueprint, VIEW), Peer(blueprint, VIEW)
    states = f"{3**disks:,} states"
    for work in ("show", "fit", "near", "drag", "highlight"):
        words = {
            "show": f"show {states}",
            "fit": f"{states}: repaint all, fitted",
            "near": f"{states}: repaint all at 100 %",
            "drag": f"{states}: drag one state a step",
            "highlight": f"{states}: light another state",
        }[work]
        mine, theirs = getattr(ours, work), getattr(peer, work)
        getattr(ours, f"before_{work}", lambda: None)()
        getattr(peer, f"before_{work}", lambda: None)()
        runs = 3 if work == "show" else 7
        figure = median_ms(mine, runs)
        yield Row(words, figure, "ms", (("an item each", median_ms(theirs, runs)),))
    ours.close()
    peer.close()
