"""The open brackets of a faulty JSON text during reading, and the meaning of a closing one.

The brackets that are still to come are counted, and indentation is compared. So a missing bracket
is reported where the next key is too far left, and an extra one where it is.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any

from smsl_studio.errors import TextFix
from smsl_studio.smsl.document.limits import MAX_DEPTH, MAX_FAULTS, TOO_DEEP
from smsl_studio.smsl.json_form.strides import BALANCE, balance_of, flat_object
from smsl_studio.smsl.json_form.tokens import (
    END,
    TEXT,
    WORD,
    JsonFault,
    JsonToken,
    JsonTokens,
    short,
)

Json = Any
NOTHING = object()
"""The placeholder of a value that could not be read."""

_MOST_REMOVED = 2000
"""With so many pieces that belong nowhere, a text is not JSON, and reading ends."""

_FEW = 8
"""If more closing brackets are missing, the kinds of values are no evidence for their places."""

_CLOSER = {"{": "}", "[": "]"}


class JsonFaultLimit(Exception):  # noqa: N818
    """Reading ends here: there are too many faults, or nothing makes sense after this one."""


@dataclass(slots=True)
class OpenBracket:
    """An open object or list: its beginning, its content, and what is expected next."""

    token: JsonToken
    holds: dict[str, Json] | list[Json]
    indent: int
    expects: str = "first"
    key: JsonToken | None = None
    comma: JsonToken | None = None
    last_end: int = 0
    name: str = ""

    @property
    def closer(self) -> str:
        """The bracket that closes this one."""
        return _CLOSER[self.token.kind]


class Brackets:
    """Reads one text, token by token. ``values`` and ``faults`` are the results."""

    def __init__(self, text: str) -> None:
        self._text = text
        self.faults: list[JsonFault] = []
        self.values: Json = NOTHING
        self._balance = balance_of(text)
        self._tokens = JsonTokens(text, self._hear)
        self._heard: set[int] = set()
        self._ahead: deque[JsonToken] = deque()
        self._frames: list[OpenBracket] = []
        self._taken_to = 0
        self._removed = 0

    def _hear(self, fault: JsonFault) -> None:
        """Note a fault within a token. A token may be read twice, but its fault counts once."""
        if fault.at not in self._heard:
            self._heard.add(fault.at)
            self._say(fault)

    def _say(self, fault: JsonFault) -> None:
        self.faults.append(fault)
        if len(self.faults) >= MAX_FAULTS:
            raise JsonFaultLimit

    def _fault(
        self,
        token: JsonToken,
        sentence: str,
        advice: str,
        fix: tuple[str, int, int, str] | None = None,
    ) -> None:
        length = max(1, token.end - token.start)
        self._say(JsonFault(token.start, length, sentence, advice, TextFix(*fix) if fix else None))

    def _peek(self, index: int = 0) -> JsonToken:
        while len(self._ahead) <= index:
            if self._ahead and self._ahead[-1].kind == END:
                return self._ahead[-1]
            self._ahead.append(self._tokens.take())
        return self._ahead[index]

    def _take(self) -> JsonToken:
        token = self._peek()
        self._ahead.popleft()
        self._taken_to = token.end
        self._balance -= BALANCE.get(token.kind, 0)
        return token

    @property
    def _excess(self) -> int:
        """The number of closing brackets still to come, minus the brackets that are open now."""
        return self._balance - len(self._frames)

    # --- opening, filling, closing -----------------------------------------------------------

    def _push(self, token: JsonToken, key: str = "") -> None:
        if len(self._frames) >= MAX_DEPTH:
            self._fault(token, *TOO_DEEP)
            raise JsonFaultLimit
        holds: Json = {} if token.kind == "{" else []
        self._frames.append(OpenBracket(token, holds, token.indent, last_end=token.end, name=key))

    def _took_whole(self, frame: OpenBracket, token: JsonToken) -> bool:
        """Read an object with nothing but names in one step, and return whether this was possible.
        Its end must be certain: it is under its beginning, or no bracket of the file is missing or
        extra.
        """
        found = flat_object(self._text, token.start)
        if found is None:
            return False
        value, end, indent = found
        if self._excess != 0 and indent != token.indent:
            return False
        self._ahead.clear()
        self._tokens.jump(end)
        self._taken_to = end
        self._put(frame, value, end)
        return True

    def _pop(self, end: int) -> None:
        frame = self._frames.pop()
        if self._frames:
            self._put(self._frames[-1], frame.holds, end)
        else:
            self.values = frame.holds

    def _put(self, frame: OpenBracket, value: Json, end: int) -> None:
        """Put a complete value into the frame. Without a key it is left out."""
        if isinstance(frame.holds, list):
            if value is not NOTHING:
                frame.holds.append(value)
        elif frame.key is not None and value is not NOTHING:
            frame.holds[frame.key.value] = value
        frame.key, frame.comma, frame.expects, frame.last_end = None, None, "next", end

    def _fold(self) -> None:
        """Close everything that is open, so that what was read is kept."""
        while self._frames:
            self._pop(self._taken_to)
        if not isinstance(self.values, dict):
            self.values = {}

    def _remove(self, token: JsonToken) -> None:
        """Report a token that does not belong here. Neighbouring tokens are one fault."""
        self._removed += 1
        if self._removed > _MOST_REMOVED:
            raise JsonFaultLimit
        found = short(self._text[token.start : min(token.end, token.start + 50)])
        start, end, last = token.start, token.end, self.faults[-1] if self.faults else None
        if (
            last
            and last.sentence.endswith("does not belong here")
            and last.fix
            and last.fix.end == start
        ):
            self.faults.pop()
            start = last.at
            found = short(self._text[start : min(end, start + 50)])
        fix = (f"Remove {found}", start, end, "")
        self._fault(token._replace(start=start), f"{found} does not belong here", "Remove it.", fix)

    def _close(self, frame: OpenBracket, token: JsonToken) -> None:
        """Handle a closing bracket: the right one, an extra one, or one that comes too early."""
        if token.kind == frame.closer:
            if self._is_extra(frame, token):
                self._drop_closer(token)
                return
            if self._closes_further_out(frame, token):
                self._missing_closer(frame, token)
                return
            self._pop(self._take().end)
        elif self._excess > 0:
            self._drop_closer(token)
        elif self._excess < 0 and len(self._frames) > 1 and self._frames[-2].closer == token.kind:
            self._missing_closer(frame, token)
        else:
            fix = (f"Write {frame.closer}", token.start, token.end, frame.closer)
            opener = frame.token.kind
            words = f"{token.kind} cannot close what {opener} has opened"
            self._fault(token, words, f"Write {frame.closer}.", fix)
            self._pop(self._take().end)

    def _is_extra(self, frame: OpenBracket, token: JsonToken) -> bool:
        """Return whether this closing bracket is extra."""
        if self._excess <= 0:
            return False
        return token.kind != frame.closer or self._is_stray(frame, token)

    def _is_stray(self, frame: OpenBracket, token: JsonToken) -> bool:
        if token.first:
            return token.indent != frame.indent
        if frame.token.line != token.line:
            return True
        following = self._peek(1).kind
        if following in (TEXT, WORD) or (following == "," and len(self._frames) == 1):
            return True
        return self._would_misplace()

    def _would_misplace(self) -> bool:
        """Return whether the next member would be one level too high after this bracket, judged by
        its kind.
        """
        comma, name = self._peek(1), self._peek(2)
        if comma.kind != "," or name.value.startswith("_") or not self._begins_member(2):
            return False
        if len(self._frames) == 3:
            return self._peek(4).kind == TEXT and self._peek(5).kind != ":"
        deeper = self._peek(4).kind == "{" and self._begins_member(5)
        return len(self._frames) == 2 and deeper and self._peek(7).kind == TEXT

    def _drop_closer(self, token: JsonToken) -> None:
        fix = (f"Remove {token.kind}", token.start, token.end, "")
        self._fault(token, f"this {token.kind} closes nothing", "Remove it.", fix)
        self._take()

    def _missing_closer(self, frame: OpenBracket, token: JsonToken, behind: str = "") -> None:
        """Report that the frame should have ended before this token."""
        at, closers, opener = frame.last_end, "", frame.token
        while True:
            closers += self._on_its_line(frame, token.start) if token.first else frame.closer
            self._pop(at)
            frame = self._frames[-1]
            further = self._closes_further_out if token.kind in "}]" else self._ends_before
            if not further(frame, token):
                break
        line = self._text.count("\n", 0, opener.start) + 1
        words = f"the {opener.kind} of line {line} is not closed before this"
        marks = "".join(closers.split())
        fix = (f"Insert {marks}", at, at, closers + behind)
        self._fault(token, words, f"Write {marks} before it.", fix)

    def _closes_further_out(self, frame: OpenBracket, token: JsonToken) -> bool:
        """Return whether a bracket is so far left that it closes something around the frame."""
        if self._excess >= 0 or len(self._frames) < 2:
            return False
        return token.first and token.indent < frame.indent

    def _ends_before(self, frame: OpenBracket, token: JsonToken) -> bool:
        """Return whether a key is so far left, or has such a value, that its object has ended."""
        if self._excess >= 0 or len(self._frames) < 2:
            return False
        if token.first and frame.token.line != token.line and token.indent <= frame.indent:
            return True
        if (
            self._excess < -_FEW
            or len(self._frames) != 3
            or token.value.startswith("_")
            or token.value == "SUB_SBS"
        ):
            return False
        in_state = not any(one.name.startswith("_") for one in self._frames)
        opens = self._peek(1).kind == ":" and self._peek(2).kind == "{"
        return in_state and opens and (self._peek(3).kind == "}" or self._begins_member(3))

    def _begins_member(self, index: int) -> bool:
        """Return whether a name and a colon come at this index."""
        return self._peek(index).kind in (TEXT, WORD) and self._peek(index + 1).kind == ":"

    def _unfinished(self, frame: OpenBracket, token: JsonToken) -> None:
        """Report that the text ends while brackets are open."""
        closers = "".join(one.closer for one in reversed(self._frames))
        what = f"{len(closers)} brackets are" if len(closers) > 1 else "a bracket is"
        end = self._taken_to
        start = frame.comma.start if frame.comma else end
        fix: tuple[str, int, int, str] | None
        lines = (self._on_its_line(one, end) for one in reversed(self._frames))
        fix = (f"Write {closers} at the end", start, end, "".join(lines))
        if frame.expects in ("colon", "value") and frame.key:
            name = short(frame.key.value)
            sentence = f"the file ends before the value of {name!r}"
            advice, fix = f"Write what is missing, then {closers}.", None
        else:
            sentence = f"the file ends, and {what} not closed"
            advice = f"Write {closers} at the end."
        self._fault(token._replace(start=max(0, end - 1), end=end), sentence, advice, fix)

    def _on_its_line(self, frame: OpenBracket, end: int) -> str:
        """Return the closing bracket of a frame. It gets a line of its own, below the line that
        opens it, if the frame has several lines.
        """
        if self._text.find("\n", frame.token.start, end) < 0:
            return frame.closer
        newline = "\r\n" if "\r\n" in self._text else "\n"
        line = frame.token.line
        return newline + self._text[line : line + frame.indent] + frame.closer
