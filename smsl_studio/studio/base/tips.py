"""Literal texts for tooltips and message boxes, where Qt guesses whether a text is markup."""

from __future__ import annotations

from PySide6.QtGui import Qt

from smsl_studio.legible import markup, plain_text


def tip_text(text: str) -> str:
    """A text in a form that Qt shows literally; a very long text is cut.

    Qt takes some plain texts for markup. These become markup that shows the same.
    """
    text = plain_text(text)
    if not Qt.mightBeRichText(text):
        return text
    lines = markup(text).replace("\n", "<br>")
    return f'<p style="white-space: pre-wrap">{lines}</p>'
