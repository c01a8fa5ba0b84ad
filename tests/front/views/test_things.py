"""Which things of a world a fact is about: told by names alone."""

from __future__ import annotations

import smsl_studio as smsl
from smsl_studio.front.views.things import changes_of, facts_of_things
from smsl_studio.shipped import plugins_dir
from tests.front.views.statuses import sample

RIVER = smsl.read(plugins_dir() / "river" / "river.json")


def test_a_thing_belongs_to_the_facts_whose_sources_begin_with_its_name() -> None:
    sources = [(("SB1", 0), "disk_1_peg"), (("SB1", 1), "disk_2_peg"), (("SB1", 2), "disk_11_peg")]
    things = ["disk_1", "disk 2", "peg_a", "disk_1", "panda_link0"]
    found = facts_of_things(sample("hanoi-corrected.json"), sources, things)
    assert found == {"disk_1": {("SB1", 0)}, "disk 2": {("SB1", 1)}}


def test_else_to_the_facts_that_operations_with_its_name_change() -> None:
    things = ["sheep", "wolf", "boat", "red_land", "table"]
    found = facts_of_things(RIVER, [(("SB1", 0), "item_1_place")], things)
    assert found == {"sheep": {("SB1", 1)}, "wolf": {("SB1", 3)}}, "a boat carries all of them"
    registration = sample("registration.json")
    found = facts_of_things(registration, (), ["landmark 1", "phantom"])
    assert ("REGISTRATION", 1) in found["landmark 1"]
    assert "phantom" not in found


def test_two_states_differ_in_facts() -> None:
    assert changes_of(RIVER, "SB1", "State_0000", "State_0B00") == {("SB1", 1)}
    assert changes_of(RIVER, "SB1", "State_0000", "State_0000") == frozenset()
