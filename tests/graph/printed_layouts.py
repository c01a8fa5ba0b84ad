"""Prints the layouts of some graphs, one line each: ``python -m tests.graph.printed_layouts``.

A line has the name of the graph and the SHA-256 of all places of its states, and for a small graph
also that of its picture with all lines and labels. The places are written with all their digits.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path
from random import Random
from unittest import mock

import numpy as np

from smsl_studio.blueprint.elements import Header
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.outputs import drawn
from smsl_studio.graph import spread
from smsl_studio.graph.arrangement import DISTANCE, KINDS, LAYERS, ties_for
from smsl_studio.graph.crossings import cost_of, costs_at
from smsl_studio.graph.layout import place_anew, place_states
from smsl_studio.graph.tidied import tidied
from smsl_studio.smsl.files import read_document
from tests.graph.pinned import pinned_branch

SAMPLES = Path(__file__).parents[2] / "samples"
Places = dict[str, tuple[float, float]]


def random_graph(size: int, seed: int) -> StateBranch:
    """Return an SB with a way to each state from an earlier one, and as many ways more."""
    chance = Random(seed)
    table: dict[str, dict[str, str]] = {f"S{number}": {} for number in range(size)}
    for number in range(1, size):
        table[f"S{chance.randrange(number)}"][f"go_{number}"] = f"S{number}"
        table[f"S{chance.randrange(size)}"][f"more_{number}"] = f"S{chance.randrange(size)}"
    return StateBranch("SB", dict(table), Header(initial="S0"))


def layouts() -> Iterator[tuple[str, Places]]:
    """Yield each layout with its name."""
    for name in ("hanoi", "registration", "hfsm", "three-roots"):
        for branch in sample(name):
            yield f"{name}/{branch.name}", place_anew(branch)
    branch = random_graph(20, 1)
    for kind in (LAYERS, DISTANCE):
        yield f"20 states by {kind}", place_anew(branch, kind)
    strewn = {name: (31.7 * at % 400, 17.3 * at) for at, name in enumerate(branch.table)}
    yield "20 states, tidied", tidied(branch, strewn)
    yield "300 states", place_anew(random_graph(300, 2))
    for name, branch in even_graphs().items():
        yield from _in_every_way(name, branch)


def _in_every_way(name: str, branch: StateBranch) -> Iterator[tuple[str, Places]]:
    """Yield the layouts of a small graph: of each kind, of some states, around others, and tidied.

    Places by hand have tenths, and many states want the same place.
    """
    for kind in KINDS:
        yield f"{name}, {kind}", place_anew(branch, kind)
    strewn = {state: (0.1 + at % 3 * 41.3, 0.7 * at) for at, state in enumerate(branch.table)}
    third = {state: at for number, (state, at) in enumerate(strewn.items()) if number % 3 == 0}
    yield f"{name}, strewn", tidied(branch, strewn)
    yield f"{name}, some tidied", tidied(branch, strewn, [s for s in strewn if s not in third])
    yield f"{name}, around pins", tidied(pinned_branch(branch, third), strewn)
    usual = place_anew(branch, LAYERS)
    first, *others = usual
    crowd = {**usual, **dict.fromkeys(others[::2], usual[others[0]])}
    yield f"{name}, in a crowd", tidied(pinned_branch(branch, {first: usual[first]}), crowd)
    near = {state: at for number, (state, at) in enumerate(strewn.items()) if number % 3}
    yield f"{name}, joined", place_states(branch, near)


def even_graphs() -> dict[str, StateBranch]:
    """Return graphs in which many states look alike, so that places are chosen among equal ones.

    If a sum is not exact, or if a set decides, another one is chosen elsewhere.
    """
    ring = {f"S{i}": {"on": f"S{(i + 1) % 9}"} for i in range(9)}
    whole = {f"S{i}": {f"to_{j}": f"S{j}" for j in range(5) if j != i} for i in range(5)}
    halves = {f"S{i}": {f"to_{j}": f"S{j}" for j in range(4, 8)} for i in range(4)}
    halves |= {f"S{j}": {} for j in range(4, 8)}
    star = {"S0": {f"to_{j}": f"S{j}" for j in range(1, 10)}}
    star |= {f"S{j}": {"back": "S0"} for j in range(1, 10)}
    grid = {
        f"S{i}": {
            **({"right": f"S{i + 1}"} if i % 4 < 3 else {}),
            **({"down": f"S{i + 4}"} if i < 12 else {}),
        }
        for i in range(16)
    }
    parts = {f"{part}{i}": {"on": f"{part}{(i + 1) % 3}"} for part in "ABCDEF" for i in range(3)}
    tables = {"ring": ring, "whole": whole, "halves": halves, "star": star, "grid": grid}
    found = {name: StateBranch("SB", dict(table)) for name, table in tables.items()}
    return {**found, "parts": StateBranch("SB", dict(parts))}


def sums() -> Iterator[tuple[str, object]]:
    """Yield the sums by which places are chosen, with all their digits.

    Layouts are rounded late, so that a last digit that differs would be seen in few of them.
    """
    for size, seed in ((12, 1), (40, 4)):
        branch = random_graph(size, seed)
        ties, places = ties_for(branch), np.array(list(place_anew(branch).values()))
        moved = places + ties.step * (np.arange(2.0 * size).reshape(-1, 2) % 7.0 - 3.0)
        near = [costs_at(ties, moved, one, moved[one] + 31.0 * places) for one in range(size)]
        found = [cost_of(ties, at) for at in (places, moved)]
        yield f"costs of {size} states", (found, [one.tolist() for one in near])
    for size in (40, 400):
        yield f"distances of {size} states", _places_by_distance(random_graph(size, 5))


def _places_by_distance(branch: StateBranch) -> object:
    """Return the places of a layout by distances before each state goes to a whole cell."""
    found: list[object] = []
    whole = spread._own_cells

    def noted(places: spread.Array) -> list[tuple[float, float]]:
        found.append(places.tolist())
        return whole(places)

    with mock.patch.object(spread, "_own_cells", noted):
        spread.by_distance(branch)
    return found


def sample(name: str) -> Blueprint:
    """Return the blueprint of a sample file."""
    return read_blueprint(read_document(SAMPLES / f"{name}.json"))


def lines() -> Iterator[str]:
    """Yield all lines."""
    for name, places in layouts():
        yield f"{name} {hashlib.sha256(repr(sorted(places.items())).encode()).hexdigest()}"
    for name, found in sums():
        yield f"{name} {hashlib.sha256(repr(found).encode()).hexdigest()}"
    for name in ("registration", "hfsm"):
        picture = drawn(sample(name), "x.svg", collapsed=name == "registration")
        yield f"{name}, drawn {hashlib.sha256(picture).hexdigest()}"


if __name__ == "__main__":
    print("\n".join(lines()))
