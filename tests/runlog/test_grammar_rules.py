"""Each rule of the grammar alone: a valid story up to one event, and the sentence about that
event."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog import events as run
from smsl_studio.runlog.ends import BROKEN_OFF, LET_GO, UNBEGUN
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.grammar import bounds, operations, regulation, scene
from smsl_studio.runlog.grammar.automaton import Grammar

START = {"S": "A", "R": "X"}
BEGINS = run.RunStarted(
    t=0.1, world="table", seed=1, start=START, goals=("S/B", "R/Y"), behaviour="a"
)
CHECKS = tuple(
    run.StateChecked(t=0.1, address=f"{branch}/{state}", result="true")
    for branch, state in START.items()
)
WAY = ("S/A/Op", "R/X/Op")
BARE = (BEGINS, *CHECKS)
OPEN = (*BARE, run.RoutePlanned(t=0.1, goal="S/B", operations=WAY, cost=1.0))
"""A run that has begun, and knows its way."""
OTHER = (*BARE, run.RoutePlanned(t=0.1, goal="R/Y", operations=WAY[::-1], cost=1.0))
"""The same, where R goes first."""


def starts(
    address: str = "S/A/Op", target: str = "B", function: str = "f", t: float = 0.1
) -> Event:
    return run.OperationStarted(t=t, address=address, target=target, function=function)


def ends(outcome: str = "returned", address: str = "S/A/Op", t: float = 0.2) -> Event:
    return run.OperationEnded(t=t, address=address, outcome=outcome)


def checks(address: str = "S/B", result: str = "true", t: float = 0.2, **facts: Any) -> Event:
    return run.StateChecked(t=t, address=address, result=result, **facts)


def commits(*addresses: str, t: float = 0.2, **states: str) -> Event:
    return run.Committed(t=t, operations=addresses, configuration=states)


def says(word: str, **more: Any) -> Event:
    return run.Commanded(**{"t": 0.1, "command": word, "by": "Ada", **more})


def over(
    reason: str, sentence: str = "So.", operations: int = 0, t: float = 0.1, **states: Any
) -> Event:
    return run.RunFinished(t=t, reason=reason, sentence=sentence, operations=operations,
                           configuration={**START, **states})  # fmt: skip


def asks(task: str = "task-1", **more: Any) -> Event:
    said = {"t": 0.1, "kind": "confirm", "address": "S/A/Op", "question": "?", "role": "",
            "options": ("yes", "no"), "persons": 1, "deadline": 9.0, **more}  # fmt: skip
    return run.TaskOpened(task=task, **said)


def answers(by: str = "Ada", task: str = "task-1", t: float = 0.1) -> tuple[Event, Event]:
    said = run.Commanded(t=t, command="answer", by=by, value=task)
    return said, run.TaskAnswered(t=t, task=task, by=by, role="")


def closes(outcome: str, answer: str = "", task: str = "task-1", **said: str) -> Event:
    return run.TaskClosed(t=0.1, task=task, outcome=outcome, answer=answer, answers=said)


DONE = (*OPEN, starts(), ends(t=0.15), checks(t=0.15), commits("S/A/Op", t=0.15, S="B"))
"""It stands at its first goal."""
TOLD = (*DONE, run.GoalReached(t=0.2, goal="S/B"))
THEN = (*TOLD, starts("R/X/Op", "Y", t=0.2), ends(address="R/X/Op", t=0.25), checks("R/Y", t=0.25),
        commits("R/X/Op", t=0.25, R="Y"))  # fmt: skip
BOTH = (*THEN, run.GoalReached(t=0.3, goal="R/Y"))
"""Both of its goals are reached."""
THERE: Mapping[str, Any] = {"operations": 2, "S": "B", "R": "Y"}
AWAY = {"S": "B", "R": "Elsewhere"}
ROUTE = run.RoutePlanned(t=0.1, goal="S/B", operations=("S/A/Op",), cost=1.0)
RISKY = run.OperationRisky(t=0.2, address="S/A/Op", reason="x")
REFUSED = run.OperationRefused(t=0.1, address="S/A/Op", reasons=("x",))
COSTS = run.CostsChanged(t=0.1, costs={"S/A/Op": 1.0})
STOP = (says("stop"), run.RunStopped(t=0.1, by="Ada"))
TAKE = (says("take_over"), run.TakenOver(t=0.1, by="Ada"))
Case = tuple[Sequence[Event], Event, str]

CASES: tuple[Case, ...] = (
    # how a run begins
    (OPEN, BEGINS, "a second run begins; a log has one"),
    ((), run.RunStarted(t=0.1, world="w", seed=0, start={}, goals=("S/B",)),
     "the run begins in no state"),
    ((run.Relocalised(t=0.1, configuration={"S": "B"}),), BEGINS,
     "the run does not begin where it was located, in S/B"),
    ((), run.RunStarted(t=0.1, world="w", seed=0, start=START, goals=("S/A/Op",)),
     "a goal is no state of an SB of this run"),
    ((), run.RunStarted(t=0.1, world="w", seed=0, start=START, goals=("S/A", "S/B")),
     "an SB has two goals"),
    ((), starts(), "operation started comes before the beginning of the run"),
    ((BEGINS,), ROUTE, "the run goes on before S/A, where it begins, was checked"),
    ((BEGINS,), checks("S/B", t=0.1), "the run begins in S/B, which is not where it starts"),
    # how it ends
    ((), over("goal_reached"), "the goal is reached by a run that has not begun"),
    (TOLD, over("goal_reached", operations=1, t=0.2, S="B"),
     "the run ends at its goal; R/Y was not reached"),
    ((*BOTH, run.RoutePlanned(t=0.3, goal="S/B", operations=("S/B/Op",), cost=1.0),
      starts("S/B/Op", "C", t=0.3)), over("goal_reached", t=0.3, **THERE),
     "the run ends at its goal in the middle of S/B/Op"),
    ((*BOTH, run.Held(t=0.3, reason="x")), over("goal_reached", t=0.3, **THERE),
     "the run ends at its goal and is fault hold"),
    (OPEN, over("held"), "the run ends because it held; it is running"),
    ((*OPEN, run.Held(t=0.1, reason="Why.")), over("held", "Other."),
     "the run held for another reason: Why."),
    ((*BOTH, says("full_map", value="on", t=0.3)), over("goal_reached", t=0.3, **THERE),
     "the run ends at its goal at the time of the last event; nothing was sensed after it"),
    (BOTH, over("goal_reached", t=0.3, **THERE),
     "the run ends at its goal, and its sentence says something else"),
    ((*OPEN, says("pause"), run.Paused(t=0.1)), over("held", "Nothing was done."),
     "the run ends because nobody goes on with it, but its sentence is: Nothing was done."),
    ((run.FactChanged(t=0.1, branch="S", digit=0, value="0"),), BEGINS,
     "facts are logged before the run began, but no person was asked for one"),
    (OPEN, over("stopped", ""), "the run ends, and does not say why"),
    ((*OPEN, asks()), over("held"), "the run ends, and task-1 is open"),
    (OPEN, over("no_route"), "the run ends without a route, but no event before says so"),
    (OPEN, over("refused"), "a run that has begun is refused, but nobody has refused its start"),
    ((*OPEN, asks(kind="start"), *answers(), closes("answered", "no", Ada="no"), starts(t=0.1)),
     over("refused"), "a run is refused that has carried out operations"),
    (OPEN, over("stopped"), "the run ends as stopped, and nobody has stopped it"),
    ((*OPEN, *STOP), over("stopped"), "the run was stopped by Ada; its end says otherwise"),
    (OPEN, over("failed"), "the run fails without a hold that gives the reason"),
    (OPEN, over("bored"), "a run cannot end with the reason bored"),
    (OPEN, over("stopped", operations=3), "the run ends with 3 operations; 0 have committed"),
    (OPEN, over("stopped", S="B"), "the run ends in another place than S/A, R/X"),
    # routes and bypasses
    ((*OPEN, starts()), ROUTE, "a route is planned in the middle of S/A/Op"),
    (BARE, run.RoutePlanned(t=0.1, goal="S/B", operations=("S/A",), cost=1.0),
     "the route is empty, or names something that is no operation of this run"),
    (BARE, run.RoutePlanned(t=0.1, goal="S/B", operations=("S/B/Op",), cost=1.0),
     "the route begins at S/B, where the run does not stand"),
    (BARE, run.RoutePlanned(t=0.1, goal="S/B", operations=("S/A/Op",), cost=-1.0),
     "the cost of the route is negative"),
    (OPEN, run.SubsBypassed(t=0.1, address="S/A", subs=("R",), sentence="So."),
     "'S/A' is no operation of this run"),
    (OPEN, run.SubsBypassed(t=0.1, address="S/A/Op", subs=("S",), sentence="So."),
     "S/A/Op bypasses no SB of this run"),
    (OPEN, ROUTE, "a route is planned twice"),
    (BARE, run.RoutePlanned(t=0.1, goal="S/A", operations=("S/A/Op",), cost=1.0),
     "a route is planned to S/A, which is no goal of this run"),
    # operations
    (OPEN, starts("Q/A/Op"), "'Q/A/Op' is no operation of this run"),
    (OPEN, starts("S/B/Op"), "S/B/Op begins; S is in A"),
    ((*OPEN, starts()), starts("S/A/Other"), "S/A/Other begins; S is still on its way"),
    ((*OPEN, says("prune", address="S/A/Op"),
      run.OperationPruned(t=0.1, address="S/A/Op", reason="")),
     starts(t=0.1), "S/A/Op begins; it was shut out"),
    ((*OPEN, run.CostsChanged(t=0.1, costs={}, closed={"S/A/Op": "it is away"})),
     starts(t=0.1), "S/A/Op begins; it is not available"),
    ((*OTHER, starts("R/X/Op", "Y"), ends("failed", "R/X/Op")), starts(t=0.2),
     "S/A/Op begins in a step that has failed"),
    ((*OTHER, starts("R/X/Op", "Y"), run.FactChanged(t=0.1, branch="S", digit=0, value="1")),
     starts(t=0.1), "S/A/Op begins; the operation before it has not ended"),
    ((*OPEN, asks()), starts(t=0.1), "S/A/Op begins; people are still being asked"),
    ((*OPEN, *STOP), starts(t=0.1), "S/A/Op begins; the run is stopped"),
    (OPEN, ends(t=0.1), "S/A/Op ends; it has not begun"),
    ((*OPEN, starts(), ends()), ends(), "S/A/Op ends for the second time"),
    ((*OPEN, starts(function="")), ends(),
     "S/A/Op ends; it has no function, and no person was asked to carry it out"),
    ((*OPEN, starts()), ends("well"), "an operation cannot end 'well'"),
    ((*OPEN, starts(), starts("R/X/Op", "Y"), ends("failed", "R/X/Op")), ends(),
     "S/A/Op ends in a step that has failed already"),
    (OPEN, starts("S/A/Other"),
     "S/A/Other begins without a command; the route goes on with S/A/Op"),
    ((*OPEN, starts()), ends(t=0.1), "S/A/Op ends at the time at which it began"),
    # checks
    ((*OPEN, starts(), ends()), checks("Q/A"), "'Q/A' is no state of this run"),
    ((*OPEN, starts(), ends()), checks(misses=("x",)),
     "the check of S/B is true, and its facts say otherwise"),
    ((*OPEN, starts(), ends()), checks(result="false"),
     "the check of S/B is false, and its facts say otherwise"),
    ((*OPEN, starts(), ends()), checks(result="maybe"),
     "the check of S/B is maybe, and its facts say otherwise"),
    (OPEN, checks(t=0.1), "S/B is checked, and no operation leads there"),
    ((*OPEN, starts()), checks(),
     "S/B is checked before the operation that leads there has succeeded"),
    ((*OPEN, starts(), ends()), checks("S/C"),
     "S/C is checked; no operation that has begun leads there"),
    # commits
    ((*OPEN, starts(), ends(), checks()), commits("S/A/Op", "S/A/Op", S="B"),
     "S/A/Op has begun 1 times, and commits 2 times"),
    ((*OPEN, starts(), ends(), checks()), commits(S="B"), "a commit has no operations"),
    ((*OPEN, starts(), ends(), checks()), commits("R/X/Op", S="B"),
     "R/X/Op commits; it has not begun"),
    ((*OPEN, starts(), starts("R/X/Op", "Y"), ends(), checks()), commits("S/A/Op", "R/X/Op", S="B"),
     "R/X/Op commits; its function has not ended"),
    ((*OPEN, starts(function="")), commits("S/A/Op", S="B", t=0.1),
     "a step commits that has failed or not ended"),
    ((*OPEN, starts(), ends(), checks()), commits("S/A/Op", S="B", t=0.3),
     "a step commits at another time than its state checks"),
    ((*OPEN, starts(), ends()), commits("S/A/Op", S="B"),
     "S/B commits without a true state check before it"),
    ((*OPEN, starts(), ends(), checks()), commits("S/A/Op"),
     "S commits elsewhere than in B, where its operation leads"),
    ((BEGINS,), checks("R/X", t=0.1), "the run begins in R/X, which is not where it starts"),
    ((*OPEN, starts(), ends(), checks()), checks(), "S is checked twice"),
    # what is said of operations
    ((*OPEN, starts(), ends("failed"), RISKY), RISKY, "S/A/Op is tagged risky twice"),
    ((*OPEN, starts(), ends("failed"), RISKY), run.Paused(t=0.2),
     "S/A/Op is risky, and the scene is not looked at"),
    ((*OPEN, REFUSED), REFUSED, "S/A/Op is refused twice"),
    ((*OPEN, COSTS), COSTS, "the new costs are the same as before"),
    (OPEN, run.OperationRefused(t=0.1, address="S/A/Op", reasons=()),
     "a refusal names no operation or no reason"),
    ((*OPEN, starts(), ends("failed")), run.OperationRisky(t=0.2, address="S/A/Op", reason=""),
     "a risk names no operation or no reason"),
    (OPEN, run.OperationRisky(t=0.1, address="S/A/Op", reason="x"),
     "S/A/Op is tagged risky, and it has not failed"),
    (OPEN, run.OperationPruned(t=0.1, address="S/A/Op", reason=""),
     "S/A/Op is excluded without a command"),
    (OPEN, run.OperationRestored(t=0.1, address="S/A/Op"),
     "S/A/Op is allowed again without a command"),
    (OPEN, run.CostsChanged(t=0.1, costs={}), "no cost has changed"),
    (OPEN, run.CostsChanged(t=0.1, costs={}, closed={"S/A/Op": ""}),
     "a guard tells nothing new of 'S/A/Op'"),
    (OPEN, run.CostsChanged(t=0.1, costs={"S/A/Op": -1.0}), "'S/A/Op' cannot cost -1"),
    # the scene
    (OPEN, run.FactChanged(t=0.1, branch="Q", digit=0, value="1"), "Q/0 is no fact of this run"),
    ((run.FactChanged(t=0.1, branch="S", digit=0, value="1"),),
     run.FactChanged(t=0.1, branch="S", digit=0, value="1"),
     "S/0 changes to the value that it had"),
    (OPEN, run.FactChanged(t=0.1, branch="S", digit=0, value="1", reason="stale"),
     "S/0 has a value, and also a reason why it has none"),
    ((*OPEN, starts()), run.Mismatch(t=0.1, facts=("x",)),
     "the scene is judged while an operation runs"),
    (OPEN, run.Mismatch(t=0.1, facts=()), "a mismatch names no fact"),
    (OPEN, run.Mismatch(t=0.1, facts=("x",), candidates=({"S": "A"},)),
     "the scene agrees with a configuration that this run cannot have"),
    ((*OPEN, starts()), run.Relocalised(t=0.1, configuration=START),
     "the run is located anew while an operation runs"),
    (OPEN, run.Relocalised(t=0.1, configuration={"S": "A"}),
     "the run is located in a configuration that it cannot have"),
    (OPEN, run.Relocalised(t=0.1, configuration=AWAY),
     "the run is located elsewhere, but neither the scene nor a person says so"),
    (OPEN, run.Held(t=0.1, reason="x", kind="bored"),
     "a run cannot hold as 'bored', or for no reason"),
    (OPEN, run.Held(t=0.1, reason="x", kind="no_route"),
     "a run holds as no_route, and says otherwise: x"),
    (OPEN, run.Held(t=0.1, reason="The goal is not confirmed: x"),
     "a run holds as held, and says otherwise: The goal is not confirmed: x"),
    ((*OPEN, run.Relocalised(t=0.1, configuration=START)),
     run.Relocalised(t=0.1, configuration=START), "the run is located twice"),
    ((*OPEN, starts(), ends("failed")), run.Relocalised(t=0.2, configuration=START),
     "an operation has failed, and none is tagged risky"),
    ((*OPEN, starts(), ends("raised")), run.Mismatch(t=0.2, facts=("x",)),
     "an operation has failed, and none is tagged risky"),
    ((*OPEN, run.Mismatch(t=0.1, facts=("x",))), ROUTE,
     "the scene and the believed facts differ, but the run goes on"),
    ((*OPEN, run.Held(t=0.1, reason="x"), run.Held(t=0.1, reason="y")), ROUTE,
     "the run holds in the middle of an operation, or while it is latched, and goes on"),
    # goals
    (TOLD, run.GoalReached(t=0.2, goal="S/B"), "S/B is reached for the second time"),
    (DONE, run.GoalReached(t=0.2, goal="R/Y"),
     "R/Y is reached, which is not the next goal of this run"),
    ((*OPEN, starts()), run.GoalReached(t=0.2, goal="S/B"),
     "S/B is reached in the middle of S/A/Op"),
    (OPEN, run.GoalReached(t=0.1, goal="S/B"), "S/B is reached; S is in A"),
    ((*THEN, run.RoutePlanned(t=0.25, goal="S/B", operations=("S/B/Back",), cost=1.0),
      starts("S/B/Back", "A", t=0.25), ends(address="S/B/Back", t=0.3), checks("S/A", t=0.3),
      commits("S/B/Back", t=0.3, S="A")),
     run.GoalReached(t=0.3, goal="R/Y"), "R/Y is reached; S has left its goal"),
    ((*DONE, says("pause", t=0.18), run.Paused(t=0.18), says("veto", t=0.18)),
     run.GoalReached(t=0.18, goal="S/B"),
     "S/B is reached at the time of the last event; nothing was sensed after it"),
    ((*DONE, run.Held(t=0.18, reason="x")), run.GoalReached(t=0.2, goal="S/B"),
     "S/B is reached; the run is fault hold"),
    ((*DONE, says("pause", t=0.18), run.Paused(t=0.18), run.GoalReached(t=0.2, goal="S/B")),
     run.CostsChanged(t=0.2, costs={"S/A/Op": 1.0}),
     "a paused run reaches a goal and goes on"),
    # commands
    (OPEN, says("pause", by=""), "pause names no person"),
    (OPEN, says("prune"), "prune names no operation"),
    (OPEN, says("stop", address="S/A/Op"), "stop names an operation"),
    (OPEN, says("full_map"), "full map says 'nothing'"),
    (OPEN, run.Paused(t=0.1), "a run is paused, but nothing asked for a pause"),
    ((*OPEN, *STOP), run.RunStopped(t=0.1, by="Ada"),
     "the run is stopped by Ada, who did not command it"),
    (OPEN, says("dance"), "there is no command 'dance'"),
    (OPEN, says("reset"), "reset is carried out in a run that is running"),
    ((*OPEN, says("pause"), run.Held(t=0.1, reason="x")), run.Paused(t=0.1),
     "a run is paused that is fault hold already"),
    (OPEN, run.Resumed(t=0.1), "the run is resumed without a command"),
    (OPEN, run.RunStopped(t=0.1, by="Ada"), "the run is stopped by Ada, who did not command it"),
    ((*OPEN, says("reset", refused="no")), run.RunReset(t=0.1, by="Ada"),
     "a run is reset that was not stopped"),
    ((*OPEN, *STOP), run.RunReset(t=0.1, by="Ada"),
     "the run is reset by Ada, who did not command it"),
    (OPEN, run.TakenOver(t=0.1, by="Ada"), "the run is taken over by Ada, who did not command it"),
    (OPEN, run.GivenBack(t=0.1, by="Ada", configuration=START),
     "a run is given back, but nobody had taken it over"),
    ((*OPEN, *TAKE), run.GivenBack(t=0.1, by="Ada", configuration=START),
     "the run is given back by Ada, who did not command it"),
    ((*OPEN, *TAKE, says("accept")), run.GivenBack(t=0.1, by="Ada", configuration={}),
     "the run is given back in a configuration that it cannot have"),
    ((*OPEN, *TAKE, says("accept"), run.GivenBack(t=0.1, by="Ada", configuration=START)),
     run.Paused(t=0.1), "the run was given back, and is not located"),
    (OPEN, run.Disturbed(t=0.1, target="S/0", kind="stuck", parameters={}, sensors=()),
     "S/0 is disturbed without a command"),
    (OPEN, run.FaultInjected(t=0.1, fault="fail", parameters={}),
     "fail is injected without a command"),
    ((*OPEN, says("stop")), says("pause"), "stop was carried out, but had no effect"),
    ((*OPEN, starts(), run.Held(t=0.1, reason="x")), run.Paused(t=0.1),
     "the run holds in the middle of an operation, or while it is latched, and goes on"),
    # tasks
    ((*OPEN, asks()), asks(), "task-1 is opened for the second time"),
    (OPEN, asks(options=()), "task-1 has no options, or one of them twice"),
    (OPEN, asks(persons=0), "task-1 asks for no person, or its deadline is before its beginning"),
    (OPEN, run.TaskEscalated(t=0.1, task="task-1", role=""),
     "task-1 is escalated; it is not open, or it was escalated before"),
    ((*OPEN, asks()), run.TaskAnswered(t=0.1, task="task-1", by="Ada", role=""),
     "Ada answers task-1 without a command"),
    ((*OPEN, answers()[0]), answers()[1], "task-1 is answered; it is not open"),
    ((*OPEN, asks(persons=2), *answers(), answers()[0]), answers()[1],
     "Ada answers task-1 for the second time"),
    ((*OPEN, asks(deadline=0.1), answers()[0]), answers()[1],
     "task-1 is answered too late, and it counts"),
    (OPEN, closes("withdrawn"), "task-1 is closed; it is not open"),
    ((*OPEN, asks()), closes("forgotten"), "a task cannot end 'forgotten'"),
    ((*OPEN, asks()), closes("answered", "yes", Ada="yes"),
     "task-1 is answered, and its answers say otherwise"),
    (OPEN, asks(address="S/A"), "task-1 is about no operation"),
    (OPEN, asks(kind="fact", address="S"), "task-1 is about no fact"),
    (OPEN, asks(kind="riddle"), "a person is not asked for 'riddle'"),
    ((*OPEN, asks(), asks("task-2"), answers()[0]), answers(task="task-2")[1],
     "Ada answers task-2, but the command was another"),
    # every event
    (OPEN, says("veto", t=0.2), "time passes until 0.2 s, but nothing in the run takes time"),
    ((*OPEN, over("stopped", LET_GO)), run.Paused(t=0.1),
     "paused comes after the end of the run"),
    ((*OPEN, run.CostsChanged(t=0.1, costs={"S/A/Op": 1.0})), run.CostsChanged(t=0.05, costs={}),
     "the time goes back from 0.1 s to 0.05 s"),
    ((*OPEN, says("pause"), run.Paused(t=0.1)), says("pause"),
     "pause is carried out in a run that is paused"),
    (OPEN, run.SweepFinished(t=0.1, edges=1, passed=1), "a run does not tell of sweep_finished"),
)  # fmt: skip


def fact(value: str | None, branch: str = "S", digit: int = 0, t: float = 0.1) -> Event:
    reason = "" if value is not None else "stale"
    return run.FactChanged(t=t, branch=branch, digit=digit, value=value, reason=reason)


GROUNDS = {"states": {"S": {"A": ["0"], "B": ["1"]}, "R": {"X": ["0"], "Y": ["1"]}},
           "sensed": ["S/0", "R/0"]}  # fmt: skip
SEEN = (BEGINS, fact("0"), fact("0", "R"), *OPEN[1:])
"""A run that has begun, in a log that says what its states want."""
THERE_SEEN = (*SEEN, starts(), fact("1", t=0.15), ends(t=0.15), checks(t=0.15),
              commits("S/A/Op", t=0.15, S="B"))  # fmt: skip

GROUNDED: tuple[Case, ...] = (
    ((BEGINS,), CHECKS[0], "the check of S/A is true; the logged facts are not those of the state"),
    ((BEGINS, fact("1")), CHECKS[0],
     "the check of S/A is true; the logged facts are not those of the state"),
    ((BEGINS, fact("0"), fact(None)), CHECKS[0],
     "the check of S/A is true; the logged facts are not those of the state"),
    ((*SEEN, starts(), ends()), checks(),
     "the check of S/B is true; the logged facts are not those of the state"),
    ((*SEEN, starts(), ends()), checks(result="unknown", unknown=("x",)),
     "the check of S/B is unknown; a logged fact contradicts the state"),
    ((*SEEN, starts(), fact("1", t=0.1), ends()), checks(result="false", misses=("x",)),
     "the check of S/B is false; the logged facts say otherwise"),
    ((replace(BEGINS, start={"S": "Q", "R": "X"}),), checks("S/Q", t=0.1),
     "S/Q is checked; S has no such state"),
    (SEEN, starts(target="C"), "S/A/Op begins; S has no C"),
    ((*SEEN, fact("1", t=0.1)), starts(t=0.1),
     "S/A/Op begins; the logged facts are not those of A"),
    ((*SEEN, starts(), ends("cancelled")), run.Mismatch(t=0.2, facts=("x",)),
     "a mismatch names 1 facts; 0 differ"),
    ((*SEEN, starts(), fact("1", t=0.1), ends("cancelled")),
     run.Relocalised(t=0.2, configuration=START),
     "the run is located in S/A, and its facts say otherwise"),
    (SEEN, fact("1", digit=1), "S/1 is no fact that is sensed"),
    (SEEN, over("stopped", LET_GO, S="C"),
     "the run ends in another place than S/A, R/X"),
    ((), over("refused", S="C"), "the run ends in S/C, which is not drawn"),
    ((*THERE_SEEN, fact("0", t=0.2)), run.GoalReached(t=0.2, goal="S/B"),
     "S/B is reached; the logged facts are not those of B"),
    ((*THERE_SEEN, fact(None, t=0.2)), run.GoalReached(t=0.2, goal="S/B"),
     "S/B is reached; the logged facts are not those of B"),
    ((*THERE_SEEN, fact("1", "R", t=0.2)), run.GoalReached(t=0.2, goal="S/B"),
     "S/B is reached; the facts of R are not as it believes"),
    ((*THERE_SEEN, run.GoalReached(t=0.2, goal="S/B"), starts("R/X/Op", "Y", t=0.2),
      fact("1", "R", t=0.25), ends(address="R/X/Op", t=0.25), checks("R/Y", t=0.25),
      commits("R/X/Op", t=0.25, R="Y"), run.GoalReached(t=0.3, goal="R/Y"), fact("0", t=0.3)),
     over("goal_reached", "S/B, R/Y hold.", t=0.3, **THERE),
     "the run ends at its goal; S has other facts"),
)  # fmt: skip


def follows(grammar: Grammar, told: Sequence[Event]) -> None:
    """Nothing that is told is wrong."""
    assert [grammar.follow(one) for one in told] == [""] * len(told)


@pytest.mark.parametrize(("before", "event", "words"), CASES, ids=[case[2] for case in CASES])
def test_a_rule_says_what_is_wrong(before: Sequence[Event], event: Event, words: str) -> None:
    grammar = Grammar({}, COMMANDS)
    follows(grammar, before)
    assert grammar.follow(event) == words


@pytest.mark.parametrize(("before", "event", "words"), GROUNDED)
def test_a_rule_goes_by_what_the_header_says_of_states(
    before: Sequence[Event], event: Event, words: str
) -> None:
    grammar = Grammar({"grounds": GROUNDS}, COMMANDS)
    follows(grammar, before)
    assert grammar.follow(event) == words


SUBS = {"S": {"0": {"sub": "R", "activating": "Y", "initial": "X", "on": ["B"]}}}
"""R expands the digit of S."""
BOTH_BEGIN = (*OPEN, starts(function=""), starts("R/X/Op", "Y"))
CROSSED = (ends(address="R/X/Op"), checks("R/Y"), checks())
LOADED = (*OTHER, starts("R/X/Op", "W"), ends(address="R/X/Op"), checks("R/W"))
"""R was on its way elsewhere when S begins."""

EXPANDED: tuple[Case, ...] = (
    ((), replace(BEGINS, start={"S": "B", "R": "X"}), "the run begins in S/B and R/X"),
    ((), replace(BEGINS, start={"S": "A", "R": "Y"}), "the run begins in S/A and R/Y"),
    ((*OPEN, starts(), ends(), checks()), commits("S/A/Op", S="B"),
     "S/B commits where R is in X"),
    ((*OTHER, starts("R/X/Op", "Y"), ends(address="R/X/Op"), checks("R/Y")),
     commits("R/X/Op", R="Y"), "S/A commits where R is in Y"),
    ((*BARE, run.Mismatch(t=0.1, facts=("x",), candidates=({"S": "A", "R": "Y"},))),
     run.Relocalised(t=0.1, configuration={"S": "A", "R": "Y"}),
     "the run is located in S/A and R/Y"),
    ((*OPEN, starts(target="Z", function=""), starts("R/X/Op", "Y"), *CROSSED),
     commits("R/X/Op", "S/A/Op", R="Y", S="B"),
     "S commits elsewhere than in Z, where its operation leads"),
    ((*LOADED, starts(t=0.2), ends(t=0.3), checks("R/Q", t=0.3), checks(t=0.3)),
     commits("R/X/Op", "S/A/Op", t=0.3, R="Q", S="B"),
     "R commits elsewhere than in W, where its operation leads"),
    ((*BOTH_BEGIN, *CROSSED), commits("R/X/Op", "S/A/Op", R="Y", S="B"), ""),
    ((*LOADED, starts(t=0.2), ends(t=0.3), checks("R/Y", t=0.3), checks(t=0.3)),
     commits("R/X/Op", "S/A/Op", t=0.3, R="Y", S="B"), ""),
)  # fmt: skip


@pytest.mark.parametrize(("before", "event", "words"), EXPANDED)
def test_a_digit_is_on_where_its_sub_is_in_activating_and_nowhere_else(
    before: Sequence[Event], event: Event, words: str
) -> None:
    """What a header without it says is believed, as of logs of earlier programs."""
    grammar = Grammar({"grounds": {"subs": SUBS}}, COMMANDS)
    follows(grammar, before)
    assert grammar.follow(event) == words


KNOWN = {
    **GROUNDS,
    "functions": {"S": {"Op": "f"}, "R": {"X/Op": "g", "X/Up": ""}},
    "costs": {"S": {}, "R": {"X/Op": 2.5, "X/Up": None}},
    "priced": False,
}
"""A header with the functions and costs of operations."""


def goes(*ways: str, cost: float = 1.0, goal: str = "S/B", t: float = 0.1) -> run.RoutePlanned:
    return run.RoutePlanned(t=t, goal=goal, operations=ways, cost=cost)


SET = says("set_cost", address="S/A/Op", value="4.0")
SEES = (BEGINS, fact("0"), fact("0", "R"), *CHECKS)
FAILS = run.OperationEnded(t=0.2, address="S/A/Op", outcome="failed", message="It slipped.")
SLIPPED = run.OperationRisky(t=0.2, address="S/A/Op", reason="S/A/Op failed: It slipped.")
DIFFER = run.Mismatch(t=0.2, facts=("x",))
FAILED = (*SEES, goes("S/A/Op"), starts(), fact("1"), FAILS)

TOLD_OF: tuple[Case, ...] = (
    (SEES, goes("S/A/Op", "R/X/Op", cost=2.0), "the route costs 2, and its operations 3.5"),
    (SEES, goes("S/A/Op", "R/X/Op", cost=3.5), ""),
    (SEES, goes("S/A/Op", "R/X/Up", cost=1.0), ""),
    ((*SEES, SET, run.CostsChanged(t=0.1, costs={"S/A/Op": 4.0})),
     goes("S/A/Op", cost=1.0), "the route costs 1, and its operations 4"),
    ((*SEES, goes("S/A/Op")), starts(function="h"),
     "S/A/Op begins with h, and its function is f"),
    ((*SEES, goes("R/X/Up", cost=0.0, goal="R/Y")), starts("R/X/Up", "Y", function="g"),
     "R/X/Up begins with g, and its function is none"),
    ((*SEES, goes("S/A/Op"), starts(function=""), asks(kind="operation"), *answers(),
      closes("answered", "yes", Ada="yes"), fact("1"), ends(), checks()),
     commits("S/A/Op", S="B"), ""),
    (SEES, run.CostsChanged(t=0.1, costs={"S/A/Op": 4.0}),
     "the costs have changed, and nobody has set them"),
    ((*SEES, SET), run.CostsChanged(t=0.1, costs={"S/A/Op": 5.0}),
     "S/A/Op was priced at 4.0, and something else has changed"),
    (FAILED, replace(SLIPPED, reason="It broke."),
     "S/A/Op is tagged risky, and it has failed for another reason"),
    ((*FAILED, SLIPPED), replace(SLIPPED, address="R/X/Op", reason="It broke."),
     "R/X/Op is tagged risky for another reason than S/A/Op"),
    ((*FAILED, SLIPPED, DIFFER), run.Held(t=0.2, reason="It broke."),
     "a run holds after S/A/Op has failed, for another reason: It broke."),
    ((*FAILED, SLIPPED, DIFFER), run.Held(t=0.2, reason=SLIPPED.reason), ""),
)  # fmt: skip


@pytest.mark.parametrize(("before", "event", "words"), TOLD_OF)
def test_a_rule_goes_by_what_the_header_says_of_operations(
    before: Sequence[Event], event: Event, words: str
) -> None:
    grammar = Grammar({"grounds": KNOWN}, COMMANDS)
    follows(grammar, before)
    assert grammar.follow(event) == words


MIXED = {
    "states": {"S": {"A": ["0", None], "B": ["1", None], "D": ["0", None]},
               "R": {"X": ["0"], "Y": ["1"]}},
    "sensed": ["S/0", "R/0"],
    "subs": {"S": {"1": {"sub": "R", "activating": "Y", "initial": "X", "on": ["B", "D"]}}},
}  # fmt: skip
RISES = (*SEES, goes("S/A/Op", "R/X/Op"), starts(), starts("R/X/Op", "Y"),
         fact("1", "R", t=0.2), ends(address="R/X/Op"))  # fmt: skip
"""S changes a digit of its own too, after R has crossed."""
SINGLE = (*SEES, goes("S/A/Op", "R/X/Op"), starts(target="D", function=""), starts("R/X/Op", "Y"),
          fact("1", "R", t=0.2), ends(address="R/X/Op"), checks("R/Y"))  # fmt: skip
LOADING = (*SEES, goes("S/A/Op"), starts(), fact("1", t=0.2), ends(), checks())

UNPROVED: tuple[Case, ...] = (
    (RISES, ends(t=0.3), "R/Y was not checked, and the step goes on"),
    (RISES, starts("S/B/Op", t=0.2), "S/B/Op begins; S is in A"),
    ((*RISES, checks("R/Y")), ends(t=0.3), ""),
    (SINGLE, starts("R/Y/Op", "X", t=0.2), "S/D was not checked, and the step goes on"),
    ((*SINGLE, checks("S/D")), commits("R/X/Op", "S/A/Op", R="Y", S="D"), ""),
    ((*LOADING, checks("R/X")), starts("R/X/Op", "Y", t=0.2),
     "R was not checked with S/B"),
)  # fmt: skip


@pytest.mark.parametrize(("before", "event", "words"), UNPROVED)
def test_each_part_of_a_step_is_checked_before_the_next_one(
    before: Sequence[Event], event: Event, words: str
) -> None:
    grammar = Grammar({"grounds": MIXED}, COMMANDS)
    follows(grammar, before)
    assert grammar.follow(event) == words


def test_an_operation_with_a_function_does_not_commit_without_it() -> None:
    """The name of its function is left out, and with it its end."""
    grounds = {**MIXED, "functions": {"S": {"Op": "f"}, "R": {"Op": "f"}}}
    before = (*SEES, goes("S/A/Op", "R/X/Op"), starts(function=""), starts("R/X/Op", "Y"),
              fact("1", "R", t=0.2), ends(address="R/X/Op"), checks("R/Y"),
              fact("1", t=0.2), checks())  # fmt: skip
    grammar = Grammar({"grounds": grounds}, COMMANDS)
    follows(grammar, before)
    words = "S/A/Op commits; its function has not ended"
    assert grammar.follow(commits("R/X/Op", "S/A/Op", R="Y", S="B")) == words


@pytest.mark.parametrize(
    ("before", "last", "words"),
    [
        ((*OPEN, run.Held(t=0.1, reason="x")), over("held", "x", t=0.2),
         "the run ends at 0.2 s; it was over at 0.1 s"),
        ((*OPEN, run.Held(t=0.1, reason="x")), over("held", "x"), ""),
        ((*OPEN, *STOP), over("stopped", "Stopped by Ada.", t=0.2),
         "the run ends at 0.2 s; it was over at 0.1 s"),
        ((*OPEN, run.Held(t=0.1, reason="x")), over("stopped", LET_GO, t=0.2), ""),
        (BOTH, over("goal_reached", "S/B, R/Y hold.", t=0.4, **THERE),
         "the run ends at 0.4 s; it was over at 0.3 s"),
        ((), over("refused", "No.", t=0.1), "the run ends at 0.1 s; it was over at 0 s"),
        ((), over("refused", "No.", t=0.0), ""),
    ],
)  # fmt: skip
def test_a_run_that_nobody_attends_ends_when_it_is_over(
    before: Sequence[Event], last: Event, words: str
) -> None:
    grammar = Grammar({"attended": False}, COMMANDS)
    follows(grammar, before)
    assert grammar.follow(last) == words


def test_a_run_that_somebody_attends_ends_when_that_person_likes() -> None:
    before = (*OPEN, run.Held(t=0.1, reason="x"))
    for header in ({"attended": True}, {}):
        grammar = Grammar(header, COMMANDS)
        follows(grammar, before)
        assert grammar.follow(over("held", "x", t=9.0)) == ""


POSSIBLE: Mapping[str, Sequence[Event]] = {
    "an asked step that has committed in part is paused, and goes on": (
        *OPEN, says("pause"), run.Paused(t=0.1), says("ask", address="S/A/Op"), starts(), ends(),
        checks(), commits("S/A/Op", S="B"), says("pause", t=0.2), run.Paused(t=0.2),
        says("resume", t=0.2), run.Resumed(t=0.2), starts("S/B/Rest", "C", t=0.2),
    ),
    "a step that was paused goes on where a fact became unknown meanwhile": (
        *SEEN, starts(), fact("1", t=0.2), ends(), checks(), commits("S/A/Op", S="B"),
        says("pause", t=0.2), run.Paused(t=0.2), fact(None, "R", t=0.2), says("resume", t=0.2),
        run.Resumed(t=0.2), starts("R/X/Op", "Y", t=0.2),
    ),
    "what was asked for in a pause is paused": (
        *OPEN, says("pause"), run.Paused(t=0.1), says("ask", address="S/A/Op"), starts(),
        says("pause", t=0.2), ends("cancelled"), run.Relocalised(t=0.2, configuration=START),
        run.Paused(t=0.2),
    ),
    "an answer names no task": (
        *OPEN, asks(), says("answer"), run.TaskAnswered(t=0.1, task="task-1", by="Ada", role=""),
    ),
    "what is asked for is no operation": (
        *OPEN, says("ask", address="S", refused="no"),
        run.OperationRefused(t=0.1, address="S", reasons=("no",)),
    ),
    "a step goes on where a fact is unknown": (
        *SEEN, starts(), fact("1", t=0.2), fact(None, "R", t=0.2), ends(), checks(),
        commits("S/A/Op", S="B"), starts("R/X/Op", "Y", t=0.2),
    ),
    "a run that holds is left while people are asked": (
        *OPEN, run.Held(t=0.1, reason="x"), says("ask", address="S/A/Op"), asks(),
        closes("withdrawn"), over("held", "The run is waiting, and nobody is there to answer."),
    ),
}  # fmt: skip
"""What looks impossible, and is told by runs."""


@pytest.mark.parametrize("told", POSSIBLE.values(), ids=POSSIBLE)
def test_no_rule_forbids_what_runs_tell(told: Sequence[Event]) -> None:
    grammar = Grammar({"grounds": GROUNDS} if fact("0") in told else {}, COMMANDS)
    follows(grammar, told)


def test_what_a_header_leaves_out_is_learned_from_checks() -> None:
    """Of an SB that the header does not draw, a state has the facts of its first true check."""
    grammar = Grammar({}, COMMANDS)
    follows(grammar, THERE_SEEN)
    back = (run.RoutePlanned(t=0.15, goal="S/B", operations=("S/B/Back",), cost=1.0),
            starts("S/B/Back", "A", t=0.15), ends(address="S/B/Back"))  # fmt: skip
    follows(grammar, back)
    words = "the check of S/A is true; the logged facts are not those of the state"
    assert grammar.follow(checks("S/A")) == words


def test_a_log_of_the_version_before_may_tell_a_goal_at_once() -> None:
    for version, words in (
        (2, ""),
        (3, "S/B is reached at the time of the last event; nothing was sensed after it"),
    ):
        grammar = Grammar({"version": version}, COMMANDS)
        follows(grammar, DONE)
        assert grammar.follow(run.GoalReached(t=0.15, goal="S/B")) == words


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ({"world": "hanoi"}, "the run is in the world table; the header has hanoi"),
        ({"seed": 2}, "the seed is 1; the header has 2"),
        ({"start": ["S/B"]}, "the run does not begin in S/B, which the header asks for"),
        ({"goals": ["S/B"]}, "the goals are not those that the header asks for"),
        ({"digests": {"behaviour": "b"}}, "the run is of another blueprint than the header"),
        ({"digests": {"behaviour": "a"}}, ""),
        ({"start": ["B"], "goals": ["B"], "seed": 1, "world": "table"}, ""),
    ],
)
def test_a_run_is_the_one_that_its_header_asks_for(header: Mapping[str, Any], words: str) -> None:
    assert Grammar(header, COMMANDS).follow(BEGINS) == words


def test_what_the_cases_build_upon_is_possible() -> None:
    grammar = Grammar({}, COMMANDS)
    follows(grammar, TOLD)


def test_every_rule_has_a_case() -> None:
    """A new rule gets one: every module of rules has as many sentences as it has cases."""
    written = 0
    for module in (bounds, operations, regulation, scene):
        tree = ast.parse(Path(module.__file__ or "").read_text("utf-8"))
        written += sum(isinstance(node, ast.Yield) for node in ast.walk(tree))
    assert written <= len(CASES) + len(GROUNDED) + len(TOLD_OF) + len(UNPROVED)


@pytest.mark.parametrize(
    ("before", "sentence", "true"),
    [
        (OPEN, LET_GO, True),
        (OPEN, BROKEN_OFF, True),
        (OPEN, UNBEGUN, False),
        ((), UNBEGUN, True),
        ((*OPEN, *STOP), "Stopped by Ada.", True),
        ((*OPEN, *STOP), "Stopped by Ada. The simulation process is gone.", True),
        ((*OPEN, *STOP), "Stopped by Ada.And more.", False),
        ((*OPEN, *STOP), "It was not stopped by Ada. It ended.", False),
    ],
)
def test_what_a_run_that_was_stopped_may_say_at_its_end(
    before: Sequence[Event], sentence: str, true: bool
) -> None:
    grammar = Grammar({}, COMMANDS)
    assert not any(grammar.follow(one) for one in before)
    last = run.RunFinished(t=0.1 if before else 0.0, reason="stopped", sentence=sentence,
                           operations=0, configuration=START if before else {})  # fmt: skip
    assert (grammar.follow(last) == "") == true
