"""Prints the layouts of some graphs, one line each: ``python -m tests.graph.printed_layouts``.

A line has the name of the graph and the SHA-256 of all places of its states, and for a small graph
also that of its picture with all lines and labels. The places are written with all their digits.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path
from random import Random

from smsl_studio.blueprint.elements import Header
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.outputs import drawn
from smsl_studio.graph.arrangement import DISTANCE, LAYERS
from smsl_studio.graph.layout import place_anew
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
    pins = {"S3": (100.3, -40.7), "S11": (333.0, 222.2)}
    yield "20 states around pins", tidied(pinned_branch(branch, pins), {**strewn, **pins})
    yield "300 states", place_anew(random_graph(300, 2))


def sample(name: str) -> Blueprint:
    """Return the blueprint of a sample file."""
    return read_blueprint(read_document(SAMPLES / f"{name}.json"))


def lines() -> Iterator[str]:
    """Yield all lines."""
    for name, places in layouts():
        yield f"{name} {hashlib.sha256(repr(sorted(places.items())).encode()).hexdigest()}"
    for name in ("registration", "hfsm"):
        picture = drawn(sample(name), "x.svg", collapsed=name == "registration")
        yield f"{name}, drawn {hashlib.sha256(picture).hexdigest()}"


if __name__ == "__main__":
    print("\n".join(lines()))
