"""The description of a plugin's offers, sent by the process that loaded the plugin: texts, no code.

Patterns are sent as they were written. The receiver parses them again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final, NoReturn

from smsl_studio.blueprint.predicates.predicate_text import LONGEST as LONGEST_PREDICATE
from smsl_studio.blueprint.predicates.units import LONGEST as LONGEST_UNIT
from smsl_studio.errors import HostError, PluginError
from smsl_studio.host.codec import Codec, Unfit, flag, one_of, text
from smsl_studio.host.compound import mapped, mapping, optional, row, several
from smsl_studio.host.reach_codec import REACH
from smsl_studio.host.vocabulary import PATIENCE, PLACE, SECONDS, name, sentence
from smsl_studio.library.entries import (
    CostEntry,
    FaultEntry,
    StationsEntry,
    SupervisorEntry,
    WorldEntry,
)
from smsl_studio.library.loaded import Plugin, PluginFault
from smsl_studio.library.operation_entry import OperationEntry
from smsl_studio.library.operation_library import (
    STOP_MODES,
    OperationLibrary,
)
from smsl_studio.library.pattern import Pattern, read_pattern
from smsl_studio.library.sensor_entry import SensorEntry
from smsl_studio.library.signature import Signature
from smsl_studio.library.stations import reaches
from smsl_studio.library.survey import FoundPlugin
from smsl_studio.world.bodies import Robot
from smsl_studio.world.engines import ENGINES
from smsl_studio.world.stations import RobotReach

LARGEST: Final = 4 * 2**20
"""The largest size of the description of one plugin, in bytes."""

MOST = 1000
"""The largest number of worlds, of operations, of sensors and so on that one plugin may offer."""


@dataclass(frozen=True, slots=True)
class AbsentCode:
    """A placeholder for code that runs in another process. A call of it raises HostError."""

    name: str

    def __call__(self, *_: Any, **__: Any) -> NoReturn:
        raise HostError(f"{self.name} is not here: its code runs in the world's process")


NAME, PARAMETER, PATTERN = name(300), name(200), name(500, empty=True)
TYPES = (int, float, str, bool, object)
"""The types of parameters that are sent. ``object`` replaces every other type."""

SIGNATURE: Codec[Signature] = mapped(
    row(mapping(PARAMETER, one_of(TYPES), 200), several(PARAMETER, 200), flag()),
    lambda told: (
        {name: kind if kind in TYPES else object for name, kind in told.types.items()},
        tuple(sorted(told.required)),
        told.any_name,
    ),
    lambda told: Signature(told[0], frozenset(told[1]), told[2]),
)

WORLD = mapped(
    row(NAME, one_of(ENGINES), flag(), SECONDS, several(NAME, MOST)),
    lambda one: (one.name, one.engine, one.hardware, one.settle, one.robots),
    lambda told: WorldEntry(
        told[0], told[1], told[2], told[3], AbsentCode(told[0]), robots=tuple(told[4])
    ),
)

OPERATION = mapped(
    row(
        NAME,
        optional(PATTERN),
        SIGNATURE,
        one_of(STOP_MODES),
        PATIENCE,
        flag(),
        several(PATTERN, MOST),
        flag(),
        text(64),
    ),
    lambda one: (
        one.name,
        one.pattern.text if one.pattern else None,
        one.signature,
        one.stop,
        one.timeout,
        one.resumes,
        tuple(pattern.text for pattern in one.touches),
        one.recovery,
        one.code,
    ),
    lambda told: _operation(*told),
)

SENSOR = mapped(
    row(
        PATTERN,
        PATTERN,
        SIGNATURE,
        PATIENCE,
        PATIENCE,
        mapping(text(1000), sentence(200), 200),
        text(LONGEST_UNIT),
        mapping(text(1000), text(LONGEST_PREDICATE), 64),
        text(1000),
    ),
    lambda one: (
        one.pattern.text,
        one.fact.text,
        one.signature,
        one.period,
        one.max_age,
        one.words,
        one.unit,
        one.predicate,
        one.otherwise,
    ),
    lambda told: SensorEntry(
        AbsentCode(told[0]), _pattern(told[0], told[2]), _pattern(told[1], told[2]), *told[2:]
    ),
)

COST = mapped(
    row(NAME, PATTERN, SIGNATURE),
    lambda one: (one.name, one.pattern.text, one.signature),
    lambda told: CostEntry(AbsentCode(told[0]), told[0], _pattern(told[1], told[2]), told[2]),
)

FAULT = mapped(
    row(NAME, NAME, SIGNATURE),
    lambda one: (one.world, one.name, one.signature),
    lambda told: FaultEntry(told[0], told[1], AbsentCode(told[1]), told[2]),
)

SUPERVISOR = mapped(
    row(NAME, SIGNATURE, PATIENCE),
    lambda one: (one.name, one.signature, one.limit),
    lambda told: SupervisorEntry(AbsentCode(told[0]), *told),
)

STATIONS: Codec[tuple[str, dict[str, RobotReach]]] = row(
    NAME, mapping(name(300, empty=True), REACH, MOST)
)
"""A world, and the reach of each of its robots. The function that tells it stays where it is."""

LIBRARY: Codec[OperationLibrary] = mapped(
    row(
        name(100),
        several(WORLD, MOST),
        several(NAME, MOST),
        several(OPERATION, MOST),
        several(SENSOR, MOST),
        several(COST, MOST),
        several(FAULT, MOST),
        several(NAME, MOST),
        several(SUPERVISOR, MOST),
        several(STATIONS, MOST),
    ),
    lambda one: (
        one.name,
        tuple(one.worlds.values()),
        tuple(one.arrangers),
        tuple(one.operations),
        tuple(one.sensors),
        tuple(one.costs),
        tuple(one.faults.values()),
        tuple(one.robots),
        tuple(one.supervisors.values()),
        tuple((world, reaches(one, entry)) for world, entry in one.reaching.items()),
    ),
    lambda told: _library(*told),
)

PLUGIN = row(name(100), sentence(100), sentence(2000), LIBRARY)
"""Name, version, description, library. The location is not sent: the receiver knows it."""

DESCRIPTION = row(optional(PLUGIN), optional(row(sentence(), optional(PLACE))))
"""Either the plugin, or the sentence and the place of its fault."""


def written(loaded: Plugin | PluginFault) -> bytes:
    """Return the bytes of a description.

    Values that do not fit raise Unfit. The plugin's own values may raise any other error.
    """
    if isinstance(loaded, PluginFault):
        return DESCRIPTION.encode((None, (loaded.sentence, loaded.place)))
    said = (loaded.name, loaded.version, loaded.description, loaded.library)
    return DESCRIPTION.encode((said, None))


def read_description(data: bytes, found: FoundPlugin) -> Plugin | PluginFault:
    """Read the description of the plugin ``found``. Invalid bytes raise Unfit."""
    said, fault = DESCRIPTION.decode(data)
    if (said is None) == (fault is None):
        raise Unfit("says neither what it is nor what is wrong, or both")
    if said is None:
        return PluginFault(found.name, fault[0], fault[1], found.location)
    called, version, words, library = said
    return Plugin(called, version, words, found.source, found.location, library)


def _operation(called: str, text: str | None, signature: Signature, *others: Any) -> OperationEntry:
    stop, timeout, resumes, touches, recovers, digest = others
    pattern = None if text is None else _pattern(text, signature)
    facts = tuple(_pattern(one, signature) for one in touches)
    code = AbsentCode(called)
    return OperationEntry(
        code, called, pattern, signature, stop, timeout, resumes, facts,
        recovery=recovers, code=digest,
    )  # fmt: skip


def _library(
    called: str,
    worlds: Iterable[WorldEntry],
    arranged: Iterable[str],
    operations: Iterable[OperationEntry],
    *others: Any,
) -> OperationLibrary:
    library = OperationLibrary(called)
    sensors, costs, faults, robots, supervisors, reaching = others
    library.worlds.update(_once(worlds, lambda one: one.name))
    library.arrangers.update({world: AbsentCode(world) for world in arranged})
    library.operations.extend(operations)
    library.sensors.extend(sensors)
    library.costs.extend(costs)
    library.faults.update(_once(faults, lambda one: (one.world, one.name)))
    # Only their names are told: the values are built where the world is.
    library.robots.update({name: Robot(name, "", "", ()) for name in robots})
    library.supervisors.update(_once(supervisors, lambda one: one.name))
    told = (StationsEntry(world, AbsentCode(world), known=known) for world, known in reaching)
    library.reaching.update(_once(told, lambda one: one.world))
    return library


def _once(entries: Iterable[Any], key: Callable[[Any], Any]) -> Mapping[Any, Any]:
    listed = list(entries)
    found = {key(entry): entry for entry in listed}
    if len(found) != len(listed):
        raise Unfit("tells the same name twice")
    return found


def _pattern(text: str, signature: Signature) -> Pattern:
    try:
        return read_pattern(text, signature.types)
    except PluginError as error:
        raise Unfit(error.sentence) from None
