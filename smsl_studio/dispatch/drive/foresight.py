"""Foresight: the forecast of a step before it begins, and its comparison with what happened.

A forecast is no evidence. It can keep a step from beginning. Only a state check commits a step.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene
from smsl_studio.blueprint.continuum import FORECAST, SHOW
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.levels import careful
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.drive.supervisor import ALLOW, Verdict
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.library.prediction import AGREES, NONE, Prediction
from smsl_studio.runlog.events import ForecastTold
from smsl_studio.runlog.regulation import RIGHT, UNKNOWN, WRONG

NO_FACTS: Mapping[str, str] = MappingProxyType({})
BY_PERSON = Prediction(NONE, reason="a person carries it out", by_people=True)
ASKS = Prediction(NONE, reason="a person has to answer before it goes on", by_people=True)


class Simulator(Protocol):
    """A simulated world beside the one of the run. Nothing that it does moves the run."""

    def predict(self, configuration: Mapping[str, str], edge: Address) -> Prediction:
        """Carry out an operation from a configuration. Stopped if the run must stop meanwhile."""
        ...

    def extend(self, blueprint: Blueprint) -> None:
        """Simulate from now on a blueprint that has one more edge."""
        ...

    def close(self) -> None:
        """Free the simulated world. A second call does nothing."""
        ...


class Foresight:
    """Asks a simulator before each step that has a level (see ``continuum.FORECAST_LEVELS``).

    ``level`` is that of the whole run, empty for none. The levels of the blueprint may be higher.
    """

    def __init__(self, simulator: Simulator, level: str = "") -> None:
        self._simulator, self._level = simulator, level
        self._made: tuple[Address, Prediction] | None = None

    def level(self, run: LiveRun, step: JointStep) -> str:
        """Return the most careful level of the edges of a step, empty if none has one."""
        own = (run.levels.forecast(edge.address) for edge in step.edges)
        return careful(self._level, *own)

    def look(self, run: LiveRun, step: JointStep) -> Prediction | None:
        """Tell the forecast of a step, and return it. None for a step without a level."""
        edge = step.asked.address
        if not self.level(run, step):
            self._made = None
            return None
        if any(run.by_person(one) for one in step.edges):
            found = BY_PERSON
        else:
            found = self._simulator.predict(dict(run.configuration), edge)
        self._made = (edge, found)
        now = sensed_values(run.senses.scene)
        facts = {
            key: UNKNOWN if value is None else value
            for key, value in found.after.items()
            if now.get(key) != value
        }
        _tell(run, edge, found.verdict, found.reason, facts)
        return found

    def verdict(self, run: LiveRun, step: JointStep, found: Prediction | None) -> Verdict:
        """Return what the level of a step says about its forecast."""
        level = self.level(run, step)
        if found is None or level == SHOW or found.verdict == AGREES or found.by_people:
            return Verdict(ALLOW)
        words = "no forecast" if found.verdict == NONE else "the forecast differs"
        return Verdict(level, f"{words}: {found.reason}", by=FORECAST)

    def compare(self, run: LiveRun, step: JointStep) -> None:
        """Tell whether the forecast of a step that has ended was right.

        Facts that are not known now are left out. Nothing is told if there was no forecast.
        """
        made, self._made = self._made, None
        if made is None or made[0] != step.asked.address or made[1].verdict == NONE:
            return
        now = sensed_values(run.senses.scene)
        wrong = [
            f"{key} is {now[key]}, not {value or 'unknown'}"
            for key, value in made[1].after.items()
            if now.get(key) is not None and now[key] != value
        ]
        _tell(run, made[0], WRONG if wrong else RIGHT, ", ".join(wrong))

    def extend(self, blueprint: Blueprint) -> None:
        """Foresee from now on with a blueprint that has one more edge."""
        self._simulator.extend(blueprint)

    def close(self) -> None:
        """Free the simulated world."""
        self._simulator.close()


def _tell(
    run: LiveRun, edge: Address, verdict: str, reason: str, facts: Mapping[str, str] = NO_FACTS
) -> None:
    told = ForecastTold(t=run.time, address=str(edge), verdict=verdict, facts=facts, reason=reason)
    run.emit(told)


def sensed_values(scene: Scene) -> dict[str, str | None]:
    """Return the value of each sensed fact of a scene by ``SB/digit``. None is an unknown fact."""
    return {
        f"{Address(branch)}/{digit}": one.value
        for (branch, digit), one in sorted(scene.readings.items())
        if one.sensed
    }
