"""Rules from blueprints: the time, the cases, and 200 seeded mistakes in each reversible family."""

from __future__ import annotations

import random
from collections.abc import Iterator

import smsl_studio as smsl
from benches.row import Row, median_ms
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.examples.mistakes import repaired
from smsl_studio.generate.examples.table import ExampleTable, examples_of
from smsl_studio.generate.rules import hanoi
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json, write_json
from tests.generate.families import FAMILIES

MISTAKES = 200
_LARGEST = 1_000


def rows() -> Iterator[Row]:
    """The time to learn, and the mistakes of each family that were not repaired."""
    for disks in (4, 6):
        blueprint = hanoi(disks)
        learnt = smsl.learn(blueprint)
        work = f"learn Hanoi {disks}, {learnt.cases} cases"
        yield Row(work, median_ms(lambda one=blueprint: smsl.learn(one), runs=3))  # type: ignore[misc]
    for name, blueprint in _families():
        table = examples_of(blueprint)
        if table.count <= _LARGEST:
            missed = sum(not _found(table, seed) for seed in range(MISTAKES))
            yield Row(f"{MISTAKES} mistakes in {name}", missed, "missed", bound="0")


def _families() -> Iterator[tuple[str, Blueprint]]:
    for disks in range(1, 6):
        yield f"Hanoi {disks}", hanoi(disks)
    for name in ("river", "chess", "registration"):
        made = smsl.generate_rules(samples_dir() / "rules" / f"{name}.toml")
        yield name, made.blueprint
    for name, make in FAMILIES.items():
        yield name, read_blueprint(parse_json(write_json(make()), "family.json"))


def _found(table: ExampleTable, seed: int) -> bool:
    """Return whether one edge that is gone or leads elsewhere is repaired, and nothing else."""
    rng = random.Random(seed)
    edges = set(table.all_edges())
    edge = rng.choice(sorted(edges))
    others = [values for values in table.states if values != edge.target]
    target = None if rng.random() < 0.5 else rng.choice(others)
    return set(repaired(table.with_edge(edge.operation, edge.source, target)).all_edges()) == edges
