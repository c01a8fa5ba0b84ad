"""Binds names to code: a function to each edge, and sensors to each fact.

For an edge, the first of these decides: the bindings file by ``State/Operation``, the blueprint's
``_operations`` by ``State/Operation``, the bindings file by operation name, ``_operations`` by
name, a plugin's plain name, a plugin's pattern. Of several patterns the one with more fixed
characters counts, then the one that was registered first. A binding that does not fit is a fault:
its edge stays unbound, and no weaker binding replaces it. For a fact, the first of these decides:
the bindings file, ``_facts`` (``sensors``), the sensors that declare the fact themselves. A fact
with predicates has the sensors that measure what the predicates name, and no others.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from smsl_studio.blueprint.address import Address, fact_text, note_key
from smsl_studio.blueprint.annotations import Binding, ProcedureBinding
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.predicates import FactSense, read_unit
from smsl_studio.errors import Place, PluginError, did_you_mean
from smsl_studio.library.bindings_file import BindingsFile, BoundFunction, WorldTable
from smsl_studio.library.bound import (
    BindingFault,
    Bindings,
    BoundCost,
    BoundOperation,
    BoundSensor,
    leaf_facts,
    noted_touches,
)
from smsl_studio.library.entries import CostEntry
from smsl_studio.library.fact_default import FactDefault, default_of
from smsl_studio.library.generated_offers import GeneratedOffers, left_out
from smsl_studio.library.loaded import Loaded, Plugin
from smsl_studio.library.operation_entry import OperationEntry
from smsl_studio.library.sensor_entry import SensorEntry
from smsl_studio.library.table import table_bindings
from smsl_studio.world.engines import TABLE


def bind(
    blueprint: Blueprint,
    loaded: Loaded,
    world: str,
    bindings: BindingsFile | None = None,
    *,
    trial: bool = False,
) -> Bindings:
    """Return the bindings of a blueprint in a world. WorldError if there is no such world. A
    generated function counts once it has passed its sweep in this world, or in a ``trial``."""
    if world == TABLE:
        return table_bindings(blueprint)
    binder = _Binder(blueprint, loaded.serving(world), world, bindings or BindingsFile())
    binder.offers = GeneratedOffers(world, loaded.world(world)[1].hardware, trial)
    operations, costs = dict(binder.operations()), dict(binder.costs())
    sensors = tuple(binder.sensors())
    binder.faults += left_out(blueprint, loaded)
    faults = (*binder.faults, *binder.unknown_keys())
    return Bindings(operations, sensors, faults, binder.named, costs)


class _Binder:
    """One pass over a blueprint, with the available functions and the faults found so far."""

    def __init__(
        self, blueprint: Blueprint, plugins: tuple[Plugin, ...], world: str, file: BindingsFile
    ) -> None:
        self.blueprint = blueprint
        self.plugins = plugins
        self.world = world
        self.file = file
        self.table: WorldTable = file.of(world)
        self.faults: list[BindingFault] = []
        self.named: dict[FactKey, tuple[str, ...]] = {}
        self.offers = GeneratedOffers(world)
        self.by_name = {
            entry.name: (plugin, entry) for plugin in plugins for entry in plugin.library.operations
        }
        self._by_text: dict[
            tuple[str, str], tuple[Plugin, OperationEntry, dict[str, str]] | None
        ] = {}

    def operations(self) -> Iterator[tuple[Address, BoundOperation]]:
        """Yield every edge that has a function, with this function. A binding that does not fit
        becomes a fault."""
        for branch in self.blueprint:
            for edge in branch.edges():
                try:
                    bound = self._operation(branch, edge.address)
                except PluginError as error:
                    self._fault(str(edge.address), error)
                else:
                    if bound is not None:
                        yield edge.address, bound

    def _operation(self, branch: StateBranch, edge: Address) -> BoundOperation | None:
        whole, own, name = str(edge), note_key(edge.operation, edge.state), note_key(edge.operation)
        in_file, notes = self.table.operations, branch.notes.operations
        candidates: tuple[
            tuple[Binding | ProcedureBinding | BoundFunction | None, bool, str], ...
        ] = (
            (in_file.get(whole), True, whole),
            (in_file.get(own), True, own),
            (notes[own].binding if own in notes else None, True, own),
            (in_file.get(name), False, name),
            (notes[name].binding if name in notes else None, False, name),
        )
        for found, exact, key in candidates:
            if isinstance(found, ProcedureBinding):
                return None
            if found is not None:
                place = self._place(branch, found, key)
                return self._explicit(branch, edge, found, exact, place)
        return self._by_pattern(branch, edge)

    def _place(self, branch: StateBranch, found: Binding | BoundFunction, key: str) -> Place | None:
        if isinstance(found, BoundFunction):
            return self.file.place(key)
        return self.blueprint.place(branch.address, "_operations", key)

    def _explicit(
        self,
        branch: StateBranch,
        edge: Address,
        found: Binding | BoundFunction,
        exact: bool,
        place: Place | None,
    ) -> BoundOperation | None:
        if found.function not in self.by_name:
            raise PluginError(
                f"the world {self.world!r} has no function {found.function!r}",
                place,
                did_you_mean(found.function, self.by_name),
            )
        plugin, entry = self.by_name[found.function]
        try:
            arguments = entry.signature.checked(found.arguments)
        except PluginError as error:
            sentence = f"{found.function}: {error.sentence}"
            raise PluginError(sentence, place, error.advice) from None
        return self._bound(branch, edge, (plugin, entry), arguments, exact)

    def _by_pattern(self, branch: StateBranch, edge: Address) -> BoundOperation | None:
        name = (branch.name, edge.operation)
        if name not in self._by_text:
            self._by_text[name] = self._match(*name)
        found = self._by_text[name]
        if found is None:
            return None
        plugin, entry, texts = found
        arguments = entry.signature.converted(texts)
        return self._bound(branch, edge, (plugin, entry), arguments)

    def _match(
        self, branch: str, name: str
    ) -> tuple[Plugin, OperationEntry, dict[str, str]] | None:
        best = None
        for plugin in self.plugins:
            for entry in plugin.library.operations:
                texts = entry.texts(branch, name)
                if entry.pattern is None or texts is None:
                    continue
                # What people have written comes first, however well a generated name fits.
                rank = (not entry.code, not entry.pattern.parameters, entry.pattern.literal)
                if best is None or rank > best[0]:
                    best = rank, (plugin, entry, texts)
        return best[1] if best else None

    def _bound(
        self,
        branch: StateBranch,
        edge: Address,
        code: tuple[Plugin, OperationEntry],
        arguments: Mapping[str, Any],
        exact: bool = False,
    ) -> BoundOperation | None:
        plugin, entry = code
        if entry.code:
            if not self.offers.offers(entry, edge, branch.table[edge.state][edge.operation]):
                return None
            arguments = {"operations": partial(self._begun, branch.name)}
        note = branch.operation_note(edge.state, edge.operation)
        stop, timeout = note.stop or entry.stop, note.timeout or entry.timeout
        resumes = entry.resumes if note.resumes is None else note.resumes
        return BoundOperation(
            entry.name,
            entry.function,
            arguments,
            exact,
            stop,
            timeout,
            plugin.location,
            resumes,
            (*noted_touches(branch, note), *self._touched(branch, entry, arguments)),
            entry.available,
            bool(entry.code),
        )

    def _begun(self, branch: str, world: Any, name: str) -> Generator[Any, Any, Any]:
        """Begin an operation of this world for generated code. PluginError if there is none."""
        found = self._match(branch, name)
        if found is None or found[1].code:
            raise PluginError(f"the world {self.world!r} has no operation {name[:100]!r}")
        _, entry, texts = found
        steps: Generator[Any, Any, Any] = entry.function(world, **entry.signature.converted(texts))
        return steps

    def _touched(
        self, branch: StateBranch, entry: OperationEntry, arguments: Mapping[str, Any]
    ) -> Iterator[FactKey]:
        """Yield the facts in the ``touches`` of a function. PluginError if one is no fact of the
        blueprint."""
        for pattern in entry.touches:
            text = pattern.fill(arguments)
            name, _, number = text.rpartition("/")
            found = self.blueprint.branches.get(name or branch.name)
            at = int(number) if number.isascii() and number.isdecimal() else 0
            if found is None or not 0 < at <= found.num_facts:
                raise PluginError(f"{entry.name} touches {text}, which is no fact")
            yield found.name, at - 1

    def costs(self) -> Iterator[tuple[Address, BoundCost]]:
        """Yield every edge that has a cost function. Of several patterns the one with more fixed
        characters counts."""
        entries = [(plugin, entry) for plugin in self.plugins for entry in plugin.library.costs]
        found: dict[str, BoundCost | None] = {}
        for edge in (one for branch in self.blueprint for one in branch.edges() if entries):
            if edge.name not in found:
                found[edge.name] = None
                try:
                    found[edge.name] = _cost_of(edge.name, entries)
                except PluginError as error:
                    self._fault(f"the cost of {edge.name}", error)
            bound = found[edge.name]
            if bound is not None:
                yield edge.address, bound

    def sensors(self) -> Iterator[BoundSensor]:
        """Yield the sensors of every fact that no sub-SB expands. Sensors of one fact keep their
        order."""
        for branch, digit in leaf_facts(self.blueprint):
            key = fact_text(branch.name, digit)
            note, sense = branch.fact_note(digit), branch.notes.senses.get(digit)
            if sense is not None:
                yield from self._measures(branch, digit, sense)
                continue
            given = self.table.facts.get(key)
            names = (given,) if isinstance(given, str) else given or (note.sensors if note else ())
            place = self.file.place(key) if given else None
            if not names:
                yield from self._offered(branch, digit)
                continue
            self.named[branch.name, digit] = tuple(names)
            elsewhere = self.file.mqtt.sources(key)
            for name in names:
                if name in elsewhere:
                    continue
                bound = self._named_sensor(branch, digit, name, place)
                if bound is not None:
                    yield bound

    def _measures(self, branch: StateBranch, digit: int, sense: FactSense) -> Iterator[BoundSensor]:
        """Yield the sensors that measure what the predicates of a fact name."""
        elsewhere = self.file.mqtt.sources(fact_text(branch.name, digit))
        for spec in sense.sources:
            if spec.name in elsewhere:
                continue
            bound = self._named_sensor(branch, digit, spec.name, None, measures=True)
            if bound is None:
                continue
            unit = read_unit(bound.unit)
            if unit.fits(spec.unit):
                yield replace(bound, unit=spec.unit.text, scale=float(unit.to(spec.unit)))
                continue
            words = f"the sensor {spec.name!r} measures {unit.text}, not {spec.unit.text}"
            error = PluginError(words, None, "Name a unit of its kind")
            self._fault(f"fact {branch.name}/{digit}", error)

    def _offered(self, branch: StateBranch, digit: int) -> Iterator[BoundSensor]:
        """Yield the sensors whose own declaration names this fact."""
        for plugin in self.plugins:
            for entry in plugin.library.sensors:
                texts = texts_read(self.blueprint, entry, branch.name, digit)
                if texts is not None:
                    name = entry.pattern.fill(texts)
                    yield self._sensor(branch, digit, (plugin, entry), name, texts)

    def _named_sensor(
        self,
        branch: StateBranch,
        digit: int,
        name: str,
        place: Place | None,
        *,
        measures: bool = False,
    ) -> BoundSensor | None:
        for plugin in self.plugins:
            for entry in plugin.library.sensors:
                texts = entry.pattern.match(name)
                if texts is not None and bool(entry.unit) == measures:
                    return self._sensor(branch, digit, (plugin, entry), name, texts)
        entries = [entry for p in self.plugins for entry in p.library.sensors]
        known = [entry.pattern.text for entry in entries if bool(entry.unit) == measures]
        what = "sensor that measures" if measures else "sensor"
        error = PluginError(
            f"the world {self.world!r} has no {what} {name!r}", place, did_you_mean(name, known)
        )
        self._fault(f"fact {branch.name}/{digit}", error)
        return None

    def _sensor(
        self,
        branch: StateBranch,
        digit: int,
        code: tuple[Plugin, SensorEntry],
        name: str,
        texts: dict[str, str],
    ) -> BoundSensor:
        plugin, entry = code
        note = branch.fact_note(digit)
        return BoundSensor(
            name,
            branch.name,
            digit,
            entry.period,
            (note.max_age if note else None) or entry.max_age,
            note.aggregation if note else "single",
            entry.function,
            entry.signature.converted(texts),
            plugin.location,
            entry.words,
            entry.unit,
            default=self._default(code, f"fact {branch.name}/{digit}", texts),
        )

    def _default(
        self, code: tuple[Plugin, SensorEntry], subject: str, texts: Mapping[str, str]
    ) -> FactDefault | None:
        """Return the predicates of a sensor, None if it has none or they cannot be read."""
        plugin, entry = code
        if not entry.predicate:
            return None
        try:
            return default_of(entry.predicate, entry.otherwise, texts, plugin.library.sensors)
        except PluginError as error:
            self._fault(subject, error)
            return None

    def unknown_keys(self) -> Iterator[BindingFault]:
        """Yield a fault for each key of the bindings file that names no element of the
        blueprint."""
        facts = {fact_text(branch.name, digit) for branch, digit in leaf_facts(self.blueprint)}
        known: set[str] = set()
        for branch in self.blueprint:
            for edge in branch.edges():
                name, own = note_key(edge.name), note_key(edge.name, edge.source)
                known |= {name, own, str(edge.address)}
        for keys, names, what in (
            (self.table.operations, known, "operation"),
            (self.table.facts, facts, "sensed fact"),
        ):
            for key in keys:
                if key not in names:
                    advice = did_you_mean(key, sorted(names))
                    sentence = f"the blueprint has no {what} of this name. {advice}".strip()
                    yield BindingFault(repr(key), sentence, self.file.place(key))

    def _fault(self, subject: str, error: PluginError) -> None:
        sentence = f"{error.sentence}. {error.advice}".strip().removesuffix(".")
        self.faults.append(BindingFault(subject, sentence, error.place))


def texts_read(
    blueprint: Blueprint, entry: SensorEntry, branch: str, digit: int
) -> dict[str, str] | None:
    """Return the texts that stand for the fields of a sensor's ``fact`` pattern for this fact. It
    is None if the sensor declares another fact.
    """
    if not entry.fact.text:
        return None
    if "/" in entry.fact.text:
        return entry.fact.match(f"{branch}/{digit + 1}")
    return entry.fact.match(str(digit + 1)) if blueprint.roots == (branch,) else None


def _cost_of(name: str, entries: Sequence[tuple[Plugin, CostEntry]]) -> BoundCost | None:
    best: tuple[tuple[bool, int], BoundCost] | None = None
    for plugin, entry in entries:
        texts = entry.pattern.match(name)
        if texts is None:
            continue
        rank = (not entry.pattern.parameters, entry.pattern.literal)
        if best is None or rank > best[0]:
            arguments = entry.signature.converted(texts)
            best = rank, BoundCost(entry.name, entry.function, arguments, plugin.location)
    return best[1] if best else None
