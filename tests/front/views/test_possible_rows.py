"""The rows of possible operations in Run mode while people are asked."""

from __future__ import annotations

from smsl_studio.dispatch.people.task import Task
from smsl_studio.front.views.possible_rows import possible_rows
from tests.front.views.statuses import at, possible, sample, status

SAMPLE = sample("registration-digitization.json")
HERE = {"REGISTRATION": "State110", "DIGITIZATION": "State1"}
NEXT = "REGISTRATION/State110/Registered"


def _task(address: str) -> Task:
    return Task("t", "confirm", address, "?", "", (), ("a",), 0.0, 60.0, 120.0)


def _said(*tasks: Task) -> tuple[str, str]:
    waiting = status(
        HERE,
        phase="waiting",
        tasks=tasks,
        route=(at(NEXT),),
        possible=(possible(NEXT, "State111"),),
    )
    (row,) = possible_rows(SAMPLE, waiting)
    return row.kind, row.words


def test_what_waits_for_an_answer_says_so() -> None:
    assert _said(_task(NEXT)) == ("waits", "waits for an answer")


def test_the_next_of_the_route_is_on_it_while_a_fact_is_asked_for() -> None:
    assert _said(_task("REGISTRATION/2")) == ("route", "on the route")
