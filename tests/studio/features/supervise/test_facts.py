"""The state check in Supervise: believed and sensed values, and the written form."""

from __future__ import annotations

from dataclasses import replace

import pytest

from smsl_studio.blueprint.check import Reading, Scene, state_check
from smsl_studio.front.views.freshness import bars
from smsl_studio.monitor.aggregate import SourceValue
from smsl_studio.monitor.facts import SourceState
from smsl_studio.studio.features.supervise.facts import check_view, sensed_marks
from tests.front.views.statuses import at, sample, scene, status

SAMPLE = sample("registration-digitization.json")
HERE = {"REGISTRATION": "State110", "DIGITIZATION": "State1"}


def _scene(
    landmarks: str | None = "1", registered: str | None = "0", all_: str | None = "1"
) -> Scene:
    return scene(REGISTRATION_0=landmarks, REGISTRATION_2=registered, DIGITIZATION_0=all_)


@pytest.mark.parametrize(
    ("found", "verdict", "qualities"),
    [
        (_scene(), "True", ["agrees", "agrees", "agrees"]),
        (_scene(registered="1"), "Not true", ["agrees", "agrees", "differs"]),
        (_scene(landmarks=None), "Unknown", ["unknown", "agrees", "agrees"]),
        (_scene(all_=None), "Unknown", ["agrees", "unknown", "agrees"]),
        (_scene(all_="0"), "Not true", ["agrees", "differs", "agrees"]),
    ],
)
def test_the_verdict_and_each_fact(found: Scene, verdict: str, qualities: list[str]) -> None:
    view = check_view(SAMPLE, status(HERE, scene=found), "REGISTRATION")
    assert view is not None
    assert (view.state, view.verdict) == ("State110", verdict)
    assert [row.quality for row in view.rows] == qualities
    assert [row.believed for row in view.rows] == ["1", "1", "0"]


def test_a_fact_that_a_sub_sb_expands_says_where_that_stands() -> None:
    view = check_view(SAMPLE, status(HERE, scene=_scene()), "REGISTRATION")
    assert view is not None
    sub = view.rows[1]
    assert (sub.words, sub.sub, sub.age) == ("DIGITIZATION in State1", True, 0.02)


def test_unknown_says_why_and_is_never_shown_as_a_value() -> None:
    view = check_view(SAMPLE, status(HERE, scene=_scene(landmarks=None)), "REGISTRATION")
    assert view is not None
    assert (view.rows[0].sensed, view.rows[0].words) == (None, "no reading for 1.2 s")


def test_the_paper_s_form_with_every_term() -> None:
    view = check_view(SAMPLE, status(HERE, scene=_scene(registered="1")), "REGISTRATION")
    assert view is not None
    assert view.written == "C_State110 := lambda s: [f1(s), f2(s), f3(s)]"
    assert "f3(s): false, Registered reads 1, not 0" in view.terms.splitlines()


def test_what_moves_is_awaited_and_not_yet_known() -> None:
    running = at("REGISTRATION/State110/Registered")
    here = _scene()
    check = state_check(SAMPLE, "REGISTRATION", "State111", here, HERE)
    moving = status(HERE, phase="running", running=running, scene=here, check=check)
    view = check_view(SAMPLE, moving, "REGISTRATION")
    assert view is not None
    assert (view.state, view.verdict, view.awaited) == ("State111", "Not yet known", True)
    assert (view.rows[2].quality, view.rows[2].words) == ("transit", "moving, expects 1")
    assert sensed_marks(SAMPLE, moving, "REGISTRATION") == ()


def test_of_a_lost_world_nothing_is_known() -> None:
    view = check_view(SAMPLE, status(HERE, scene=_scene()), "REGISTRATION", lost=True)
    assert view is not None
    assert view.verdict == "Unknown"
    assert {row.sensed for row in view.rows if not row.sub} == {None}


def test_what_is_sensed_otherwise_is_marked_on_the_state() -> None:
    found = status(HERE, scene=_scene(landmarks=None, registered="1"))
    assert sensed_marks(SAMPLE, found, "REGISTRATION") == ((0, "unknown"), (2, "differs"))
    assert sensed_marks(SAMPLE, replace(found, configuration={}), "REGISTRATION") == ()


def _aged(age: float, *read: tuple[str, str]) -> tuple[int, str]:
    """The bars and the words of a fact of that age (s), and what each source reads."""
    fact = ("REGISTRATION", 2)
    aged = Scene({**_scene().readings, fact: Reading("0", "", age)}, 60.0)
    sources = tuple(
        SourceState(fact, SourceValue(name, value, "", age), None, 0.0, 1, 0, 0, 0.3)
        for name, value in read
    )
    view = check_view(SAMPLE, status(HERE, scene=aged, sources=sources), "REGISTRATION")
    assert view is not None
    row = view.rows[2]
    return bars(row.age, row.limit), row.words


def test_bars_show_age_against_limit_and_words_say_who_agrees() -> None:
    both = ("tracker A", "0"), ("tracker B", "0")
    assert _aged(0.012, *both) == (4, "tracker A, tracker B agree")
    assert _aged(0.1, *both) == (3, "tracker A, tracker B agree")
    assert _aged(0.212, *both) == (2, "tracker A, tracker B agree, limit 300 ms")
    assert _aged(0.3, both[0]) == (1, "tracker A, limit 300 ms")
    assert _aged(0.012, both[0], ("tracker B", "1")) == (4, "tracker A; not tracker B")


def test_a_person_s_answer_has_no_limit_of_a_sensor_that_does_not_count() -> None:
    fact = ("REGISTRATION", 2)
    aged = Scene({**_scene().readings, fact: Reading("0", "", 5.0)}, 60.0)
    sensor = SourceState(fact, SourceValue("table", "0", "", 0.05), None, 0.0, 1, 0, 0, 0.3)
    person = SourceState(
        fact, SourceValue("A. Okafor", "0", "", 5.0, human=True), None, 0.0, 0, 0, 0
    )
    found = status(HERE, scene=aged, sources=(sensor, person))
    view = check_view(SAMPLE, found, "REGISTRATION")
    assert view is not None
    row = view.rows[2]
    assert (row.limit, row.words) == (None, "A. Okafor, table agree")


def test_no_age_is_claimed_where_none_is_known_and_no_limit_where_none_is_set() -> None:
    assert bars(None, 0.3) == 0
    assert bars(50.0, None) == 4


def test_what_nobody_said_yet_has_no_age() -> None:
    fact = ("REGISTRATION", 2)
    silent = Scene({**_scene().readings, fact: Reading(None, "nobody has answered yet")}, 60.0)
    view = check_view(SAMPLE, status(HERE, scene=silent), "REGISTRATION")
    assert view is not None
    assert (view.rows[2].age, view.rows[2].words) == (None, "nobody has answered yet")
