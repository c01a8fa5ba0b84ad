"""One run of a case, recorded in plain values from its first event to its last.

A case is a dict: ``blueprint`` (the JSON of a file), ``asked`` (start, goals, avoid, on_mismatch,
levels, automatic, attended), ``world`` (see ``recorded_host``), ``script`` (acts, each with its
moment), ``people`` (how they answer) and ``agent`` (what a supervisor decides).
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.supervisor import Proposal, Verdict
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.smsl.json_form import parse_json
from tests.oracle.recorded_host import RecordedHost

Json = Any
LONGEST = 900
"""Ticks after which a run is stopped and left; what goes on for much longer hangs."""
PATIENCE = 12
"""Ticks for which a run may wait, while its script may still say something that never comes."""
WAITING = ("ready", "paused", "waiting", "no_route", "taken_over", "fault_hold", "stopped")


def record(case: Mapping[str, Json]) -> list[dict[str, Json]]:
    """Every tick of the run: what was said before it, what the world was asked, what was told.

    The first entry is the opening. The last has the word ``hangs`` where the run did not end.
    """
    blueprint = read_blueprint(parse_json(json.dumps(case["blueprint"]), "case.json"))
    asked = case["asked"]
    host = RecordedHost(blueprint, case.get("world", {}), int(case.get("seed", 0)))
    agent = Agent(case["agent"], host) if case.get("agent") else None
    terms = RunTerms(
        start=asked.get("start", {}),
        goals=[_address(one) for one in asked.get("goals", ())],
        avoid=[_address(one) for one in asked.get("avoid", ())],
        on_mismatch=asked.get("on_mismatch", "hold"),
        automatic=asked.get("automatic", True),
        attended=asked.get("attended", None),
    )
    levels = Levels(blueprint, asked.get("levels", {}))
    dispatcher = Dispatcher(blueprint, host, terms, levels=levels, supervisor=agent)
    voice = Voice(case, dispatcher)
    kept: list[dict[str, Json]] = []

    def keep(said: list[Json], events: Any) -> None:
        told = [json.loads(event.line()) for event in events]
        calls, host.calls = host.calls, []
        if agent is not None:
            agent.host = host
        kept.append({"said": said, "calls": calls, "events": told, "phase": dispatcher.phase})
        voice.hear(told)

    try:
        keep([], dispatcher.open())
        for tick in range(LONGEST + 60):
            if dispatcher.finished:
                break
            said = voice.speak(tick)
            if tick == LONGEST:
                dispatcher.stop()
                dispatcher.leave()
                said = [*said, {"do": "stop"}, {"do": "leave"}]
            keep(said, dispatcher.tick())
        if not dispatcher.finished:
            kept[-1]["hangs"] = True
    finally:
        dispatcher.close()
    return kept


def read(case: Mapping[str, Json]) -> Blueprint:
    """The blueprint of a case, as the program reads it."""
    return read_blueprint(parse_json(json.dumps(case["blueprint"]), "case.json"))


class Agent:
    """A supervisor that says what its case says, one word after the other, then always allows."""

    name = "agent of the case"

    def __init__(self, words: list[str], host: RecordedHost) -> None:
        self._words = list(words)
        self.host = host

    def review(self, proposal: Proposal) -> Verdict:
        word = self._words.pop(0) if self._words else "allow"
        operations = [str(one) for one in proposal.operations]
        self.host.calls.append(["reviewed", str(proposal.operation), operations, word])
        return Verdict(word, "the case says so")


class Voice:
    """Says what the script has when its moment comes, and answers what people are asked."""

    def __init__(self, case: Mapping[str, Json], dispatcher: Dispatcher) -> None:
        self._acts = [dict(act) for act in case.get("script", ())]
        self._people = case.get("people")
        self._dispatcher = dispatcher
        self._goals = set(case.get("goal_states", ()))
        self._due: list[tuple[int, dict[str, Json]]] = []
        self._tick = 0
        self._idle = 0
        self._open: dict[str, Json] = {}
        self._asked = 0
        self._left = False
        self._standing: dict[str, str] = {}
        self._blueprint = case["blueprint"]

    def hear(self, events: list[dict[str, Json]]) -> None:
        """What was told; it brings about acts that hang on it."""
        for event in events:
            for act in list(self._acts):
                if act.get("on") and self._fits(act, event):
                    act["nth"] = act.get("nth", 1) - 1
                    if act["nth"] <= 0:
                        self._acts.remove(act)
                        self._due.append((self._tick + act.get("plus", 0), act))
            self._follow(event)
            if event["event"] == "task_opened":
                self._open[event["task"]] = event
                self._will_answer(event)
            elif event["event"] == "task_closed":
                self._open.pop(event["task"], None)

    def _follow(self, event: Mapping[str, Json]) -> None:
        """Where the procedure stands, by its events."""
        there = event.get("start" if event["event"] == "run_started" else "configuration")
        self._standing.update(there or {})

    def _chosen(self, number: int) -> str:
        """One of the edges that leave an active state."""
        edges = [
            f"{name}/{state}/{operation}"
            for name, state in sorted(self._standing.items())
            for operation in sorted(self._blueprint[name][state])
        ]
        return edges[number % len(edges)] if edges else ""

    def speak(self, tick: int) -> list[Json]:
        """Say what is due before this tick; what was said, in order."""
        for act in list(self._acts):
            if "tick" in act and act["tick"] <= tick:
                self._acts.remove(act)
                self._due.append((tick, act))
        said = [act for at, act in self._due if at <= tick]
        self._due = [one for one in self._due if one[0] > tick]
        self._tick = tick + 1
        told = [plain for act in said if (plain := self._say(act)) is not None]
        waits = self._dispatcher.phase in WAITING
        self._idle = self._idle + 1 if waits and not said else 0
        later = self._due or any("tick" in act for act in self._acts)
        over = self._idle > PATIENCE or (waits and not later and not self._acts)
        if waits and not told and over and not later and not self._left:
            self._left = True
            self._dispatcher.leave()
            told.append({"do": "leave"})
        return told

    def _fits(self, act: Mapping[str, Json], event: Mapping[str, Json]) -> bool:
        if act["on"] == "goal":
            where = f"{str(event.get('address', '')).split('/')[0]}/{event.get('target')}"
            return event["event"] == "operation_started" and where in self._goals
        return bool(event["event"] == act["on"]) and act.get("of", "") in json.dumps(event)

    def _will_answer(self, event: Mapping[str, Json]) -> None:
        """One act for each person that must answer, as the case has it."""
        if not self._people:
            return
        words = self._people["words"]
        word = words[self._asked % len(words)]
        self._asked += 1
        if word == "silent":
            return
        options = event["options"]
        if word == "fact":
            option = options[0]
        elif word == "no" and len(options) > 1:
            option = options[-1]
        else:
            option = options[0]
        if event["kind"] == "fact":
            option = self._true_fact(event["address"], options) if word != "no" else options[-1]
        roles = [one.strip() for one in event["role"].split(",")] if event["role"] else [""]
        for person in range(event["persons"]):
            role = roles[person] if person < len(roles) else ""
            act = {
                "do": "answer",
                "task": event["task"],
                "option": option,
                "role": role,
                "by": f"person {person}",
            }
            self._due.append((self._tick + self._people.get("plus", 0), act))

    def _true_fact(self, address: str, options: list[str]) -> str:
        """What stands on the table, as a person who looks would say it."""
        host: Any = self._dispatcher.host
        branch, _, digit = address.rpartition("/")
        there = host._fact(branch, int(digit))
        return there if there in options else options[0]

    def _say(self, act: Mapping[str, Json]) -> dict[str, Json] | None:
        do, dispatcher = act["do"], self._dispatcher
        if "choose" in act:
            address = self._chosen(act["choose"])
            if not address:
                return None
            act = {"do": do, "address": address}
        by = act.get("by", "script")
        plain = {key: act[key] for key in act if key not in ("on", "of", "nth", "plus", "tick")}
        if do in PLAIN:
            getattr(dispatcher, do)(by=by)
        elif do in ("by_hand", "automatic"):
            dispatcher.set_automatic(do == "automatic", by=by)
        elif do in ("ask", "restore"):
            getattr(dispatcher, do)(_address(act["address"]), by=by)
        elif do == "veto":
            dispatcher.veto(_address(act["address"]) if "address" in act else None, by=by)
        elif do == "prune":
            dispatcher.prune(_address(act["address"]), "by the script", by=by)
        elif do == "set_cost":
            dispatcher.set_cost(_address(act["address"]), act["cost"], by=by)
        elif do == "disturb":
            dispatcher.disturb(act["target"], act["kind"], by=by, **act.get("with", {}))
        elif do == "inject":
            dispatcher.inject(act["fault"], by=by, **act.get("with", {}))
        elif do == "answer":
            if act["task"] not in self._open:
                return None
            dispatcher.answer(act["task"], act["option"], act["role"], by=by)
        else:
            raise ValueError(do)
        return plain


PLAIN = ("pause", "resume", "step", "stop", "reset", "end", "take_over", "give_back", "accept",
         "adopt")  # fmt: skip


def _address(text: str) -> Address:
    return Address(*Address.split(text))
