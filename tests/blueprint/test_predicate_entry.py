"""Changes of a sensed fact's entry, and what may be typed into a predicate."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.editing import fact_entry as entry
from smsl_studio.blueprint.properties.predicate_offers import predicate_offers, unit_offers

NOTE = FactNote(
    sources={"force": "N", "tag drill": "m"},
    range={"force": (0.0, 50.0)},
    predicate={"0": "force < 1 N or age('tag drill') > 2 s", "1": "force >"},
)
SOURCES = {"force": "N", "gap": "mm", "tag drill": "m", "persons": "1"}


def test_a_renamed_source_is_renamed_in_all_that_can_be_read() -> None:
    assert entry.renamed_source(NOTE, "tag drill", "max") == {
        "sources": {"force": "N", "max": "m"},
        "range": {"force": [0.0, 50.0]},
        "predicate": {"0": "force < 1 N or age('max') > 2 s", "1": "force >"},
    }
    assert entry.renamed_source(NOTE, "force", "grip")["range"] == {"grip": [0.0, 50.0]}


def test_one_thing_changes_at_a_time() -> None:
    assert entry.with_unit(NOTE, "gap", "mm") == {
        "sources": {"force": "N", "tag drill": "m", "gap": "mm"}
    }
    assert entry.with_range(NOTE, "force", None) == {"range": None}
    assert entry.with_range(NOTE, "force", (0.5, 9.0)) == {"range": {"force": [0.5, 9]}}
    assert entry.with_predicate(NOTE, "1", "")["predicate"] == {"0": NOTE.predicate["0"]}  # type: ignore[index]
    assert entry.with_predicate(FactNote(predicate="held"), "1", "a > 1 N") == {
        "predicate": {"1": "a > 1 N"}
    }
    assert entry.without_source(NOTE, "force") == {"sources": {"tag drill": "m"}, "range": None}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("force > 2 kN and gap > 3 mm", None),
        ("force > 2 mm", "character 9: 2 mm is compared with a measure in N"),
        ("grip > 2 N", "character 1: 'grip' is no source of this fact"),
        ("force > 2 N for", "character 16: a number is expected, but the text ends there"),
    ],
)
def test_a_fault_is_told_with_its_place(text: str, words: str | None) -> None:
    found = entry.predicate_fault(text, SOURCES)
    assert (None if found is None else found.sentence) == words


@pytest.mark.parametrize(
    ("typed", "wanted"),
    [
        ("", ("force", "gap", "'tag drill'", "persons", "not")),
        ("fo", ("force",)),
        ("not 'tag", ("'tag drill'",)),
        ("gap ", ("<", ">", "<=", ">=")),
        ("gap > 2 ", ("mm", "m", "cm", "um")),
        ("age(gap) > 2 ", ("s", "ms", "min")),
        ("force > 2 N ", ("and", "or", "for")),
        ("persons >= 1 ", ("and", "or", "for")),
        ("force > 2 N for 1 ", ("s", "ms", "min")),
        ("force > 2 N", ()),
        ("distance(", ("force", "gap")),
        (("(" * 300) + "zz", ()),
    ],
)
def test_what_fits_is_offered(typed: str, wanted: tuple[str, ...]) -> None:
    found = predicate_offers(typed, len(typed), SOURCES)
    assert found.texts[: len(wanted)] == wanted
    assert bool(found.texts) == bool(wanted)


def test_units_are_offered_by_their_beginning() -> None:
    assert unit_offers("", 0).texts[:3] == ("mm", "m", "N")
    assert unit_offers("kP", 2).texts == ("kPa",)
    assert unit_offers("N", 1).texts == ()
