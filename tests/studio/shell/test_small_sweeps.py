"""The window's collector looks at few objects at a time, and forgets no garbage."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator, Mapping

import pytest
from PySide6.QtCore import QObject

from smsl_studio.studio.shell.sweeper import MANY, YOUNG, Sweeper

pytestmark = pytest.mark.usefixtures("qapp")

ENOUGH = YOUNG + 100
"""New objects that are worth a collection, even if a thread of the tests frees some meanwhile."""


class _Ring:
    """An object that holds itself, so only the collector frees it."""

    def __init__(self) -> None:
        self.me = self


@pytest.fixture
def sets_nothing_aside() -> None:
    """Here objects are set aside, because this is what is tested."""


@pytest.fixture
def looks() -> Iterator[list[int]]:
    """The number of objects that each collection had to look at."""
    seen: list[int] = []

    def look(phase: str, info: Mapping[str, int]) -> None:
        """Count the objects of the generations that are looked at."""
        if phase == "start":
            generations = range(info["generation"] + 1)
            seen.append(sum(len(gc.get_objects(one)) for one in generations))

    enabled = gc.isenabled()
    gc.disable()
    gc.collect()
    gc.freeze()
    gc.callbacks.append(look)
    yield seen
    gc.callbacks.remove(look)
    gc.unfreeze()
    gc.collect()
    gc.freeze()
    if enabled:
        gc.enable()


def _many(count: int) -> list[list[int]]:
    return [[] for _ in range(count)]


def test_no_collection_looks_at_many_objects(looks: list[int]) -> None:
    owner = QObject()
    sweeper = Sweeper(owner)
    kept = []
    for _ in range(30):
        kept.append(_many(ENOUGH))
        assert sweeper.sweep()
    assert len(looks) == 30
    assert max(looks) < 2 * MANY < sum(map(len, kept))


def test_few_new_objects_are_not_worth_a_collection(looks: list[int]) -> None:
    owner = QObject()
    assert not Sweeper(owner).sweep()
    assert looks == []


def test_garbage_is_freed_soon(looks: list[int]) -> None:
    owner = QObject()
    sweeper, ring = Sweeper(owner), _Ring()
    gone = weakref.ref(ring)
    del ring
    kept = _many(ENOUGH)
    sweeper.sweep()
    assert gone() is None
    assert kept


def test_garbage_among_what_was_set_aside_is_freed_when_all_is_looked_at(looks: list[int]) -> None:
    owner = QObject()
    sweeper, ring = Sweeper(owner), _Ring()
    gone = weakref.ref(ring)
    kept = _many(MANY + 1)
    sweeper.sweep()
    del ring
    kept += _many(MANY + 1)
    sweeper.sweep()
    assert gone() is not None
    sweeper.sweep_all()
    assert gone() is None


def test_nothing_is_looked_at_twice_for_nothing(looks: list[int]) -> None:
    owner = QObject()
    sweeper = Sweeper(owner)
    sweeper.sweep_all()
    assert looks == []
