"""A world of Studio, served to a program that is somewhere else (``docs/remote.md``).

The program asks, and a host of this computer carries it out. Nothing that the program says is
believed before it is checked.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from smsl_studio.blueprint.address import Address, fact_text
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.channel.door import AskedQuestion
from smsl_studio.channel.fields import one_of, text_of
from smsl_studio.channel.frames import VERSION, ChannelError, Frame
from smsl_studio.channel.moment import ToldSample, sample_frame
from smsl_studio.channel.offer import (
    STOPS,
    OfferedOperation,
    OfferedSensor,
    WorldOffer,
    offer_frame,
)
from smsl_studio.channel.questions import OpenQuestion, read_open, read_parameters
from smsl_studio.errors import HostError, RunRefused, StudioError
from smsl_studio.host.protocol import Bound, Host, OpenedWorld, Outcome
from smsl_studio.monitor.sample import Sample

Built = tuple[Host, Blueprint]


class ServedWorld:
    """A world for one program after another. ``build`` makes the host and the blueprint for each.

    ``wants_blueprint`` says that a program must send the text of the blueprint.
    """

    def __init__(
        self, world: str, build: Callable[[OpenQuestion], Built], wants_blueprint: bool
    ) -> None:
        self.begun = 0
        """How many operations have begun so far."""
        self._world, self._build, self._wants = world, build, wants_blueprint
        self._host: Host | None = None
        self._blueprint: Blueprint | None = None
        self._opened: OpenedWorld | None = None
        self._known: Mapping[tuple[str, str], frozenset[str]] = {}
        self._running = False
        self._verbs: dict[str, Callable[[Frame], Frame]] = {
            "open": self._open,
            "sense": self._sense,
            "begin": self._begin,
            "tick": self._tick,
            "stop": self._stop,
            "inject": self._inject,
            "pulse": lambda frame: {},
        }

    def card(self, session: str) -> Frame:
        """Return the answer to ``hello``. The world of the program before is left."""
        self.close()
        return {
            "answer": "hello",
            "version": VERSION,
            "session": session,
            "world": self._world,
            "hardware": False,
            "wants_blueprint": self._wants,
        }

    def answer(self, question: AskedQuestion) -> Frame:
        """Carry out a question. ChannelError if it cannot be asked now, or is not valid."""
        verb = self._verbs.get(question.verb)
        if verb is None:
            raise ChannelError("there is no such question")
        if question.verb not in ("open", "pulse") and self._opened is None:
            raise ChannelError(f"{question.verb} came before open")
        try:
            return {"answer": question.verb, **verb(question.frame)}
        except StudioError as error:
            return {"answer": "refused", "sentence": str(error)[:2000], "advice": error.advice}

    def brake(self) -> bool:
        """Brake the world, because nobody commands it any more. Return whether it stands."""
        self._running = False
        try:
            if self._host is not None and self._opened is not None:
                self._host.cancel("abort")
        except HostError:
            return False
        return True

    def close(self) -> None:
        """Free the world."""
        if self._host is not None:
            self._host.close()
        self._host = self._opened = None
        self._running = False

    # questions ----------------------------------------------------------------------------------

    def _open(self, frame: Frame) -> Frame:
        if self._opened is not None:
            raise ChannelError("open came twice")
        asked = read_open(frame)
        self.close()
        self._host, blueprint = self._build(asked)
        self._blueprint = blueprint
        wrong = [b.name for b in blueprint if asked.start.get(b.name) not in b.table]
        if wrong:
            raise RunRefused(f"the start of {wrong[0]} is no state of it")
        opened = self._host.open({name: asked.start[name] for name in blueprint.branches})
        self._opened = opened
        self._known = _values(opened, blueprint)
        return offer_frame(offer_of(opened))

    def _sense(self, frame: Frame) -> Frame:
        host, _ = self._standing()
        return {"samples": self._told(host.sense())}

    def _begin(self, frame: Frame) -> Frame:
        host, opened = self._standing()
        edge = Address.read(text_of(frame, "operation", 3000))
        bound = opened.bound.get(edge) if edge is not None and self._is_edge(edge) else None
        if edge is None or bound is None or text_of(frame, "function") != bound.function:
            raise ChannelError("an operation was begun that is not offered")
        if self._running:
            raise ChannelError("an operation was begun while another runs")
        host.begin(edge)
        self._running = True
        self.begun += 1
        return {}

    def _tick(self, frame: Frame) -> Frame:
        host, _ = self._standing()
        tick = host.tick()
        if tick.outcome is not Outcome.RUNNING:
            self._running = False
        return {
            "time": tick.time,
            "outcome": tick.outcome.value,
            "message": tick.message[:2000],
            "samples": self._told(tick.samples),
        }

    def _stop(self, frame: Frame) -> Frame:
        host, _ = self._standing()
        host.cancel("hold" if one_of(frame, "mode", STOPS) == "hold" else "abort")
        self._running = False
        return {}

    def _inject(self, frame: Frame) -> Frame:
        host, _ = self._standing()
        host.inject(text_of(frame, "fault"), **read_parameters(frame))
        return {}

    def _is_edge(self, edge: Address) -> bool:
        """Whether the blueprint has an edge. The table of a large world looks it up on demand."""
        branch = self._blueprint.branches.get(edge.branch) if self._blueprint else None
        return branch is not None and edge.operation in branch.table.get(edge.state, {})

    def _standing(self) -> tuple[Host, OpenedWorld]:
        assert self._host is not None
        assert self._opened is not None
        return self._host, self._opened

    def _told(self, samples: Sequence[Sample]) -> list[Frame]:
        return [sample_frame(self._one(sample)) for sample in samples]

    def _one(self, sample: Sample) -> ToldSample:
        fact = fact_text(sample.branch, sample.digit)
        value, reason = sample.value, sample.reason
        known = self._known.get((fact, sample.source))
        if value is not None and known is not None and value not in known:
            reason = f"it reads {value[:40]!r}, which is no value of the fact"
            value = None
        return ToldSample(
            fact, sample.source, value, sample.time, sample.sequence, sample.quality, reason[:2000]
        )


def offer_of(opened: OpenedWorld) -> WorldOffer:
    """Return what an opened world offers.

    Edges that have one function stand under the name of their operation, where that is the same
    for all edges of this name and no binding names one of them exactly.
    """
    by_name: dict[str, set[tuple[Bound, bool]]] = {}
    for edge, bound in opened.bound.items():
        by_name.setdefault(edge.operation, set()).add((bound, bound.exact))
    serves: dict[Bound, dict[str, None]] = {}
    for edge, bound in opened.bound.items():
        plain = len(by_name[edge.operation]) == 1 and not bound.exact
        serves.setdefault(bound, {})[edge.operation if plain else str(edge)] = None
    operations = [
        OfferedOperation(
            bound.function,
            tuple(texts),
            bound.stop,
            bound.timeout,
            bound.resumes,
            tuple(fact_text(*key) for key in bound.touches),
        )
        for bound, texts in serves.items()
    ]
    sensors = [
        OfferedSensor(
            one.name,
            fact_text(one.branch, one.digit),
            one.period,
            one.max_age,
            one.words,
            one.unit,
        )
        for one in opened.sensors
    ]
    return WorldOffer(
        opened.tick, opened.settle, tuple(operations), tuple(sensors), opened.world_faults
    )


def _values(opened: OpenedWorld, blueprint: Blueprint) -> dict[tuple[str, str], frozenset[str]]:
    """Return the values that each sensor may tell. Those that measure are not in it."""
    return {
        (fact_text(one.branch, one.digit), one.name): frozenset(
            (*blueprint[one.branch].alphabet[one.digit], *one.words)
        )
        for one in opened.sensors
        if not one.unit
    }
