"""The looks of the page Review: its reading sizes, which a person can make larger."""

from __future__ import annotations

from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import Tokens

SIZES = (1.0, 1.25, 1.5, 1.75, 2.0)
"""The text sizes that can be chosen."""
SIDE = 1.5
"""The largest text size of the columns beside the reading. They have little room."""


def review_sheet(tokens: Tokens, size: float) -> str:
    """The style sheet of the page. ``size`` is the factor of the reading; 1 is the usual one."""
    ink = tokens.css()
    side = min(size, SIDE)

    def text(role: str, pixels: int, factor: float, colour: str, weight: int = 400) -> str:
        return (
            f'QLabel[role="{role}"] {{ font-size: {round(pixels * factor)}px; '
            f"color: {ink[colour]}; font-weight: {weight}; }}"
        )

    return "\n".join((
        text("readTitle", 24, min(size, SIDE), "tx", 600),
        text("readLead", 15, size, "tx2"),
        text("readHeading", 18, size, "tx", 600),
        text("readText", 16, size, "tx"),
        text("readInner", 15, size, "tx", 600),
        text("readMeta", 14, size, "tx2"),
        text("readNote", 14, size, "risk"),
        text("readSmall", 13, size, "tx2"),
        text("sideTitle", 16, side, "tx", 600),
        text("sideStrong", 14, side, "tx", 600),
        text("sideText", 14, side, "tx2"),
        f'QFrame[role="readLine"] {{ background: {ink["surf"]}; border: 0;'
        f' border-bottom: 1px solid {ink["line"]}; border-left: 4px solid {ink["surf"]}; }}',
        f'QFrame[role="readLine"][here="true"] {{ background: {ink["accs"]};'
        f' border-left: 4px solid {ink["acc"]}; }}',
        f'QFrame[role="comment"] {{ background: {ink["risks"]}; border: 1px solid {ink["risk"]};'
        " border-radius: 6px; }",
        f'QFrame[role="comment"][kind="closed"] {{ background: {ink["sunk"]};'
        f' border-color: {ink["line2"]}; }}',
        f'QFrame[role="comment"][kind="closed"] QLabel {{ color: {ink["tx2"]}; }}',
        f'QWidget[role="side"] {{ background: {ink["surf"]}; }}',
        f'QWidget[role="signPart"] {{ background: {ink["win"]};'
        f' border-top: 1px solid {ink["line"]}; }}',
        f'QFrame[role="signer"] {{ background: {ink["surf"]}; border: 1px dashed {ink["acc"]};'
        " border-radius: 6px; }",
        f'QFrame[role="signer"][kind="signed"] {{ background: {ink["oks"]};'
        f' border: 1px solid {ink["ok"]}; }}',
        f'QPushButton {{ font-size: {round(14 * side)}px; min-height: {round(30 * side)}px; }}',
        f'QPushButton[kind="approved"] {{ background: {ink["oks"]}; border-color: {ink["ok"]};'
        f' color: {ink["ok"]}; font-weight: 600; }}',
        f'QPushButton[kind="asked"] {{ background: {ink["risks"]}; border-color: {ink["risk"]};'
        f' color: {ink["risk"]}; font-weight: 600; }}',
        f'QPushButton[kind="section"] {{ border: 1px solid transparent; border-radius: 0;'
        f' background: transparent; text-align: left; padding: 0 12px; color: {ink["tx"]};'
        f' min-height: {round(36 * side)}px; font-weight: 400; }}',
        f'QPushButton[kind="section"]:checked {{ background: {ink["accs"]}; color: {ink["acc"]};'
        " font-weight: 600; }",
        f'QPushButton[kind="section"]:focus {{ border: 1px solid {ink["acc"]}; }}',
        f'QLabel[role="flagOpen"] {{ background: {ink["risks"]}; color: {ink["risk"]};'
        f' border: 1px solid {ink["risk"]}; border-radius: 4px; padding: 1px 6px;'
        f' font-size: {round(12 * side)}px; font-weight: 600; }}',
        f'QLabel[role="flagChanged"] {{ background: {ink["accs"]}; color: {ink["acc"]};'
        f' border: 1px solid {ink["accl"]}; border-radius: 4px; padding: 1px 6px;'
        f' font-size: {round(12 * side)}px; font-weight: 500; }}',
        f'QPlainTextEdit[role="field"] {{ font-size: {round(15 * size)}px; }}',
    ))  # fmt: skip


class TextSize:
    """How large the text of the reading is. It is remembered for the next time."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        kept = settings.text_of(_SIZE)
        self.factor = next((size for size in SIZES if str(size) == kept), SIZES[0])
        """1 is the usual size."""

    def next(self) -> bool:
        """Take the next larger one; after the largest the usual one. Returns whether it changed."""
        return self._take((SIZES.index(self.factor) + 1) % len(SIZES))

    def step(self, by: int) -> bool:
        """Take a larger (1) or a smaller one (-1), or the usual one (0)."""
        place = SIZES.index(self.factor) + by if by else 0
        return self._take(max(0, min(len(SIZES) - 1, place)))

    def _take(self, place: int) -> bool:
        changed = SIZES[place] != self.factor
        self.factor = SIZES[place]
        if changed:
            self._settings.store_text(_SIZE, str(self.factor))
        return changed


_SIZE = "review/size"
