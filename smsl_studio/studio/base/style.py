"""The theme of the application: palette, fonts and style sheet."""

from __future__ import annotations

import re

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from smsl_studio.shipped import resources_dir
from smsl_studio.studio.base.theme import CONTRAST, DARK, LIGHT, Tokens, text_font

_PLACE = re.compile(r"\{([a-z][a-z0-9]*)\}")


def tokens_of(theme: str, app: QApplication) -> Tokens:
    """The tokens of the theme ``light``, ``dark``, ``contrast`` or ``system`` (the desktop's
    choice)."""
    if theme == "system":
        dark = app.styleHints().colorScheme() is Qt.ColorScheme.Dark
        return DARK if dark else LIGHT
    return {"dark": DARK, "contrast": CONTRAST}.get(theme, LIGHT)


def style_sheet(tokens: Tokens) -> str:
    """``resources/studio.qss`` with every ``{token}`` replaced by its colour."""
    text = (resources_dir() / "studio.qss").read_text(encoding="utf-8")
    colours = tokens.css()
    return _PLACE.sub(lambda match: colours[match[1]], text)


def dress(app: QApplication, tokens: Tokens) -> None:
    """Set style, palette, font and style sheet of the application."""
    prepare(app, tokens)
    put_sheet(app, tokens)


def prepare(app: QApplication, tokens: Tokens) -> None:
    """Set style, palette and font, without which no widget can be measured.

    The palette gives our colours to the parts that the style sheet leaves to Fusion.
    """
    app.setStyle("Fusion")
    app.setPalette(tokens.palette())
    app.setFont(text_font())


def put_sheet(app: QApplication, tokens: Tokens) -> None:
    """Set the style sheet.

    It comes after the first window is built and before it is shown: whenever a widget gets a
    parent, Qt applies a sheet to all that is in the widget, which costs more than the building.
    """
    sheet = style_sheet(tokens)
    if app.styleSheet() != sheet:
        app.setStyleSheet(sheet)
