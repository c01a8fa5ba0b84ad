"""The table world: it writes and reads facts, and nothing moves in it."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.world.table import TableWorld

Facts = dict[tuple[str, int], str]
FACTS = st.dictionaries(st.tuples(st.text(), st.integers(0, 9)), st.text())


@given(FACTS, FACTS)
def test_what_is_written_is_read_and_the_rest_stays(first: Facts, second: Facts) -> None:
    world = TableWorld()
    world.set_facts(first)
    world.set_facts(second)
    for (branch, digit), value in {**first, **second}.items():
        assert world.fact(branch, digit) == value
    assert world.fact("nobody wrote this", 10) is None


@given(FACTS, FACTS, st.integers(0, 5))
def test_a_snapshot_brings_back_facts_and_time(first: Facts, second: Facts, ticks: int) -> None:
    world = TableWorld()
    world.set_facts(first)
    for _ in range(ticks):
        world.step()
    snapshot, copy = world.snapshot(), world.fork()
    world.set_facts(second)
    world.step()
    world.apply(snapshot)
    for one in (world, copy):
        assert one.snapshot() == snapshot
        assert one.time == ticks * one.tick


def test_a_copy_goes_its_own_way() -> None:
    world = TableWorld("shelf")
    copy = world.fork()
    copy.set_facts({("SB", 0): "1"})
    copy.step()
    assert (world.fact("SB", 0), world.time, copy.name) == (None, 0.0, "shelf")


def test_there_is_nothing_to_see_or_to_hold() -> None:
    world = TableWorld()
    world.brake()
    world.close()
    world.close()
    assert (world.shapes(), world.poses(), dict(world.status())) == ((), (), {})
