"""Families of procedures that a learner has not seen: each is a function from values to moves."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from itertools import product

Values = tuple[str, ...]
Moves = Callable[[Values], Iterable[tuple[str, Values]]]


def reached(start: Values, moves: Moves) -> dict[Values, dict[str, Values]]:
    """Every state that is reached, and its operations."""
    table: dict[Values, dict[str, Values]] = {start: {}}
    queue = deque([start])
    while queue:
        here = queue.popleft()
        for name, there in moves(here):
            assert name not in table[here]
            table[here][name] = there
            if there not in table:
                table[there] = {}
                queue.append(there)
    return table


def put(values: Values, *changes: tuple[int, str]) -> Values:
    """The values with some changed."""
    found = list(values)
    for digit, value in changes:
        found[digit] = value
    return tuple(found)


def blueprint(start: Values, moves: Moves, name: str = "SB1") -> dict[str, object]:
    """The blueprint of a family, the state reached last as its goal."""
    table = reached(start, moves)
    state = "State_{}".format
    states = {state("".join(v)): {o: state("".join(t)) for o, t in row.items()}
              for v, row in table.items()}  # fmt: skip
    header = {"INITIAL": state("".join(start)), "NUM_FACTS": len(start)}
    return {name: {"HEADER": header, **states}}


def lights(rows: int, columns: int) -> dict[str, object]:
    """A grid of lights, each with a switch."""
    cells = list(product(range(rows), range(columns)))

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        for at, (r, c) in enumerate(cells):
            yield f"toggle_r{r + 1}c{c + 1}", put(v, (at, "1" if v[at] == "0" else "0"))

    return blueprint(("0",) * len(cells), moves, "LIGHTS")


def lamps(count: int) -> dict[str, object]:
    """Lamps that are switched on and off by two operations."""

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        for at in range(count):
            name = "abcdefgh"[at]
            yield (f"SwitchOff-{name}", put(v, (at, "d"))) if v[at] == "l" else (
                f"SwitchOn-{name}", put(v, (at, "l")))  # fmt: skip

    return blueprint(("d",) * count, moves)


def lights_out(count: int) -> dict[str, object]:
    """Lights in a row: a switch turns its own light and its neighbours."""

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        for at in range(count):
            own = [i for i in (at - 1, at, at + 1) if 0 <= i < count]
            yield f"press{at}", put(v, *((i, "1" if v[i] == "0" else "0") for i in own))

    return blueprint(("0",) * count, moves)


def ferry(things: str, eats: Iterable[tuple[str, str]], banks: str = "lr") -> dict[str, object]:
    """A ferryman takes one passenger at most; some eat others when he is away. He is last."""

    def safe(v: Values) -> bool:
        return all(v[things.index(a)] != v[things.index(b)] or v[things.index(a)] == v[-1]
                   for a, b in eats)  # fmt: skip

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        there = banks[1 - banks.index(v[-1])]
        alone = put(v, (len(things), there))
        if safe(alone):
            yield f"cross_alone_to_{there}", alone
        for at, one in enumerate(things):
            if v[at] == v[-1]:
                after = put(alone, (at, there))
                if safe(after):
                    yield f"cross_with_{one}_to_{there}", after

    return blueprint((banks[0],) * (len(things) + 1), moves, "FERRY")


def counter(size: int, *, wraps: bool, digits: int = 1) -> dict[str, object]:
    """Counters that go up and down."""

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        for at in range(digits):
            now = int(v[at], 36)
            for word, step in (("up", 1), ("down", -1)):
                after = (now + step) % size if wraps else now + step
                if 0 <= after < size:
                    value = "0123456789abcdefghijklmnopqrstuvwxyz"[after]
                    yield (word if digits == 1 else f"{word}_{at}"), put(v, (at, value))

    return blueprint(("0",) * digits, moves, "COUNTER")


def odometer(base: int) -> dict[str, object]:
    """Two digits that count together."""

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        now = int(v[0]) * base + int(v[1])
        for word, after in (("increment", now + 1), ("decrement", now - 1)):
            if 0 <= after < base * base:
                yield word, (str(after // base), str(after % base))

    return blueprint(("0", "0"), moves)


def sokoban(columns: int, rows: int) -> dict[str, object]:
    """A player on a floor pushes a box, or pulls it behind; values are column and row."""
    steps = {"left": (-1, 0), "right": (1, 0), "up": (0, -1), "down": (0, 1)}

    def inside(x: int, y: int) -> bool:
        return 0 <= x < columns and 0 <= y < rows

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        px, py, bx, by = map(int, v)
        for word, (dx, dy) in steps.items():
            x, y = px + dx, py + dy
            if not inside(x, y):
                continue
            if (x, y) != (bx, by):
                yield f"go_{word}", (str(x), str(y), v[2], v[3])
                if (px - dx, py - dy) == (bx, by):
                    yield f"pull_{word}", (str(x), str(y), str(px), str(py))
            elif inside(x + dx, y + dy):
                yield f"push_{word}", (str(x), str(y), str(x + dx), str(y + dy))

    return blueprint(("0", "0", "1", "1"), moves, "SOKOBAN")


def lift(floors: int, people: int) -> dict[str, object]:
    """A lift and people who ride in it (i) or stand on a floor."""

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        now = int(v[0])
        if now + 1 < floors:
            yield "lift_up", put(v, (0, str(now + 1)))
        if now > 0:
            yield "lift_down", put(v, (0, str(now - 1)))
        for at in range(1, people + 1):
            if v[at] == v[0]:
                yield f"enter_p{at}", put(v, (at, "i"))
            if v[at] == "i":
                yield f"leave_p{at}", put(v, (at, v[0]))

    return blueprint(("0",) * (people + 1), moves)


def rooms(count: int) -> dict[str, object]:
    """A robot in a row of rooms with doors, and a ball it carries (h)."""
    names = "pqrstu"[:count]

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        robot, ball, *doors = v
        at = names.index(robot)
        for near in (at - 1, at + 1):
            if 0 <= near < count and doors[min(at, near)] == "o":
                yield f"GoTo{names[near].upper()}", put(v, (0, names[near]))
        for door in (at - 1, at):
            if 0 <= door < count - 1:
                shut = doors[door] == "o"
                yield (
                    f"{'Shut' if shut else 'Open'}Door{door}",
                    put(v, (door + 2, "s" if shut else "o")),
                )
        if ball == robot:
            yield "Grasp", put(v, (1, "h"))
        if ball == "h":
            yield "Release", put(v, (1, robot))

    return blueprint((names[0], names[-1], *("s" * (count - 1))), moves, "ROBOT")


def pegs(tiles: int) -> dict[str, object]:
    """Tiles on a ring of places, one place is free; a tile moves to the free place beside it."""
    places = "0123456789"[: tiles + 1]

    def moves(v: Values) -> Iterator[tuple[str, Values]]:
        free = next(p for p in places if p not in v)
        for at, place in enumerate(v):
            if (int(place) - int(free)) % len(places) in (1, len(places) - 1):
                yield f"slide_{'xyzw'[at]}_{free}", put(v, (at, free))

    return blueprint(tuple(places[:tiles]), moves)


FAMILIES: dict[str, Callable[[], dict[str, object]]] = {
    "lights 2x2": lambda: lights(2, 2),
    "lights 2x3": lambda: lights(2, 3),
    "lights 3x3": lambda: lights(3, 3),
    "lamps 5": lambda: lamps(5),
    "lights out 4": lambda: lights_out(4),
    "ferry of three": lambda: ferry("fgh", [("f", "g"), ("g", "h")]),
    "ferry of four": lambda: ferry("kmnq", [("k", "m")], "ew"),
    "counter 10": lambda: counter(10, wraps=False),
    "ring counter 7": lambda: counter(7, wraps=True),
    "three counters": lambda: counter(4, wraps=True, digits=3),
    "odometer": lambda: odometer(4),
    "sokoban 3x3": lambda: sokoban(3, 3),
    "sokoban 4x2": lambda: sokoban(4, 2),
    "lift": lambda: lift(3, 3),
    "rooms": lambda: rooms(3),
    "tiles 3": lambda: pegs(3),
}
