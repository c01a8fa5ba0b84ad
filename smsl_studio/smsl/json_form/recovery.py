"""Reads a faulty JSON text: finds several faults in one pass, and everything sound between them.

The reader never stops at a fault. It assumes the most probable meaning, reports the fault, and goes
on. Nothing is recursive, and no piece of the text is read more than a few times.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from smsl_studio.smsl.json_form.brackets import NOTHING, JsonFaultLimit, OpenBracket
from smsl_studio.smsl.json_form.commas import Commas
from smsl_studio.smsl.json_form.fault_pairs import merged
from smsl_studio.smsl.json_form.tokens import END, NUMBER, ODD, TEXT, WORD, JsonToken, quoted, short

Json = Any
_COLONS = ("=", "->", "=>", ";")
"""Signs that people write instead of a colon."""
_ENDS = (",", "}", "]", END)
_VALUES = ("{", "[", TEXT, NUMBER, WORD)


class Recovery(Commas):
    """The steps of reading: what may come here, and the probable meaning of what comes."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        steps: dict[tuple[str, str], Callable[[OpenBracket, JsonToken], None]] = {
            ("{", "first"): self._key,
            ("{", "key"): self._key,
            ("{", "colon"): self._colon,
            ("{", "value"): self._value,
            ("{", "next"): self._next,
            ("[", "first"): self._item,
            ("[", "item"): self._item,
            ("[", "next"): self._next_item,
        }
        with suppress(JsonFaultLimit):
            self._read(steps)
        self._fold()
        self.faults = merged(self.faults, text)

    # --- the file ----------------------------------------------------------------------------

    def _read(
        self, steps: Mapping[tuple[str, str], Callable[[OpenBracket, JsonToken], None]]
    ) -> None:
        """Read on, by the open bracket and what it expects, until no bracket is open."""
        self._open_root()
        while self._frames:
            frame, token = self._frames[-1], self._peek()
            if token.kind == END:
                self._unfinished(frame, token)
                return
            steps[frame.token.kind, frame.expects](frame, token)
        self._after_the_end()

    def _open_root(self) -> None:
        begin = self._peek()
        while (token := self._peek()).kind != "{":
            named = token.kind in (TEXT, WORD) and self._peek(1).kind == ":"
            if named:
                fix = ("Insert the opening brace", token.start, token.start, "{")
                self._fault(token, "the opening brace of the file is missing", "Write {.", fix)
                self._push(token._replace(kind="{", end=token.start))
                return
            if token.kind in ("[", END):
                self.faults.clear()
                words = "An SMSL file is one JSON object whose members are State Branches."
                self._fault(begin, "the file holds no State Branches", words)
                raise JsonFaultLimit
            self._remove(self._take())
        self._push(self._take())

    def _after_the_end(self) -> None:
        token = self._peek()
        if token.kind == END:
            return
        last = token
        while self._peek().kind in ("}", "]", ","):
            last = self._take()
        if self._peek().kind == END:
            what = "closing bracket" if last is token else "closing brackets"
            fix = (f"Remove the {what}", token.start, last.end, "")
            self._fault(token, "this closes nothing", "Remove it.", fix)
            return
        self._fault(
            token,
            "text follows after the end of the file's object",
            "A file is one object: put its State Branches into the first, or remove this.",
        )

    # --- in an object ------------------------------------------------------------------------

    def _key(self, frame: OpenBracket, token: JsonToken) -> None:
        kind = token.kind
        if kind in (TEXT, WORD, NUMBER):
            if self._is_glued(token) or (kind != TEXT and self._begins_member(1)):
                self._remove(self._take())
            elif self._ends_before(frame, token):
                pending = frame.comma
                self._missing_closer(frame, token, "" if pending else ",")
                self._frames[-1].comma = pending
                self._expect_another()
            else:
                self._begin_member(frame, self._take())
        elif kind in ("}", "]") and self._is_extra(frame, token):
            self._drop_closer(token)
        elif kind == "}" and frame.comma:
            self._close_behind_comma(frame, frame.comma, token)
        elif kind in ("}", "]"):
            self._close(frame, token)
        elif kind == ",":
            self._extra_comma(token)
        elif kind in ("{", "["):
            self._unnamed(frame, token)
        elif kind == ":" and not self._begins_member(1):
            self._fault(token, "a name is missing before the colon", 'Write "Name": ... here.')
            self._take()
            frame.expects = "value"
        else:
            self._remove(self._take())

    def _expect_another(self) -> None:
        """Let the open bracket expect a name or an element, as if a comma had come."""
        frame = self._frames[-1]
        frame.expects = "key" if frame.token.kind == "{" else "item"

    def _begin_member(self, frame: OpenBracket, token: JsonToken) -> None:
        if token.kind != TEXT:
            name = token.value
            fix = ("Write it in quotes", token.start, token.end, quoted(name))
            words = f"the name {short(name)} stands without quotes"
            self._fault(token, words, f"Write {quoted(short(name))}.", fix)
        frame.key, frame.comma, frame.expects = token, None, "colon"

    def _unnamed(self, frame: OpenBracket, token: JsonToken) -> None:
        """Handle a bracket that opens where a name should be."""
        if self._excess < 0:
            self._remove(self._take())
            return
        self._fault(token, f"a name is missing before {token.kind}", 'Write "Name": before it.')
        self._push(self._take(), "_")

    def _colon(self, frame: OpenBracket, token: JsonToken) -> None:
        kind = token.kind
        assert frame.key is not None, "a colon is expected behind a name"
        if kind == ":":
            self._take()
            frame.expects = "value"
        elif token.value in _COLONS and kind == ODD and self._peek(1).kind != ":":
            self._colon_instead(frame, token)
        elif kind == ODD or self._is_stray_behind(frame.key, token):
            self._remove(self._take())
        elif self._is_bracket_for_colon(token):
            self._colon_instead(frame, token)
        elif kind in _VALUES and not self._begins_member(0):
            end = frame.key.end
            words = f"the colon behind {short(frame.key.value)!r} is missing"
            self._fault(token, words, "Write a colon.", ("Insert the colon", end, end, ":"))
            frame.expects = "value"
        elif kind == "," and self._peek(1).kind in _VALUES and not self._begins_member(1):
            self._colon_instead(frame, token)
        else:
            self._no_value(frame, token)

    def _colon_instead(self, frame: OpenBracket, token: JsonToken) -> None:
        fix = ("Write a colon", token.start, token.end, ":")
        found = token.value or token.kind
        words = f"a colon stands between name and value, not {found}"
        self._fault(token, words, "Write a colon.", fix)
        self._take()
        frame.expects = "value"

    def _is_stray_behind(self, key: JsonToken, token: JsonToken) -> bool:
        """Return whether a token between a name and its colon belongs to neither."""
        if token.kind == WORD and token.start == key.end:
            return True
        if self._peek(1).kind != ":":
            return False
        if token.kind in ("{", "["):
            return self._excess < 0
        return token.kind in (WORD, NUMBER, ",") or self._excess > 0

    def _is_bracket_for_colon(self, token: JsonToken) -> bool:
        """Return whether a bracket is in the place of the colon, judged by the number of
        brackets.
        """
        value_follows = self._peek(1).kind in _VALUES and not self._begins_member(1)
        wrong = self._excess < 0 if token.kind in ("{", "[") else self._excess > 0
        return token.kind in ("{", "[", "}", "]") and wrong and value_follows

    def _no_value(self, frame: OpenBracket, token: JsonToken) -> None:
        """Report a name without a value. It is left out."""
        advice = 'Write "Name": value, or remove it.'
        key = frame.key
        name = repr(short(key.value)) if key else "this"
        self._fault(token, f"{name} has no value", advice)
        frame.expects = "next"
        self._put(frame, NOTHING, key.end if key else token.start)

    def _value(self, frame: OpenBracket, token: JsonToken) -> None:
        kind, after = token.kind, self._peek(1)
        value_follows = after.kind in _VALUES and not self._begins_member(1)
        if kind in (TEXT, WORD) and after.kind == ":" and self._excess > 0:
            self._unopened(frame, self._taken_to, self._taken_to)
        elif kind in ("{", "["):
            if self._excess < 0 and after.kind == TEXT and self._peek(2).kind in _ENDS:
                self._remove(self._take())
            elif kind == "[" and self._begins_member(1):
                self._unopened(frame, token.start, self._take().end)
            elif not (kind == "{" and self._took_whole(frame, token)):
                self._push(self._take(), frame.key.value if frame.key else "_")
        elif kind in (TEXT, WORD, NUMBER):
            if kind == WORD and (value_follows or self._is_glued(token)):
                self._remove(self._take())
            else:
                self._put(frame, self._scalar(self._take()), token.end)
        elif kind in ("}", "]", ",") and self._excess > 0:
            self._bracket_for_value(frame, token)
        elif kind in (":", ODD) or (kind == "," and value_follows):
            self._remove(self._take())
        else:
            self._no_value(frame, token)

    def _bracket_for_value(self, frame: OpenBracket, token: JsonToken) -> None:
        """Handle a mark in the place of an object, if there are too many closing brackets."""
        value_follows = self._peek(1).kind in _VALUES and not self._begins_member(1)
        if value_follows:
            self._remove(self._take())
        elif self._begins_member(1):
            self._take()
            self._unopened(frame, token.start, token.end)
        elif token.kind == "}":
            self._unopened(frame, token.start, token.start)
        else:
            self._no_value(frame, token)

    def _unopened(self, frame: OpenBracket, start: int, end: int) -> None:
        """Report that the object of this member has no opening brace."""
        key = frame.key
        token = self._peek()
        fix = ("Write {", start, end, "{")
        name = repr(short(key.value)) if key else "this"
        at = token._replace(start=start, end=end) if end > start else token
        self._fault(at, f"the opening brace of {name} is missing", "Write {.", fix)
        opener = key or token
        self._push(opener._replace(kind="{", end=end), key.value if key else "_")

    def _next(self, frame: OpenBracket, token: JsonToken) -> None:
        kind = token.kind
        if kind == "," and not self._stands_for_closer(frame, token):
            frame.comma, frame.expects = self._take(), "key"
        elif kind in ("}", "]"):
            self._close(frame, token)
        elif self._stands_for_closer(frame, token):
            self._closer_instead(frame, token)
        elif (token.value == ";" and self._peek(1).kind not in _ENDS) or (
            kind == ":" and self._begins_member(1)
        ):
            self._comma_instead(frame, token)
        elif self._begins_member(0) and not self._is_glued(token):
            if self._ends_before(frame, token):
                self._missing_closer(frame, token, ",")
            else:
                self._missing_comma(frame, token)
            self._expect_another()
        elif kind in ("{", "[") and self._excess >= 0:
            words = f"a comma and a name are missing before {kind}"
            self._fault(token, words, 'Write , "Name": before it.')
            frame.key = None
            self._push(self._take(), "_")
        elif kind == ":" and self._peek(1).kind in _VALUES:
            self._fault(token, "a second colon follows the value", "Write a comma and a name.")
            self._take()
            frame.expects = "value"
        else:
            self._remove(self._take())

    def _stands_for_closer(self, frame: OpenBracket, token: JsonToken) -> bool:
        """Return whether something wrong is on its own line in the place of the closing bracket."""
        if self._excess >= 0 or len(self._frames) < 2 or self._begins_member(0):
            return False
        if token.kind == "," and self._peek(1).kind != ",":
            return False
        return token.first and token.indent == frame.indent

    def _closer_instead(self, frame: OpenBracket, token: JsonToken) -> None:
        found, closer = token.value or token.kind, frame.closer
        fix = (f"Write {closer}", token.start, token.end, closer)
        words = f"{closer} should stand here, not {short(found)}"
        self._fault(token, words, f"Write {closer}.", fix)
        self._pop(self._take().end)

    # --- in a list ---------------------------------------------------------------------------

    def _item(self, frame: OpenBracket, token: JsonToken) -> None:
        kind = token.kind
        if kind in ("{", "["):
            self._push(self._take(), "_")
        elif kind in (TEXT, WORD, NUMBER):
            self._put(frame, self._scalar(self._take()), token.end)
        elif kind == "]" and frame.comma:
            self._close_behind_comma(frame, frame.comma, token)
        elif kind in ("}", "]"):
            self._close(frame, token)
        elif kind == ",":
            self._extra_comma(token)
        else:
            self._remove(self._take())

    def _next_item(self, frame: OpenBracket, token: JsonToken) -> None:
        kind = token.kind
        if kind == ",":
            frame.comma, frame.expects = self._take(), "item"
        elif kind in ("}", "]"):
            self._close(frame, token)
        elif (kind == ":" or token.value == ";") and self._peek(1).kind in _VALUES:
            self._comma_instead(frame, token)
            frame.expects = "item"
        elif kind in _VALUES and not self._is_glued(token):
            self._missing_comma(frame, token)
            frame.expects = "item"
        else:
            self._remove(self._take())
