"""The supervisor is asked last, sees the partial view, and gives verdicts."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.dispatch.drive.supervisor import Proposal, Verdict
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.runs import Story, blueprint, branch, sample
from tests.dispatch.supervision.runs import FIRST, OTHER, calls, hanoi, said


class Agent:
    """Says what a function says; keeps what it was shown."""

    name = "Agent"

    def __init__(self, judge: Callable[[Proposal], Verdict]) -> None:
        self.judge = judge
        self.seen: list[Proposal] = []

    def review(self, proposal: Proposal) -> Verdict:
        self.seen.append(proposal)
        return self.judge(proposal)


def against_first(decision: str) -> Agent:
    def judge(proposal: Proposal) -> Verdict:
        no = proposal.operation == FIRST
        return Verdict(decision, "too steep") if no else Verdict("allow")

    return Agent(judge)


def told(story: Story, command: str) -> tuple[str, str, str]:
    (event,) = [one for one in story.of("commanded") if one.command == command]
    return event.by, event.address, event.reason


def test_it_sees_the_partial_view_of_a_step() -> None:
    values = {
        "BASE": branch({"0": "up>1", "1": ""}, subs={"SUB": 0}, operations={"up": {"risk": "low"}}),
        "SUB": branch({"0": "in>1", "1": ""}, operations={"in": {"risk": "high", "cost": 4}}),
    }
    agent = Agent(lambda proposal: Verdict("allow"))
    made = blueprint(values)
    story = Story(made, FakeHost(made), supervisor=agent).run()
    assert story.end.reason == "goal_reached"
    (seen,) = agent.seen
    assert str(seen.operation) == "BASE/State0/up"
    assert list(map(str, seen.operations)) == ["SUB/State0/in", "BASE/State0/up"]
    assert (seen.risk, seen.cost, seen.target) == ("high", 4.0, "State1")
    assert seen.configuration == {"BASE": "State0", "SUB": "State0"}


def test_it_is_asked_last_and_not_where_another_guard_says_no() -> None:
    agent = against_first("allow")
    story = hanoi(supervisor=agent, automatic=False, avoid=[str(FIRST)]).tick()
    said(story, "ask", FIRST)
    assert agent.seen == []


def test_a_veto_skips_the_edge_once() -> None:
    story = hanoi(supervisor=against_first("veto")).run()
    assert story.end.reason == "goal_reached"
    assert story.commits[0] == (str(OTHER),)
    assert told(story, "veto") == ("Agent", str(FIRST), "too steep")
    assert story.reasons == ["Agent says no: too steep"]


def test_vetoes_of_everything_end_in_no_route() -> None:
    agent = Agent(lambda proposal: Verdict("veto"))
    story = hanoi(supervisor=agent, attended=False).run()
    assert story.end.reason == "no_route"
    assert len(agent.seen) == 2
    assert not [call for call in calls(story) if "/" in call]


def test_a_prune_shuts_the_edge_out() -> None:
    story = hanoi(supervisor=against_first("prune")).run()
    assert story.of("operation_pruned")[0].address == str(FIRST)
    assert told(story, "prune") == ("Agent", str(FIRST), "too steep")
    assert story.end.reason == "goal_reached"
    assert (str(FIRST),) not in story.commits


def test_after_its_pause_a_person_lets_this_operation_begin() -> None:
    agent = against_first("pause")
    story = hanoi(supervisor=agent).run()
    assert (story.phase, story.commits) == ("paused", [])
    said(story, "resume", by="Brandt")
    assert story.run().end.reason == "goal_reached"
    assert story.commits[0] == (str(FIRST),)
    assert [one.operation for one in agent.seen].count(FIRST) == 1


def test_its_question_is_a_task_where_somebody_is_there_and_a_hold_else() -> None:
    story = hanoi(supervisor=against_first("ask"), attended=False).run()
    assert story.end.reason == "held"
    assert story.end.sentence == f"Agent asks about {FIRST}: too steep"
    story = hanoi(supervisor=against_first("ask")).tick()
    assert story.phase == "waiting"
    (task,) = story.dispatcher.status.tasks
    said(story, "answer", task.name, "go_on", by="Brandt")
    assert story.run().end.reason == "goal_reached"
    assert story.commits[0] == (str(FIRST),)


def test_of_what_a_person_asks_for_it_may_refuse_but_not_ask_back() -> None:
    story = hanoi(supervisor=against_first("veto"), automatic=False).tick()
    assert said(story, "ask", FIRST).refused == "Agent says no: too steep"
    story = hanoi(supervisor=against_first("pause"), automatic=False).tick()
    assert said(story, "ask", FIRST).refused == ""


def test_two_equal_runs_are_supervised_equally() -> None:
    made = sample("hanoi-corrected")

    def run() -> list[str]:
        story = Story(made, FakeHost(made), supervisor=against_first("veto")).run()
        return [event.line() for event in story.events]

    assert run() == run()
