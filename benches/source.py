"""The source pane: one key in texts of one and ten megabytes, and in one line of a megabyte.

A key is sent as Qt sends it, and the text and its gutter are painted before the clock stops. The
limit is Qt's bare text widget, without colours, line numbers or a graph behind it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

from benches.row import Row, median_ms

SIZE = (364, 700)
FRAME = "below 16 ms"


def rows() -> Iterator[Row]:
    """Measure milliseconds for each key, for an edit from the canvas, and for the list of names."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtWidgets import QApplication

    application = QApplication.instance() or QApplication([])
    for words, text in (
        ("1 MB", _text(1_000_000, "\n")),
        ("10 MB", _text(10_000_000, "\n")),
        ("1 MB in one line", _text(1_000_000, " ")),
    ):
        yield from _rows(words, text)
    application.processEvents()


def _text(size: int, between: str) -> str:
    """States of three operations each, in so many characters."""
    states, length, at = [], 0, 0
    while length < size:
        inner = f",{between}".join(
            f'            "Op_{n}": "State_{(at * 3 + n) % 9999:06}"' for n in range(3)
        )
        body = f'        "State_{at:06}": {{{between}{inner}{between}        }}'
        states.append(body if between == "\n" else " ".join(body.split()))
        length += len(states[-1]) + 2
        at += 1
    return f'{{{between}    "SB1": {{{between}' + f",{between}".join(states) + f"{between}}}}}\n"


def _rows(words: str, text: str) -> Iterator[Row]:
    from benches.source_sides import Bare, Ours

    ours, bare = Ours(text, SIZE), Bare(text, SIZE)
    yield Row(f"{words}: open and show it", median_ms(ours.open, 3))
    ours.show()
    bare.show()
    limit = median_ms(bare.key, 7)
    yield Row(f"{words}: a key", median_ms(ours.key, 15), "ms", (("bare widget", limit),), FRAME)
    if "xxx" not in ours.text or "xxx" not in bare.text:
        raise AssertionError("the keys did not arrive")
    yield Row(f"{words}: the names that fit", median_ms(ours.names, 7))
    if len(text) < 2_000_000:
        ours.forget()
        yield Row(f"{words}: rename a state on the canvas", median_ms(ours.edit, 3))
    ours.close()
    bare.close()
