"""The watch for hazards while no step is carried out: if one is met, the run holds.

It also watches while a person has taken over or drives by hand. A stop counts more than a hold, so
a stopped run only tells the hazard, and holds when it would go on.
"""

from __future__ import annotations

from smsl_studio.dispatch.drive.conduct import Conduct
from smsl_studio.dispatch.drive.run_state import RunState
from smsl_studio.dispatch.execution.hazard_guard import met, tell
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.trouble import Trouble


class HazardWatch:
    """Holds a run while the sensed facts meet a hazard."""

    def __init__(self, run: LiveRun, state: RunState, trouble: Trouble, conduct: Conduct) -> None:
        self._run, self._state, self._trouble, self._conduct = run, state, trouble, conduct

    def holds(self) -> bool:
        """Hold if a hazard is met. Return whether the run holds or is latched in one.

        A run that holds is told again only of another hazard.
        """
        found = met(self._run) if self._run.hazards else ()
        if not found:
            return False
        state = self._state
        new = [one for one in found if one.name not in self._run.told_hazards]
        if state.stopped or state.held is not None:
            if not new:
                return True
            found = tuple(new)
        self._conduct.withdraw()
        tell(self._run, found)
        if not state.stopped:
            observes = bool(state.taken_over)
            self._conduct.hold(self._trouble.endangered(found, observes=observes))
        return True
