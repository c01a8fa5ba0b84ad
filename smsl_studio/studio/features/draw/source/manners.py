"""The editing keys of the text: Enter, Tab, brackets, comments, and lines to duplicate or move.

Enter keeps the indentation. An opening bracket or quote adds the closing one. Every change is made
in the exact text, and the widget shows it.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from smsl_studio.studio.features.draw.source.editor import Editor

PAIRS = {"{": "}", "[": "]", '"': '"'}
COMMENTS = {"smsl": "//", "yaml": "#"}
"""The sign of a comment line, for the written forms that have comments."""
_LEAD = re.compile(r"[ \t]*")
_UNIT = re.compile(r"^( {1,8}|\t)\S", re.MULTILINE)
_CTRL, _ALT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier
_SHIFT = Qt.KeyboardModifier.ShiftModifier
_NONE = Qt.KeyboardModifier.NoModifier


class Manners:
    """Handles the editing keys of one editor."""

    def __init__(self, editor: Editor) -> None:
        self._editor = editor
        key = Qt.Key
        self._keys: dict[tuple[int, Qt.KeyboardModifier], Callable[[], bool]] = {
            (key.Key_Return, _NONE): self._enter,
            (key.Key_Enter, _NONE): self._enter,
            (key.Key_Tab, _NONE): lambda: self._indent(1),
            (key.Key_Backtab, _SHIFT): lambda: self._indent(-1),
            (key.Key_Backspace, _NONE): self._rub_out_pair,
            (key.Key_Slash, _CTRL): self._comment,
            (key.Key_D, _CTRL): self._double,
            (key.Key_Up, _ALT): lambda: self._move(-1),
            (key.Key_Down, _ALT): lambda: self._move(1),
        }

    def answer(self, event: QKeyEvent) -> bool:
        """Do what a key asks for. Returns False for an ordinary key."""
        held = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        if self._editor.isReadOnly():
            return False
        call = self._keys.get((event.key(), held))
        if call is not None:
            return call()
        plain = held in (_NONE, _SHIFT) or held == (_CTRL | _ALT)
        return plain and self._pair(event.text())

    def takes(self, event: QKeyEvent) -> bool:
        """Whether a key is for the text, even if it is a shortcut of the window."""
        return (event.key(), event.modifiers()) in self._keys

    # Lines.

    def _lines(self) -> tuple[int, int]:
        """The first and last selected line, or twice the line of the caret."""
        start, end = self._editor.marked
        first, last = self._editor.sheet.where(start)[0], self._editor.sheet.where(end)
        return first, last[0] - (last[1] == 0 and last[0] > first)

    def _ends(self, first: int, last: int) -> tuple[int, int]:
        """The offsets at which some lines begin and end, without the last line end."""
        sheet = self._editor.sheet
        return sheet.offset(first, 0), sheet.offset(last, len(sheet.shown_piece(last)))

    def _said(self, verb: str, first: int, last: int) -> str:
        number = self._editor.sheet.line_of
        one, other = number(first) + 1, number(last) + 1
        return f"{verb} line {one}" if one == other else f"{verb} lines {one} to {other}"

    def _each_line(self, verb: str, change: Callable[[str], str]) -> bool:
        """Change every selected line; the selection stays."""
        editor = self._editor
        first, last = self._lines()
        marked = editor.textCursor().hasSelection()
        start, end = self._ends(first, last)
        old = editor.sheet.text[start:end]
        new = "\n".join(change(line) for line in old.split("\n"))
        if new == old:
            return True
        caret = editor.marked[1] + len(new) - len(old)
        editor.begin_command()
        editor.replace(start, end, new, self._said(verb, first, last))
        if marked:
            editor.set_caret(start, start + len(new))
        else:
            editor.set_caret(max(start, caret))
        return True

    def _indent(self, by: int) -> bool:
        editor = self._editor
        cursor, unit = editor.textCursor(), self._unit()
        if by > 0 and not cursor.hasSelection():
            column = editor.caret[1]
            width = 1 if unit == "\t" else len(unit) - column % len(unit)
            cursor.insertText("\t" if unit == "\t" else " " * width)
            return True
        if by > 0:
            return self._each_line("Indent", lambda line: unit + line if line.strip() else line)
        least = re.compile(rf"\t| {{1,{max(1, len(unit))}}}")
        return self._each_line("Unindent", lambda line: least.sub("", line, count=1)
                               if line[:1] in (" ", "\t") else line)  # fmt: skip

    def _unit(self) -> str:
        """One step of indentation, as the text uses it."""
        head = "".join(self._editor.sheet.pieces[:200])
        found = _UNIT.search(head)
        return found[1] if found else "    "

    def _comment(self) -> bool:
        mark = COMMENTS.get(self._editor.form)
        if mark is None:
            return True
        first, last = self._lines()
        lines = [one for one in self._editor.sheet.shown_lines(first, last) if one.strip()]
        done = bool(lines) and all(one.lstrip().startswith(mark) for one in lines)
        off = re.compile(rf"^(\s*){re.escape(mark)} ?")
        if done:
            return self._each_line("Uncomment", lambda line: off.sub(r"\1", line))
        return self._each_line("Comment", lambda line: _commented(line, mark))

    def _double(self) -> bool:
        editor = self._editor
        first, last = self._lines()
        start, end = self._ends(first, last)
        text = editor.sheet.text[start:end]
        caret = editor.marked[1] + len(text) + len(editor.sheet.newline)
        editor.begin_command()
        words = self._said("Duplicate", first, last)
        editor.replace(end, end, editor.sheet.newline + text, words, caret)
        return True

    def _move(self, by: int) -> bool:
        editor, sheet = self._editor, self._editor.sheet
        first, last = self._lines()
        other = last + 1 if by > 0 else first - 1
        if not 0 <= other < len(sheet.pieces):
            return True
        start, end = self._ends(min(first, other), max(last, other))
        moved = sheet.text[slice(*self._ends(first, last))]
        passed = sheet.text[slice(*self._ends(other, other))]
        step = len(passed) + len(sheet.newline)
        caret = editor.marked[1] + (step if by > 0 else -step)
        new = [passed, moved] if by > 0 else [moved, passed]
        editor.begin_command()
        editor.replace(start, end, sheet.newline.join(new), self._said("Move", first, last), caret)
        return True

    # Letters.

    def _enter(self) -> bool:
        editor = self._editor
        line, column = editor.caret
        shown = editor.sheet.shown_piece(line)
        match = _LEAD.match(shown[:column])
        lead = match[0] if match else ""
        before, after = shown[:column].rstrip()[-1:], shown[column:].lstrip()[:1]
        deeper = before in PAIRS and before != '"'
        cursor = editor.textCursor()
        cursor.insertText("\n" + lead + (self._unit() if deeper else ""))
        if deeper and after == PAIRS[before]:
            at = cursor.position()
            cursor.insertText("\n" + lead)
            cursor.setPosition(at)
        editor.setTextCursor(cursor)
        editor.ensureCursorVisible()
        return True

    def _pair(self, letter: str) -> bool:
        editor = self._editor
        if letter not in PAIRS and letter not in PAIRS.values():
            return False
        cursor = editor.textCursor()
        line, column = editor.caret
        shown = editor.sheet.shown_piece(line)
        before, after = shown[column - 1 : column], shown[column : column + 1]
        if cursor.hasSelection() and letter in PAIRS and "\u2029" not in cursor.selectedText():
            cursor.insertText(letter + cursor.selectedText() + PAIRS[letter])
        elif after == letter and letter in PAIRS.values():
            cursor.movePosition(cursor.MoveOperation.NextCharacter)
        elif letter not in PAIRS or cursor.hasSelection() or not _closes(letter, before, after):
            return False
        else:
            cursor.insertText(letter + PAIRS[letter])
            cursor.movePosition(cursor.MoveOperation.PreviousCharacter)
        editor.setTextCursor(cursor)
        return True

    def _rub_out_pair(self) -> bool:
        editor = self._editor
        cursor = editor.textCursor()
        line, column = editor.caret
        shown = editor.sheet.shown_piece(line)
        pair = shown[column - 1 : column], shown[column : column + 1]
        if cursor.hasSelection() or not column or PAIRS.get(pair[0]) != pair[1]:
            return False
        cursor.movePosition(cursor.MoveOperation.PreviousCharacter)
        cursor.movePosition(cursor.MoveOperation.NextCharacter, cursor.MoveMode.KeepAnchor, 2)
        cursor.removeSelectedText()
        return True


def _closes(letter: str, before: str, after: str) -> bool:
    """Whether typing this opening bracket or quote also inserts the closing one."""
    free = after == "" or after in " \t,}]:"
    return free and (letter != '"' or before == "" or before in " \t{[(,:")


def _commented(line: str, mark: str) -> str:
    """A line as a comment with its indentation kept; a blank line stays blank."""
    body = line.lstrip()
    return f"{line[: len(line) - len(body)]}{mark} {body}" if body.strip() else line
