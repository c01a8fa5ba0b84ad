"""The oracle: reads the record of a run and tells in sentences what differs from docs/running.md.

It was written from the specification alone and shares no code with the program. It sees the JSON of
the blueprint, what was asked, the reading of every sensor at every tick, the calls of the world,
the commands and the events. Each sentence begins with the clause that is broken.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tests.oracle import commits, danger, ends, motion, people, tables, trouble
from tests.oracle.situation import HAIR, Json, Situation

LATCHES = {"paused": "paused", "held": "held", "taken_over": "taken over", "stopped": "stopped"}
ON = ("resume", "step", "ask", "adopt")


def judge(
    blueprint: Json,
    asked: Mapping[str, Json],
    world: Mapping[str, Json],
    record: Sequence[Mapping[str, Json]],
) -> list[str]:
    """What is wrong with a run, one sentence each; empty where nothing is.

    ``asked`` has start, goals, avoid, on_mismatch, levels and automatic; ``world`` what the table
    world of this run has besides (see ``recorded_host``); ``record`` is that of ``recorded_run``.
    """
    return _Reading(Situation(blueprint, asked, world)).findings(record)


class _Reading:
    """One record being read."""

    def __init__(self, now: Situation) -> None:
        self.now = now
        self.table = tables.Table(now)
        self.integrity = trouble.Integrity()
        self.danger = danger.Danger()
        self.people = people.People(now)
        self.told: dict[str, str | None] = {}
        self.stood = False
        self.perhaps: set[str] = set()
        """Facts that may be told as unknown until the next tick: a step was cut off."""

    def findings(self, record: Sequence[Mapping[str, Json]]) -> list[str]:
        now = self.now
        for number, moment in enumerate(record):
            now.moment = number
            self._moment(moment)
            if len(now.findings) > 3:
                return now.findings
        last = record[-1]
        if last.get("hangs"):
            now.findings.append(f"hangs: the run does not end, it is {last['phase']}")
        elif not last["events"] or last["events"][-1]["event"] != "run_finished":
            now.findings.append("hangs: the last event is not run_finished")
        return now.findings

    def _moment(self, moment: Mapping[str, Json]) -> None:
        """One tick of the dispatcher: what came before time moved, then what came after."""
        now = self.now
        self.people.said(moment["said"])
        if moment["said"]:
            now.disturbed = True
        if any(act["do"] == "leave" for act in moment["said"]):
            self.stood = False
        calls, events = moment["calls"], moment["events"]
        ticks = [at for at, call in enumerate(calls) if call[0] == "tick"]
        if len(ticks) > 1:
            now.broken(15, "time moves twice in one tick")
        if not ticks:
            self._part(calls, events)
            return
        time = calls[ticks[0]][1]
        early = [event for event in events if event["t"] < time - HAIR]
        self._part(calls[: ticks[0]], early)
        self._part(calls[ticks[0] :], events[len(early) :])

    def _part(self, calls: Sequence[Json], events: Sequence[Json]) -> None:
        now = self.now
        now.scene.begin_part()
        begins = self._calls(calls)
        passed = any(call[0] == "tick" for call in calls)
        if passed:
            motion.watched(now)
        for event in events:
            if abs(event["t"] - now.now) > 1e-5:
                now.broken(15, f"{event['event']} is told at {event['t']}")
            self._event(event, events)
        for edge in begins:
            motion.begun(now, edge)
            self.table.begun(edge)
        if passed:
            motion.closed(now)
            if self.danger.told:  # it holds for a hazard already, also while people are asked
                self.integrity.since.clear()
            else:
                self.integrity.watch(now, list(events))
        self.danger.close(now, events, passed)
        self._facts()

    def _calls(self, calls: Sequence[Json]) -> list[str]:
        """What the world was told and what it said; the functions that begin."""
        now = self.now
        begins: list[str] = []
        for call in calls:
            word = call[0]
            if word == "tick":
                self._tick(call)
            elif word == "sense":
                now.scene.hear(call[1], now.now)
                now.was_read()
            elif word == "begin":
                begins.append(call[1])
            elif word == "cancel":
                self._cancelled(call[1])
            elif word == "reviewed":
                now.disturbed = now.disturbed or call[3] != "allow"
                now.reviews[call[1]] = call[3]
                self.people.reviewed(call[1], call[2])
            else:
                now.happened()
                self.table.told(call)
        return begins

    def _tick(self, call: Json) -> None:
        now = self.now
        _, time, outcome, samples, table = call
        if abs(time - now.now - 0.05) > HAIR:
            now.broken(15, f"time goes from {now.now:g} to {time:g}")
        if self.stood:
            now.broken(15, "time passes while the run is paused")
        now.now = time
        self.perhaps = set()
        now.scene.hear(samples, time)
        self.danger.look(now)
        now.was_read()
        step = now.step
        if step is not None and step.running and outcome in ("returned", "failed", "raised"):
            now.happened()
            motion.ended(now, step.running, outcome)
        self.table.passed(outcome, table)

    def _cancelled(self, mode: str) -> None:
        """An operation was cut off: what it may have moved is unknown until it is sensed anew."""
        now = self.now
        step = now.step
        if mode == "finish":
            return
        now.happened()
        self.table.cancelled()
        if step is not None:
            acting = [edge for edge in step.started if now.drawing.level(edge) == "human"]
            running = [step.running] if step.running else acting[-1:]
            step.running, step.cut_off = "", step.running
            now.scene.doubt({fact for edge in running for fact in now.touched_by(edge)})
            planned = step.plan.starts if step.plan else step.started
            self.perhaps = {fact for edge in planned for fact in now.touched_by(edge)}

    def _left_off(self, edge: str) -> None:
        """A person's operation was cut off; sensors may have been read anew in the same tick."""
        now = self.now
        step = now.step
        planned = step.plan.starts if step and step.plan else (edge,)
        self.perhaps = {fact for one in planned for fact in now.touched_by(one)}
        now.scene.forget(now.touched_by(edge))
        now.scene.doubt(fact for fact in now.touched_by(edge) if not now.scene.has_sensors(fact))

    def _facts(self) -> None:
        """Clause 13: what is told of a fact is what its sensors amount to."""
        now = self.now
        if not now.configuration or now.ended:
            return
        for fact in sorted(self.perhaps):
            if self.told.get(fact, "") is None:
                now.scene.forget([fact])
                now.scene.doubt([fact])
        for fact in now.drawing.leaves:
            if now.scene.is_sensed(fact) and fact not in self.perhaps:
                known = now.scene.reading(fact)
                if self.told.get(fact, "never") != known and not now.scene.in_doubt(fact):
                    now.broken(
                        13, f"{fact} is told as {self.told.get(fact, 'never')}, and it is {known}"
                    )
                    self.told[fact] = known

    def _event(self, event: Json, events: Sequence[Json]) -> None:
        now = self.now
        word = event["event"]
        if now.ended:
            now.broken(9, f"{word} is told after the end")
        if word == "fact_changed":
            fact = f"{event['branch']}/{event['digit']}"
            self.told[fact] = event["value"]
        elif word == "run_started":
            commits.run_started(now, event)
        elif word == "operation_started":
            motion.started(now, event)
        elif word == "operation_ended":
            if now.drawing.level(event["address"]) == "human" and event["outcome"] == "cancelled":
                self._left_off(event["address"])
            if event["outcome"] in ("timed_out", "cancelled"):
                motion.ended(now, event["address"], event["outcome"])
        elif word == "committed":
            commits.committed(now, event)
        elif word == "goal_reached":
            ends.goal_reached(now, [event["goal"]], "goal_reached")
        elif word == "run_finished":
            self._finished(event)
        elif word == "route_planned":
            ends.planned(now, event)
        else:
            self._other(word, event, events)

    def _finished(self, event: Json) -> None:
        now = self.now
        refused = not now.configuration and event["reason"] == "refused"
        quiet = not now.disturbed and not now.drawing.peopled
        if refused and quiet and not commits.may_start(now):
            now.broken(3, f"it is refused without a reason: {event['sentence']}")
        ends.finished(now, event)

    def _other(self, word: str, event: Json, events: Sequence[Json]) -> None:
        now = self.now
        if word == "mismatch":
            trouble.mismatched(now, event)
        elif word == "relocalised":
            by_person = any(
                one["event"] == "commanded" and one["command"] in ("adopt", "accept", "resume")
                for one in events
            )
            trouble.relocalised(now, event, by_person)
            now.latched = "" if now.latched == "held" else now.latched
            if now.requested and now.asked_while in ("held", "paused"):
                now.latched = now.asked_while
            now.requested = ""
            trouble.break_off(now)
        elif word == "given_back":
            trouble.relocalised(now, event, True)
            now.scene.trust()
            now.latched = "paused"
        elif word == "operation_risky":
            now.risky.add(event["address"])
            if now.step is not None:
                now.step.over = True
                now.step.pending.clear()
        elif word == "operation_pruned":
            now.shut[event["address"]] = "pruned"
        elif word == "operation_restored":
            for shut in (now.shut, now.risky, now.vetoed):
                shut.discard(event["address"]) if isinstance(shut, set) else shut.pop(
                    event["address"], None
                )
        elif word == "costs_changed":
            now.costs.update(event["costs"])
        elif word == "operation_refused":
            motion.refused(now, event)
        elif word == "hazard_met":
            if now.step is not None and not now.step.over:
                now.step.endangered = event["name"]
        elif word == "commanded":
            self._commanded(event)
        elif word in LATCHES:
            self._latched(word, event)
        elif word == "resumed":
            now.latched = ""
            self.stood = False
        elif word == "reset":
            now.scene.doubt(event["unknown"])
            now.latched = "paused"
            self.stood = True
        else:
            self.people.event(word, event)

    def _latched(self, word: str, event: Json) -> None:
        now = self.now
        if word == "taken_over":
            now.scene.forget_people()
        if word == "held" and now.latched == "taken over":
            return  # a hazard holds it besides, and nobody but the person decides
        now.latched = LATCHES[word]
        self.stood = word == "paused"
        if word == "held" and event["kind"] == "no_route":
            trouble.no_way(now, event)
        if word == "held":
            trouble.failed(now)
        if word != "paused":
            trouble.break_off(now)

    def _commanded(self, event: Json) -> None:
        now = self.now
        now.disturbed = True
        if event["command"] == "ask" and not now.requested:
            now.asked_while = now.latched or ("running" if now.automatic else "ready")
        if event["refused"]:
            return
        command = event["command"]
        if command in ON and now.latched in ("held", "paused"):
            now.latched = ""
            self.stood = False
        if command == "ask":
            now.requested = event["address"]
        elif command == "veto":
            now.has_vetoes = True
            now.shunned.add(event["address"])
            if now.step is None:
                now.vetoed.add(event["address"])
        elif command in ("resume", "step"):
            now.vetoed = set()
            now.automatic = now.automatic or command == "resume"
        elif command == "adopt":
            now.scene.trust()
        elif command == "set_automatic":
            now.automatic = event["value"] == "on"
