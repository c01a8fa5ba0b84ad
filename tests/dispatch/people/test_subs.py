"""People below a base SB: human operations and facts of a sub-SB inside a joint step."""

from __future__ import annotations

from tests.dispatch.people.tasks import Attended
from tests.dispatch.runs import sample, short


def names(story: Attended) -> tuple[str, str]:
    """The rise of the base on the route, and the sub's operation that it brings along."""
    rise = next(a for a in story.started if a.startswith("REGISTRATION") and "Digitized" in a)
    below = next(a for a in story.started if a.startswith("DIGITIZATION"))
    return rise, below


def plain() -> tuple[str, str]:
    story = driven({}).run()
    assert story.end.reason == "goal_reached"
    return names(story)


def driven(levels: dict[str, str]) -> Attended:
    made = sample("registration-digitization")
    avoid = [
        str(edge.address) for edge in made["REGISTRATION"].edges() if edge.name == "UsePrevRegister"
    ]
    return Attended(made, levels=levels, avoid=avoid)


def test_a_person_digitizes_and_base_and_sub_commit_together() -> None:
    rise, below = plain()
    story = driven({below: "human"}).run()
    assert story.asked == [("operation", below)]
    status = story.dispatcher.status
    assert str(status.running) == below
    assert status.configuration["DIGITIZATION"] != story.blueprint["DIGITIZATION"].activating
    story.say("done")
    assert story.end.reason == "goal_reached"
    together = next(ones for ones in story.commits if below in ones)
    assert rise in together


def test_a_persons_fact_below_decides_the_digit_above() -> None:
    rise, below = plain()
    story = driven({"DIGITIZATION/0": "human"})
    assert story.asked == [("fact", "DIGITIZATION/0")], "the base's digit hangs on it"
    story.say("0")
    assert story.asked == [("fact", "DIGITIZATION/0")] * 2
    story.say("0")
    assert story.configuration["DIGITIZATION"] == story.blueprint["DIGITIZATION"].initial
    assert {event.address for event in story.of("operation_risky")} == {below, rise}


def test_a_rise_has_nothing_of_its_own_that_a_person_could_do() -> None:
    rise, _ = plain()
    story = driven({rise: "human"}).run()
    assert story.asked == []
    assert story.end.reason == "goal_reached"


def test_all_of_a_joint_step_is_confirmed_before_any_of_it_moves() -> None:
    rise, below = plain()
    story = driven({rise: "shared", below: "shared"}).run()
    assert sorted(story.asked) == sorted([("confirm", rise), ("confirm", below)])
    assert short(story.started) == short(story.started[:1])
    first, second = story.tasks
    story.say("confirm", task=first.name)
    assert below not in story.started
    story.say("confirm", task=second.name)
    assert below in story.started
    assert story.end.reason == "goal_reached"


def test_one_no_withdraws_the_other_questions() -> None:
    rise, below = plain()
    story = driven({rise: "shared", below: "shared"}).run()
    story.say("refuse", task=story.tasks[1].name)
    assert sorted(story.outcomes) == [("answered", "refuse"), ("withdrawn", "")]
    assert story.phase == "fault_hold"
    assert below not in story.started
