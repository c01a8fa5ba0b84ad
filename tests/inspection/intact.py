"""Intact blueprints: more than forty made from rules, and the samples without errors.

A rule that reports an error or a warning in one of them reports a false alarm.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations, pairwise
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.rules import hanoi_failures_values, hanoi_values, level_values
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json, write_json

Json = Any
Facts = tuple[str, ...]
Moves = Callable[[Facts], Iterable[tuple[str, Facts]]]


def read(values: Json, name: str = "intact.json") -> Blueprint:
    """Read a blueprint from plain values, by way of its text."""
    return read_blueprint(parse_json(write_json(values), name))


def searched(start: Facts, goal: Facts, moves: Moves) -> Json:
    """Return the SB of all states that ``start`` leads to, with their operations."""
    table: dict[Facts, dict[str, Facts]] = {}
    waiting = [start]
    for facts in waiting:
        if facts not in table:
            table[facts] = dict(moves(facts))
            waiting.extend(table[facts].values())
    states = {
        f"State_{''.join(facts)}": {name: f"State_{''.join(to)}" for name, to in out.items()}
        for facts, out in table.items()
    }
    ends = {"INITIAL": f"State_{''.join(start)}", "ACTIVATING": f"State_{''.join(goal)}"}
    return {"SB1": {"HEADER": {**ends, "NUM_FACTS": len(start)}, **states}}


def put(facts: Facts, digit: int, value: str) -> Facts:
    """Return the facts with another value of one digit."""
    return (*facts[:digit], value, *facts[digit + 1 :])


def river(passengers: Sequence[str], bad: Sequence[tuple[str, str]]) -> Json:
    """A farmer and his passengers cross a river. Of a bad pair none may be left alone."""
    count = len(passengers)

    def fine(facts: Facts) -> bool:
        sides = dict(zip(passengers, facts[1:], strict=True))
        return all(sides[a] != sides[b] or sides[a] == facts[0] for a, b in bad)

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        other = "r" if facts[0] == "l" else "l"
        for digit in range(count + 1):
            after = put(put(facts, digit, other), 0, other)
            if (digit == 0 or facts[digit] == facts[0]) and fine(after):
                yield f"cross_{passengers[digit - 1] if digit else 'alone'}_{other}", after

    return searched(("l",) * (count + 1), ("r",) * (count + 1), moves)


def missionaries(count: int, seats: int) -> Json:
    """As many cannibals as missionaries cross; nowhere may they outnumber the missionaries."""

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        m, c, here = int(facts[0]), int(facts[1]), facts[2]
        sign, other = (-1, "r") if here == "l" else (1, "l")
        for a in range(seats + 1):
            for b in range(seats + 1 - a):
                after = m + sign * a, c + sign * b
                fits = a + b and all(0 <= n <= count for n in after)
                if fits and after[0] in (0, count, after[1]):
                    yield f"ferry_{a}_{b}_{other}", (*map(str, after), other)

    return searched((str(count), str(count), "l"), ("0", "0", "r"), moves)


def board(pieces: int, edges: Sequence[str]) -> Json:
    """Pieces move along the edges of a board (``ab`` joins a and b), one piece on a block."""
    near: dict[str, list[str]] = {}
    for edge in edges:
        one, other = edge[0], edge[1]
        near.setdefault(one, []).append(other)
        near.setdefault(other, []).append(one)
    blocks = sorted(near)

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        for digit, block in enumerate(facts):
            for other in near[block]:
                if other not in facts:
                    yield f"move-{digit + 1}-{block}-to-{other}", put(facts, digit, other)

    return searched(tuple(blocks[:pieces]), tuple(blocks[-pieces:]), moves)


def steps(count: int) -> Json:
    """A procedure of steps in order. A step may be cleared, and the later ones with it."""

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        done = facts.count("1")
        if done < count:
            yield f"Op_Do{done + 1}", put(facts, done, "1")
        for digit in range(done):
            yield f"Op_Clear{digit + 1}", (*facts[:digit], *("0" * (count - digit)))

    return searched(("0",) * count, ("1",) * count, moves)


def free_steps(count: int) -> Json:
    """Steps in any order, each can be undone; the last one when all others are done."""

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        for digit, value in enumerate(facts):
            if digit < count - 1 and facts[-1] == "0":
                name = f"Do{digit + 1}" if value == "0" else f"Undo{digit + 1}"
                yield name, put(facts, digit, "1" if value == "0" else "0")
        if set(facts[:-1]) == {"1"}:
            name, value = ("Finish", "1") if facts[-1] == "0" else ("Reopen", "0")
            yield name, put(facts, count - 1, value)

    return searched(("0",) * count, ("1",) * count, moves)


def lock(chambers: int) -> Json:
    """An air lock: of two doors beside each other only one may be open."""

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        for digit, value in enumerate(facts):
            after = put(facts, digit, "c" if value == "o" else "o")
            if not any(a == b == "o" for a, b in pairwise(after)):
                yield f"{'close' if value == 'o' else 'open'}_{digit + 1}", after

    ends = ["o" if n % 2 else "c" for n in range(chambers + 1)]
    return searched(("c",) * (chambers + 1), tuple(ends), moves)


def counter(wheels: int, size: int) -> Json:
    """Wheels with ``size`` positions, which turn in both directions."""

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        for digit, value in enumerate(facts):
            for word, turn in (("up", 1), ("down", -1)):
                yield f"{word}_{digit + 1}", put(facts, digit, str((int(value) + turn) % size))

    return searched(("0",) * wheels, (str(size - 1),) * wheels, moves)


def lift(floors: int) -> Json:
    """A lift moves from floor to floor while its door is closed."""

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        yield ("close", (facts[0], "c")) if facts[1] == "o" else ("open", (facts[0], "o"))
        if facts[1] == "c":
            for word, turn in (("up", 1), ("down", -1)):
                if 0 <= int(facts[0]) + turn < floors:
                    yield word, (str(int(facts[0]) + turn), "c")

    return searched(("0", "c"), (str(floors - 1), "o"), moves)


def gripper(places: str, things: int) -> Json:
    """A gripper (g) carries things between places, one at a time; places hold any number."""

    def moves(facts: Facts) -> Iterator[tuple[str, Facts]]:
        held = [digit for digit, value in enumerate(facts) if value == "g"]
        if not held:
            yield from ((f"pick_{n + 1}", put(facts, n, "g")) for n in range(things))
        for digit in held:
            yield from ((f"place_{digit + 1}_{p}", put(facts, digit, p)) for p in places)

    return searched((places[0],) * things, (places[-1],) * things, moves)


SAMPLES = (
    "hanoi-corrected",
    "registration",
    "registration-people",
    "registration-failures",
    "registration-digitization",
    "hfsm",
    "three-levels",
    "three-roots",
)
"""The samples without errors that no family makes."""


def intact_files() -> dict[str, Json]:
    """Return all intact files as plain values, by name."""
    samples = ((name, samples_dir() / f"{name}.json") for name in SAMPLES)
    return {**dict(intact()), **{n: json.loads(path.read_text("utf-8")) for n, path in samples}}


def intact() -> Iterator[tuple[str, Json]]:
    """Yield more than forty made blueprints as plain values, with their names."""
    yield from ((f"hanoi {n}", hanoi_values(n)) for n in range(1, 6))
    yield from ((f"hanoi with failures {n}", hanoi_failures_values(n)) for n in range(1, 4))
    yield "river", river(("wolf", "goat", "cabbage"), (("wolf", "goat"), ("goat", "cabbage")))
    yield "river of two", river(("fox", "goose"), (("fox", "goose"),))
    names = ("ash", "birch", "cedar", "date")
    yield "river of four", river(names, (("ash", "birch"),))
    yield "missionaries 2", missionaries(2, 2)
    yield "missionaries 3", missionaries(3, 2)
    yield "missionaries 5", missionaries(5, 3)
    ring, line = ("ab", "bc", "cd", "de", "ea"), ("ab", "bc", "cd", "be")
    grid = ("ab", "bc", "de", "ef", "gh", "hi", "ad", "dg", "be", "eh", "cf", "fi")
    yield from ((f"ring board {n}", board(n, ring)) for n in (1, 2, 3))
    yield from ((f"line board {n}", board(n, line)) for n in (1, 2))
    yield from ((f"grid board {n}", board(n, grid)) for n in (1, 2, 3))
    yield from ((f"steps {n}", steps(n)) for n in range(2, 6))
    yield from ((f"free steps {n}", free_steps(n)) for n in (3, 4, 5))
    yield from ((f"lock {n}", lock(n)) for n in (1, 2, 3))
    yield from ((f"counter {n} of {size}", counter(n, size)) for n, size in ((2, 3), (3, 4)))
    yield from ((f"lift {n}", lift(n)) for n in (2, 5))
    yield from ((f"gripper {n}", gripper("abc", n)) for n in (1, 2, 3))
    yield from ((f"levels {sizes}", level_values(sizes)) for sizes in combinations((4, 3, 2), 2))
