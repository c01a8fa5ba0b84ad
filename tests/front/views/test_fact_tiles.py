"""The facts of a run as tiles: values with their meaning, and what is wrong with them."""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.blueprint.check import Reading, Scene
from smsl_studio.front.views.fact_rows import fact_rows
from smsl_studio.front.views.fact_tiles import FactTile, fact_tiles
from smsl_studio.front.views.run_marks import operation_words
from tests.front.views.statuses import at, sample, status

FAILURES = sample("registration-failures.json")
HERE = {"REGISTRATION": "State_100"}


def _scene(*values: str | None) -> Scene:
    """A scene with these values; None is a fact without a reading."""
    found = {}
    for digit, value in enumerate(values):
        reason = "" if value else "no reading for 1.2 s"
        found["REGISTRATION", digit] = Reading(value, reason, 0.01)
    return Scene(found)


def _tiles(scene: Scene, **said: object) -> tuple[FactTile, ...]:
    return fact_tiles(FAILURES, fact_rows(FAILURES, status(HERE, scene=scene, **said)))


def test_a_tile_has_the_name_the_value_and_its_meaning() -> None:
    tiles = _tiles(_scene("1", "0", "0"))
    assert [tile.said for tile in tiles] == [
        "Landmarks planned: 1",
        "Landmarks digitized: 0 (no)",
        "Registered: 0 (no)",
    ]
    assert tiles[1].values == ("0", "1", "e")
    assert {tile.quality for tile in tiles} == {"agrees"}


def test_what_is_unknown_or_disagrees_is_plain() -> None:
    _, digitized, registered = _tiles(_scene("1", "e", None))
    assert digitized.said == (
        "Landmarks digitized: e (badly: a point is too far from the plan), the run believes no (0)"
    )
    assert (registered.shown, registered.quality) == ("?", "unknown")
    assert registered.said == "Registered: unknown, no reading for 1.2 s"


def test_a_fact_that_an_operation_changes_is_on_its_way() -> None:
    edge = next(
        edge for edge in FAILURES["REGISTRATION"].edges()
        if edge.source == "State_100" and edge.target == "State_110"
    )  # fmt: skip
    tiles = _tiles(_scene("1", "0", "0"), running=edge.address)
    assert [tile.target for tile in tiles] == ["", "1", ""]
    assert tiles[1].words == "moving to yes (1)"
    words = operation_words(FAILURES, status(HERE, running=edge.address))
    assert words == f"{edge.name}, from 100 to 110"


def test_the_tiles_of_several_branches_name_them_and_those_of_subs_follow() -> None:
    blueprint = sample("hfsm.json")
    here = status({"SB1": "State000", "SB2": "State0"}, route=(at("SB1/State000/Operation000"),))
    tiles = fact_tiles(blueprint, fact_rows(blueprint, here))
    assert [tile.group for tile in tiles] == ["SB1", "SB1", "SB1", "SB2"]
    assert "follows SB2, State0" in [tile.words for tile in tiles]
    assert operation_words(blueprint, here) == "Next: Operation000"
    assert operation_words(blueprint, replace(here, route=())) == ""
