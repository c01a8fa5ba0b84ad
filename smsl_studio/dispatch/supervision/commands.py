"""The commands of a dispatcher: each waits for the next tick and is answered there by one event.

``by`` names who says it; it stands in the record.
"""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.supervision.command import PERSON, Command


class Commands:
    """What may be said to a run. ``docs/supervision.md`` has what each does in each run state."""

    def __init__(self) -> None:
        self._waiting: list[Command] = []

    @property
    def commanded(self) -> tuple[str, ...]:
        """The words of the commands that wait for the next tick."""
        return tuple(command.word for command in self._waiting)

    # going on and holding -----------------------------------------------------------------------

    def ask(self, address: Address, *, by: str = PERSON, every_time: bool = False) -> None:
        """Carry out one operation that a person chose; refused with every reason otherwise.

        ``every_time``: it is asked for by itself whenever the run comes by, so it must end.
        """
        said = {"every_time": True} if every_time else {}
        self._say(Command("ask", by, address, parameters=said))

    def pause(self, *, by: str = PERSON) -> None:
        """Hold now, or as the running operation declares (finish it, abort it)."""
        self._say(Command("pause", by))

    def resume(self, *, by: str = PERSON) -> None:
        """Go on after a pause or a hold: state and route are checked again. By hand: run by
        itself from now on."""
        self._say(Command("resume", by))

    def step(self, *, by: str = PERSON) -> None:
        """Carry out one operation of the route, then pause; ignored while one is carried out."""
        self._say(Command("step", by))

    def set_automatic(self, automatic: bool, *, by: str = PERSON) -> None:
        """Follow the route by itself, or wait to be asked."""
        self._say(Command("set_automatic", by, value=_on(automatic)))

    # about edges --------------------------------------------------------------------------------

    def veto(self, address: Address | None = None, *, reason: str = "", by: str = PERSON) -> None:
        """Skip the next operation once (or this one, the next time it would begin)."""
        self._say(Command("veto", by, address, reason=reason))

    def prune(self, address: Address, reason: str, *, by: str = PERSON) -> None:
        """Shut an edge out until it is restored; if it is being carried out, stop it."""
        self._say(Command("prune", by, address, reason=reason))

    def restore(self, address: Address, *, by: str = PERSON) -> None:
        """Let a pruned, avoided, vetoed or risky edge be used again."""
        self._say(Command("restore", by, address))

    def set_cost(self, address: Address, cost: float, *, by: str = PERSON) -> None:
        """Price an edge anew; the route is found again."""
        self._say(Command("set_cost", by, address, value=str(float(cost))))

    # latches ------------------------------------------------------------------------------------

    def stop(self, *, by: str = PERSON) -> None:
        """Brake within one step of the world and latch; unattended, it is the end of the run."""
        self._say(Command("stop", by))

    def reset(self, *, by: str = PERSON) -> None:
        """Unlatch a stop, to paused and no further."""
        self._say(Command("reset", by))

    def end(self, *, by: str = PERSON) -> None:
        """Finish a run that is stopped or holds."""
        self._say(Command("end", by))

    def take_over(self, *, by: str = PERSON) -> None:
        """Lock automation out; the dispatcher only observes."""
        self._say(Command("take_over", by))

    def give_back(self, *, by: str = PERSON) -> None:
        """Ask the scene where the procedure stands: one configuration must check true."""
        self._say(Command("give_back", by))

    def accept(self, *, by: str = PERSON) -> None:
        """Take the configuration that ``give_back`` found; the run is paused then."""
        self._say(Command("accept", by))

    def adopt(self, *, by: str = PERSON) -> None:
        """While it holds: go on from the one configuration the scene agrees with."""
        self._say(Command("adopt", by))

    # people, trials, view -----------------------------------------------------------------------

    def answer(self, task: str, option: str, role: str = "", *, by: str = PERSON) -> None:
        """Answer a task, in a role; what was answered stays hidden until all have."""
        said = {"option": option, "role": role}
        self._say(Command("answer", by, value=task, parameters=said))

    def disturb(
        self, target: str, kind: str, *, by: str = PERSON, **parameters: float | str
    ) -> None:
        """Disturb a sensor, or all of one fact (``SB/digit``), from now on; ``none`` ends it."""
        said = {"target": target, "kind": kind, "with": parameters}
        self._say(Command("disturb", by, value=f"{target} {kind}", parameters=said))

    def inject(self, fault: str, *, by: str = PERSON, **parameters: float | str) -> None:
        """Have something go wrong in the world, by the name that its plugin gave it."""
        self._say(Command("inject", by, value=fault, parameters=parameters))

    def full_map(self, on: bool, *, by: str = PERSON) -> None:
        """Show a supervisor the whole map instead of the neighbours, or no longer."""
        self._say(Command("full_map", by, value=_on(on)))

    def _say(self, command: Command) -> None:
        self._waiting.append(command)


def _on(value: bool) -> str:
    return "on" if value else "off"
