"""Reads a script: JSON Lines. Every line is checked before the run begins.

A script is not trusted. The result is always a script that fits the blueprint, or a ReadError with
file, line and column. Blank lines and keys that begin with an underscore are ignored.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.levels import fault_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place, ReadError, UsageError, did_you_mean
from smsl_studio.front.script.script import (
    ASKED,
    AT,
    DURING,
    EVERY,
    MOMENT,
    WHEN,
    WITH,
    Act,
    Script,
    Trigger,
)
from smsl_studio.front.script.words import WORDS, checked, operation, seconds, state, text
from smsl_studio.monitor.disturbance import checked as checked_disturbance
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.inputs import read_ordinary

Json = Any
LONGEST, MOST, LARGEST = 1 << 16, 10_000, 1 << 24
"""The largest length of a line (characters), number of lines, and size of a file (bytes)."""
ENCODE = "Save the script as UTF-8."
SHORTER = "Make it shorter; a script is written for one run."
FAULTS = 20
"""The largest number of wrong lines that are reported together."""
BY = "script"


def read_script(path: Path, blueprint: Blueprint) -> Script:
    """Read a script from a file. ReadError if it cannot be read or does not fit the blueprint.

    >>> script = read_script(Path("hanoi-pruned.jsonl"), read("hanoi-corrected.json"))
    >>> [act.do for act in script.acts]
    ['prune']
    """
    try:
        raw = read_ordinary(path, LARGEST).raw
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ReadError(
            f"the script cannot be read: {reason}",
            Place(str(path), 1, 1),
            "Check the path and the right to read it.",
        ) from None
    return script_of(raw, str(path), blueprint)


def script_of(raw: bytes, file: str, blueprint: Blueprint) -> Script:
    """Read a script from bytes. ``file`` is its name in messages. ReadError has all wrong lines."""
    acts: list[Act] = []
    levels: dict[str, str] = {}
    faults: list[ReadError] = []
    if len(raw) > LARGEST:
        faults.append(_wrong(file, 1, 1, "the script is longer than 16 MB", SHORTER))
    lines = [] if faults else raw.removeprefix(b"\xef\xbb\xbf").split(b"\n")
    if len(lines) > MOST:
        faults.append(_wrong(file, MOST + 1, 1, f"a script has at most {MOST:,} lines", SHORTER))
        lines = []
    for number, line in enumerate(lines, 1):
        try:
            _take(_Line(file, number, line), blueprint, acts, levels)
        except ReadError as fault:
            faults.append(fault)
            if len(faults) == FAULTS:
                break
    if faults:
        raise ReadError.of(faults)
    return Script(file, tuple(acts), levels, sha256_hex(raw))


class _Line:
    """One line of a script, with the columns of its keys and values."""

    def __init__(self, file: str, number: int, raw: bytes) -> None:
        self.file, self.number = file, number
        self.noted = False
        """Whether the line has keys that are left out."""
        try:
            self.text = raw.decode("utf-8").rstrip("\r")
        except UnicodeDecodeError as error:
            column = len(raw[: error.start].decode("utf-8")) + 1
            raise _wrong(file, number, column, "the line is not UTF-8", ENCODE) from None
        if len(self.text) > LONGEST:
            raise self.wrong(1, f"the line is longer than {LONGEST:,} characters", SHORTER)

    def values(self) -> dict[str, Json]:
        """Return the keys and values of the line. ReadError if it is no JSON object."""
        try:
            found = json.loads(
                self.text, object_pairs_hook=self._once, parse_constant=self._no_constant
            )
        except json.JSONDecodeError as error:
            words = "the line is no JSON object"
            raise self.wrong(error.colno, f"{words}: {error.msg}") from None
        except (RecursionError, ValueError):
            raise self.wrong(1, "the line nests too deep, or has too long a number") from None
        if not isinstance(found, dict):
            raise self.wrong(1, "the line is no JSON object")
        values = {key: value for key, value in found.items() if not key.startswith("_")}
        self.noted = len(values) < len(found)
        return values

    def of(self, key: str, check: Callable[[], Json]) -> Json:
        """Return the checked value of a key. A UsageError of ``check`` becomes a ReadError with the
        place of the value."""
        try:
            return check()
        except UsageError as error:
            raise self.wrong(self.value_at(key), error.sentence, error.advice) from None

    def key_at(self, key: str) -> int:
        """Return the column of a key, counted from 1."""
        found = self._find(key)
        return found.start() + 1 if found else 1

    def value_at(self, key: str) -> int:
        """Return the column of the value of a key, counted from 1."""
        found = self._find(key)
        return found.end() + 1 if found else 1

    def wrong(self, column: int, sentence: str, advice: str = "") -> ReadError:
        """Return an error at a column of this line."""
        return _wrong(self.file, self.number, column, sentence, advice)

    def _find(self, key: str) -> re.Match[str] | None:
        written = re.escape(json.dumps(key, ensure_ascii=False))
        return re.search(rf"{written}\s*:\s*", self.text)

    def _once(self, pairs: list[tuple[str, Json]]) -> dict[str, Json]:
        found = dict(pairs)
        if len(found) < len(pairs):
            names = [name for name, _ in pairs]
            twice = next(name for name in names if names.count(name) > 1)
            words = f"{twice[:60]!r} is written twice"
            raise self.wrong(self.key_at(twice), words, "Keep one of them.")
        return found

    def _no_constant(self, word: str) -> Json:
        words = f"{word} is no number"
        raise self.wrong(self.text.find(word) + 1, words, "Write it like 2.5.")


def _take(line: _Line, blueprint: Blueprint, acts: list[Act], levels: dict[str, str]) -> None:
    """Check one line and add it to ``acts`` or ``levels``."""
    if not line.text.strip():
        return
    values = line.values()
    if line.noted and not values:
        return
    word = values.get("do")
    if not isinstance(word, str) or word not in WORDS:
        known = f"The words are {', '.join(WORDS)}."
        if "do" not in values:
            raise line.wrong(1, "the line has no 'do'", known)
        near = did_you_mean(str(word)[:80], WORDS) if isinstance(word, str) else ""
        shown = f"{str(word)[:60]!r} is no command"
        raise line.wrong(line.value_at("do"), shown, near or known)
    given = _given(line, word, values, blueprint)
    if word == "level":
        _set_level(line, values, given, blueprint, levels)
        return
    by = values.get("by", BY)
    place = Place(line.file, line.number, 1)
    trigger = _trigger(line, word, values, blueprint)
    who = line.of("by", lambda: text(blueprint, by))
    places = {key: Place(line.file, line.number, line.value_at(key)) for key in given}
    acts.append(Act(place, trigger, word, given, who, places))


def _given(
    line: _Line, do: str, values: Mapping[str, Json], blueprint: Blueprint
) -> Mapping[str, Json]:
    """Return the checked arguments of a command."""
    word, given = WORDS[do], {}
    inner = _inner(line, values) if word.free and WITH in values else {}
    outer = {key: one for key, one in values.items() if key not in MOMENT}
    if inner:
        del outer[WITH]
    for key, value in (*outer.items(), *inner.items()):
        if key in given or (key in inner and key in (*word.needs, "by")):
            words = f"{key[:60]!r} stands in {WITH!r}"
            raise line.wrong(line.value_at(WITH), words, "Write it beside it, and once.")
        check = word.check_of(key)
        if check is None or not key.isidentifier() or key == "self":
            known = (*word.needs, *word.may)
            near = did_you_mean(key[:80], (*known, *MOMENT))
            takes = f"It takes {', '.join(known)}." if known else "It takes nothing."
            raise line.wrong(line.key_at(key), f"{do} takes no {key[:60]!r}", near or takes)
        given[key] = line.of(key, partial(checked, check, blueprint, value))
    missing = next((key for key in word.needs if key not in given), None)
    if missing is not None:
        takes = f"Add {missing!r}; {do} takes {', '.join((*word.needs, *word.may))}."
        raise line.wrong(line.value_at("do"), f"{do} needs {missing!r}", takes)
    if do == "disturb":
        parameters = {k: v for k, v in given.items() if k not in word.needs}
        line.of("kind", lambda: checked_disturbance(given["kind"], parameters))
    return given


def _inner(line: _Line, values: Mapping[str, Json]) -> Mapping[str, Json]:
    """Return the arguments that stand in the object ``with``."""
    inner = values[WITH]
    if not isinstance(inner, dict) or not inner:
        words = f"{WITH!r} is no object with parameters"
        raise line.wrong(line.value_at(WITH), words, f'Write it like "{WITH}": {{"after": 0.5}}.')
    return inner


def _trigger(line: _Line, do: str, values: Mapping[str, Json], blueprint: Blueprint) -> Trigger:
    """Return the moment of an act. Without a moment it is the start of the run, or, for an answer,
    the opening of its task."""
    said = [key for key in (AT, WHEN, DURING) if key in values]
    if len(said) > 1:
        words = f"{said[0]!r} and {said[1]!r} exclude each other"
        raise line.wrong(line.key_at(said[1]), words, "Say one moment a line.")
    kind = said[0] if said else ASKED if do == "answer" else AT
    for key in ("after", "times"):
        if kind == AT and key in values:
            inside = f' A parameter of the fault stands in "{WITH}": {{"{key}": 0.5}}.'
            raise line.wrong(
                line.key_at(key),
                f"{key!r} needs a state or an operation",
                f"Say when, or during.{inside if WORDS[do].free else ''}",
            )
    turn = line.of("turn", lambda: _count(values.get("turn", 1)))
    if kind == AT:
        return Trigger(AT, line.of(AT, lambda: seconds(blueprint, values.get(AT, 0))), turn=turn)
    after = line.of("after", lambda: seconds(blueprint, values.get("after", 0)))
    address = ""
    if kind in (WHEN, DURING):
        check = state if kind == WHEN else operation
        address = line.of(kind, lambda: checked(check, blueprint, values[kind]))
    times = line.of("times", lambda: _times(values.get("times", 1)))
    return Trigger(kind, after, address, times, turn)


def _times(value: Json) -> int:
    return EVERY if value == "every" else _count(value, ', or "every"')


def _count(value: Json, more: str = "") -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= 10**6:
        raise UsageError(
            f"{str(value)[:60]} is no count", advice=f"Write a number from 1 on{more}."
        )
    return value


def _set_level(
    line: _Line,
    values: Mapping[str, Json],
    given: Mapping[str, Json],
    blueprint: Blueprint,
    levels: dict[str, str],
) -> None:
    late = next((key for key in MOMENT[:6] if key in values), None)
    if late is not None:
        words = "a level is set before the start, at no other moment"
        raise line.wrong(line.key_at(late), words, f"Leave {late!r} out.")
    fault = fault_of(blueprint, given["of"], given["level"])
    if fault is not None:
        key = "level" if "no level of" in fault.sentence else "of"
        raise line.wrong(line.value_at(key), fault.sentence, fault.advice())
    levels[given["of"]] = given["level"]


def _wrong(file: str, line: int, column: int, sentence: str, advice: str = "") -> ReadError:
    return ReadError(sentence, Place(file, line, column), advice or "Write one JSON object a line.")
