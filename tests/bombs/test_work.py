"""Twice the input takes about twice the work, counted in executed lines instead of seconds."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import FrameType
from typing import Any
from zlib import crc32

import pytest

from smsl_studio.blueprint.comparison import compare
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.merge import merge
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.ways import Ways
from smsl_studio.errors import StudioError
from smsl_studio.front.proof import prove
from smsl_studio.graph.hierarchy import cycles
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.effects import mislabelled
from smsl_studio.smsl.files import parse_bytes
from tests.bombs.table import BOMBS, BY_NAME, Bomb

SIZE = 3_000
"""Bytes of the smaller text."""
MOST = 2.3


@pytest.fixture(autouse=True)
def _small_caps(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is listed and compared up to a number is so from small sizes on."""
    monkeypatch.setattr("smsl_studio.inspection.selection.LISTED", 5)
    monkeypatch.setattr("smsl_studio.inspection.selection.LISTED_IN_ALL", 10)
    monkeypatch.setattr("smsl_studio.inspection.rules.words._MANY", 8)
    monkeypatch.setattr("smsl_studio.graph.hierarchy.MOST_CYCLES", 3)


def steps(work: Callable[[], object]) -> int:
    """How many lines of Python are carried out; a line that loops counts each time round."""
    count = 0

    def on_line(frame: FrameType, event: str, arg: object) -> Any:
        nonlocal count
        count += event == "line"
        return on_line

    before = sys.gettrace()
    sys.settrace(on_line)
    try:
        work()
    except StudioError:
        pass
    finally:
        sys.settrace(before)
    return count


def read(bomb: Bomb, form: str, size: int) -> Blueprint:
    raw = bomb.sized(form, size).encode("utf-8", "surrogatepass")
    return read_blueprint(parse_bytes(raw, f"bomb.{form}"))


def growth(work: Callable[[int], object]) -> float:
    """By how much the work grows when the size doubles; 4 would be its square."""
    steps(lambda: work(SIZE // 8))  # what is loaded at the first use is no work
    return steps(lambda: work(2 * SIZE)) / max(steps(lambda: work(SIZE)), 2_000)


def share(form_of: int) -> list[Any]:
    """Every bomb in one of its forms; the bench takes them all."""
    chosen = ((b, b.forms[(crc32(b.name.encode()) + form_of) % len(b.forms)]) for b in BOMBS)
    return [pytest.param(bomb, form, id=f"{bomb.name}-{form}") for bomb, form in chosen]


@pytest.mark.parametrize(("bomb", "form"), share(0))
def test_reading_and_inspecting(bomb: Bomb, form: str) -> None:
    assert growth(lambda size: inspect(read(bomb, form, size))) <= MOST


@pytest.mark.parametrize("bomb", [b for b in BOMBS if b.readable][::2], ids=lambda b: b.name)
def test_digests_and_differences(bomb: Bomb) -> None:
    def work(size: int) -> None:
        before, after = read(bomb, "json", size), read(bomb, "json", size * 9 // 10)
        digests(before)
        compare(before, after)

    assert growth(work) <= MOST


MERGED = ("states_in_a_ring", "unknown_subs", "small_sbs", "alike_states", "true_notes", "levels")


@pytest.mark.parametrize("name", MERGED)
def test_merging(name: str) -> None:
    """One side deletes the last tenth, in both roles."""

    def work(size: int) -> None:
        base, less = (read(BY_NAME[name], "json", part) for part in (size, size * 9 // 10))
        merge(base, base, less)
        merge(base, less, base)

    assert growth(work) <= MOST


Part = Callable[[Blueprint], object]


def every_sb(blueprint: Blueprint) -> None:
    for branch in blueprint:
        blueprint.place(branch.address, "HEADER", "SUB_SBS")


def every_slip(blueprint: Blueprint) -> None:
    for branch in blueprint:
        mislabelled(branch)


def every_way_up(blueprint: Blueprint) -> None:
    hierarchy = Hierarchy(blueprint)
    for name in hierarchy.order:
        hierarchy.roots_of(name)


def every_level(blueprint: Blueprint) -> None:
    levels = Levels(blueprint)
    for branch in blueprint:
        levels.people_do(branch.name)


def every_lone_way(blueprint: Blueprint) -> None:
    hierarchy = Hierarchy(blueprint)
    bound = frozenset(edge.address for branch in blueprint for edge in branch.edges())
    stepper, ways = Stepper(hierarchy, Terms(bound=bound)), Ways(hierarchy)
    start = start_configuration(hierarchy, {})
    for branch in blueprint:
        assert ways.way(stepper, start, branch.name, [branch.activating]) is not None


def every_edge(blueprint: Blueprint) -> None:
    edges = Edges(Hierarchy(blueprint))
    for branch in blueprint:
        assert all(edges.get(edge.address) for edge in branch.edges())


PARTS: list[tuple[str, str, Part]] = [
    ("small_sbs", "smsl", every_sb),
    ("small_sbs", "json", every_sb),
    ("small_sbs", "yaml", every_sb),
    ("mislabelled", "json", every_slip),
    ("paired_sbs", "json", every_way_up),
    ("shared_sub", "json", lambda b: Hierarchy(b).roots_of("B0")),
    ("sub_chain", "json", lambda b: (cycles(b), Hierarchy(b))),
    ("sub_cycles", "json", cycles),
    ("levels", "json", every_level),
    ("unknown_subs", "json", lambda b: inspect(b, ["R07"])),
    ("listed_subs", "json", lambda b: inspect(b, ["R07"])),
    ("conditional", "json", lambda b: inspect(b, ["R16"])),
    ("unreachable_ring", "json", lambda b: inspect(b, ["R10"])),
    ("trap", "json", lambda b: inspect(b, ["R11"])),
    ("careful_sbs", "json", every_lone_way),
    ("operations_of_one_state", "json", every_edge),
    ("hazards_of_states", "json", prove),
    ("hazards_of_states", "json", guard_hazards),
]


@pytest.mark.parametrize(("name", "form", "part"), PARTS)
def test_a_part_by_itself(name: str, form: str, part: Part) -> None:
    """What once took the square of its size, counted without the reading before it."""

    def count(size: int) -> int:
        blueprint = read(BY_NAME[name], form, size)
        return steps(lambda: part(blueprint))

    count(SIZE)
    assert count(16 * SIZE) <= MOST * count(8 * SIZE)
