"""States keep their positions from edit to edit."""

from __future__ import annotations

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.studio.document.places import Places


def branch(*names: str) -> StateBranch:
    return StateBranch("SB", {name: {"go": names[0]} for name in names})


def test_states_that_are_renamed_all_at_once_keep_their_places() -> None:
    places = Places()
    before = places.of(branch("A", "B", "C", "D"))
    after = places.of(branch("A", "X", "Y", "D"))
    assert list(after.values()) == list(before.values())
    assert places.of(branch("A", "B", "C", "D")) == before
    swapped = places.of(branch("A", "C", "B", "D"))
    assert swapped == before


def test_a_state_that_takes_the_name_of_one_long_gone_keeps_its_own_place() -> None:
    places = Places()
    before = places.of(branch("A", "B", "C"))
    places.of(branch("A", "C"))
    assert places.of(branch("A", "B"))["B"] == before["C"]
