"""The questions to people and their answers: guards of clause 4, and facts that people sense."""

from __future__ import annotations

from tests.oracle.situation import HAIR, Json, Situation


class People:
    """The tasks of a run, and who has answered them."""

    def __init__(self, now: Situation) -> None:
        self._now = now
        self._said: list[Json] = []
        self._open: dict[str, Json] = {}
        self._answers: dict[str, dict[str, str]] = {}

    def said(self, acts: list[Json]) -> None:
        """What was commanded before this tick."""
        self._said = [act for act in acts if act.get("do") == "answer"]
        for act in self._said:
            self._answers.setdefault(act["task"], {}).setdefault(act["by"], act["option"])

    def reviewed(self, edge: str, operations: list[str]) -> None:
        """The supervisor was shown a proposal: all edges of the joint step must be in it."""
        plans = self._now.carriages(edge, True)
        if plans and not any(set(operations) == set(plan.starts) for plan in plans):
            self._now.broken(
                4, f"the supervisor is shown {operations} of {edge}, moved are {plans[0].starts}"
            )

    def event(self, word: str, event: Json) -> None:
        """A task was opened, answered or closed."""
        now = self._now
        if word == "task_opened":
            now.asked_people = True
            self._open[event["task"]] = event
            now.tasks[event["task"]] = event
            if event["kind"] == "operation":
                if now.step is not None:
                    now.step.acted.append(event["address"])
                now.scene.forget(now.touched_by(event["address"]))
        elif word == "task_closed":
            task = self._open.pop(event["task"], None)
            now.tasks.pop(event["task"], None)
            if task is not None and event["outcome"] == "answered":
                self._answered(task, event)

    def _answered(self, task: Json, event: Json) -> None:
        now = self._now
        said = self._answers.get(task["task"], {})
        if len(said) < task["persons"] or set(said.values()) != {event["answer"]}:
            now.broken(4, f"{task['kind']} {task['address']} counts as {event['answer']}: {said}")
        if now.now > task["deadline"] + HAIR:
            now.broken(4, f"{task['kind']} {task['address']} is answered after its deadline")
        if task["kind"] == "fact":
            known = event["answer"] if event["answer"] != "cannot say" else None
            now.scene.answer(task["address"], known)
            now.happened()
        else:
            now.agreed.append((task["kind"], task["address"], event["answer"]))
