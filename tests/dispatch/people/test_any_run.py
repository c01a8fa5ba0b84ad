"""With any answers, silence and commands, nothing begins without the confirmation that it needs."""

from __future__ import annotations

from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.people.task import Task
from tests.counts import share_of
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.people.tasks import Attended
from tests.dispatch.runs import blueprint, branch

NOTES = {
    "go": {"confirm": ["surgeon", "nurse"], "answer_within": 3, "escalates_to": "head"},
    "on": {"actor": "human", "answer_within": 4},
    "aside": {"actor": "shared"},
    "back": {"cost": 3, "actor": "human", "confirm": [""]},
}
MADE = blueprint(
    {
        "SB": branch(
            {"00": "go>10, aside>01", "10": "on>11, back>00", "01": "on>11", "11": "back>00"},
            operations=NOTES,
            facts={"1": {"aggregation": "human", "max_age": 20}},
        )
    }
)
EDGES = [edge.address for branch in MADE for edge in branch.edges()]
NEEDS = {"go": 2, "aside": 1, "back": 1}
"""How many persons must say yes before an operation begins."""

ACTS = st.one_of(
    st.tuples(
        st.just("answer"),
        st.integers(0, 3),
        st.sampled_from([0, 0, 0, 1, 2]),
        st.sampled_from(["Ann", "Bo", "Cy"]),
        st.sampled_from(["surgeon", "nurse", "head", ""]),
    ),
    st.tuples(st.just("tick"), st.integers(1, 12)),
    st.tuples(st.just("wait"), st.integers(20, 60)),
    st.tuples(st.sampled_from(["pause", "resume", "step", "stop", "reset", "take_over"])),
    st.tuples(st.sampled_from(["give_back", "accept", "adopt", "veto"])),
    st.tuples(st.sampled_from(["ask", "prune", "restore"]), st.sampled_from(EDGES)),
    st.tuples(st.just("agree")),
    st.tuples(st.just("agree")),
    st.tuples(st.just("agree")),
)


def right(story: Attended, task: Task) -> str:
    """What lets the run go on: what the operation that is carried out leads to, if one is; where
    a person does it, it is so then."""
    status, host = story.dispatcher.status, story.host
    assert isinstance(host, FakeHost)
    edge = status.carrying
    state = status.configuration["SB"]
    if edge is not None:
        state = MADE["SB"].table[edge.state][edge.operation]
    facts = MADE["SB"].facts(state)
    if task.kind == "operation":
        host.facts["SB", 0] = facts[0]
    return facts[1] if task.kind == "fact" else task.options[0].value


def act(story: Attended, one: tuple[Any, ...]) -> None:
    dispatcher = story.dispatcher
    match one:
        case ("answer", int() as at, int() as option, str() as by, str() as role):
            tasks = story.tasks
            if not tasks:
                return
            task = tasks[at % len(tasks)]
            value = task.options[option % len(task.options)].value
            dispatcher.answer(task.name, value, role, by=by)
        case ("tick" | "wait", int() as count):
            story.tick(count)
        case ("prune", Address() as edge):
            dispatcher.prune(edge, "bent")
        case (str() as word, Address() as edge):
            getattr(dispatcher, word)(edge)
        case ("agree",):
            for task in story.tasks:
                for number, role in enumerate(task.roles):
                    dispatcher.answer(task.name, right(story, task), role, by=f"{role} {number}")
        case (str() as word,):
            getattr(dispatcher, word)()


@settings(max_examples=share_of(150), deadline=None)
@given(
    st.lists(ACTS, min_size=8, max_size=40),
    st.booleans(),
    st.integers(0, 5).map(bool),
    st.sampled_from([{}, {"supervision": "human"}, {"SB/go": "human"}, {"SB/0": "shared"}]),
)
def test_nothing_begins_without_the_yes_it_needs(
    acts: list[tuple[Any, ...]], automatic: bool, begun: bool, levels: dict[str, str]
) -> None:
    story = Attended(MADE, FakeHost(MADE), levels, automatic=automatic)
    if begun:
        story.say("0")
    for one in acts:
        act(story, one)
        story.tick()
        open_ones = {event.task for event in story.of("task_opened")} - {
            event.task for event in story.of("task_closed")
        }
        assert {task.name for task in story.tasks} == open_ones
        waiting = story.phase == "waiting"
        assert waiting <= bool(open_ones)
        assert bool(open_ones) <= (story.phase in ("waiting", "paused", "taken_over"))
    story.dispatcher.stop()
    story.dispatcher.leave()
    story.tick(3)
    assert story.dispatcher.finished
    assert story.tasks == ()
    yes: dict[str, int] = {}
    opened_ones = {event.task: event for event in story.of("task_opened")}
    told: list[Any] = story.events
    for event in told:
        if event.event == "task_closed":
            opened = opened_ones[event.task]
            if event.outcome != "answered":
                assert not event.answer
            elif (opened.kind, event.answer) == ("confirm", "confirm"):
                assert len(event.answers) == opened.persons
                yes[opened.address] = len(event.answers)
        elif event.event == "operation_started":
            needed = NEEDS.get(event.address.rpartition("/")[2], 0)
            assert yes.pop(event.address, 0) == needed, event
        elif event.event in ("operation_refused", "held", "stopped", "taken_over"):
            yes.clear()
    calls = story.host.calls  # type: ignore[attr-defined]
    assert not [call for call in calls if call.endswith(("/on", "/back"))], "people do these"
