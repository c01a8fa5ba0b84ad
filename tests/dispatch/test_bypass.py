"""A run reports before it uses an edge with ``subs: load``."""

from __future__ import annotations

from tests.dispatch.runs import Story, blueprint, branch, sample

MADE = blueprint(
    {
        "A": branch(
            {"0": "up>1, load>1", "1": "drop>0"},
            activating="1",
            subs={"B": 0},
            facts={"0": {"name": "Landmarks"}},
            operations={
                "up": {"cost": 0},
                "load": {"subs": "load", "title": "Use the last ones", "cost": 0.5},
                "drop": {"subs": "load"},
            },
        ),
        "B": branch({"0": "b>1", "1": ""}, activating="1", subs={"C": 0}),
        "C": branch({"0": "c>1", "1": ""}, activating="1"),
        "D": branch({"0": "d>1", "1": ""}, activating="1"),
    }
)
SENTENCE = (
    "Goes by Use the last ones: it sets Landmarks of A by itself, and no operation of B and C "
    "is carried out."
)


def test_a_route_that_loads_says_so_before_anything_moves() -> None:
    story = Story(MADE, goals=["A/State1"]).run()
    (told,) = story.of("subs_bypassed")
    assert (told.address, told.subs, told.sentence) == ("A/State0/load", ("B", "C"), SENTENCE)
    words = story.words
    assert words.index("route_planned") < words.index("subs_bypassed")
    assert words.index("subs_bypassed") < words.index("operation_started")
    assert story.end.reason == "goal_reached"


def test_a_later_leg_that_loads_is_told_with_the_first_route_and_once() -> None:
    story = Story(MADE, goals=["D/State1", "A/State1"]).run()
    assert [one.goal for one in story.of("route_planned")] == ["A/State1", "D/State1"]
    assert len(story.of("subs_bypassed")) == 1


def test_what_a_person_asks_for_is_told_each_time() -> None:
    story = Story(MADE, automatic=False).tick().ask("load", "drop", "load")
    told = [one.address for one in story.of("subs_bypassed")]
    assert told == ["A/State0/load", "A/State1/drop", "A/State0/load"]
    assert story.started == told


def test_a_refused_one_is_not_told() -> None:
    story = Story(MADE, automatic=False, avoid=["A/State0/load"]).tick().ask("load")
    assert story.reasons
    assert not story.of("subs_bypassed")


def test_a_route_that_drives_its_subs_says_nothing() -> None:
    story = Story(MADE, goals=["A/State1"], avoid=["A/State0/load"]).run()
    assert story.end.reason == "goal_reached"
    assert not story.of("subs_bypassed")
    assert not Story(sample("hanoi")).run().of("subs_bypassed")


def test_the_status_says_it_as_long_as_it_lies_ahead() -> None:
    story = Story(MADE, goals=["D/State1", "A/State1"], attended=True).tick()
    assert notes(story) == [SENTENCE]
    while not story.commits:
        story.tick()
    assert notes(story) == []


def notes(story: Story) -> list[str]:
    return list(story.dispatcher.status.notes)
