"""The design tokens of the window: colours, fonts and distances, in three themes.

Painters and the style sheet use these and nothing else. Light and dark have the same contrast, and
the third theme has more. Lengths are device-independent pixels.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cache

from PySide6.QtGui import QColor, QFont, QFontDatabase, QPalette

from smsl_studio.picture import colours

SPACE = (4, 8, 12, 16, 24)
RADIUS_CHIP, RADIUS_CONTROL, RADIUS_NODE, RADIUS_CARD = 4, 6, 8, 10
CONTROL, CONTROL_ROW, CONTROL_DECISION = 32, 26, 40
MENU_BAR, MODE_BAR, MODE_BAR_RUN, STATUS_LINE = 32, 48, 56, 26


@dataclass(frozen=True)
class Tokens:
    """The colours of one theme; docs/window.md explains what each is for."""

    name: str
    win: QColor
    surf: QColor
    sunk: QColor
    canvas: QColor
    dot: QColor
    line: QColor
    line2: QColor
    nl: QColor
    tx: QColor
    tx2: QColor
    tx3: QColor
    acc: QColor
    accs: QColor
    accl: QColor
    onacc: QColor
    ok: QColor
    oks: QColor
    bad: QColor
    bads: QColor
    unk: QColor
    unks: QColor
    risk: QColor
    risks: QColor
    edge: QColor
    dim: QColor
    slate: QColor
    onslate: QColor
    stop: QColor

    @property
    def dark(self) -> bool:
        """Whether the grounds of this theme are dark."""
        return self.win.lightness() < 128

    def css(self) -> dict[str, str]:
        """Every colour by name as ``#rrggbb``, for the style sheet."""
        return {f.name: getattr(self, f.name).name() for f in fields(self) if f.name != "name"}

    def palette(self) -> QPalette:
        """The Qt palette of this theme.

        ``setColorScheme`` does not work on every platform, but Fusion follows a palette.
        """
        palette = QPalette()
        role = QPalette.ColorRole
        for target, colour in (
            (role.Window, self.win),
            (role.WindowText, self.tx),
            (role.Base, self.surf),
            (role.AlternateBase, self.sunk),
            (role.Text, self.tx),
            (role.PlaceholderText, self.tx3),
            (role.Button, self.surf),
            (role.ButtonText, self.tx),
            (role.BrightText, self.onacc),
            (role.Highlight, self.acc),
            (role.HighlightedText, self.onacc),
            (role.ToolTipBase, self.surf),
            (role.ToolTipText, self.tx),
            (role.Link, self.acc),
            (role.Light, self.surf),
            (role.Midlight, self.line),
            (role.Mid, self.line2),
            (role.Dark, self.nl),
            (role.Shadow, self.line2),
            (role.Accent, self.acc),
        ):
            palette.setColor(target, colour)
        for target in (role.WindowText, role.Text, role.ButtonText):
            palette.setColor(QPalette.ColorGroup.Disabled, target, self.tx3)
        return palette


def _tokens(name: str, inks: colours.Colours) -> Tokens:
    return Tokens(name, *(QColor(inks[f.name]) for f in fields(Tokens)[1:]))


LIGHT = _tokens("light", colours.LIGHT)
DARK = _tokens("dark", colours.DARK)
CONTRAST = _tokens("contrast", colours.CONTRAST)


@cache
def _family(*wanted: str) -> str:
    installed = set(QFontDatabase.families())
    return next((name for name in wanted if name in installed), "")


def text_font(size: int = 13, weight: int = 400) -> QFont:
    """The reading font: Inter if it is installed, else Noto Sans, else that of the system.

    ``size`` in pixels.
    """
    return QFont(_font(_family("Inter", "Noto Sans"), size, weight, QFont.StyleHint.SansSerif))


def mono_font(size: int = 12, weight: int = 400) -> QFont:
    """The font of fact names, values and source: JetBrains Mono, else another fixed one.

    ``size`` in pixels.
    """
    family = _family("JetBrains Mono", "Noto Sans Mono", "DejaVu Sans Mono")
    return QFont(_font(family, size, weight, QFont.StyleHint.Monospace))


@cache
def _font(family: str, size: int, weight: int, hint: QFont.StyleHint) -> QFont:
    """The pattern that each caller gets a copy of: painting asks for fonts very often."""
    font = QFont(family) if family else QFont()
    font.setStyleHint(hint)
    font.setPixelSize(size)
    font.setWeight(QFont.Weight(weight))
    # Names are shown as they are written, without ligatures such as an arrow for "->".
    font.setFeature(QFont.Tag("calt"), 0)
    if hint is QFont.StyleHint.SansSerif:
        font.setFeature(QFont.Tag("tnum"), 1)
    return font
