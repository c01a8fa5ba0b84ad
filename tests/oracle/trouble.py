"""Operations that go wrong: clause 8, and integrity between operations (9)."""

from __future__ import annotations

from tests.oracle import danger
from tests.oracle.route import route_to
from tests.oracle.situation import TICK, Json, Situation
from tests.oracle.standing import Configuration, all_configurations


def failed(now: Situation) -> None:
    """A step is broken off: an operation that ended badly is risky, and the root's edge with it."""
    step = now.step
    if step is None:
        return
    for edge, (outcome, _) in step.ended.items():
        if outcome in ("failed", "raised", "timed_out"):
            if edge not in now.risky:
                now.broken(8, f"{edge} {outcome} and is not tagged risky")
            roots = [one for one in step.started if one.split("/", 1)[0] in now.drawing.roots]
            if roots and not set(roots) & now.risky:
                now.broken(8, f"{edge} {outcome}, and the root's edge {roots[0]} is not risky")


def agreeing(now: Situation) -> list[Configuration]:
    """Every configuration that the scene agrees with; none where a sensed fact is unknown."""
    return [one for one in all_configurations(now.drawing) if now.scene.agrees(one)]


def mismatched(now: Situation, event: Json) -> None:
    """Integrity is broken: what the scene agrees with is told."""
    told = [dict(one) for one in event["candidates"]]
    if any(not now.scene.agreed(one, trusting=True) for one in told):
        now.broken(8, f"the scene does not agree with all of {told}")
    failed(now)
    break_off(now)


def break_off(now: Situation) -> None:
    """The step under way is over, however it stands."""
    now.step = None
    now.agreed = []


def relocalised(now: Situation, event: Json, by_person: bool) -> None:
    """Where a run goes on from must be what the scene says, by a check of every SB."""
    failed(now)
    there = {**now.configuration, **event["configuration"]}
    before = now.configuration
    now.happened()
    now.configuration = there
    _agreed_with(now, there)
    if there == before:
        return
    if not by_person and any(danger.met(now).values()):
        now.broken(16, f"{there} is adopted while a hazard is met")
    found = agreeing(now)
    believed = [one for one in found if _believed(now, one, before)]
    if by_person or now.asked.get("on_mismatch") == "adopt":
        if [there] not in (found, believed) and not _only_below(now, before, there):
            now.broken(8, f"{there} is adopted, and the scene agrees with {len(found)}")
    elif not _only_below(now, before, there):
        now.broken(8, f"{there} is adopted, and nobody has asked for that")


def _believed(now: Situation, there: Configuration, before: Configuration) -> bool:
    """Whether every fact that nobody senses has the value that was believed of it (clause 13)."""
    drawing = now.drawing
    for fact in drawing.leaves:
        name, digit = fact.rsplit("/", 1)
        if not now.scene.is_sensed(fact):
            values = [drawing.value(one[name], name, int(digit)) for one in (there, before)]
            if values[0] != values[1]:
                return False
    return True


def _agreed_with(now: Situation, there: Configuration) -> None:
    if not now.scene.agreed(there):
        now.broken(8, f"it goes on from {there}, and the scene does not agree with it")


def _only_below(now: Situation, before: Configuration, there: Configuration) -> bool:
    """Whether only SBs moved that have a base, and none of them crossed."""
    return all(
        bool(now.drawing.bases[name])
        and now.drawing.branches[name].activating not in (before[name], there[name])
        for name in there
        if there[name] != before[name]
    )


class Integrity:
    """Clause 9 while nothing is carried out: sensed facts and flags that differ for longer than
    the world needs to settle, and critical facts that are unknown for so long.

    People may say a critical fact of theirs first; nobody else needs to be waited for. After a
    step has failed the scene is read (clause 8), also by asking people: until then only critical
    facts count.
    """

    def __init__(self) -> None:
        self.since: dict[str, float] = {}

    def watch(self, now: Situation, told: list[Json]) -> None:
        """At the end of a tick in which time passed."""
        carrying = now.step is not None and not now.step.over
        if carrying or now.latched or not now.configuration or now.ended:
            self.since.clear()
            return
        wrong = set() if now.step else now.scene.mismatches(now.configuration)
        for fact in now.critical_lost():
            known = now.scene.reading(fact) is not None
            if known or now.drawing.fact_level(fact) == "automatic":
                wrong.add(fact)
        self.since = {fact: self.since.get(fact, now.now) for fact in wrong}
        words = {event["event"] for event in told}
        if words & {"mismatch", "held", "relocalised", "run_finished"}:
            self.since.clear()
        for fact, since in self.since.items():
            if now.now - since > now.settle + 1.5 * TICK:
                now.broken(9, f"{fact} is not as its flag since t={since:g}, and nothing holds")
                self.since.clear()
                return


def no_way(now: Situation, event: Json) -> None:
    """It holds for want of a way: there must be none, and risky edges in it are named."""
    if now.ended or now.step is not None:
        return
    goals = now.goals
    if now.drawing.can_fail or now.has_vetoes:
        return
    if route_to(now.terms, now.configuration, goals, goals) is not None:
        now.broken(11, f"it holds for want of a way to {goals}, and there is one")
