"""The look of a help page: fonts and colours of the theme on what Qt has read from Markdown."""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt

from PySide6.QtGui import (
    QFont,
    QTextBlock,
    QTextBlockFormat,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
    QTextFragment,
    QTextFrameFormat,
    QTextImageFormat,
    QTextLength,
    QTextTable,
)

from smsl_studio.studio.base.theme import Tokens, mono_font, text_font
from smsl_studio.studio.features.help.pages import anchor_of

HEADINGS = {1: (24, 0, 12), 2: (18, 26, 8), 3: (15, 18, 6), 4: (13, 14, 4)}
"""By the level of a heading: its size, and the space above and below it (pixels)."""
BODY, LINE = 14, 140
"""The size of the text (pixels), and the height of its lines (percent)."""
CELL = 7
"""The space around the text of a cell (pixels)."""
WORD = 5
"""So many letters of room around the longest word of a column."""
_Property = QTextFormat.Property
_PROPORTIONAL = QTextBlockFormat.LineHeightTypes.ProportionalHeight.value


def dress(document: QTextDocument, tokens: Tokens) -> dict[str, int]:
    """Dress a page in fonts and colours. Returns the position of each section by its anchor."""
    document.setUndoRedoEnabled(False)
    document.setDefaultFont(text_font(BODY))
    cursor = QTextCursor(document)
    cursor.beginEditBlock()
    places: dict[str, int] = {}
    for block in blocks(document):
        level = block.blockFormat().headingLevel()
        if level:
            places.setdefault(anchor_of(block.text()), block.position())
        cursor.setPosition(block.position())
        cursor.setBlockFormat(_block_format(block, tokens))
        for fragment in fragments(block):
            cursor.setPosition(fragment.position())
            end = fragment.position() + fragment.length()
            cursor.setPosition(end, QTextCursor.MoveMode.KeepAnchor)
            cursor.mergeCharFormat(_char_format(fragment.charFormat(), level, block, tokens))
    cursor.endEditBlock()
    for frame in document.rootFrame().childFrames():
        if isinstance(frame, QTextTable):
            _dress_table(frame, tokens)
    return places


def fit_pictures(document: QTextDocument, wide: int) -> None:
    """Make pictures smaller that are wider than ``wide`` pixels."""
    for block in blocks(document):
        for fragment in fragments(block):
            if not fragment.charFormat().isImageFormat():
                continue
            shown = QTextImageFormat(fragment.charFormat().toImageFormat())
            picture = document.resource(
                QTextDocument.ResourceType.ImageResource.value, shown.name()
            )
            if picture is None or picture.isNull():
                continue
            width = min(wide, picture.width())
            if shown.width() != width:
                shown.setWidth(width)
                shown.setHeight(round(picture.height() * width / picture.width()))
                cursor = QTextCursor(document)
                cursor.setPosition(fragment.position())
                cursor.setPosition(fragment.position() + 1, QTextCursor.MoveMode.KeepAnchor)
                cursor.setCharFormat(shown)


def blocks(document: QTextDocument) -> Iterator[QTextBlock]:
    """All paragraphs, headings, lines of code and cells of a page."""
    block = document.begin()
    while block.isValid():
        yield block
        block = block.next()


def fragments(block: QTextBlock) -> list[QTextFragment]:
    """The pieces of a block, each in one format. They are listed first, so that they may change."""
    found = []
    at = block.begin()
    while not at.atEnd():
        found.append(at.fragment())
        at += 1
    return found


def _block_format(block: QTextBlock, tokens: Tokens) -> QTextBlockFormat:
    made = QTextBlockFormat(block.blockFormat())
    level = made.headingLevel()
    if level:
        _, above, below = HEADINGS[level]
        made.setTopMargin(above)
        made.setBottomMargin(below)
    elif made.hasProperty(_Property.BlockCodeFence):
        made.setBackground(tokens.sunk)
        made.setLeftMargin(0)
        made.setTopMargin(0 if _is_code(block.previous()) else 8)
        made.setBottomMargin(0 if _is_code(block.next()) else 12)
    elif QTextCursor(block).currentTable() is None:
        made.setLineHeight(LINE, _PROPORTIONAL)
        made.setTopMargin(3 if block.textList() is not None else 6)
        made.setBottomMargin(3 if block.textList() is not None else 8)
    return made


def _is_code(block: QTextBlock) -> bool:
    return block.isValid() and block.blockFormat().hasProperty(_Property.BlockCodeFence)


def _char_format(
    was: QTextCharFormat, level: int, block: QTextBlock, tokens: Tokens
) -> QTextCharFormat:
    made = QTextCharFormat()
    fence = _is_code(block)
    if fence or was.fontFixedPitch():
        size = HEADINGS[level][0] - 1 if level else BODY - 1
        _set_font(made, mono_font(size, 600 if level else 400))
        made.setBackground(tokens.sunk)
    elif level:
        _set_font(made, text_font(HEADINGS[level][0], 600))
    elif was.fontWeight() > QFont.Weight.Normal:
        made.setFontWeight(QFont.Weight.DemiBold)
    made.setForeground(tokens.acc if was.isAnchor() else tokens.tx)
    made.setFontUnderline(was.isAnchor())
    return made


def _set_font(made: QTextCharFormat, font: QFont) -> None:
    """Set what a font says; Qt's reader of Markdown gave a size that is relative."""
    made.setFontFamilies(font.families())
    made.setProperty(_Property.FontSizeAdjustment, 0)
    made.setProperty(_Property.FontPixelSize, font.pixelSize())
    made.setFontWeight(font.weight())


def _dress_table(table: QTextTable, tokens: Tokens) -> None:
    made = table.format()
    made.setBorder(1)
    made.setBorderBrush(tokens.line2)
    made.setBorderStyle(QTextFrameFormat.BorderStyle.BorderStyle_Solid)
    made.setBorderCollapse(True)
    made.setCellPadding(CELL)
    made.setCellSpacing(0)
    made.setTopMargin(6)
    made.setBottomMargin(12)
    made.setWidth(_percent(100))
    made.setColumnWidthConstraints([_percent(share) for share in _shares(table)])
    table.setFormat(made)
    for column in range(table.columns()):
        cell = table.cellAt(0, column)
        head = cell.format()
        head.setBackground(tokens.sunk)
        cell.setFormat(head)


def _shares(table: QTextTable) -> list[float]:
    """The share of each column in the width, in percent. A column with more text is wider.

    It grows with the square root, as the side of a box of text does, and has room for the longest
    word: a page is about 100 letters wide.
    """
    lines = range(table.rows())
    texts = [
        [table.cellAt(line, at).firstCursorPosition().block().text() for line in lines]
        for at in range(table.columns())
    ]
    words = [max(len(word) for word in " ".join(column).split() or ("",)) for column in texts]
    sides = [sqrt(1 + sum(map(len, column))) for column in texts]
    shares = [
        max(100 * side / sum(sides), word + WORD) for side, word in zip(sides, words, strict=True)
    ]
    return [100 * share / sum(shares) for share in shares]


def _percent(share: float) -> QTextLength:
    return QTextLength(QTextLength.Type.PercentageLength, share)
