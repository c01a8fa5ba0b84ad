"""Event stories that no run can have: each operator changes a true story into an impossible one.

The chain and the head are computed anew, so that only the story is wrong. An operator returns None
if a story has nothing that it could change. What it changes is impossible for any blueprint; its
docstring says why.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from copy import deepcopy
from dataclasses import dataclass
from random import Random
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.seal.chain import unlinked
from tests.runlog.logs import chained

Json = dict[str, Any]


@dataclass
class Story:
    """The header and the events of a log, as plain values."""

    header: Json
    events: list[Json]

    @staticmethod
    def of(raw: bytes) -> Story:
        """The story of a log."""
        first, *lines = (unlinked(line) for line in raw.splitlines(keepends=True)[:-1])
        assert first is not None
        events = [json.loads(line[0]) for line in lines if line is not None]
        return Story(json.loads(first[0]), events)

    def raw(self) -> bytes:
        """A log of it, with a good chain and a good head."""
        return chained([_written(self.header), *map(_written, self.events)])

    def at(self, *words: str, **said: Any) -> list[int]:
        """Where events of these words stand that say so."""
        return [
            n
            for n, one in enumerate(self.events)
            if one["event"] in words and all(one.get(key) == value for key, value in said.items())
        ]

    @property
    def end(self) -> Json:
        return self.events[-1]


Operator = Callable[[Story, Random], Story | None]


def impossible(story: Story, operator: Operator, random: Random) -> Story | None:
    """The story as an operator changes it; None where it cannot."""
    return operator(deepcopy(story), random)


def _written(values: Json) -> bytes:
    return json.dumps(values, ensure_ascii=False, separators=(",", ":")).encode(
        "utf-8", "backslashreplace"
    )


def _one(random: Random, found: Iterable[int]) -> int | None:
    found = list(found)
    return random.choice(found) if found else None


def _changed(story: Story, at: int | None, **said: Any) -> Story | None:
    if at is None:
        return None
    story.events[at].update(said)
    return story


def _without(story: Story, at: int | None) -> Story | None:
    if at is None:
        return None
    del story.events[at]
    return story


def _twice(story: Story, at: int | None) -> Story | None:
    if at is None:
        return None
    story.events.insert(at, deepcopy(story.events[at]))
    return story


def _before_first_step(story: Story) -> int | None:
    """Where the first operation begins, of a run in which nobody has said anything until then."""
    first = story.at("operation_started")
    quiet = first and not story.at("commanded", "task_opened", "held")
    return first[0] if quiet else None


# time ------------------------------------------------------------------------------------------


def time_goes_back(story: Story, random: Random) -> Story | None:
    """No event is earlier than the one before it."""
    late = [n for n, one in enumerate(story.events) if n and story.events[n - 1]["t"] > 0.01]
    at = _one(random, late)
    return _changed(story, at, t=story.events[at - 1]["t"] - 0.01) if at else None


def time_is_below_zero(story: Story, random: Random) -> Story | None:
    """A run begins at 0 s."""
    return _changed(story, 0, t=-1.0)


def two_moments_exchanged(story: Story, random: Random) -> Story | None:
    """Of two neighbours at different times the later one cannot stand first."""
    events = story.events
    at = _one(random, [n for n in range(1, len(events)) if events[n - 1]["t"] < events[n]["t"]])
    if at is None:
        return None
    events[at - 1], events[at] = events[at], events[at - 1]
    return story


# beginning and end -----------------------------------------------------------------------------


def no_beginning(story: Story, random: Random) -> Story | None:
    """State checks, operations and goals are of a run that has begun."""
    return _without(story, _one(random, story.at("run_started")))


def two_beginnings(story: Story, random: Random) -> Story | None:
    """A log has one run."""
    begun = story.at("run_started")
    if not begun:
        return None
    at = random.randrange(begun[0] + 1, len(story.events))
    again = {**story.events[begun[0]], "t": story.events[at]["t"]}
    story.events.insert(at, again)
    return story


def two_runs_in_one(story: Story, random: Random) -> Story | None:
    """Behind the end nothing follows, not even another run."""
    story.events += deepcopy(story.events)
    return story


def no_end(story: Story, random: Random) -> Story | None:
    """A head is written behind the end of a run, and nowhere else."""
    return _without(story, len(story.events) - 1)


def cut_and_headed(story: Story, random: Random) -> Story | None:
    """The same, wherever it is cut."""
    del story.events[random.randrange(len(story.events)) :]
    return story


def two_ends(story: Story, random: Random) -> Story | None:
    """A run ends once."""
    return _twice(story, len(story.events) - 1)


def life_after_the_end(story: Story, random: Random) -> Story | None:
    """Nothing happens in a run that is over."""
    story.events.append({"event": "paused", "t": story.end["t"]})
    return story


def begins_nowhere(story: Story, random: Random) -> Story | None:
    """Every run begins in a state of each SB."""
    return _changed(story, _one(random, story.at("run_started")), start={})


def begins_elsewhere(story: Story, random: Random) -> Story | None:
    """The states of the start are those that are checked then."""
    at = _one(random, story.at("run_started"))
    if at is None:
        return None
    start = story.events[at]["start"]
    return _changed(story, at, start={**start, random.choice(list(start)): "Elsewhere"})


def goal_of_no_branch(story: Story, random: Random) -> Story | None:
    """A goal is a state of one of the run's SBs."""
    return _changed(story, _one(random, story.at("run_started")), goals=["Nowhere/State_1"])


def no_goal(story: Story, random: Random) -> Story | None:
    """Where nobody names a goal, each root has one."""
    return _changed(story, _one(random, story.at("run_started")), goals=[])


def start_not_checked(story: Story, random: Random) -> Story | None:
    """Every state of the start is checked before anything else happens."""
    begun = story.at("run_started")
    checks = [n for n in story.at("state_checked") if begun and n > begun[0]]
    count = len(story.events[begun[0]]["start"]) if begun else 0
    return _without(story, _one(random, checks[:count]))


def start_not_true(story: Story, random: Random) -> Story | None:
    """A run whose start does not check true is refused."""
    begun = story.at("run_started")
    if not begun:
        return None
    at = story.at("state_checked")[0]
    return _changed(story, at, result="false", misses=["Fact 1 reads x"])


def ends_for_no_reason(story: Story, random: Random) -> Story | None:
    """There are six reasons."""
    return _changed(story, len(story.events) - 1, reason="bored")


def ends_at_an_unreached_goal(story: Story, random: Random) -> Story | None:
    """A run that ends for another reason has not told all of its goals."""
    begun, told = story.at("run_started"), {story.events[n]["goal"] for n in
                                            story.at("goal_reached")}  # fmt: skip
    if begun and set(story.events[begun[0]]["goals"]) <= told:
        return None
    return _changed(story, len(story.events) - 1, reason="goal_reached")


def ends_without_a_route(story: Story, random: Random) -> Story | None:
    """A hold says that there is no route, and why."""
    if story.end["reason"] == "no_route":
        return None
    return _changed(story, len(story.events) - 1, reason="no_route")


def route_lost_without_a_word(story: Story, random: Random) -> Story | None:
    """The same, with the hold taken away."""
    at = story.at("held", kind="no_route")
    whole = story.end["reason"] == "no_route" and at == [len(story.events) - 2]
    return _without(story, at[0]) if whole else None


def fails_without_a_word(story: Story, random: Random) -> Story | None:
    """A failure holds the run, which says why, directly before the end."""
    if story.end["reason"] == "failed":
        return _without(story, len(story.events) - 2)
    return _changed(story, len(story.events) - 1, reason="failed", sentence="It died.")


def refused_in_the_middle(story: Story, random: Random) -> Story | None:
    """What has carried out operations was not refused."""
    if not story.end["operations"]:
        return None
    return _changed(story, len(story.events) - 1, reason="refused")


def stopped_by_nobody(story: Story, random: Random) -> Story | None:
    """A stop is told before the end, with a name."""
    if story.end["reason"] == "stopped":
        return None
    return _changed(story, len(story.events) - 1, reason="stopped")


def held_for_another_reason(story: Story, random: Random) -> Story | None:
    """A run that ends because it holds ends for that reason."""
    whole = story.end["reason"] == "held" and story.events[-2]["event"] == "held"
    return _changed(story, len(story.events) - 1, sentence="For fun.") if whole else None


def ends_later(story: Story, random: Random) -> Story | None:
    """A run that nobody attends ends when it is over."""
    word = {"held": "held", "no_route": "held", "goal_reached": "goal_reached",
            "stopped": "stopped"}.get(story.end["reason"], "")  # fmt: skip
    before = [one["event"] for one in story.events[-2:-1]]
    if story.header["attended"] or before != [word]:
        return None
    return _changed(story, len(story.events) - 1, t=story.end["t"] + 0.05)


def operations_miscounted(story: Story, random: Random) -> Story | None:
    """The end counts what has committed."""
    more = story.end["operations"] + random.choice([-1, 1, 7])
    return _changed(story, len(story.events) - 1, operations=more)


def ends_elsewhere(story: Story, random: Random) -> Story | None:
    """The end has the states that commits and relocations led to."""
    here = story.end["configuration"]
    if not story.at("run_started"):
        return None
    there = {**here, random.choice(list(here)): "Elsewhere"}
    return _changed(story, len(story.events) - 1, configuration=there)


def ends_without_a_branch(story: Story, random: Random) -> Story | None:
    """The same, for all SBs."""
    here = story.end["configuration"]
    if not story.at("run_started"):
        return None
    here.pop(random.choice(list(here)))
    return story


# operations ------------------------------------------------------------------------------------


def _committed_starts(story: Story) -> list[int]:
    """Starts of operations that commit, each the last one before the commit."""
    found = []
    for at in story.at("committed"):
        for address in story.events[at]["operations"]:
            before = [n for n in story.at("operation_started", address=address) if n < at]
            found.append(before[-1])
    return found


def commits_without_a_start(story: Story, random: Random) -> Story | None:
    """What commits has begun."""
    return _without(story, _one(random, _committed_starts(story)))


def begins_twice(story: Story, random: Random) -> Story | None:
    """An operation that has begun begins again only when it is over."""
    return _twice(story, _one(random, story.at("operation_started")))


def begins_where_nobody_stands(story: Story, random: Random) -> Story | None:
    """An operation leaves the state in which its SB stands."""
    at = _one(random, _committed_starts(story))
    if at is None:
        return None
    old = story.events[at]["address"]
    parts = Address.split(old)
    new = str(Address(parts[0], "Elsewhere", parts[2]))
    text = json.dumps(story.events[at:]).replace(json.dumps(old), json.dumps(new))
    story.events[at:] = json.loads(text)
    return story


def begins_in_no_branch(story: Story, random: Random) -> Story | None:
    """An operation is one of the run's SBs."""
    return _changed(story, _one(random, story.at("operation_started")), address="Nowhere/S/Op")


def begins_shut_out(story: Story, random: Random) -> Story | None:
    """What is avoided from the beginning is not begun before it is restored."""
    at = _one(random, story.at("operation_started"))
    if at is None or story.at("operation_restored"):
        return None
    story.header["avoid"] = [story.events[at]["address"]]
    return story


def begins_pruned(story: Story, random: Random) -> Story | None:
    """The same, with somebody who shuts it out a moment before."""
    at = _before_first_step(story)
    if at is None:
        return None
    one = story.events[at]
    said = _command("prune", one["t"], address=one["address"])
    pruned = {"event": "operation_pruned", "t": one["t"], "address": one["address"], "reason": ""}
    story.events[at:at] = [said, pruned]
    return story


def begins_stopped(story: Story, random: Random) -> Story | None:
    """Nothing begins in a run that was stopped."""
    at = _before_first_step(story)
    if at is None:
        return None
    t = story.events[at]["t"]
    story.events[at:at] = [_command("stop", t), {"event": "stopped", "t": t, "by": "Ada"}]
    return story


def begins_taken_over(story: Story, random: Random) -> Story | None:
    """Nor in one that a person has taken over."""
    at = _before_first_step(story)
    if at is None:
        return None
    t = story.events[at]["t"]
    story.events[at:at] = [_command("take_over", t), {"event": "taken_over", "t": t, "by": "Ada"}]
    return story


def begins_paused(story: Story, random: Random) -> Story | None:
    """Nor in one that is paused, unless somebody asks for it."""
    at = _before_first_step(story)
    if at is None:
        return None
    t = story.events[at]["t"]
    story.events[at:at] = [_command("pause", t), {"event": "paused", "t": t}]
    return story


def ends_twice(story: Story, random: Random) -> Story | None:
    """A function ends once."""
    return _twice(story, _one(random, story.at("operation_ended")))


def ends_as_nothing_ends(story: Story, random: Random) -> Story | None:
    """There are six outcomes."""
    return _changed(story, _one(random, story.at("operation_ended")), outcome="well")


def _ended_and_committed(story: Story) -> list[int]:
    """Ends of functions whose operations commit afterwards."""
    found = []
    for at in story.at("committed"):
        for address in story.events[at]["operations"]:
            ends = [n for n in story.at("operation_ended", address=address) if n < at]
            begins = [n for n in story.at("operation_started", address=address) if n < at]
            if ends and ends[-1] > begins[-1]:
                found.append(ends[-1])
    return found


def part_of_a_step_not_checked(story: Story, random: Random) -> Story | None:
    """A step goes on after the state to which its last operation has led was checked."""
    begun = story.at("operation_started")
    found = [
        n for n in story.at("state_checked", result="true")
        if begun and n > begun[0] and _after_checks(story, n) in ("operation_started",
                                                                  "operation_ended")
    ]  # fmt: skip
    return _without(story, _one(random, found))


def _after_checks(story: Story, at: int) -> str:
    """The word of the next event that is neither a check nor a fact."""
    words = (str(one["event"]) for one in story.events[at:])
    return next(word for word in words if word not in ("state_checked", "fact_changed"))


def another_function(story: Story, random: Random) -> Story | None:
    """An operation runs the function that is bound to it."""
    named = [n for n in story.at("operation_started") if story.events[n]["function"]]
    return _changed(story, _one(random, named), function="somebody.elses")


def function_left_out(story: Story, random: Random) -> Story | None:
    """And does not commit without it, though nothing is said of it."""
    at = _one(random, _ended_and_committed(story))
    if at is None or story.at("task_opened"):
        return None
    begins = story.at("operation_started", address=story.events[at]["address"])
    begin = [n for n in begins if n < at][-1]
    if not story.events[begin]["function"]:
        return None
    story.events[begin]["function"] = ""
    return _without(story, at)


def route_at_another_cost(story: Story, random: Random) -> Story | None:
    """A route costs what its operations cost."""
    at = _one(random, story.at("route_planned"))
    if at is None:
        return None
    return _changed(story, at, cost=story.events[at]["cost"] + random.choice([-0.5, 0.5, 7.0]))


def failed_for_another_reason(story: Story, random: Random) -> Story | None:
    """What was tagged risky has failed for the reason that is told."""
    failed = [n for word in ("failed", "raised") for n in story.at("operation_ended", outcome=word)
              if story.events[n]["message"] and not story.at("task_opened")
              and any(one["event"] == "operation_risky" for one in story.events[n:])]  # fmt: skip
    return _changed(story, _one(random, failed), message="It was the moon.")


def costs_that_nobody_set(story: Story, random: Random) -> Story | None:
    """Where no function gives costs, a person sets them."""
    at = _before_first_step(story)
    if at is None or story.header["grounds"].get("priced") is not False:
        return None
    one = story.events[at]
    costs = {"event": "costs_changed", "t": one["t"], "costs": {one["address"]: 7.0}, "faults": []}
    story.events.insert(at, costs)
    return story


def commits_without_an_end(story: Story, random: Random) -> Story | None:
    """What runs a function commits when that has returned."""
    return _without(story, _one(random, _ended_and_committed(story)))


def commits_after_a_failure(story: Story, random: Random) -> Story | None:
    """A failure that was told is one, whatever the check says."""
    outcome = random.choice(["failed", "raised", "timed_out", "cancelled", "lost"])
    return _changed(story, _one(random, _ended_and_committed(story)), outcome=outcome)


def _checks_of_commits(story: Story) -> list[int]:
    found = []
    for at in story.at("committed"):
        for branch, state in story.events[at]["configuration"].items():
            address = str(Address(branch, state))
            found.append([n for n in story.at("state_checked", address=address) if n < at][-1])
    return found


def commits_unchecked(story: Story, random: Random) -> Story | None:
    """The state check decides, directly before the commit."""
    return _without(story, _one(random, _checks_of_commits(story)))


def commits_on_a_false_check(story: Story, random: Random) -> Story | None:
    """And it is true."""
    at = _one(random, _checks_of_commits(story))
    return _changed(story, at, result="false", misses=["Fact 1 reads x"])


def commits_on_an_unknown_check(story: Story, random: Random) -> Story | None:
    """Unknown is not true."""
    at = _one(random, _checks_of_commits(story))
    return _changed(story, at, result="unknown", unknown=["Fact 1 is unknown"])


def commits_elsewhere(story: Story, random: Random) -> Story | None:
    """It commits to the state that was checked."""
    at = _one(random, story.at("committed"))
    if at is None:
        return None
    there = dict.fromkeys(story.events[at]["configuration"], "Elsewhere")
    return _changed(story, at, configuration=there)


def commits_twice(story: Story, random: Random) -> Story | None:
    """What has committed must begin again before it can commit again."""
    return _twice(story, _one(random, story.at("committed")))


def commits_a_stranger(story: Story, random: Random) -> Story | None:
    """Every operation of a commit has begun."""
    at = _one(random, story.at("committed"))
    if at is None:
        return None
    operations = [*story.events[at]["operations"], "Nowhere/State/Op"]
    return _changed(story, at, operations=operations)


def commits_nothing(story: Story, random: Random) -> Story | None:
    """A commit is of operations."""
    return _changed(story, _one(random, story.at("committed")), operations=[])


def checked_against_its_facts(story: Story, random: Random) -> Story | None:
    """A check that is true has no fact that misses."""
    at = _one(random, story.at("state_checked", result="true"))
    return _changed(story, at, misses=["Fact 1 of SB1 reads b, not a"])


def checked_out_of_a_step(story: Story, random: Random) -> Story | None:
    """A state is checked at the start, and where an operation leads."""
    begun = story.at("run_started")
    first = story.at("operation_started")
    checks = len(story.events[begun[0]]["start"]) if begun else 0
    done = story.at("state_checked")[:checks]
    if not done or (first and first[0] < done[-1]):
        return None
    story.events.insert(done[-1] + 1, deepcopy(story.events[done[-1]]))
    return story


def risky_without_a_failure(story: Story, random: Random) -> Story | None:
    """An operation is risky when it has failed."""
    at = _before_first_step(story)
    if at is None:
        return None
    one = story.events[at]
    risky = {"event": "operation_risky", "t": one["t"], "address": one["address"], "reason": "x"}
    story.events.insert(at, risky)
    return story


def route_from_elsewhere(story: Story, random: Random) -> Story | None:
    """A route begins where the run stands."""
    at = _one(random, story.at("route_planned"))
    if at is None:
        return None
    parts = Address.split(story.events[at]["operations"][0])
    first = str(Address(parts[0], "Elsewhere", parts[2]))
    return _changed(story, at, operations=[first, *story.events[at]["operations"][1:]])


def route_of_nothing(story: Story, random: Random) -> Story | None:
    """A route has operations: what holds already needs none."""
    return _changed(story, _one(random, story.at("route_planned")), operations=[])


def bypass_of_nothing(story: Story, random: Random) -> Story | None:
    """What is bypassed are SBs of the run."""
    return _changed(story, _one(random, story.at("subs_bypassed")), subs=["Nowhere"])


# scene and goals -------------------------------------------------------------------------------


def fact_changes_to_itself(story: Story, random: Random) -> Story | None:
    """A fact is told where it changes."""
    return _twice(story, _one(random, story.at("fact_changed")))


def fact_of_no_branch(story: Story, random: Random) -> Story | None:
    """A fact is one of the run's SBs."""
    begun = story.at("run_started")
    later = [n for n in story.at("fact_changed") if begun and n > begun[0]]
    return _changed(story, _one(random, later), branch="Nowhere")


def fact_of_no_digit(story: Story, random: Random) -> Story | None:
    """Digits are counted from 0."""
    return _changed(story, _one(random, story.at("fact_changed")), digit=-1)


def fact_known_and_not(story: Story, random: Random) -> Story | None:
    """What is known has no reason for which it is not."""
    known = [n for n in story.at("fact_changed") if story.events[n]["value"] is not None]
    return _changed(story, _one(random, known), reason="no reading yet")


def goal_told_twice(story: Story, random: Random) -> Story | None:
    """A goal is told once."""
    return _twice(story, _one(random, story.at("goal_reached")))


def goal_of_somebody_else(story: Story, random: Random) -> Story | None:
    """Only the goals of the run are told."""
    return _changed(story, _one(random, story.at("goal_reached")), goal="Nowhere/State_1")


def goal_told_where_the_run_is_not(story: Story, random: Random) -> Story | None:
    """A goal is told where the run stands in it."""
    at = _before_first_step(story)
    begun = story.at("run_started")
    if at is None:
        return None
    start = story.events[begun[0]]
    away = [g for g in start["goals"] if start["start"][Address.split(g)[0]] != Address.split(g)[1]]
    if not away:
        return None
    story.events.insert(at, {"event": "goal_reached", "t": story.events[at]["t"], "goal": away[0]})
    return story


def goal_not_told(story: Story, random: Random) -> Story | None:
    """A run that ends at its goals has told each of them."""
    if story.end["reason"] != "goal_reached":
        return None
    return _without(story, _one(random, story.at("goal_reached")))


def mismatch_in_nothing(story: Story, random: Random) -> Story | None:
    """Scene and belief differ in a fact."""
    return _changed(story, _one(random, story.at("mismatch")), facts=[])


def located_in_no_configuration(story: Story, random: Random) -> Story | None:
    """A configuration has every SB of the run."""
    at = _one(random, story.at("relocalised", "given_back"))
    return _changed(story, at, configuration={"Nowhere": "State"})


def located_by_nobody(story: Story, random: Random) -> Story | None:
    """Where nothing has failed, and nobody has accepted it, a run is located where it was."""
    at = _before_first_step(story)
    if at is None:
        return None
    start = story.events[story.at("run_started")[0]]["start"]
    there = dict.fromkeys(start, "Elsewhere")
    t = story.events[at]["t"]
    story.events.insert(at, {"event": "relocalised", "t": t, "configuration": there})
    return story


def holds_in_no_way(story: Story, random: Random) -> Story | None:
    """There are four kinds of holds."""
    return _changed(story, _one(random, story.at("held")), kind="bored")


def nothing_was_sensed(story: Story, random: Random) -> Story | None:
    """A check is true where every fact of the state was told."""
    if not story.at("run_started") or not story.header["grounds"]["sensed"]:
        return None
    story.events = [one for one in story.events if one["event"] != "fact_changed"]
    return story


def goal_in_the_moment_of_its_commit(story: Story, random: Random) -> Story | None:
    """A goal is told after a tick in which it was looked at."""
    at = _one(random, [n for n in story.at("goal_reached")
                       if story.events[n - 1]["t"] < story.events[n]["t"]
                       and story.events[n - 1]["event"] != "fact_changed"])  # fmt: skip
    if at is None:
        return None
    late = story.events[at]["t"] - story.events[at - 1]["t"]
    for one in story.events[at:]:
        one["t"] -= late
    return story


def _goal_and_fact(story: Story, random: Random) -> tuple[int, Json] | None:
    """Where a goal is told, and a fact of its SB as it would be told at that moment."""
    at = _one(random, story.at("goal_reached"))
    if at is None:
        return None
    goal = story.events[at]
    branch = Address.split(goal["goal"])[0]
    told = [story.events[n] for n in story.at("fact_changed", branch=branch) if n < at]
    return (at, {**random.choice(told), "t": goal["t"]}) if told else None


def goal_fact_lost(story: Story, random: Random) -> Story | None:
    """A goal is told where its facts are those of its state."""
    found = _goal_and_fact(story, random)
    if found is None:
        return None
    story.events.insert(found[0], {**found[1], "value": "elsewhere", "reason": ""})
    return story


def goal_fact_unknown(story: Story, random: Random) -> Story | None:
    """And where they are known."""
    found = _goal_and_fact(story, random)
    if found is None:
        return None
    story.events.insert(found[0], {**found[1], "value": None, "reason": "stale"})
    return story


def goal_of_a_run_that_holds(story: Story, random: Random) -> Story | None:
    """What holds tells no goal."""
    at = _one(random, story.at("goal_reached"))
    if at is None:
        return None
    t = story.events[at - 1]["t"]
    held = {"event": "held", "t": t, "reason": "x", "details": [], "kind": "guard_lost"}
    story.events.insert(at, held)
    return story


def hazard_with_other_facts(story: Story, random: Random) -> Story | None:
    """A hazard is met by the facts that are sensed."""
    at = _one(random, story.at("hazard_met"))
    if at is None:
        return None
    event = story.events[at]
    sensed = {f"{e['branch']}/{e['digit']}" for e in story.events[:at] if "digit" in e}
    known = sorted(sensed & event["facts"].keys())
    if not known:
        return None
    story.events[at] = {**event, "facts": {**event["facts"], known[0]: "elsewhere"}}
    return story


def hazard_without_a_name(story: Story, random: Random) -> Story | None:
    """And has a name."""
    at = _one(random, story.at("hazard_met"))
    if at is None:
        return None
    story.events[at] = {**story.events[at], "name": ""}
    return story


def left_out_later(story: Story, random: Random) -> Story | None:
    """What cannot be read is told before anything else."""
    at = _one(random, story.at("left_out"))
    if at is None or len(story.events) < at + 8:
        return None
    one = story.events.pop(at)
    story.events.insert(at + 5, {**one, "t": story.events[at + 4]["t"]})
    return story


def mismatch_at_the_goal(story: Story, random: Random) -> Story | None:
    """Nor one in which the scene differs from what is believed."""
    at = _one(random, story.at("goal_reached"))
    if at is None:
        return None
    facts = ["Fact 1 reads x, not y"]
    t = story.events[at]["t"]
    story.events.insert(at, {"event": "mismatch", "t": t, "facts": facts, "candidates": []})
    return story


def no_route_was_planned(story: Story, random: Random) -> Story | None:
    """What nobody asks for is on a route."""
    if story.at("commanded") or not story.at("operation_started"):
        return None
    story.events = [one for one in story.events if one["event"] != "route_planned"]
    return story


def off_the_route(story: Story, random: Random) -> Story | None:
    """And is the next operation of it."""
    at = _one(random, story.at("operation_started"))
    if at is None or story.at("commanded"):
        return None
    old = story.events[at]["address"]
    branch, state, _ = Address.split(old)
    new = str(Address(branch, state, "Something_else"))
    head, tail = story.events[:at], json.dumps(story.events[at:])
    story.events = [*head, *json.loads(tail.replace(json.dumps(old), json.dumps(new)))]
    return story


def ends_at_its_goal_in_other_words(story: Story, random: Random) -> Story | None:
    """A run that ends at its goals says that they hold."""
    if story.end["reason"] != "goal_reached":
        return None
    return _changed(story, len(story.events) - 1, sentence="Nothing was done.")


# people ----------------------------------------------------------------------------------------


def _command(word: str, t: float, **said: Any) -> Json:
    return {"event": "commanded", "command": word, "by": "Ada", "address": "", "value": "",
            "reason": "", "refused": "", "t": t, **said}  # fmt: skip


def effect_without_a_command(story: Story, random: Random) -> Story | None:
    """A stop, a take-over, what goes on, is reset or disturbed: somebody has said so."""
    words = {"stop": "stopped", "take_over": "taken_over", "reset": "reset", "resume": "resumed",
             "disturb": "disturbed", "inject": "fault_injected", "accept": "given_back",
             "restore": "operation_restored"}  # fmt: skip
    found = [n for word in words for n in story.at("commanded", command=word, refused="")]
    return _without(story, _one(random, found))


def command_without_an_effect(story: Story, random: Random) -> Story | None:
    """What was commanded and not refused has its effect at that moment."""
    words = ("stopped", "taken_over", "reset", "resumed", "disturbed", "fault_injected",
             "operation_restored")  # fmt: skip
    return _without(story, _one(random, story.at(*words)))


def another_hand(story: Story, random: Random) -> Story | None:
    """Who did it is who commanded it."""
    words = ("stopped", "taken_over", "reset", "given_back")
    return _changed(story, _one(random, story.at(*words)), by="somebody who said nothing")


def unknown_command(story: Story, random: Random) -> Story | None:
    """There are twenty commands."""
    return _changed(story, _one(random, story.at("commanded")), command="dance")


def refusal_taken_back(story: Story, random: Random) -> Story | None:
    """What a run state refuses is not carried out; and no effect follows it."""
    words = ("reset", "accept", "resume", "take_over", "adopt", "restore")
    found = [n for word in words for n in story.at("commanded", command=word)
             if story.events[n]["refused"]]  # fmt: skip
    return _changed(story, _one(random, found), refused="")


def paused_twice(story: Story, random: Random) -> Story | None:
    """What stands still cannot be paused."""
    return _twice(story, _one(random, story.at("paused")))


def task_opened_twice(story: Story, random: Random) -> Story | None:
    """A task has a name that was never used."""
    return _twice(story, _one(random, story.at("task_opened")))


def task_never_opened(story: Story, random: Random) -> Story | None:
    """What is closed was open."""
    closed = {story.events[n]["task"] for n in story.at("task_closed")}
    found = [n for n in story.at("task_opened") if story.events[n]["task"] in closed]
    return _without(story, _one(random, found))


def task_closed_twice(story: Story, random: Random) -> Story | None:
    """And is open no more."""
    return _twice(story, _one(random, story.at("task_closed")))


def task_answered_by_nobody(story: Story, random: Random) -> Story | None:
    """A task is answered by as many as it asks."""
    answered = {story.events[n]["task"] for n in story.at("task_closed", outcome="answered")}
    found = [n for n in story.at("task_answered", refused="")
             if story.events[n]["task"] in answered]  # fmt: skip
    return _without(story, _one(random, found))


def task_answered_with_no_option(story: Story, random: Random) -> Story | None:
    """With one of its options."""
    at = _one(random, story.at("task_closed", outcome="answered"))
    if at is None:
        return None
    answers = dict.fromkeys(story.events[at]["answers"], "perhaps")
    return _changed(story, at, answer="perhaps", answers=answers)


def task_out_of_time_too_soon(story: Story, random: Random) -> Story | None:
    """A deadline has passed when it has."""
    found = [
        n
        for n in story.at("task_closed")
        if any(
            story.events[m]["deadline"] > story.events[n]["t"] + 1
            for m in story.at("task_opened", task=story.events[n]["task"])
        )
    ]
    return _changed(story, _one(random, found), outcome="timed_out", answer="", answers={})


def task_without_a_question(story: Story, random: Random) -> Story | None:
    """Every task has options."""
    return _changed(story, _one(random, story.at("task_opened")), options=[])


# the header, and other streams -----------------------------------------------------------------


def header_of_another_world(story: Story, random: Random) -> Story | None:
    """The run is in the world that the header names."""
    if not story.at("run_started"):
        return None
    story.header["world"] = "another"
    return story


def header_of_another_seed(story: Story, random: Random) -> Story | None:
    """And has its seed."""
    if not story.at("run_started"):
        return None
    story.header["seed"] = 10**6
    return story


def header_of_another_blueprint(story: Story, random: Random) -> Story | None:
    """And is of its blueprint."""
    if not story.at("run_started"):
        return None
    story.header["digests"]["behaviour"] = "0" * 64
    return story


def header_of_another_start(story: Story, random: Random) -> Story | None:
    """And begins where it was asked to."""
    begun = story.at("run_started")
    if not begun or story.at("relocalised"):
        return None
    branch = random.choice(list(story.events[begun[0]]["start"]))
    story.header["start"] = [str(Address(branch, "Elsewhere"))]
    return story


def header_of_other_digits(story: Story, random: Random) -> Story | None:
    """A digit is on if and only if its sub-SB stands in ACTIVATING, also at the start."""
    begun, subs = story.at("run_started"), story.header["grounds"]["subs"]
    if not begun or not subs:
        return None
    start = story.events[begun[0]]["start"]
    base = random.choice(sorted(subs))
    one = random.choice(list(subs[base].values()))
    one["on"] = [] if start[base] in one["on"] else [start[base]]
    return story


def base_commits_before_its_sub(story: Story, random: Random) -> Story | None:
    """A base commits with the last crossing of its subs, and not before."""
    subs = story.header["grounds"]["subs"]
    pairs = [
        (n, one["sub"])
        for n in story.at("committed")
        for base in subs.keys() & story.events[n]["configuration"].keys()
        for one in subs[base].values()
        if one["sub"] in story.events[n]["configuration"]
    ]
    if not pairs:
        return None
    at, sub = random.choice(pairs)
    commit = story.events[at]
    del commit["configuration"][sub]
    kept = [text for text in commit["operations"] if Address.split(text)[0] != sub]
    return _changed(story, at, operations=kept) if kept else None


def operation_to_another_target(story: Story, random: Random) -> Story | None:
    """An SB that nobody loads commits where its operation leads."""
    grounds = story.header["grounds"]
    loaded = {one["sub"] for base in grounds["subs"].values() for one in base.values()}
    at, target = -1, ""
    for n in story.at("committed"):
        for text in story.events[n]["operations"]:
            branch = Address.split(text)[0]
            began = [k for k in story.at("operation_started", address=text) if k < n]
            known = story.events[n]["configuration"].get(branch), story.events[began[-1]]["target"]
            others = grounds["states"].get(branch, {}).keys() - set(known)
            if branch not in loaded and others and (at < 0 or random.random() < 0.3):
                at, target = began[-1], min(others)
    return _changed(story, at, target=target) if at >= 0 else None


def event_of_a_sweep(story: Story, random: Random) -> Story | None:
    """A sweep writes no log."""
    at = random.randrange(len(story.events))
    sweep = {"event": "sweep_finished", "t": story.events[at]["t"], "edges": 1, "passed": 1}
    story.events.insert(at, {**sweep, "failed": []})
    return story


OPERATORS: tuple[Operator, ...] = tuple(
    one
    for name, one in list(globals().items())
    if callable(one) and getattr(one, "__module__", "") == __name__
    and not name.startswith("_") and name not in ("Story", "impossible")
)  # fmt: skip
