"""Physics explored whole: Hanoi with 3 and 4 disks, registration, river and chess, each against the
blueprint of its rules.

Each world is one row with its CPU time, in one process. The world registration binds several names
to one function, for several blueprints, and permits what its rules do not: to touch landmarks that
nobody has planned, for one.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import smsl_studio as smsl
from benches.row import Row
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.physics import against, generate_explore
from smsl_studio.shipped import samples_dir


def rows() -> Iterator[Row]:
    """Explore registration, which has few states."""
    yield from _explored("registration", "registration", "registration")


def all_rows() -> Iterator[Row]:
    """Explore all worlds. Alone on one core this takes about an hour."""
    yield from rows()
    yield from _explored("hanoi", "hanoi-3", "Hanoi 3")
    yield from _explored("hanoi", "hanoi-4", "Hanoi 4")
    yield from _explored("river", "river", "river")
    yield from _explored("chess", "chess", "chess")


def _explored(world: str, rules: str, name: str) -> Iterator[Row]:
    drawn = smsl.generate_rules(samples_dir() / "rules" / f"{rules}.toml").blueprint
    with TemporaryDirectory() as folder:
        yield _row(world, drawn, name, Path(folder))


def _row(world: str, drawn: Blueprint, name: str, kept: Path) -> Row:
    began = time.process_time()
    found = generate_explore(drawn, world, part=kept / f"{name}.part")
    spent = time.process_time() - began
    told = against(found.generated.blueprint, drawn, found.idle)
    edges = drawn.operation_count
    others = "" if world == "registration" else ", and no other"
    words = (
        f"explore {name}: {edges - len(told.missing)} of {edges} operations, "
        f"{len(told.false)} that the rules do not give"
    )
    return Row(words, spent, "CPU s", bound=f"all operations{others}")
