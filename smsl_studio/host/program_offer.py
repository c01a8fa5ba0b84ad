"""Binds the offer of a program elsewhere to a blueprint: which edges it serves, and which facts it
senses. Only what fits the blueprint is bound; the rest is told as faults, and never used."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from smsl_studio.blueprint.address import Address, fact_text, split_fact
from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.channel.offer import OfferedOperation, OfferedSensor, WorldOffer
from smsl_studio.host.fact_rules import rules_of
from smsl_studio.host.protocol import Bound, OpenedWorld, SensorInfo
from smsl_studio.library.bound import Bindings, leaf_facts, noted_touches
from smsl_studio.monitor.aggregate import FactRule

MOST_FAULTS = 100
"""The largest number of faults that are told."""


class ProgramOffer:
    """An offer, and what of it a blueprint with its procedures uses."""

    def __init__(self, offer: WorldOffer, blueprints: Sequence[Blueprint]) -> None:
        self._offer = offer
        self._branches = {one.name: one for blueprint in blueprints for one in blueprint}
        self._blueprints = tuple(blueprints)
        self._facts = {
            fact_text(branch.name, digit): branch
            for blueprint in blueprints
            for branch, digit in leaf_facts(blueprint)
        }
        self.faults: list[str] = []
        self.unbound: set[tuple[str, str]] = set()
        """The offered sensors that are not used: their facts and names."""
        self.bound = dict(self._bound())
        self.sensors = tuple(self._sensors())

    def opened(self, world: str, hardware: bool) -> OpenedWorld:
        """Return the description of the world."""
        faults = self.faults
        if len(faults) > MOST_FAULTS:
            faults = [*faults[:MOST_FAULTS], f"{len(faults) - MOST_FAULTS:,} more are not bound"]
        return OpenedWorld(
            world=world,
            tick=self._offer.tick,
            hardware=hardware,
            bound=self.bound,
            sensors=self.sensors,
            shapes=(),
            settle=self._offer.settle,
            faults=tuple(faults),
            rules=self._rules(),
            world_faults=self._offer.faults,
        )

    def values(self, sensor: SensorInfo) -> frozenset[str]:
        """Return the values that a sensor may read: those of its fact, and those it explains."""
        return frozenset((*self.alphabet(sensor), *sensor.words))

    def alphabet(self, sensor: SensorInfo) -> tuple[str, ...]:
        """Return the values of the fact that a sensor reads, in order."""
        return tuple(self._branches[sensor.branch].alphabet[sensor.digit])

    def _bound(self) -> Iterator[tuple[Address, Bound]]:
        """Yield every edge that an operation serves. An address counts before a name, and of two
        operations that serve the same the first one."""
        by_text: dict[str, OfferedOperation] = {}
        for operation in self._offer.operations:
            for served in operation.serves:
                by_text.setdefault(served, operation)
        used: set[str] = set()
        for branch in self._branches.values():
            for edge in branch.edges():
                address = edge.address
                whole, name = str(address), address.operation
                text = whole if whole in by_text else name
                if text in by_text:
                    used.add(text)
                    yield address, self._of(by_text[text], branch, address, text == whole)
        for text in by_text:
            if text not in used:
                self.faults.append(f"the program serves {text!r}, which is no operation")

    def _of(
        self, operation: OfferedOperation, branch: StateBranch, edge: Address, exact: bool
    ) -> Bound:
        note = branch.operation_note(edge.state, edge.operation)
        return Bound(
            operation.function,
            exact,
            note.stop or operation.stop,
            note.timeout or operation.timeout,
            operation.resumes if note.resumes is None else note.resumes,
            (*noted_touches(branch, note), *self._touched(operation)),
        )

    def _touched(self, operation: OfferedOperation) -> Iterator[FactKey]:
        for text in operation.touches:
            key = split_fact(text)
            branch = self._branches.get(key[0]) if key else None
            if key is None or branch is None or key[1] >= branch.num_facts:
                fault = f"{operation.function} touches {text!r}, which is no fact"
                if fault not in self.faults:
                    self.faults.append(fault)
            else:
                yield key

    def _sensors(self) -> Iterator[SensorInfo]:
        for sensor in self._offer.sensors:
            branch, key = self._facts.get(sensor.fact), split_fact(sensor.fact)
            wrong = f"reads {sensor.fact!r}, which no sensor can read"
            if branch is not None and key is not None:
                wanted = _unit(branch, key[1], sensor.name)
                wrong = f"measures {sensor.unit!r}; the blueprint wants {wanted or 'no unit'}"
                wrong = wrong if sensor.unit != wanted else ""
            if branch is None or key is None or wrong:
                self.unbound.add((sensor.fact, sensor.name))
                self.faults.append(f"the sensor {sensor.name} {wrong}")
            else:
                yield _info(sensor, branch.fact_note(key[1]), key)

    def _rules(self) -> dict[FactKey, FactRule]:
        found: dict[FactKey, FactRule] = {}
        for blueprint in self._blueprints:
            named = {
                (branch.name, digit): tuple(note.sensors)
                for branch, digit in leaf_facts(blueprint)
                if (note := branch.fact_note(digit)) is not None
            }
            found |= rules_of(blueprint, Bindings({}, (), named=named))
        return found


def _info(sensor: OfferedSensor, note: FactNote | None, key: FactKey) -> SensorInfo:
    return SensorInfo(
        sensor.name,
        *key,
        sensor.period,
        (note.max_age if note else None) or sensor.max_age,
        note.aggregation if note else "single",
        dict(sensor.words),
        unit=sensor.unit,
    )


def _unit(branch: StateBranch, digit: int, source: str) -> str:
    """Return the unit in which predicates of a fact read a source, empty if they do not."""
    sense = branch.notes.senses.get(digit)
    if sense is None or sense.fault is not None:
        return ""
    units: Mapping[str, object] = sense.units
    return sense.units[source].text if source in units else ""
