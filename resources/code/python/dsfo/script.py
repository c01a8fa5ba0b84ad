"""Scripts: what a supervisor does, operations that people choose, and faults, at their moments.

A script is JSON Lines. Every line is checked before the run begins. Keys that begin with an
underscore are comments.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Any

from . import disturbance
from .addresses import operation_at, state_at
from .commands import TABLE
from .elements import Blueprint, address, split_fact
from .errors import UsageError, did_you_mean
from .faults import check_fault
from .levels import must_have_a_level

AT, WHEN, DURING, ASKED = "at", "when", "during", "asked"
EVERY = 0
"""The value of ``times`` that means every time."""
LARGEST, MOST, LONGEST = 1 << 24, 10_000, 1 << 16
"""The largest size of a script (bytes), number of lines, and length of a line (characters)."""
_MOMENT = (AT, WHEN, DURING, "after", "times", "turn", "do", "by")
_TASKS = ("operation", "confirm", "fact", "supervise", "start")

Json = Any


@dataclass(frozen=True)
class Act:
    """One line of a script: its moment, its word, its arguments, and who acts.

    ``kind`` is at, when, during or asked. ``seconds`` is the time of ``at``, and what is waited
    after the others. ``turn`` counts ticks, because several may have one simulated time.
    """

    line: int
    do: str
    given: Mapping[str, Json]
    by: str
    kind: str
    seconds: float = 0.0
    address: str = ""
    times: int = 1
    turn: int = 1

    def __str__(self) -> str:
        return " ".join((self.do.replace("_", " "), *map(str, self.given.values())))


@dataclass(frozen=True)
class Script:
    """A checked script. ``levels`` are set before the start."""

    file: str
    acts: tuple[Act, ...]
    levels: Mapping[str, str] = field(default_factory=dict)
    digest: str = ""


def read_script(path: str, blueprint: Blueprint) -> Script:
    """Read a script. UsageError has the file and the line of what is wrong."""
    try:
        raw = Path(path).read_bytes()
    except OSError as error:
        words = f"{path}:1:1: the script cannot be read: {error.strerror or error}"
        raise UsageError(words) from None
    lines = raw.split(b"\n")
    if len(raw) > LARGEST or len(lines) > MOST:
        raise UsageError(f"{path}:1:1: the script has more than 16 MB or {MOST:,} lines")
    acts, levels = list[Act](), dict[str, str]()
    for number, one in enumerate(lines, 1):
        try:
            _take(blueprint, number, one, acts, levels)
        except UsageError as error:
            raise UsageError(f"{path}:{number}:1: {error.sentence}", error.advice) from None
    return Script(path, tuple(acts), levels, sha256(raw).hexdigest())


def _take(
    blueprint: Blueprint, number: int, raw: bytes, acts: list[Act], levels: dict[str, str]
) -> None:
    values = _values(raw)
    if not values:
        return
    word = values.get("do")
    if not isinstance(word, str) or word not in WORDS:
        near = did_you_mean(str(word), WORDS) or f"The words are {', '.join(WORDS)}."
        raise UsageError(f"{str(word)[:60]!r} is no command", near)
    given = _given(blueprint, word, values)
    if word == "level":
        if any(key in values for key in _MOMENT[:6]):
            raise UsageError("a level is set before the start, at no other moment")
        must_have_a_level(blueprint, given["of"], given["level"])
        levels[given["of"]] = given["level"]
        return
    by = _text(blueprint, values.get("by", "script"))
    acts.append(_act(blueprint, number, word, given, by, values))


def _values(raw: bytes) -> dict[str, Json]:
    try:
        text = raw.decode("utf-8-sig").strip()
        if len(text) > LONGEST:
            raise UsageError(f"the line is longer than {LONGEST:,} characters")
        found = json.loads(text, object_pairs_hook=_once) if text else {}
    except UnicodeDecodeError:
        raise UsageError("the line is not UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise UsageError(f"the line is no JSON object: {error}") from None
    if not isinstance(found, dict):
        raise UsageError("the line is no JSON object")
    return {key: value for key, value in found.items() if not key.startswith("_")}


def _once(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
    if len(dict(pairs)) < len(pairs):
        raise UsageError("a key is written twice in the line")
    return dict(pairs)


def _given(blueprint: Blueprint, word: str, values: Mapping[str, Json]) -> dict[str, Json]:
    needs, may, free = WORDS[word]
    given: dict[str, Json] = {}
    for key, value in values.items():
        if key in _MOMENT:
            continue
        check = needs.get(key) or may.get(key) or (_scalar if free else None)
        if check is None or not key.isidentifier() or key == "self":
            takes = f"It takes {', '.join((*needs, *may)) or 'nothing'}."
            raise UsageError(f"{word} takes no {key[:60]!r}", takes)
        given[key] = check(blueprint, value)
    for key in needs:
        if key not in given:
            raise UsageError(f"{word} needs {key!r}")
    more = {key: value for key, value in given.items() if key not in needs}
    if word == "disturb":
        disturbance.checked(given["kind"], more)
    if word == "inject":
        check_fault(given["fault"], more)
    return given


def _act(
    blueprint: Blueprint,
    number: int,
    word: str,
    given: Mapping[str, Json],
    by: str,
    values: Mapping[str, Json],
) -> Act:
    said = [key for key in (AT, WHEN, DURING) if key in values]
    if len(said) > 1:
        raise UsageError(f"{said[0]!r} and {said[1]!r} exclude each other")
    kind = said[0] if said else ASKED if word == "answer" else AT
    turn = _count(values.get("turn", 1))
    if kind == AT:
        if "after" in values or "times" in values:
            raise UsageError("'after' and 'times' need a state or an operation")
        seconds = _seconds(blueprint, values.get(AT, 0))
        return Act(number, word, given, by, AT, seconds, turn=turn)
    named = ""
    if kind != ASKED:
        check = _state if kind == WHEN else _operation
        named = check(blueprint, values[kind])
    times = values.get("times", 1)
    many = EVERY if times == "every" else _count(times)
    after = _seconds(blueprint, values.get("after", 0))
    return Act(number, word, given, by, kind, after, named, many, turn)


# arguments ---------------------------------------------------------------------------------------


def _count(value: Json) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= 10**6:
        raise UsageError(f"{str(value)[:60]} is no count", "Write a number from 1 on.")
    return value


def _text(_: Blueprint, value: Json) -> str:
    if not isinstance(value, str) or not value.strip() or not value.isprintable():
        raise UsageError(f"{str(value)[:60]!r} is no text", 'Write it in quotes: "...".')
    return value


def _seconds(_: Blueprint, value: Json) -> float:
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not number or not 0 <= value < 1e9:
        raise UsageError(f"{str(value)[:60]} is no number from 0 to 1e+09", "Write it like 2.5.")
    return float(value)


def _switch(_: Blueprint, value: Json) -> bool:
    if not isinstance(value, bool):
        raise UsageError(f"{str(value)[:60]} is neither true nor false")
    return value


def _scalar(_: Blueprint, value: Json) -> Json:
    if isinstance(value, bool) or not isinstance(value, (str, int, float)):
        raise UsageError(f"{str(value)[:60]} is neither a text nor a number")
    return value


def _state(blueprint: Blueprint, value: Json) -> str:
    return address(*state_at(blueprint, _text(blueprint, value)))


def _operation(blueprint: Blueprint, value: Json) -> str:
    return operation_at(blueprint, _text(blueprint, value))


def _sensed(blueprint: Blueprint, value: Json) -> str:
    fact = split_fact(_text(blueprint, value))
    if fact is not None:
        branch = blueprint.branches.get(fact[0])
        if branch is None or fact[1] >= len(branch.flags):
            raise UsageError(f"there is no fact {value!r}", "Write SB/digit.")
    return str(value)


def _one_of(known: tuple[str, ...]) -> Callable[[Blueprint, Json], str]:
    def check(_: Blueprint, value: Json) -> str:
        """Return the value if it is one of the words."""
        if value not in known:
            raise UsageError(f"{str(value)[:60]!r} is none of {', '.join(known)}")
        return str(value)

    return check


Check = Callable[[Blueprint, Json], Json]
_CHECKS: Mapping[str, Check] = {
    "address": _operation,
    "reason": _text,
    "cost": _seconds,
    "on": _switch,
    "option": _text,
    "role": _text,
    "fault": _text,
    "target": _sensed,
    "of": _text,
    "level": _text,
}


def _words() -> dict[str, tuple[dict[str, Check], dict[str, Check], bool]]:
    """Return the words of ``do``: what each needs, what it may have, and whether it takes more."""
    found: dict[str, tuple[dict[str, Check], dict[str, Check], bool]] = {}
    for word, row in TABLE.items():
        special: dict[str, Check] = {}
        if word == "answer":
            special = {"address": _text, "kind": _one_of(_TASKS)}
        if word == "disturb":
            special = {"kind": _one_of(tuple(disturbance.PARAMETERS))}
        checks = {**_CHECKS, **special}
        needs = {key: checks[key] for key in row.needs if key != "automatic"}
        may = {key: checks[key] for key in row.may}
        names = ("by_hand", "automatic") if word == "set_automatic" else (word,)
        found.update((name, (needs, may, row.free)) for name in names)
    return {**found, "level": ({"of": _text, "level": _text}, {}, False)}


WORDS = _words()
