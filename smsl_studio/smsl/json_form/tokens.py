"""The tokens of a JSON text that may be faulty, and the faults within each.

If a line has an odd number of quotes, one is missing or extra. There the end of a string is checked
again, because its closing quote may be the opening one of the next.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import NamedTuple

from smsl_studio.errors import TextFix
from smsl_studio.smsl.json_form.characters import HALF, HALF_PAIR, half_pair


class JsonFault(NamedTuple):
    """One fault at an offset of the text."""

    at: int
    length: int
    sentence: str
    advice: str
    fix: TextFix | None = None


class JsonToken(NamedTuple):
    """A piece of the text. ``kind`` is a mark of JSON, or one of the words below.

    ``line`` is the offset of the beginning of its line, and ``indent`` the number of blanks there.
    ``first`` says that nothing comes before it on its line.
    """

    kind: str
    start: int
    end: int
    value: str
    line: int
    indent: int
    first: bool


TEXT, NUMBER, WORD, ODD, END = "text", "number", "word", "odd", "end"

COMMENT = "JSON has no comments"

_BLANKS = re.compile(r"[ \t]*")
_GAP = re.compile(r"[ \t\r\n]+")
_ODD_SPACE = re.compile(r"[^\S \t\r\n]+|[\ufeff\u200b]+")
_COMMENT = re.compile(r"(?://|#)[^\r\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_LINE_STRING = re.compile(r'"(?:[^"\\\r\n]|\\[^\r\n])*"')
_LINE_END = re.compile(r"[\r\n]|\Z")
_OTHER_QUOTES = re.compile(r"'([^'\r\n]*)'|[“”„]([^“”„\"\r\n]*)[“”]")
_QUOTE = re.compile(r'\\.|"')
_TAIL = re.compile(r'[^"{}\[\],:\r\n]*"(?=[ \t]*(?:[,:}\]\r\n]|\Z))')
_AFTER_QUOTE = re.compile(r'"(?=[ \t]*(?:[,:}\]\r\n]|\Z))')
_VALUE_INSIDE = re.compile(r"\s*:\s*(?:-?\d|[\[{]|true\b|false\b|null\b)")
_NUMBER = re.compile(r"-?(?:0|[1-9]\d*)(?:\.\d+)?(?:[eE][+-]?\d+)?")
_CHUNK = r"(?:[^\s{}\[\]:,\"'=;#>/-]|-(?!>)|/(?![/*]))"
_WORD = re.compile(rf"{_CHUNK}+(?:[ \t]+{_CHUNK}+)*")
_ONE_WORD = re.compile(rf"{_CHUNK}+")
_ARROW = re.compile(r"[-=]>|.", re.DOTALL)
_CONTROL = re.compile(r"[\x00-\x1f]")
_BAD_ESCAPE = re.compile(r'\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4})|(\\)')
_MARKS = " \t\r,:{}[]"


class JsonTokens:
    """Reads the tokens of one text, in order. Faults within them go to ``complain``."""

    def __init__(self, text: str, complain: Callable[[JsonFault], None]) -> None:
        self._text = text
        self._complain = complain
        self._at = 1 if text.startswith("\ufeff") else 0
        self._line, self._indent, self._first = self._at, 0, True
        self._counted, self._odd = 0, False

    def take(self) -> JsonToken:
        """Return the next token. At the end it is always ``END``."""
        while True:
            self._skip()
            if self._at >= len(self._text):
                return self._made(END, self._at, self._at)
            token = self._token(self._at)
            if token is not None:
                self._first = False
                return token

    def jump(self, end: int) -> None:
        """Go on after an object that was read in one step and ends at ``end``."""
        line = self._text.rfind("\n", self._line, end) + 1
        if line > self._line:
            self._line = line
            self._indent = _BLANKS.match(self._text, line).end() - line  # type: ignore[union-attr]
        self._at, self._first = end, False

    def _made(self, kind: str, start: int, end: int, value: str = "") -> JsonToken:
        self._at = end
        return JsonToken(kind, start, end, value, self._line, self._indent, self._first)

    def _skip(self) -> None:
        """Skip white space and comments."""
        text = self._text
        while self._at < len(text):
            if gap := _GAP.match(text, self._at):
                self._at = gap.end()
                new_line = max(text.rfind("\n", *gap.span()), text.rfind("\r", *gap.span()))
                if new_line >= 0:
                    self._line, self._first = new_line + 1, True
                    self._indent = self._at - new_line - 1
                elif self._first:
                    self._indent = self._at - self._line
            elif comment := _COMMENT.match(text, self._at):
                self._comment(*comment.span())
            elif odd := _ODD_SPACE.match(text, self._at):
                self._say(odd.start(), odd.end(), "a blank that JSON does not know", " ")
                self._at = odd.end()
            else:
                return

    def _comment(self, start: int, end: int) -> None:
        before = start
        while before > self._line and self._text[before - 1] in " \t":
            before -= 1
        self._complain(
            JsonFault(
                start,
                end - start,
                COMMENT,
                'Remove it, write it as "_comment": "...", or keep the file in the native form'
                " (.smsl), which has // comments.",
                TextFix("Remove the comment", before, end, ""),
            )
        )
        self._at = end

    def _token(self, at: int) -> JsonToken | None:
        char = self._text[at]
        if char in "{}[],:":
            return self._made(char, at, at + 1)
        if char == '"':
            return self._string(at)
        if other := _OTHER_QUOTES.match(self._text, at):
            content = HALF.sub("\ufffd", other[1] or other[2] or "")
            self._say(at, other.end(), "only double quotes are quotes in JSON", quoted(content))
            return self._made(TEXT, at, other.end(), content)
        if word := _WORD.match(self._text, at):
            return self._word(at, word.end())
        end = _ARROW.match(self._text, at).end()  # type: ignore[union-attr]
        return self._made(ODD, at, end, self._text[at:end])

    def _word(self, at: int, end: int) -> JsonToken:
        """Read a bare run: a number, a name without quotes, or a name without its opening quote."""
        closing = _AFTER_QUOTE.match(self._text, end)
        if closing and self._is_odd(at):
            name = HALF.sub("\ufffd", self._text[at:end])
            words = "the opening quote is missing"
            self._complain(_inserted(at, words, f'Write "{short(name)}".', '"', "opening quote"))
            return self._made(TEXT, at, closing.end(), name)
        number = _NUMBER.match(self._text, at)
        if number and not _ONE_WORD.match(self._text, number.end()):
            end = number.end()
            return self._made(NUMBER, at, end, self._text[at:end])
        return self._made(WORD, at, end, HALF.sub("\ufffd", self._text[at:end]))

    def _string(self, at: int) -> JsonToken | None:
        closed = _LINE_STRING.match(self._text, at)
        end = closed.end() if closed else 0
        if closed is None or self._is_odd(at):
            if closed is None:
                line_end = self._line_end(at)
                return self._unclosed(at, self._text[at + 1 : line_end])
            content = self._text[at + 1 : end - 1]
            if content.rstrip(" \t") != (head := content.rstrip(_MARKS)) and head:
                return self._unclosed(at, content)
            if not content.strip(" \t") and _TAIL.match(self._text, end):
                self._lone_quote(at)
                return None
            end = self._behind_stray_quote(at, end)
        value = self._read(at, end)
        return self._made(TEXT, at, end, value)

    def _behind_stray_quote(self, at: int, end: int) -> int:
        """Return the end of a string, after reporting an extra quote inside it, if there is one."""
        tail = _TAIL.match(self._text, end)
        if tail is None or self._text[end : end + 1] in " \t":
            return end
        self._complain(
            JsonFault(
                end - 1,
                1,
                "a quote stands inside a text",
                'Remove it, or write it as \\".',
                TextFix("Remove the quote", end - 1, end, ""),
            )
        )
        return tail.end()

    def _unclosed(self, at: int, content: str) -> JsonToken | None:
        """Read a string without a closing quote. It ends before the marks after its name."""
        inside = _VALUE_INSIDE.search(content)
        name = content[: inside.start()] if inside else content.rstrip(_MARKS)
        end = at + 1 + len(name)
        if not name:
            self._lone_quote(at)
            return None
        words = "the closing quote is missing"
        fix = TextFix("Insert the closing quote", end, end, '"')
        self._complain(JsonFault(at, end - at, words, f'Write "{short(name)}".', fix))
        return self._made(TEXT, at, end, self._read(at, end, closed=False))

    def _lone_quote(self, at: int) -> None:
        """Report and skip a quote that belongs to no text."""
        fix = TextFix("Remove the quote", at, at + 1, "")
        advice = "Remove it, or write the text it should open."
        self._complain(JsonFault(at, 1, "this quote opens no text", advice, fix))
        self._at = at + 1

    def _read(self, at: int, end: int, *, closed: bool = True) -> str:
        """Return the text of a string. Forbidden characters are reported and left out."""
        content = self._text[at + 1 : end - 1 if closed else end]
        if content.isprintable() and "\\" not in content and '"' not in content:
            return content
        for found in _CONTROL.finditer(content):
            words = f"a control character (U+{ord(found[0]):04X}) stands in a text"
            spelled = json.dumps(found[0])[1:-1]
            self._say(at + 1 + found.start(), at + 1 + found.end(), words, spelled)
        for found in _BAD_ESCAPE.finditer(content):
            if found[1]:
                start = at + 1 + found.start()
                words = f"{content[found.start() : found.start() + 2]} means nothing in JSON"
                self._say(start, start + 1, words, "\\\\")
        self._halves(content, at + 1)
        plain = _BAD_ESCAPE.sub(lambda m: "\\\\" if m[1] else m[0], content)
        plain = re.sub(r'(\\.)|"', lambda m: m[1] or '\\"', plain)
        read: str = json.loads(f'"{plain}"', strict=False)
        return HALF.sub("\ufffd", read)

    def _halves(self, content: str, start: int) -> None:
        at = half_pair(content, 0, len(content))
        if at is None and (raw := HALF.search(content)):
            at = raw.start()
        if at is not None:
            length = 6 if content[at] == "\\" else 1
            words, advice = HALF_PAIR
            if length == 6:
                words = f"{content[at : at + 6]} is half a surrogate pair, which is no character"
            self._complain(JsonFault(start + at, length, words, advice))

    def _say(self, start: int, end: int, sentence: str, instead: str) -> None:
        fix = TextFix(f"Write {instead.strip() or 'a blank'}", start, end, instead)
        self._complain(
            JsonFault(start, end - start, sentence, f"Write {instead.strip() or 'a blank'}.", fix)
        )

    def _line_end(self, at: int) -> int:
        return _LINE_END.search(self._text, at).start()  # type: ignore[union-attr]

    def _is_odd(self, at: int) -> bool:
        """Return whether the line of ``at`` has an odd number of quotes."""
        if at >= self._counted:
            self._counted = self._line_end(at)
            quotes = _QUOTE.finditer(self._text, self._line, self._counted)
            self._odd = sum(found[0] == '"' for found in quotes) % 2 == 1
        return self._odd


def _inserted(at: int, sentence: str, advice: str, text: str, what: str) -> JsonFault:
    return JsonFault(at, 1, sentence, advice, TextFix(f"Insert the {what}", at, at, text))


def quoted(content: str) -> str:
    """Return a text as JSON spells it."""
    return json.dumps(content, ensure_ascii=False)


def short(text: str) -> str:
    """Return a text for a message, shortened to 40 characters."""
    return text if len(text) <= 40 else f"{text[:39]}…"
