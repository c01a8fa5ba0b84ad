"""The three procedures that clinicians know: checked, shown, run by a script, and read."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.front.proof import prove
from smsl_studio.front.readings import reading
from smsl_studio.front.recovery import recoverability
from smsl_studio.inspection.inspect import inspect
from smsl_studio.shipped import samples_dir

CLINICAL = ("femoroplasty", "stimulation", "knee")
STATES = range(12, 41)


def _sample(name: str) -> smsl.Blueprint:
    return smsl.read(samples_dir() / f"{name}.json")


@pytest.mark.parametrize("name", CLINICAL)
def test_it_has_no_error_and_what_it_claims_is_shown(name: str) -> None:
    blueprint = _sample(name)
    assert blueprint.state_count in STATES
    assert not [one for one in inspect(blueprint) if one.severity.value == "E"]
    verdicts = prove(blueprint).verdicts
    assert len(verdicts) >= 6
    assert {one.verdict for one in verdicts} == {"holds"}
    assert all(one.path is not None and len(one.path) < 2 for one in recoverability(blueprint))


@pytest.mark.parametrize("name", CLINICAL)
def test_its_script_answers_all_questions_and_comes_to_the_goal(name: str) -> None:
    blueprint = _sample(name)
    script = smsl.read_script(samples_dir() / "scripts" / f"{name}.jsonl", blueprint)
    done = smsl.run(blueprint, script=script)
    assert (done.reason, done.left) == ("goal_reached", ())
    assert not [one for one in done.events if one.as_json().get("refused")]


@pytest.mark.parametrize("name", CLINICAL)
def test_its_reading_has_a_title_for_everything_and_no_open_point(name: str) -> None:
    told = reading(_sample(name))
    assert told.untitled.sentence == ""
    assert [line.heading for _, line in told.lines() if line.open_point] == []
    words = " ".join(words for _, line in told.lines() for words in line.words)
    assert "Op_" not in words
    assert "State_" not in words


@pytest.mark.parametrize("name", CLINICAL)
def test_it_says_that_it_is_an_example_and_where_it_comes_from(name: str) -> None:
    text = json.loads(Path(samples_dir() / f"{name}.json").read_text("utf-8"))["_comment"]
    assert text.startswith("An example, not medical advice: ")
    assert " After " in text
    assert text.endswith("Times, limits and roles are made up.")
