"""Rules from blueprints: the time, the cases, and 200 seeded mistakes of each kind in each family.

Registration cannot be undone everywhere, so nothing is promised of it.
"""

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
from tests.generate.seeded_mistakes import KINDS, Kind, mistaken

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
            for kind in KINDS:
                missed, tried = _missed(table, kind)
                bound = "0" if kind in ("deleted", "elsewhere") and name != "registration" else ""
                yield Row(f"{tried} edges {kind} in {name}", missed, "missed", bound=bound)


def _families() -> Iterator[tuple[str, Blueprint]]:
    for disks in range(1, 6):
        yield f"Hanoi {disks}", hanoi(disks)
    for name in ("river", "chess", "registration"):
        made = smsl.generate_rules(samples_dir() / "rules" / f"{name}.toml")
        yield name, made.blueprint
    for name, make in FAMILIES.items():
        yield name, read_blueprint(parse_json(write_json(make()), "family.json"))


def _missed(table: ExampleTable, kind: Kind) -> tuple[int, int]:
    """Return in how many tables with one mistake something else than this mistake is repaired, and
    the number of tables."""
    edges = set(table.all_edges())
    seeds = (random.Random(f"{kind} {seed}") for seed in range(MISTAKES))
    tables = [one for rng in seeds if (one := mistaken(table, kind, rng)) is not None]
    return sum(set(repaired(one).all_edges()) != edges for one in tables), len(tables)
