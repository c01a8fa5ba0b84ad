"""The sentences that tell how a task ended."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from smsl_studio.front.views.task_outcomes import MOST, Outcomes
from smsl_studio.runlog.events import TaskAnswered, TaskClosed
from tests.front.views.test_card_view import TASK


def _closed(outcome: str, answers: Mapping[str, str], answer: str = "") -> Outcomes:
    found = Outcomes()
    found.see((TASK,))
    closed = TaskClosed(t=31.0, task=TASK.name, outcome=outcome, answer=answer, answers=answers)
    found.tell((closed,))
    return found


def _words(outcome: str, answers: Mapping[str, str], answer: str = "") -> str:
    return _closed(outcome, answers, answer).lines[0].words


def test_what_people_said_is_told_when_it_is_over() -> None:
    asked = "Match patient and scan now?"
    assert _words("answered", {"A": "yes"}, "yes") == f"{asked} A: Match now."
    assert (
        _words("answered", {"A": "yes", "B": "yes"}, "yes") == f"{asked} A and B agreed: Match now."
    )
    assert _words("disagreed", {"A": "yes", "B": "no"}) == (
        f"{asked} The answers differ. A: Match now; B: I cannot tell. This is no yes."
    )
    assert _words("timed_out", {}) == f"{asked} Nobody answered in time. This is no yes."
    assert _words("timed_out", {"A": "yes"}) == (
        f"{asked} Only A answered in time. This is no yes."
    )
    assert _words("withdrawn", {}) == f"{asked} No longer asked: no answer is needed now."


def test_a_late_answer_is_told_beside_the_outcome() -> None:
    found = _closed("timed_out", {})
    late = TaskAnswered(t=140.0, task=TASK.name, by="B", role="", refused="it is too late")
    found.tell((late,))
    assert found.lines[0].late == ("The answer of B does not count: it is too late.",)
    assert not found.refusals


def test_a_refused_answer_to_an_open_task_is_told_until_one_counts() -> None:
    found = Outcomes()
    found.see((TASK,))
    found.tell((TaskAnswered(t=1.0, task=TASK.name, by="B", role="", refused="no such role"),))
    assert found.refusals == {TASK.name: "The answer of B does not count: no such role."}
    found.tell((TaskAnswered(t=2.0, task=TASK.name, by="A", role="surgeon"),))
    assert not found.refusals


def test_a_question_that_is_asked_again_is_not_said_to_be_asked_no_longer() -> None:
    found = _closed("withdrawn", {})
    found.see((TASK,))
    assert len(found.lines) == 1, "the same task may be seen once more before it is gone"
    found.see((replace(TASK, name="task-9", question="Another?"),))
    assert len(found.lines) == 1
    found.see((replace(TASK, name="task-2"),))
    assert not found.lines
    late = _closed("timed_out", {})
    late.see((replace(TASK, name="task-2"),))
    assert len(late.lines) == 1, "that nobody answered in time is still worth reading"


def test_lines_stay_until_dismissed_and_are_few() -> None:
    found = _closed("timed_out", {})
    for number in range(MOST + 2):
        found.tell((TaskClosed(t=1.0, task=f"task-{number + 2}", outcome="withdrawn"),))
    assert len(found.lines) == MOST
    found.dismiss(found.lines[0])
    assert len(found.lines) == MOST - 1
    found.clear()
    assert not found.lines
