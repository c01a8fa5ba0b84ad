"""The host of a world that is a program somewhere else (``docs/remote.md``).

The program is trusted with nothing (see ``asked_program``): no operation begins on one that is
lost, late or lying.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from smsl_studio.blueprint.address import Address, fact_text
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.channel.frames import ChannelError
from smsl_studio.channel.line import Declined
from smsl_studio.channel.moment import read_samples, read_tick
from smsl_studio.channel.offer import WorldCard, read_offer
from smsl_studio.errors import HostError, RunRefused, UsageError, did_you_mean
from smsl_studio.host.asked_program import AskedProgram, ProgramTerms
from smsl_studio.host.program_offer import ProgramOffer
from smsl_studio.host.program_sensors import ProgramSensors
from smsl_studio.host.protocol import Happened, OpenedWorld, Outcome, Priced, Tick
from smsl_studio.library.table import facts_of
from smsl_studio.monitor.sample import Sample


class ProgramHost:
    """A world in a program that listens at an address.

    ``parts`` are the blueprints of procedures. Any thread may call ``close``.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        world: str,
        seed: int,
        terms: ProgramTerms,
        parts: tuple[Blueprint, ...] = (),
    ) -> None:
        self._blueprint, self._parts = blueprint, parts
        self._world, self._seed = world, seed
        self._program = AskedProgram(terms)
        self._offer: ProgramOffer | None = None
        self._sensing: ProgramSensors | None = None
        self._faults: tuple[str, ...] = ()
        self._tick = 0.0
        self._ticks = 0
        self._progress: float | None = None

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Connect, and let the program put its world into the states ``start`` (SB -> state).

        RunRefused if the program is hardware and the run is not approved for that, or if it
        refuses. HostError if nobody answers, or what answers is no world, or at a second call.
        """
        if self._offer is not None:
            raise HostError("a program elsewhere is opened once", advice="Start a new run.")
        program = self._program
        card = program.connect()
        if card.hardware and program.terms.barred:
            program.close()
            words = f"the program at {program.terms.address} says that it is hardware"
            sentence = f"{words}, and no policy that names a register is met"
            advice = "Run the blueprint in a simulated world first; see: verify."
            raise RunRefused(sentence, advice=advice, refusals=[(program.terms.barred, sentence)])
        try:
            frame = program.ask("open", program.terms.open_limit, **self._start(start, card))
        except Declined as error:
            program.close()
            raise RunRefused(error.sentence, advice=error.advice) from None
        with program.checking():
            told = read_offer(frame)
        offer = self._offer = ProgramOffer(told, (self._blueprint, *self._parts))
        self._sensing = ProgramSensors(offer, self._seed)
        self._tick, self._faults = told.tick, told.faults
        return offer.opened(self._world, card.hardware)

    def sense(self) -> tuple[Sample, ...]:
        """Read every sensor once. The simulated time does not move."""
        frame, time = self._program.carried("sense"), self._ticks * self._tick
        with self._program.checking():
            return self._heard(frame, time)

    def begin(self, edge: Address) -> None:
        """Let the program begin an operation; it first moves at the next tick."""
        program = self._program
        bound = self._offer.bound.get(edge) if self._offer is not None else None
        if bound is None:
            raise HostError(f"{edge} has no operation in the program at {program.terms.address}")
        if program.running:
            raise HostError(f"{edge} cannot begin: another operation runs")
        program.carried("begin", operation=str(edge), function=bound.function)
        program.running, self._progress = str(edge), None

    def tick(self) -> Tick:
        """Let the program's world advance by one tick."""
        program = self._program
        frame = program.carried("tick")
        self._ticks += 1
        time = self._ticks * self._tick
        with program.checking():
            told = read_tick(frame, time)
            if program.running and told.outcome == "idle":
                raise ChannelError("it does nothing, and an operation has begun")
            if not program.running and told.outcome != "idle":
                raise ChannelError(f"an operation is {told.outcome}, and none has begun")
            samples = self._sensed().heard(told.samples, time)
        if told.outcome != "running":
            program.running = ""
        self._progress = told.progress
        return Tick(time, Outcome(told.outcome), samples, told.message)

    def cancel(self, mode: str) -> None:
        """Stop what moves, at once, even while an answer is owed. ``finish`` lets it run on.

        HostError if the program does not acknowledge the stop. It may move on then.
        """
        if mode != "finish":
            self._program.stop(mode)

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """Disturb a sensor, or all sensors of a fact, on this side of the connection."""
        return self._sensed().disturb(target, kind, parameters)

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Let the program cause a fault. UsageError if it has none of this name, or refuses."""
        if fault not in self._faults:
            there = f"There are {', '.join(self._faults)}." if self._faults else "It offers none."
            advice = did_you_mean(fault, self._faults) or there
            raise UsageError(f"the world {self._world!r} has no fault {fault!r}", advice=advice)
        try:
            limit = self._program.terms.answer_limit
            self._program.ask("inject", limit, fault=fault, parameters=parameters)
        except Declined as error:
            raise UsageError(error.sentence, advice=error.advice) from None

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Return no costs. The protocol has none, so the declared ones count."""
        return Priced()

    def suppose(self, edge: Address) -> None:
        """Do nothing. The protocol has no guards."""

    def poses(self) -> tuple[float, ...]:
        """Return no poses. The protocol draws nothing."""
        return ()

    def status(self) -> Mapping[str, str]:
        """Return how far the operation is, if the program says so."""
        progress = self._progress
        return {} if progress is None else {"progress": f"{progress:.0%}"}

    def check(self) -> None:
        """Raise HostError if the program is lost, as far as is known."""
        self._program.check()

    def close(self) -> None:
        """End the connection, so that the program brakes. A second call does nothing."""
        self._program.close()

    def _heard(self, frame: Mapping[str, Any], time: float) -> tuple[Sample, ...]:
        return self._sensed().heard(read_samples(dict(frame), time), time)

    def _sensed(self) -> ProgramSensors:
        if self._sensing is None:
            raise HostError("the host is not open")
        return self._sensing

    def _start(self, start: Mapping[str, str], card: WorldCard) -> dict[str, Any]:
        """Return the fields of ``open``."""
        branches = {one.name: one for part in (self._blueprint, *self._parts) for one in part}
        facts = {
            fact_text(*key): value
            for name, state in start.items()
            for key, value in facts_of(branches[name], state).items()
        }
        said: dict[str, Any] = {
            "start": dict(start),
            "facts": facts,
            "seed": self._seed,
            "behaviour": self._blueprint.behaviour,
        }
        if not card.wants_blueprint:
            return said
        if self._parts:
            words = "the program wants the blueprint, and this one runs procedures"
            raise RunRefused(words, advice="Run it in a world of this computer.")
        said["blueprint"] = [
            {"file": one.file, "form": one.form, "text": one.text}
            for one in self._blueprint.documents
        ]
        return said
