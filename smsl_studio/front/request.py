"""The request of a run: one frozen value for Python, the command line, the window and the log."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.drive.supervisor import Supervisor
from smsl_studio.errors import UsageError
from smsl_studio.front.log_seals import Seal
from smsl_studio.front.run_trust import RunTrust
from smsl_studio.front.script.addresses import Written, operations_at, states_at
from smsl_studio.front.script.script import Script
from smsl_studio.front.supervisors import supervisor_of
from smsl_studio.world.engines import REMOTE, TABLE

Json = Any
Several = Written | Iterable[Written] | None
Supervising = Supervisor | str | Sequence[str] | None
"""A supervisor, or automatic supervisors by name (see ``agents.asked_agent``)."""
HOSTS = ("local", "process")
ON_MISMATCH = ("hold", "adopt")


@dataclass(frozen=True, eq=False)
class RunRequest:
    """Everything that is asked for a run. Only ``checked`` looks up the names in it.

    ``starts`` and ``goals`` are states, at most one for each SB. The default is INITIAL and
    ACTIVATING. ``avoid`` are operations that the run must not use. ``levels`` replace levels of the
    blueprint (see ``blueprint.levels``). ``script`` supervises the run. ``broker`` (HOST:PORT),
    ``site`` and ``login`` (a login file) are for remote sensors. ``speed`` is simulated time
    divided by wall time; None means as fast as possible. ``log`` is the file for the recording.

    A run ``by_hand`` chooses no operation itself. ``attended`` says that a person can end a hold;
    None means that only a run ``by_hand`` is attended. ``agents`` are automatic supervisors by name
    (see ``agents.asked_agent``), in the place of a ``supervisor``. ``person`` is the name of the
    person who supervises if there is no ``supervisor``. ``plugin_paths`` are searched before all
    other folders.

    ``policy`` is the file of a trust policy, and ``record`` the file of a record. If either is
    given, the run starts only if the blueprint is approved. ``now`` is the time for this question;
    None means the clock of the computer. ``trust`` is the answer to it. ``seal`` signs the head of
    the log (see ``log_seals``). ``robot`` is the robot to build the world with; empty means the
    usual one of the world. ``forecast`` is the level at which each operation is tried in a
    simulated world before it begins (see ``foresight``): show, ask or hold; empty means never.
    ``generate`` is who proposes edges where no way leads to the goals (see ``edge_proposer``);
    empty means nobody.
    ``address`` (``unix:PATH`` or ``HOST:PORT``) is where the program of the world remote listens,
    and ``token_file`` has the token that it asks for. In a ``trial`` generated functions run that
    have not passed their sweep.

    >>> RunRequest(read("hanoi.json"), goals=("State_ccc",)).checked().goals
    (Address(branch='SB1', state='State_ccc', operation=''),)
    """

    blueprint: Blueprint
    world: str = TABLE
    starts: tuple[Written, ...] = ()
    goals: tuple[Written, ...] = ()
    seed: int = 0
    host: str = "process"
    avoid: tuple[Written, ...] = ()
    levels: Mapping[str, str] = field(default_factory=dict)
    script: Script | None = None
    broker: str = ""
    site: str = ""
    login: str = ""
    on_mismatch: str = "hold"
    speed: float | None = None
    log: Path | None = None
    by_hand: bool = False
    attended: bool | None = None
    supervisor: Supervisor | None = None
    agents: tuple[str, ...] = ()
    person: str = ""
    plugin_paths: tuple[Path, ...] = ()
    policy: Path | None = None
    record: Path | None = None
    now: datetime | None = None
    trust: RunTrust | None = None
    seal: Seal | None = field(default=None, repr=False)
    robot: str = ""
    forecast: str = ""
    generate: str = ""
    address: str = ""
    token_file: str = ""
    trial: bool = False

    @property
    def asks_approval(self) -> bool:
        """Whether the blueprint must be approved before the run starts."""
        return self.policy is not None or self.record is not None

    @property
    def may_be_hardware(self) -> bool:
        """Whether a program elsewhere may be hardware. Its host asks it before it is opened."""
        return self.world == REMOTE and self.trust is not None and not self.trust.barred

    @property
    def supervised(self) -> bool:
        """Whether a person or an agent supervises the run.

        A script does not: it was written before, and nobody knows whether its moments come.
        """
        scripted = self.script is not None and bool(self.script.acts)
        present = self.by_hand or (self.attended and not scripted)
        return bool(self.supervisor or self.agents or self.person or present)

    @property
    def set_levels(self) -> Mapping[str, str]:
        """The levels that are set for this run, those of its script included."""
        return {**self.levels, **(self.script.levels if self.script else {})}

    def checked(self) -> RunRequest:
        """Return the request with checked addresses, the levels of its script, and its supervisor.

        AddressError for an unknown address, UsageError for parts that do not fit together.
        """
        _one_of(self.host, HOSTS, "host")
        _one_of(self.on_mismatch, ON_MISMATCH, "on_mismatch")
        if (self.address or self.token_file) and self.world != REMOTE:
            words = f"an address is for the world {REMOTE!r}, not for {self.world!r}"
            raise UsageError(words, advice="Say --world remote, or leave the address out.")
        forecast = self.forecast or self._implied_forecast()
        if forecast and self.world == REMOTE:
            words = "what a program elsewhere does cannot be tried beforehand"
            raise UsageError(words, advice="Leave the forecast out.")
        levels = self.set_levels
        return replace(
            self,
            goals=states_at(self.blueprint, self.goals, "goal"),
            starts=states_at(self.blueprint, self.starts, "start"),
            avoid=operations_at(self.blueprint, self.avoid),
            levels=levels,
            supervisor=supervisor_of(Levels(self.blueprint, levels), self._named()),
            forecast=forecast,
        )

    def _implied_forecast(self) -> str:
        """Return the level that a supervisor needs which decides by forecasts."""
        names = (text.partition(":")[0] for text in self.agents)
        return "show" if "forecast" in names else ""

    def _named(self) -> Supervisor | None:
        if self.supervisor is not None or not self.agents:
            return self.supervisor
        from smsl_studio.front.agents.agents import Agents

        return Agents(self.agents, self.plugin_paths)

    def as_json(self) -> Mapping[str, Json]:
        """Return the choices for the header of a log. Addresses are texts."""
        script = self.script
        return {
            "seed": self.seed,
            "host": self.host,
            "start": list(map(str, self.starts)),
            "goals": list(map(str, self.goals)),
            "avoid": list(map(str, self.avoid)),
            "on_mismatch": self.on_mismatch,
            "by_hand": self.by_hand,
            "attended": self.by_hand if self.attended is None else self.attended,
            "levels": dict(self.levels),
            "script": {"file": script.file, "digest": script.digest} if script else None,
            "supervisor": self.supervisor.name if self.supervisor else self.person,
            **({"robot": self.robot} if self.robot else {}),
            **({"forecast": self.forecast} if self.forecast else {}),
            **({"generate": self.generate} if self.generate else {}),
            **({"address": self.address} if self.address else {}),
        }


def several(asked: Several) -> tuple[Written, ...]:
    """Return one address, several addresses, or None as a tuple."""
    if asked is None:
        return ()
    return (asked,) if isinstance(asked, str | Address) else tuple(asked)


def supervised_by(asked: Supervising) -> tuple[Supervisor | None, tuple[str, ...]]:
    """Return a supervisor, and the names of automatic ones. One of both is empty."""
    if asked is None:
        return None, ()
    if isinstance(asked, str):
        return None, (asked,)
    return (None, tuple(asked)) if isinstance(asked, Sequence) else (asked, ())


def _one_of(value: str, known: tuple[str, ...], what: str) -> None:
    if value not in known:
        raise UsageError(f"{what} is {value!r}, not one of {', '.join(known)}")
