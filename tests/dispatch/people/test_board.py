"""Tasks: who may answer and until when. Only agreement in time counts as yes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.person_names import same_name
from smsl_studio.dispatch.people.board import Question, TaskBoard
from smsl_studio.dispatch.people.seats import seated
from smsl_studio.dispatch.people.task import Option
from smsl_studio.runlog.events import (
    Event,
    TaskAnswered,
    TaskClosed,
    TaskEscalated,
    TaskOpened,
)

YES, NO = Option("yes", "Go on", True), Option("no", "Do not", False)


def asked(*roles: str, within: float | None = None, escalation: str = "") -> Question:
    return Question(
        "confirm", "SB/S/op", "Begin?", (YES, NO), roles, within=within, escalation=escalation
    )


def refusal(events: tuple[Event, ...]) -> str:
    return next(event.refused for event in events if isinstance(event, TaskAnswered))


def test_a_task_is_told_with_all_that_a_person_must_know() -> None:
    board = TaskBoard()
    task, events = board.open(asked("surgeon", "nurse", within=60), 10.0)
    assert events == (
        TaskOpened(
            t=10.0,
            task="task-1",
            kind="confirm",
            address="SB/S/op",
            question="Begin?",
            options=("yes", "no"),
            role="surgeon, nurse",
            persons=2,
            deadline=70.0,
        ),
    )
    assert board.tasks == (task,)
    assert (task.escalates, task.persons, task.answered) == (40.0, 2, ())


def test_two_persons_agree_and_only_then_is_anything_seen() -> None:
    board = TaskBoard()
    board.open(asked("surgeon", "nurse"), 0.0)
    first = board.answer("task-1", "yes", by="A. Berg", role="Surgeon", now=1.0)
    assert first == (TaskAnswered(t=1.0, task="task-1", by="A. Berg", role="Surgeon"),)
    assert "yes" not in repr(first) + repr(board.tasks[0].answered)
    second = board.answer("task-1", "yes", by="B. Lind", role="nurse", now=2.0)
    assert second[-1] == TaskClosed(
        t=2.0,
        task="task-1",
        outcome="answered",
        answer="yes",
        answers={"A. Berg": "yes", "B. Lind": "yes"},
    )
    closed = board.closed("task-1")
    assert closed is not None
    assert closed.yes
    assert board.tasks == ()


def test_answers_that_differ_are_no_yes() -> None:
    board = TaskBoard()
    board.open(asked("", ""), 0.0)
    board.answer("task-1", "yes", by="A", now=1.0)
    events = board.answer("task-1", "no", by="B", now=1.0)
    assert isinstance(events[-1], TaskClosed)
    assert (events[-1].outcome, events[-1].answer) == ("disagreed", "")
    assert events[-1].answers == {"A": "yes", "B": "no"}
    closed = board.closed("task-1")
    assert closed is not None
    assert not closed.yes
    assert closed.answer is None


def test_a_no_that_all_give_is_an_answer_and_no_yes() -> None:
    board = TaskBoard()
    board.open(asked(""), 0.0)
    board.answer("task-1", "no", by="A", now=1.0)
    closed = board.closed("task-1")
    assert closed is not None
    assert (closed.outcome, closed.answer, closed.yes) == (
        "answered",
        NO,
        False,
    )


def test_half_time_asks_another_role_as_well() -> None:
    board = TaskBoard()
    board.open(asked("surgeon", within=10, escalation="head of surgery"), 0.0)
    early = board.answer("task-1", "yes", by="C", role="head of surgery", now=4.9)
    assert refusal(early) == (
        "the role head of surgery may not answer it, it is asked of surgeon, "
        "head of surgery (from 5 s on)"
    )
    assert board.tick(4.99) == ()
    assert board.tick(5.0) == (TaskEscalated(t=5.0, task="task-1", role="head of surgery"),)
    assert board.tasks[0].escalated
    assert board.tick(5.1) == ()
    events = board.answer("task-1", "yes", by="C", role="head of surgery", now=6.0)
    assert isinstance(events[-1], TaskClosed)
    assert events[-1].outcome == "answered"


def test_who_may_answer_any_seat_leaves_the_others_theirs() -> None:
    board = TaskBoard()
    board.open(asked("surgeon", "nurse", within=10, escalation="head"), 0.0)
    board.answer("task-1", "yes", by="C", role="head", now=5.0)
    events = board.answer("task-1", "yes", by="A", role="surgeon", now=6.0)
    assert isinstance(events[-1], TaskClosed)
    assert events[-1].outcome == "answered"


def test_time_that_runs_out_is_never_a_yes_and_late_answers_are_refused() -> None:
    board = TaskBoard()
    board.open(asked("", "", within=10), 0.0)
    board.answer("task-1", "yes", by="A", now=1.0)
    escalated, closed = board.tick(10.0)
    assert isinstance(escalated, TaskEscalated)
    assert closed == TaskClosed(t=10.0, task="task-1", outcome="timed_out")
    late = board.answer("task-1", "yes", by="B", now=10.1)
    assert refusal(late) == "it is too late, the time ran out"
    over = board.closed("task-1")
    assert over is not None
    assert not over.yes


def test_an_answer_at_the_very_deadline_is_late() -> None:
    board = TaskBoard()
    board.open(asked("", within=10), 0.0)
    events = board.answer("task-1", "yes", by="A", now=10.0)
    assert [event.event for event in events] == ["task_escalated", "task_closed", "task_answered"]
    assert refusal(events) == "it is too late, the time ran out"


def test_the_default_time_is_two_minutes() -> None:
    board = TaskBoard()
    task, _ = board.open(asked(""), 5.0)
    assert (task.escalates, task.deadline) == (65.0, 125.0)


@pytest.mark.parametrize(
    ("by", "role", "option", "words"),
    [
        ("a  BERG ", "nurse", "yes", "a  BERG  has answered already; another person must"),
        ("A. Berg\u200b", "nurse", "yes", "another person must"),
        ("B", "surgeon", "yes", "the role surgeon may not answer it"),
        ("B", "", "yes", "a person without a role may not answer it"),
        ("B", "nurse", "maybe", "'maybe' is no answer to it, choose one of yes, no"),
        ("B", "nurse", "", "'' is no answer to it"),
        ("  ", "nurse", "yes", "an answer needs the name of a person"),
        ("a person", "nurse", "yes", "2 persons must be told apart, say the name of who answers"),
        ("Script", "nurse", "yes", "2 persons must be told apart"),
    ],
)
def test_what_does_not_count_says_why(by: str, role: str, option: str, words: str) -> None:
    board = TaskBoard()
    board.open(asked("surgeon", "nurse"), 0.0)
    first = "A Berg" if "BERG" in by else "A. Berg"
    board.answer("task-1", "yes", by=first, role="surgeon", now=1.0)
    events = board.answer("task-1", option, by=by, role=role, now=2.0)
    assert words in refusal(events)
    assert len(board.tasks[0].answered) == 1


def test_tasks_are_found_by_name_by_address_or_as_the_only_one() -> None:
    board = TaskBoard()
    assert refusal(board.answer("", "yes", by="A", now=0.0)) == "there is no open task ''"
    board.open(asked(""), 0.0)
    assert board.find("") == board.find("SB/S/op") == board.find("task-1") == "task-1"
    board.open(asked(""), 0.0)
    assert board.find("") == ""
    assert board.find("SB/S/op") == "SB/S/op"
    words = refusal(board.answer("task-3", "yes", by="A", now=0.0))
    assert words.startswith("there is no open task 'task-3'. Did you mean")


def test_what_is_withdrawn_is_over() -> None:
    board = TaskBoard()
    board.open(asked("", ""), 0.0)
    board.open(asked(""), 0.0)
    board.answer("task-1", "yes", by="A", now=1.0)
    assert board.withdraw(2.0, ["task-1"]) == (
        TaskClosed(t=2.0, task="task-1", outcome="withdrawn"),
    )
    assert [task.name for task in board.tasks] == ["task-2"]
    words = refusal(board.answer("task-1", "yes", by="B", now=3.0))
    assert words == "it was withdrawn, the run has moved on"
    assert [event.event for event in board.withdraw(4.0)] == ["task_closed"]
    assert board.withdraw(5.0) == ()
    assert board.tasks == ()


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("Lea Brandt", " lea  BRANDT", True),
        ("Müller", "Mu\u0308ller", True),
        ("A\u200bB", "AB", True),
        ("Straße", "STRASSE", True),
        ("Ann\ufe0f", "Ann", True),
        ("An\x00n", "Ann", True),
        ("Ann\u3164", "Ann\u2800", True),
        ("Ann\tBerg", "Ann Berg", True),
        ("A. Berg", "B. Berg", False),
    ],
)
def test_one_person_is_one_person_however_typed(one: str, other: str, same: bool) -> None:
    assert (same_name(one) == same_name(other)) is same


ROLES = st.sampled_from(["", "nurse", "surgeon", "head"])


@given(st.lists(ROLES, max_size=4), st.lists(ROLES, max_size=4), st.sampled_from(["", "head"]))
def test_seats_are_found_wherever_there_are_any(
    wanted: list[str], persons: list[str], escalation: str
) -> None:
    from itertools import permutations

    fits = len(persons) <= len(wanted) and any(
        all(
            s in ("", p) or (escalation and p == escalation)
            for s, p in zip(order, persons, strict=False)
        )
        for order in permutations(wanted)
    )
    assert seated(wanted, persons, escalation) is bool(fits)


def test_twelve_seats_take_no_long_time() -> None:
    """All orders of twelve seats would take hours."""
    assert seated(["surgeon"] * 12, ["surgeon"] * 12)
    assert not seated(["surgeon"] * 12, ["surgeon"] * 11 + ["nurse"])


ACTS = st.one_of(
    st.tuples(st.just("open"), st.lists(ROLES, min_size=1, max_size=3), st.sampled_from([2, 8])),
    st.tuples(
        st.just("answer"),
        st.integers(1, 4),
        st.sampled_from(["yes", "no", "?"]),
        st.sampled_from(["Ann", "ann ", "Bo", "Cy", "Di", ""]),
        ROLES,
    ),
    st.tuples(st.just("wait"), st.floats(0, 5)),
    st.tuples(st.just("withdraw")),
)


@given(st.lists(ACTS, max_size=40))
def test_nothing_but_agreement_in_time_is_ever_a_yes(acts: list[tuple[object, ...]]) -> None:
    """Against a plain count of what was said: who, in time, with a seat; and silence until then."""
    board, now = TaskBoard(), 0.0
    events: list[Event] = []
    said: dict[str, dict[str, str]] = {}
    for act in acts:
        match act:
            case ("open", list() as roles, int() as within):
                task, told = board.open(asked(*roles, within=within, escalation="head"), now)
                said[task.name] = {}
                events += told
            case ("answer", int() as number, str() as option, str() as by, str() as role):
                told = board.answer(f"task-{number}", option, by=by, role=role, now=now)
                events += told
                if not refusal(told):
                    assert same_name(by) not in map(same_name, said[f"task-{number}"])
                    said[f"task-{number}"][by] = option
            case ("wait", float() as seconds):
                now += seconds
                events += board.tick(now)
            case _:
                events += board.withdraw(now)
        for task in board.tasks:
            assert now < task.deadline
            assert len(said[task.name]) < task.persons
            assert len(task.answered) == len(said[task.name])
    opened = {event.task: event for event in events if isinstance(event, TaskOpened)}
    ended = [event for event in events if isinstance(event, TaskClosed)]
    assert len({event.task for event in ended}) == len(ended), "an outcome never changes"
    for event in ended:
        closed, given_to = board.closed(event.task), said[event.task]
        assert closed is not None
        all_in = len(given_to) == opened[event.task].persons
        agreed = all_in and len(set(given_to.values())) == 1
        assert closed.yes is (agreed and "yes" in given_to.values())
        assert (event.outcome == "answered") is agreed
        assert (event.outcome == "disagreed") is (all_in and not agreed)
        assert event.answers == (given_to if all_in else {})
        if event.outcome == "timed_out":
            assert event.t >= opened[event.task].deadline - 1e-6
    silent = [e for e in events if not isinstance(e, TaskClosed | TaskOpened)]
    assert not any("yes" in repr(e) or "'no'" in repr(e) for e in silent if "refused=''" in repr(e))
