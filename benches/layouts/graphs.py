"""The 60 graphs of the bench: samples, published procedures, and random ones with a seed."""

from __future__ import annotations

import itertools
import json
import random
from collections.abc import Iterable, Iterator

from scipy.spatial import Delaunay

import smsl_studio as smsl
from benches.layouts.procedures import chess, river, rotms
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.rules import hanoi
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json

Graph = tuple[str, Blueprint, str]
"""What it is called, the blueprint, and the SB that is drawn."""
Pairs = Iterable[tuple[int, int]]
SAMPLES = (
    ("hanoi.json", "SB1"),
    ("hanoi-failures.json", "SB1"),
    ("registration.json", "REGISTRATION"),
    ("registration-failures.json", "REGISTRATION"),
    ("registration-digitization.json", "REGISTRATION"),
    ("registration-digitization.json", "DIGITIZATION"),
    ("three-levels.json", "REGISTRATION"),
    ("hfsm.json", "SB1"),
    ("hfsm.json", "SB2"),
)
DENSE = ((8, 30), (10, 60), (12, 50), (16, 60), (20, 60), (24, 90), (30, 80), (40, 120))
SPARSE = ((12, 16), (18, 26), (25, 32), (35, 50), (50, 66), (80, 100))
"""States and operations of random graphs."""


def graphs() -> Iterator[Graph]:
    """Yield the graphs, in order of their kinds."""
    for file, branch in SAMPLES:
        yield f"{file.removesuffix('.json')}/{branch}", smsl.read(samples_dir() / file), branch
    for name, table in (("rotms", rotms()), ("river", river()), ("chess", chess())):
        yield name, _blueprint(table), "SB"
    for disks in (3, 4, 5, 6):
        yield f"Hanoi {disks}", hanoi(disks), "SB1"
    for number, (name, size, edges) in enumerate(_pairs()):
        yield name, _blueprint(_table(size, edges, number)), "SB"


def _pairs() -> Iterator[tuple[str, int, Pairs]]:
    for size, seed in ((12, 1), (20, 2), (30, 3), (40, 4), (60, 5), (90, 6)):
        yield f"planar {size}", size, _planar(size, seed)
    for size, count in DENSE:
        yield f"dense {size}/{count}", size, _random(size, count, size)
    for size, count in SPARSE:
        yield f"random {size}/{count}", size, _random(size, count, size)
    for size, ways in ((15, 2), (13, 3), (31, 2), (40, 3)):
        yield f"tree {size}/{ways}", size, (((i - 1) // ways, i) for i in range(1, size))
    for size in (20, 45):
        chance = random.Random(size)
        yield f"random tree {size}", size, [(chance.randrange(i), i) for i in range(1, size)]
    for bits in (3, 4, 5):
        turns = ((i, i ^ 1 << bit) for i in range(1 << bits) for bit in range(bits))
        yield f"cube {bits}, both ways", 1 << bits, turns
    for bits in (4, 6):
        up = ((i, i | 1 << b) for i in range(1 << bits) for b in range(bits) if not i >> b & 1)
        yield f"cube {bits}, upwards", 1 << bits, up
    for size in (8, 25):
        yield f"ring {size}", size, _ring(size, 0)
    for size in (10, 30):
        back = ((i, 0) for i in range(2, size))
        yield f"chain {size}, all back to start", size, [*itertools.pairwise(range(size)), *back]
    for rows, columns in ((4, 5), (6, 8)):
        yield f"grid {rows} by {columns}", rows * columns, _grid(rows, columns)
    for size in (9, 20):
        leaves = range(1, size)
        yield f"star {size}", size, [*((0, i) for i in leaves), *((i, 0) for i in leaves)]
    for layers, each in ((4, 4), (5, 6), (8, 3)):
        yield f"layers {layers} of {each}", layers * each, _layers(layers, each)
    yield "two rings", 16, [*_ring(8, 0), *_ring(8, 8), (0, 8)]
    rungs = (pair for i in range(0, 24, 2) for pair in ((i, i + 1), (i + 1, i)))
    yield "ladder 12, both ways", 24, [*rungs, *((i, i + 2) for i in range(22))]


def _ring(size: int, first: int) -> Pairs:
    return [(first + i, first + (i + 1) % size) for i in range(size)]


def _planar(size: int, seed: int) -> Pairs:
    """Four fifths of the edges of a Delaunay triangulation, some of them in both directions."""
    chance = random.Random(seed)
    points = [(chance.random(), chance.random()) for _ in range(size)]
    sides = {
        (min(a, b), max(a, b))
        for corners in Delaunay(points).simplices.tolist()
        for a, b in itertools.combinations(corners, 2)
    }
    for a, b in sorted(sides):
        if chance.random() < 0.8:
            yield a, b
            if chance.random() < 0.2:
                yield b, a


def _random(size: int, count: int, seed: int) -> Pairs:
    """A random tree from the first state, and random operations until there are ``count``."""
    chance = random.Random(seed)
    found = {(chance.randrange(i), i): None for i in range(1, size)}
    while len(found) < count:
        pair = chance.randrange(size), chance.randrange(size)
        if pair[0] != pair[1]:
            found[pair] = None
    return found


def _grid(rows: int, columns: int) -> Pairs:
    for row, column in itertools.product(range(rows), range(columns)):
        at = row * columns + column
        if column + 1 < columns:
            yield at, at + 1
        if row + 1 < rows:
            yield at, at + columns


def _layers(layers: int, each: int) -> Pairs:
    chance = random.Random(layers)
    for layer, place in itertools.product(range(layers - 1), range(each)):
        for other in chance.sample(range(each), 2):
            yield layer * each + place, (layer + 1) * each + other


def _table(size: int, pairs: Pairs, seed: int) -> dict[str, dict[str, str]]:
    """States and operations with names of ordinary length."""
    chance = random.Random(seed)
    words = ("Move", "Plan", "Check", "Clear", "Fix", "Open", "Register", "Take", "Digitize")
    things = ("Tool", "Clamp", "Pose", "Landmark", "Tracker", "Drape")
    table: dict[str, dict[str, str]] = {f"State_{i:02d}": {} for i in range(size)}
    for number, (a, b) in enumerate(pairs):
        operation = f"Op_{chance.choice(words)}{chance.choice(things)}{number}"
        table[f"State_{a:02d}"][operation] = f"State_{b:02d}"
    return table


def _blueprint(table: dict[str, dict[str, str]]) -> Blueprint:
    text = json.dumps({"SB": {"HEADER": {"INITIAL": next(iter(table))}, **table}})
    return read_blueprint(parse_json(text, "graph.json"))
