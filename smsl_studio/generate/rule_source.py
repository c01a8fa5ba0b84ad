"""The text of a file of rules: its values, and the place of each part.

TOML has no places in Python, so a place is that of the first text that is the same: in the rule
that is read, or else in the file.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from typing import Any

from smsl_studio.errors import Place, ReadError, did_you_mean, instead_of
from smsl_studio.generate.rule_fixes import word_fix

Json = Any
LARGEST = 1 << 20
"""The largest size of a file of rules (bytes)."""
LONGEST = 10_000
"""The most letters of a text, also after values of ``for`` stand in it."""
_LARGE = 10**18
"""A whole number must be smaller than this to stand for a name or a value. Python refuses to write
very long numbers."""
_SHOWN = 200
_ERROR = re.compile(r"\(at line (\d+), column (\d+)\)")
_END = "(at end of document)"
_LONG_NUMBER = re.compile(r"[0-9][0-9_]{4000}")
_DOTTED = re.compile(r"""(?<![\w"'-])(?>(?:"[^"\n]*+"|[\w-]++)[ \t]*+\.[ \t]*+){30}""")
"""A key of very many parts. Python needs time that grows with their square for it."""
_RULE_BEGINS = re.compile(r"^[ \t]*\[\[[ \t]*rule[ \t]*\]\]", re.MULTILINE)


class RuleSource:
    """A file of rules as text and as values."""

    def __init__(self, raw: bytes, file: str) -> None:
        """ReadError for bytes that are too many, or no TOML."""
        self._file, self._from = file, 0
        self.text = ""
        if len(raw) > LARGEST:
            raise self.fault("the rules are longer than 1 MB", "", "Rules are short: use 'for'.")
        try:
            self.text = raw.decode("utf-8")
            if _DOTTED.search(self.text):
                raise ValueError("a key has more than 30 parts")
            self.values: dict[str, Json] = tomllib.loads(self.text)
        except (ValueError, RecursionError) as error:
            raise _no_toml(error, self.text, file) from None
        self._rules = [found.start() for found in _RULE_BEGINS.finditer(self.text)]

    def enter(self, number: int, count: int) -> None:
        """Look for places in one of so many rules. Rules may also be written without a heading for
        each, or in one a text may look like a heading: then the whole file is looked through."""
        self._from = self._rules[number] if len(self._rules) == count else 0

    def leave(self) -> None:
        """Look for places in the whole file."""
        self._from = 0

    def text_of(self, value: Json, what: str, near: str = "") -> str:
        """Return a value as text. ReadError if it is neither a text nor a whole number."""
        if isinstance(value, int) and not isinstance(value, bool) and abs(value) < _LARGE:
            return str(value)
        if not isinstance(value, str) or not value or len(value) > LONGEST:
            raise self.fault(f"{what} is missing, empty or no text", near or what)
        return value

    def members(self, values: Mapping[str, Json], known: set[str], what: str, near: str) -> None:
        """Refuse keys that are not known."""
        for name in values:
            if name not in known:
                advice = (
                    did_you_mean(name, sorted(known)) or f"There is {', '.join(sorted(known))}."
                )
                raise self.fault(
                    f"{what} has an unknown key {name!r}", name or near, advice,
                    instead_of(name, sorted(known)),
                )  # fmt: skip

    def fault(
        self,
        sentence: str,
        near: str,
        advice: str = "",
        instead: tuple[str, str] = ("", ""),
        after: int = 0,
    ) -> ReadError:
        """Return an error at the line of the first place that has a text. ``instead`` is a wrong
        word, which stands there ``after`` some characters, and the right one."""
        fix = word_fix(self.text, self._offset(near) + after, *instead)
        return ReadError(sentence, self.place(near), advice, fix=fix)

    def place(self, near: str) -> Place:
        """Return the line of a text: in the rule that is read, or else the first in the file."""
        return Place(self._file, self.text.count("\n", 0, self._offset(near)) + 1, 1)

    def _offset(self, near: str) -> int:
        at = self.text.find(near, self._from)
        return at if at >= 0 else max(0, self.text.find(near))

    def set_place(self, key: str, value: Json) -> str:
        """Return a text that stands where a key is set to a value, if there is one, and else the
        key."""
        keys = (f'"{key}" =', f"'{key}' =", f"{key} =")
        spellings = [f"{own} {given}" for own in keys for given in (f'"{value}"', f"'{value}'")]
        own_text = self.text[self._from :]
        return next((one for one in (*spellings, *keys) if one in own_text), key)


def short(text: str) -> str:
    """Return a text as a message shows it."""
    return repr(text if len(text) <= _SHOWN else f"{text[:_SHOWN]}...")


def _no_toml(error: Exception, text: str, file: str) -> ReadError:
    """Return the error for bytes that are no TOML, with the line that Python names.

    It names none for a number that is too long, and no number for the end of the text.
    """
    told = str(error)
    line, column = 1, 1
    if found := _ERROR.search(told):
        line, column = int(found[1]), int(found[2])
    elif _END in told:
        line = max(1, len(text.splitlines()))
    elif long := _LONG_NUMBER.search(text):
        line = text.count("\n", 0, long.start()) + 1
    words = _ERROR.sub("", told).strip()
    return ReadError(f"this is no TOML: {words}", Place(file, line, column), "See docs/rules.md.")
