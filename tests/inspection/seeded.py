"""Seeded faults of seven kinds in intact blueprints, each a change of the plain values."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from random import Random
from typing import Any

Json = Any

NOWHERE = "State_nowhere"


@dataclass(frozen=True)
class SeededFault:
    """A fault: its kind, the name of its file, and the values with it."""

    kind: str
    file: str
    values: Json


def seeded_faults(files: dict[str, Json], count: int, seed: int) -> Iterator[SeededFault]:
    """Yield ``count`` faults, the kinds in turn, each in a file that can have it."""
    drawn = Random(seed)
    names = list(files)
    for number in range(count):
        kind = list(KINDS)[number % len(KINDS)]
        found = None
        while found is None:
            file = drawn.choice(names)
            values = copy.deepcopy(files[file])
            if KINDS[kind](drawn, values) and values != files[file]:
                found = SeededFault(kind, file, values)
        yield found


def _branches(values: Json) -> list[Json]:
    return [branch for name, branch in values.items() if not name.startswith("_")]


def states_of(branch: Json) -> dict[str, dict[str, str]]:
    """Return the states of an SB in plain values, with their operations."""
    states = {k: v for k, v in branch.items() if k != "HEADER" and not k.startswith("_")}
    return {k: {n: t for n, t in v.items() if not n.startswith("_")} for k, v in states.items()}


def _edge(drawn: Random, values: Json) -> tuple[Json, str, str] | None:
    branch = drawn.choice(_branches(values))
    edges = [(state, name) for state, out in states_of(branch).items() for name in out]
    return (branch, *drawn.choice(edges)) if edges else None


def _state_deleted(drawn: Random, values: Json) -> bool:
    branch = drawn.choice(_branches(values))
    states = states_of(branch)
    ends = {branch.get("HEADER", {}).get(key) for key in ("INITIAL", "ACTIVATING")}
    entered = {t for s, out in states.items() for t in out.values() if t != s}
    choice = [state for state in states if state in entered and state not in ends]
    if choice:
        del branch[drawn.choice(choice)]
    return bool(choice)


def _operation_deleted(drawn: Random, values: Json) -> bool:
    found = _edge(drawn, values)
    if found:
        branch, state, name = found
        del branch[state][name]
    return found is not None


def _target_changed(drawn: Random, values: Json) -> bool:
    found = _edge(drawn, values)
    if found:
        branch, state, name = found
        branch[state][name] = drawn.choice(list(states_of(branch)))
    return found is not None


def _target_undefined(drawn: Random, values: Json) -> bool:
    found = _edge(drawn, values)
    if found:
        branch, state, name = found
        branch[state][name] = NOWHERE
    return found is not None


def _wrong_label(drawn: Random, values: Json) -> bool:
    """Give an edge the name of another operation of its SB that its state does not have."""
    found = _edge(drawn, values)
    if not found:
        return False
    branch, state, name = found
    known = {other: None for out in states_of(branch).values() for other in out}
    others = [other for other in known if other not in branch[state]]
    if others:
        other = drawn.choice(others)
        branch[state] = {other if k == name else k: v for k, v in branch[state].items()}
    return bool(others)


def _sub_wrong(drawn: Random, values: Json) -> bool:
    """Name an unknown sub-SB, a digit that is out of range, or an SB above itself."""
    bases = [(n, b) for n, b in values.items() if not n.startswith("_") and _subs(b)]
    if not bases:
        return False
    name, base = drawn.choice(bases)
    subs = dict(_subs(base))
    sub = drawn.choice(list(subs))
    way = drawn.randrange(3)
    if way == 0:
        subs[f"{sub}x"] = subs.pop(sub)
    elif way == 1:
        subs[sub] = 17
    else:
        subs[name] = subs.pop(sub)
    base["HEADER"]["SUB_SBS"] = subs
    return True


def _subs(branch: Json) -> dict[str, int]:
    found = branch.get("HEADER", {}).get("SUB_SBS")
    return found if isinstance(found, dict) else {}


def _ends_wrong(drawn: Random, values: Json) -> bool:
    """Let INITIAL or ACTIVATING name another state, or none."""
    branch = drawn.choice(_branches(values))
    header = branch.setdefault("HEADER", {})
    key = drawn.choice(["INITIAL", "ACTIVATING"])
    header[key] = drawn.choice([*states_of(branch), NOWHERE])
    return True


KINDS: dict[str, Callable[[Random, Json], bool]] = {
    "state deleted": _state_deleted,
    "operation deleted": _operation_deleted,
    "target changed": _target_changed,
    "target undefined": _target_undefined,
    "wrong label": _wrong_label,
    "sub-SB wrong": _sub_wrong,
    "INITIAL or ACTIVATING wrong": _ends_wrong,
}
"""The kinds of faults. Each function changes the values, or says that it cannot."""
