"""Commands and answers given while a run is paused, settles or asks for its state are not lost."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.drive.supervisor import ALLOW, ASK, PAUSE, Proposal, Verdict
from tests.dispatch.fake_host import FakeHost, Fault
from tests.dispatch.people.tasks import Attended
from tests.dispatch.runs import Story, blueprint, branch, sample
from tests.dispatch.supervision.runs import (
    FIRST,
    facts_of,
    fault_hold,
    hanoi,
    paused,
    said,
    stopped,
    taken_over,
)

CONFIRMED = blueprint(
    {
        "SB": branch(
            {"0": "go>1, alt>2", "1": "", "2": "x>1"},
            activating="1",
            operations={"go": {"confirm": ["surgeon"]}},
        )
    }
)
NESTED = blueprint(
    {
        "A": branch(
            {"00": "go>01", "01": "done>11", "11": ""},
            initial="00",
            activating="11",
            subs={"B": 1},
        ),
        "B": branch({"0": "u>2", "2": "v>1", "1": "d>0"}, initial="0", activating="1"),
    }
)
PEOPLE = blueprint(
    {
        "HEAD": branch(
            {"0": "fix>1", "1": "free>0"},
            activating="1",
            facts={"0": {"aggregation": "human"}},
            operations={"fix": {"actor": "human"}},
        ),
        "R": branch({"0": "go>1, alt>2", "1": "", "2": "x>1"}, activating="1"),
    }
)
ALT = Address("SB", "State0", "alt")


class Agent:
    """Says what it was told to say, then allows."""

    name = "agent"

    def __init__(self, *verdicts: object) -> None:
        self._verdicts = list(verdicts)

    def review(self, proposal: Proposal) -> Verdict:
        said = self._verdicts.pop(0) if self._verdicts else Verdict(ALLOW)
        if isinstance(said, Exception):
            raise said
        return said  # type: ignore[return-value]


# a pause ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("pruned", [False, True])
def test_what_is_asked_for_while_a_question_is_paused_is_carried_out(pruned: bool) -> None:
    story = Attended(CONFIRMED).tick(2)
    said(story, "pause")
    assert story.tasks
    if pruned:
        said(story, "prune", Address("SB", "State0", "go"), "bent")
    assert not said(story, "ask", ALT).refused
    story.run()
    assert (story.phase, story.configuration) == ("paused", {"SB": "State2"})
    assert story.outcomes == [("withdrawn", "")]
    assert story.words.index("task_closed") < story.words.index("operation_started")


def test_a_refused_question_leaves_the_paused_one_paused() -> None:
    story = Attended(CONFIRMED).tick(2)
    said(story, "pause")
    assert said(story, "ask", Address("SB", "State1", "go")).refused
    assert (story.phase, len(story.tasks)) == ("paused", 1)


def test_a_step_that_is_paused_in_the_middle_can_be_stepped_on() -> None:
    story = paused()
    said(story, "step")
    said(story, "pause")
    assert not said(story, "step").refused
    assert story.run().phase == "paused"
    assert len(story.commits) == 2


def test_a_step_that_ends_in_a_pause_tells_it_once() -> None:
    story = hanoi(host={"stop": "finish"})
    said(story, "pause")
    story.run()
    said(story, "step")
    said(story, "pause")
    before = story.words.count("paused")
    assert story.run().phase == "paused"
    assert story.words.count("paused") == before + 1


def test_a_step_that_an_agent_pauses_can_be_stepped_again() -> None:
    story = hanoi(supervisor=Agent(Verdict(PAUSE, "look first")))
    said(story, "pause")
    said(story, "step")
    assert (story.phase, story.started) == ("paused", [])
    assert not said(story, "step").refused
    story.run()
    assert (story.phase, len(story.commits)) == ("paused", 1)


def test_what_people_confirmed_in_a_pause_begins_on_what_is_sensed_after_it() -> None:
    story = Attended(CONFIRMED, FakeHost(CONFIRMED)).tick(2)
    said(story, "pause")
    story.dispatcher.answer("", "confirm", "surgeon", by="Ann")
    story.tick()
    facts_of(story)["SB", 0] = "2"
    said(story, "resume")
    story.run()
    assert story.started == []
    assert story.phase == "fault_hold"


@pytest.mark.parametrize(
    ("where", "first", "second"),
    [
        (paused, "pause", "resume"),
        (paused, "pause", "step"),
        (stopped, "stop", "reset"),
        (taken_over, "take_over", "give_back"),
        (fault_hold, "pause", "resume"),
    ],
)
def test_whoever_wants_it_to_stand_counts_more_also_where_it_stands_already(
    where: Callable[[], Story], first: str, second: str
) -> None:
    story = where()
    phase = story.phase
    getattr(story.dispatcher, first)(by="Bo")
    answer = said(story, second, by="Ann")
    assert answer.refused == f"{first.replace('_', ' ')} came at the same tick and counts more"
    assert story.phase == phase


def asked_out_of_a_hold() -> Attended:
    """No route leads on; a person asks for an operation that another one must confirm."""
    made = blueprint(
        {
            "SB": branch(
                {"0": "go>1, alt>2", "1": "", "2": ""},
                activating="1",
                operations={"alt": {"confirm": ["surgeon"]}},
            )
        }
    )
    story = Attended(made, avoid=["SB/State0/go"]).tick(2)
    assert story.phase == "no_route"
    said(story, "ask", ALT)
    return story


def test_a_pause_of_what_was_asked_out_of_a_hold_lets_nothing_begin() -> None:
    story = asked_out_of_a_hold()
    said(story, "pause")
    assert story.phase == "paused"
    story.dispatcher.answer("", "confirm", "surgeon", by="Ann")
    story.tick(3)
    assert (story.phase, story.started) == ("paused", [])
    said(story, "resume")
    story.run()
    assert story.started == [str(ALT)]


def test_while_people_are_asked_out_of_a_hold_that_is_what_is_told_and_offered() -> None:
    story = asked_out_of_a_hold()
    status = story.dispatcher.status
    assert status.sentence == "Waiting for an answer: alt: may it begin?"
    assert status.offers == ()
    said(story, "answer", "", "refuse", "surgeon", by="Ann")
    assert story.phase == "no_route"
    assert "end" in [offer.command for offer in story.dispatcher.status.offers]


def test_who_takes_a_run_by_hand_takes_back_what_the_route_proposed() -> None:
    story = Attended(CONFIRMED).tick(2)
    said(story, "set_automatic", False)
    assert (story.phase, story.tasks) == ("ready", ())
    said(story, "ask", Address("SB", "State0", "go"))
    said(story, "set_automatic", False)
    assert story.phase == "waiting"


# an agent -----------------------------------------------------------------------------------------


def test_a_pause_that_an_agent_wants_ends_a_run_that_nobody_attends() -> None:
    story = hanoi(attended=False, supervisor=Agent(Verdict(PAUSE, "look first"))).tick(3)
    assert story.end.event == "run_finished"
    assert story.end.reason == "held"
    assert story.end.sentence == f"agent wants a pause before {FIRST}: look first"


@pytest.mark.parametrize("wrong", [Verdict("deny"), ValueError("no model"), None])
def test_an_agent_that_fails_decides_nothing(wrong: object) -> None:
    story = hanoi(supervisor=Agent(wrong))
    story.run()
    assert story.phase == "waiting"
    assert story.dispatcher.status.tasks[0].kind == "supervise"
    assert story.started == []
    unattended = hanoi(attended=False, supervisor=Agent(wrong)).tick(3)
    assert unattended.end.reason == "held"
    assert unattended.started == []


@pytest.mark.parametrize(
    "ways",
    [
        ("resume",),
        ("take_over", "give_back", "accept", "resume"),
        ("stop", "reset", "resume"),
    ],
)
def test_an_agent_that_asks_people_gets_no_yes_from_time_or_from_resume(
    ways: tuple[str, ...],
) -> None:
    story = hanoi(supervisor=Agent(*[Verdict(ASK, "is it clear?")] * 9)).tick(2)
    if ways == ("resume",):
        while story.phase == "waiting":
            story.tick()
        assert [event.outcome for event in story.of("task_closed")] == ["timed_out"]
    for word in ways:
        assert not said(story, word).refused
    story.tick(3)
    assert (story.phase, story.started) == ("waiting", [])


def test_a_pause_that_an_agent_wanted_is_not_over_for_who_took_over_since() -> None:
    agent = Agent(Verdict(PAUSE, "look first"), Verdict(PAUSE, "look again"))
    story = hanoi(supervisor=agent).tick(2)
    for word in ("take_over", "give_back", "accept", "resume"):
        said(story, word)
    story.tick(3)
    assert (story.phase, story.started) == ("paused", [])


# in the middle of a joint step --------------------------------------------------------------------


@pytest.mark.parametrize("held", [False, True])
def test_a_base_edge_pruned_while_its_sub_settles_moves_the_sub_no_further(held: bool) -> None:
    story = Story(NESTED, FakeHost(NESTED, lasts=2, settle=0.5), attended=True)
    while "operation_ended" not in story.words:
        story.tick()
    if held:
        said(story, "pause")
    said(story, "prune", Address("A", "State00", "go"), "bent")
    story.run()
    assert story.started == ["A/State00/go", "B/State0/u"]
    assert story.configuration["A"] == "State00"


@pytest.mark.parametrize("word", ["stop", "prune", "take_over"])
def test_what_a_load_was_bringing_about_below_is_unknown_where_it_is_cut_short(word: str) -> None:
    made = sample("registration-digitization")
    story = Story(made, FakeHost(made, lasts=4), attended=True, automatic=False).tick()
    edge = made.resolve("REGISTRATION/State000/UsePrevRegister")
    story.dispatcher.ask(edge)
    story.tick(2)
    said(story, word, *((edge, "bent") if word == "prune" else ()))
    doubted = {(one.branch, one.digit) for one in story.of("fact_changed") if one.value is None}
    assert doubted == {("REGISTRATION", 0), ("REGISTRATION", 2), ("DIGITIZATION", 0)}
    if word == "stop":
        said(story, "reset")
        assert story.of("reset")[0].unknown == (
            "DIGITIZATION/0",
            "REGISTRATION/0",
            "REGISTRATION/2",
        )


# where the procedure stands -----------------------------------------------------------------------


def unsure() -> Attended:
    """Somebody could not fix the head; the run asks whether it is fixed."""
    story = Attended(PEOPLE, FakeHost(PEOPLE)).tick()
    story.say("0")
    story.dispatcher.answer("", "could_not", by="Ann")
    story.tick()
    assert [task.kind for task in story.tasks] == ["fact"]
    return story


def test_a_prune_takes_back_no_question_about_where_it_stands() -> None:
    story = unsure()
    facts_of(story)["R", 0] = "2"
    said(story, "prune", Address("R", "State0", "alt"), "bent")
    assert [task.kind for task in story.tasks] == ["fact"]
    story.tick(5).say("0")
    assert story.phase == "fault_hold"
    assert story.dispatcher.status.candidates == ({"HEAD": "State0", "R": "State2"},)
    assert not said(story, "adopt").refused


def test_nothing_is_begun_by_hand_before_it_is_known_where_it_stands() -> None:
    story = unsure()
    said(story, "pause")
    answer = said(story, "ask", Address("R", "State0", "alt"))
    assert answer.refused == "people are being asked where the procedure stands"
    assert story.started == ["HEAD/State0/fix"]


def test_a_prune_takes_back_no_question_of_giving_back() -> None:
    story = Attended(PEOPLE, FakeHost(PEOPLE)).tick()
    story.say("0")
    said(story, "take_over")
    said(story, "give_back")
    said(story, "prune", Address("R", "State0", "alt"), "bent")
    story.say("0")
    assert not said(story, "accept").refused


def test_what_a_hold_offered_to_adopt_is_not_offered_by_the_next() -> None:
    story = fault_hold()
    said(story, "adopt")
    story.run()
    assert story.phase == "done"
    story = fault_hold()
    said(story, "adopt")
    said(story, "pause")
    for edge in [one.address for one in story.dispatcher.status.possible]:
        said(story, "prune", edge, "bent")
    said(story, "resume")
    story.run()
    assert story.phase == "no_route"
    assert story.dispatcher.status.candidates == ()


def test_what_was_adopted_by_itself_is_not_offered_afterwards() -> None:
    made = blueprint({"A": branch({"0": "go>1", "1": "", "2": "rec>0"}, activating="1")})
    elsewhere = FakeHost(made, faults={"A/State0/go": Fault(writes={("A", 0): "2"})})
    story = Story(made, elsewhere, attended=True, on_mismatch="adopt").run()
    assert story.phase == "fault_hold"
    status = story.dispatcher.status
    assert (status.configuration, status.candidates) == ({"A": "State2"}, ())
    assert "adopt" not in [offer.command for offer in status.offers]


def test_a_run_by_hand_that_nobody_asks_says_so() -> None:
    story = hanoi(automatic=False).tick()
    story.dispatcher.leave()
    story.tick()
    words = "The run is waiting to be asked, and nobody is there to go on with it."
    assert story.end.sentence == words


# words --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("wrong", [Address("SB1", "", ""), Address("SB1", "State_aaa", "")])
def test_what_is_no_operation_cannot_be_asked_for(wrong: Address) -> None:
    story = paused()
    assert said(story, "ask", wrong).refused == f"{wrong} is no operation"


@pytest.mark.parametrize(
    ("word", "said_so"),
    [
        ("veto", "A/State0/h: it is vetoed"),
        ("", "A/State0/f: no route uses it, it leads into a failure: Fact 1 would be f"),
        ("", "C/State0/z: possible, but no goal moves C"),
        ("", "A/State0/x: possible, but no way leads on from State2"),
    ],
)
def test_without_a_route_each_edge_says_what_is_true_of_it(word: str, said_so: str) -> None:
    made = blueprint(
        {
            "A": branch(
                {"0": "h>1, f>f, x>2", "f": "rec>0", "1": "", "2": ""},
                initial="0",
                activating="1",
                facts={"0": {"failure": ["f"]}},
            ),
            "C": branch({"0": "z>1", "1": ""}, activating="1"),
        }
    )
    avoid = [] if word else ["A/State0/h"]
    story = Story(made, attended=True, automatic=False, goals=["A/State1"], avoid=avoid).tick()
    if word:
        said(story, word)
    said(story, "set_automatic", True)
    assert story.run().phase == "no_route"
    assert said_so in story.dispatcher.status.details


# the end ------------------------------------------------------------------------------------------


def test_a_script_that_steps_to_the_goal_has_reached_it() -> None:
    story = hanoi()
    said(story, "pause")
    story.run()
    while story.configuration["SB1"] != "State_ccc":
        said(story, "step")
        story.run()
    assert story.phase == "paused"
    story.dispatcher.leave()
    story.tick()
    assert story.end.reason == "goal_reached"


def test_a_paused_run_whose_facts_say_otherwise_has_reached_nothing() -> None:
    story = hanoi(goals=["SB1/State_caa"])
    said(story, "pause")
    story.run()
    said(story, "step")
    story.run()
    facts_of(story)["SB1", 0] = "b"
    story.dispatcher.leave()
    story.tick()
    assert story.end.reason == "held"


@pytest.mark.parametrize("waits", ["paused", "waiting"])
def test_what_is_held_in_the_middle_is_cancelled_before_a_run_ends_that_nobody_attends(
    waits: str,
) -> None:
    if waits == "paused":
        story = hanoi().tick(3)
        said(story, "pause")
    else:
        story = Attended(PEOPLE, FakeHost(PEOPLE)).tick().say("0")
    story.dispatcher.leave()
    story.tick()
    assert story.end.reason == "held"
    assert len(story.started) == len(story.of("operation_ended"))
    assert story.of("operation_ended")[-1].outcome == "cancelled"


def test_a_veto_in_a_joint_step_says_what_it_is_part_of() -> None:
    story = Story(NESTED, FakeHost(NESTED, lasts=5), attended=True).tick(2)
    answer = said(story, "veto", Address("B", "State2", "v"))
    words = "too late, A/State00/go is being carried out, and B/State2/v is part of it"
    assert answer.refused == f"{words}; a stop ends it"
