"""Commas and single values, for members of objects and elements of lists."""

from __future__ import annotations

from typing import Any

from smsl_studio.smsl.json_form.brackets import Brackets, OpenBracket
from smsl_studio.smsl.json_form.scalars import scalar_of
from smsl_studio.smsl.json_form.tokens import NUMBER, TEXT, WORD, JsonToken

Json = Any


class Commas(Brackets):
    """Reads a text and finds missing and extra commas."""

    def _is_glued(self, token: JsonToken) -> bool:
        """Return whether a bare word touches a text after it. Then it is a stray character and no
        name.
        """
        after = self._peek(1)
        return token.kind in (WORD, NUMBER) and after.kind == TEXT and after.start == token.end

    def _comma_instead(self, frame: OpenBracket, token: JsonToken) -> None:
        fix = ("Write a comma", token.start, token.end, ",")
        words = f"a comma stands between members, not {token.value or token.kind}"
        self._fault(token, words, "Write a comma.", fix)
        self._take()
        frame.expects, frame.comma = "key", token

    def _missing_comma(self, frame: OpenBracket, token: JsonToken) -> None:
        end = frame.last_end
        fix = ("Insert the comma", end, end, ",")
        self._fault(token, "a comma is missing before this", "Write a comma.", fix)

    def _extra_comma(self, token: JsonToken) -> None:
        last = self._take()
        while self._peek().kind == "," and not self._text[last.end : self._peek().start].strip():
            last = self._take()
        fix = ("Remove the comma", token.start, last.end, "")
        words = "a comma with nothing before it"
        self._fault(token._replace(end=last.end), words, "Remove it.", fix)

    def _close_behind_comma(self, frame: OpenBracket, comma: JsonToken, token: JsonToken) -> None:
        fix = ("Remove the comma", comma.start, comma.end, "")
        self._fault(comma, "a comma with nothing behind it", "Remove it.", fix)
        frame.comma = None
        self._close(frame, token)

    def _scalar(self, token: JsonToken) -> Json:
        """Return the value of a text, number or word. A wrong value is reported."""
        value, wrong = scalar_of(token)
        if wrong is not None:
            self._say(wrong)
        return value
