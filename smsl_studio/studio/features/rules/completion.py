"""What fits at the caret of a text of rules: facts, their values, and the words of the language."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from smsl_studio.generate.rule_conditions import Alphabets

_LONGEST = 2_000
_WORD = re.compile(r"[\w.-]*\Z")
_COUNTED = re.compile(r"count\(([^()=]*)=\s*['\"]?\Z")
_COMPARED = re.compile(r"""(?:"([^"]+)"|'([^']+)'|([^\s"'(){},=!]+))['"]?\s*!?=\s*['"]?\Z""")
_ENDS = re.compile(r"^\s*(?:start|goal)\s*=\s*\[([^\]]*)\Z")
_TOP = ("facts", "goal", "never", "sb", "start", "[[rule]]")
_RULE = ("cases", "for", "operation", "set", "when")
_LOGIC = ("and", "count(", "not", "or")


class FittingWord(NamedTuple):
    """A word that fits, and what it is."""

    word: str
    kind: str


def offers(before: str, facts: Alphabets) -> tuple[str, list[FittingWord]]:
    """Return the word that has been begun at the end of ``before``, the line up to the caret, and
    what may stand in its place."""
    line = before[-_LONGEST:]
    begun = _WORD.findall(line)[0]
    rest = line[: len(line) - len(begun)]
    found = [one for one in _all(rest, facts) if one.word.lower().startswith(begun.lower())]
    return begun, found


def _all(rest: str, facts: Alphabets) -> list[FittingWord]:
    names = list(facts)
    if ended := _ENDS.match(rest):
        digit = ended[1].count(",")
        return _values(names[digit : digit + 1], facts)
    if counted := _COUNTED.search(rest):
        told = [one.strip().strip("\"'") for one in counted[1].split(",")]
        return _values([one for one in told if one in facts] or names, facts)
    if compared := _COMPARED.search(rest):
        name = next(one for one in compared.groups() if one is not None)
        if name.isdecimal() and int(name[:6]) < len(names):
            name = names[int(name[:6])]
        if name in facts:
            return _values([name], facts)
        if "{" in name:
            return _values(names, facts)
    if not _quoted(rest):
        if not rest.strip():
            return [*(FittingWord(one, "part of the file") for one in _TOP), *_words(_RULE)]
        return [*_facts(names), *_words(_RULE)] if "{" in rest else []
    return [*_facts(names), *(FittingWord(one, "word") for one in _LOGIC)]


def _quoted(rest: str) -> bool:
    """Return whether the end of a line stands in a text of TOML."""
    sign = ""
    for letter in rest:
        if sign:
            sign = "" if letter == sign else sign
        elif letter in "\"'":
            sign = letter
    return bool(sign)


def _facts(names: Sequence[str]) -> list[FittingWord]:
    return [FittingWord(name, f"digit {digit}") for digit, name in enumerate(names)]


def _words(words: Sequence[str]) -> list[FittingWord]:
    return [FittingWord(one, "part of a rule") for one in words]


def _values(names: Sequence[str], facts: Alphabets) -> list[FittingWord]:
    """Return the values of some facts, each with the facts that have it."""
    having: dict[str, list[str]] = {}
    for name in names:
        for value in facts[name]:
            having.setdefault(value, []).append(name)
    return [FittingWord(value, f"value of {', '.join(own[:3])}") for value, own in having.items()]
