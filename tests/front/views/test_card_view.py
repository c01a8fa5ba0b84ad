"""The content of a task's card, computed from the task alone."""

from __future__ import annotations

from dataclasses import replace

import pytest

from smsl_studio.dispatch.people.task import Answered, Option, Task
from smsl_studio.front.views.card_view import TAKEN, CardView, card_view, clock, letters

TASK = Task(
    name="task-1",
    kind="confirm",
    address="REGISTRATION/State_1100/Op_Register",
    question="Match patient and scan now?",
    detail="Op_Register leads to State_1101.",
    options=(
        Option("yes", "Match now", yes=True),
        Option("again", "Digitise a landmark again", yes=False),
        Option("no", "I cannot tell", yes=False),
    ),
    roles=("surgeon", ""),
    opened=10.0,
    escalates=70.0,
    deadline=130.0,
    escalation="lead surgeon",
)


def _of(task: Task = TASK, time: float = 28.0, who: tuple[str, str] = ("", "")) -> CardView:
    return card_view(task, time, *who)


def test_time_that_is_left_is_simulated_and_never_below_nothing() -> None:
    card = _of()
    assert card.left == "1:42"
    assert card.share == pytest.approx(0.85)
    assert card.escalation == pytest.approx(0.5)
    assert _of(time=500.0).left == "0:00"
    assert _of(time=500.0).share == 0.0
    times = (0.0, 0.2, 60.0, 59.5, 60.0000000001, -3.0)
    assert [clock(s) for s in times] == ["0:00", "0:01", "1:00", "1:00", "1:00", "0:00"]


def test_each_answer_has_a_letter_of_its_own_that_means_nothing_else() -> None:
    assert [option.letter for option in _of().options] == ["M", "D", "I"]
    six = letters(["Veto it", "Prune", "Take over", "Match", "Match again", "Maybe"])
    assert len(set(six)) == 6
    assert not TAKEN & set(six)
    assert all(letters([f"Answer {n}" for n in range(20)]))


def test_what_is_said_of_time_roles_and_silence() -> None:
    assert _of().sentence == (
        "Both answers stay hidden until both are in. At 1:00 the lead surgeon is asked as well; "
        "at 0:00 the run holds. Silence is never a yes."
    )
    late = replace(TASK, escalated=True, roles=("", "", ""))
    assert _of(late).sentence.startswith(
        "All three answers stay hidden until all are in. The lead surgeon is asked as well; at 0:00"
    )
    alone = replace(TASK, roles=("",), escalation="")
    assert _of(alone).sentence == "At 0:00 the run holds. Silence is never a yes."
    assert _of(alone).escalation == 0.0


def test_places_show_who_has_answered_and_never_what() -> None:
    answered = replace(TASK, answered=(Answered("A. Okafor", "Surgeon", 24.25),))
    card = _of(answered, who=("L. Brandt", "supervisor"))
    first, second = card.persons
    assert (first.place, first.name, first.words) == ("Surgeon", "A. Okafor", "answered at 24.2 s")
    assert first.answered
    assert not first.you
    assert (second.place, second.name) == ("Second person", "L. Brandt, you")
    assert second.words == "not yet answered"
    assert card.heading == "Your decision is needed"
    for shown in (first, second):
        assert not any(option.words in shown.words for option in TASK.options)


def test_one_who_has_answered_is_asked_no_second_time() -> None:
    answered = replace(TASK, answered=(Answered("A. Okafor", "surgeon", 24.0),))
    card = _of(answered, who=("a.  okafor", ""))
    assert card.heading == "Your answer is in"
    assert card.objection == "a.  okafor has answered. Another person must answer as well."
    assert card.persons[0].you
    assert not card.persons[1].you


def test_a_role_that_is_not_asked_for_is_told_before_anybody_answers() -> None:
    asked = replace(TASK, roles=("surgeon",))
    card = _of(asked, who=("L. Brandt", "engineer"))
    assert card.objection == "It is asked of a surgeon; L. Brandt is an engineer."
    assert card.heading == "A decision is needed"
    assert _of(asked, who=("L. Brandt", "")).objection == (
        "It is asked of a surgeon; L. Brandt has no role."
    )
    later = replace(asked, escalated=True, escalation="engineer")
    assert _of(later, who=("L. Brandt", "engineer")).objection == ""
    assert _of(asked).heading == "Your decision is needed"


def test_two_of_whom_one_must_be_a_surgeon() -> None:
    """Whoever takes anybody's place leaves the surgeon's free."""
    answered = replace(TASK, answered=(Answered("N. One", "nurse", 12.0),))
    assert [p.answered for p in _of(answered).persons] == [False, True]
    assert _of(answered, who=("N. Two", "nurse")).objection
    assert not _of(answered, who=("A. Okafor", "surgeon")).objection
