"""Clause 16 while a run goes on: what a hazard refuses, and when it holds."""

from __future__ import annotations

from collections.abc import Sequence

from tests.oracle.hazards import Facts, in_transit, objections, passes, places
from tests.oracle.situation import Json, Situation, Step


def met(now: Situation) -> dict[str, bool | None]:
    """For each hazard whether the sensed facts meet it now; None where it is unknown."""
    if not now.drawing.hazards:
        return {}
    flags = now.flags
    transit = in_transit(now.drawing, now.configuration, flags) | _crossing(now)
    moving = _moving(now)
    vague = {fact for fact in transit if fact.rsplit("/", 1)[0] in moving}
    vague |= {
        fact
        for name, (before, after) in moving.items()
        for digit in now.drawing.branches[name].leaves
        for fact in [f"{name}/{digit}"]
        if not now.scene.is_sensed(fact)
        and now.drawing.value(before, name, digit) != now.drawing.value(after, name, digit)
    }
    return Facts(now.drawing, now.scene, flags, transit, {}, vague).met()


def _moving(now: Situation) -> dict[str, tuple[str, str]]:
    """The SBs that the function under way moves, each with the states before and after it."""
    step = now.step
    if step is None or step.plan is None or not step.acting:
        return {}
    way = [step.began_in, *places(now.drawing, step.plan, step.began_in)]
    number = min(len(step.acted), len(way) - 1)
    return {
        name: (way[number - 1][name], state)
        for name, state in way[number].items()
        if way[number - 1][name] != state
    }


def _crossing(now: Situation) -> set[str]:
    """The digits of bases whose subs are crossing: an operation of theirs has started."""
    found: set[str] = set()
    for edge in now.step.under_way if now.step else ():
        if now.drawing.is_crossing(edge):
            bases = now.drawing.bases[edge.split("/", 1)[0]]
            found |= {f"{base}/{digit}" for base, digit in bases}
        if now.drawing.kind(edge) == "load":
            for sub in now.moved_branches():
                found |= {f"{base}/{digit}" for base, digit in now.drawing.bases[sub]}
    return found


def begins(now: Situation, step: Step) -> None:
    """A step begins: nothing that it declares may meet a hazard."""
    drawing = now.drawing
    if not drawing.hazards or step.plan is None:
        return
    here = now.configuration
    planned = [set(passes(drawing, plan, here)) for plan in step.plans]
    if all(planned):
        now.broken(16, f"{step.edge} begins, and meets {sorted(planned[0])} on its way")
    way = list(places(drawing, step.plan, here))
    # The scene may have been read again after the step began, in the same part of a tick.
    found = [objections(drawing, now.scene, here, way) for _ in now.scene.moments()]
    if all(found):
        now.broken(16, f"{step.edge} begins, and {found[-1]}")
    endangered = [any(met(now).values()) for _ in now.scene.moments()]
    if not step.asked and all(endangered):
        now.broken(16, f"{step.edge} begins by itself while a hazard is met")


def goes_on(now: Situation, step: Step, edge: str) -> None:
    """A later function of a step begins: what it declares is asked again."""
    if step.endangered:
        now.broken(16, f"the function of {edge} begins although {step.endangered} is met")
    number = len(step.begun) - 1
    if not now.drawing.hazards or step.plan is None or not 0 < number < len(step.plan.begins):
        return
    way = list(places(now.drawing, step.plan, step.began_in))
    before, there = way[number - 1], way[number]
    transit = in_transit(now.drawing, now.configuration, before)
    scene = now.scene
    found = [objections(now.drawing, scene, before, [there], transit) for _ in scene.moments()]
    if all(found):
        now.broken(16, f"the function of {edge} begins, and {found[-1]}")


def refused(now: Situation, event: Json, asked: bool) -> None:
    """A hazard refuses: it must have a reason to."""
    edge, name = event["address"], event["hazard"]
    if now.has_vetoes or now.drawing.can_fail or now.step is not None or not now.configuration:
        return
    here, plans = now.configuration, now.carriages(edge, asked)
    for plan in plans:
        way = list(places(now.drawing, plan, here))
        found = objections(now.drawing, now.scene, here, way)
        if name in found or name in passes(now.drawing, plan, here):
            return
    if plans:
        now.broken(16, f"{edge} is refused for {name}, which it would not meet")


class Danger:
    """The sensed facts at every tick against the hazards that were told."""

    def __init__(self) -> None:
        self.told: set[str] = set()
        self._before: dict[str, bool | None] = {}

    def look(self, now: Situation) -> None:
        """Time has passed; nothing of this tick was told yet."""
        self._before = met(now) if now.configuration and not now.ended else {}

    def close(self, now: Situation, events: Sequence[Json], passed: bool) -> None:
        """All events of this part of a tick are told."""
        if not now.drawing.hazards or not now.configuration:
            return
        after = met(now)
        before = self._before if passed else after
        told = {event["name"] for event in events if event["event"] == "hazard_met"}
        for name in sorted(told):
            if before.get(name) is not True and after[name] is not True:
                now.broken(16, f"{name} is told as met, and it is not")
        if passed:  # what is read between two ticks ends nothing
            ends = {one for one in self.told if True not in (after[one], before.get(one))}
            self.told -= ends
        sure = {one for one, so in after.items() if so is True and before.get(one) is True}
        missing = sure - self.told - told
        words = {event["event"] for event in events}
        if missing and passed and not now.ended:
            now.broken(16, f"{sorted(missing)[0]} is met, and the run does not tell it")
        if told and not words & {"held", "run_finished"} and not _may_wait(now):
            now.broken(16, f"{sorted(told)[0]} is met, and the run does not hold")
        self.told |= told | missing


def _may_wait(now: Situation) -> bool:
    """Whether a stop counts more, or an operation is let finish."""
    if now.latched == "stopped":
        return True
    step = now.step
    if step is None:
        return False
    edge = step.running or (step.started or [step.edge])[-1]
    return bool(now.drawing.note(edge).get("stop") == "finish")
