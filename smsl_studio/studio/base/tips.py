"""Texts for those parts of Qt that guess whether a text is markup: tool tips and message boxes."""

from __future__ import annotations

from PySide6.QtGui import Qt

from smsl_studio.legible import markup, plain_text


def tip_text(text: str) -> str:
    """A text that is shown as it is, whatever it holds; cut where it is too long to be read.

    Qt takes some plain texts for markup: those it would are given as markup that says the same.
    """
    text = plain_text(text)
    if not Qt.mightBeRichText(text):
        return text
    lines = markup(text).replace("\n", "<br>")
    return f'<p style="white-space: pre-wrap">{lines}</p>'
