"""The code that is bound to a blueprint in a world, in the form that an approval signs."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.address import fact_text
from smsl_studio.inspection.approval.statement import SignedFunction, WorldCode
from smsl_studio.library.bindings_file import BindingsFile
from smsl_studio.library.bound import Bindings
from smsl_studio.library.loaded import Loaded
from smsl_studio.monitor.bus import SourceKey
from smsl_studio.seal.digest import digest_of

Json = Any


@dataclass(frozen=True)
class SignedBindings:
    """A bindings file as an approval signs it. ``speakers`` are the nodes that may speak for a
    source (SB, digit, name), as the room that the file names says."""

    file: BindingsFile
    speakers: Mapping[SourceKey, str] = field(default_factory=dict)

    @property
    def listens(self) -> bool:
        """Whether any fact is sensed elsewhere."""
        return bool(self.file.mqtt.facts)

    def elsewhere(self) -> dict[str, Json]:
        """Return who tells which fact, and over which broker, as plain values. A blueprint that
        hears nobody has no broker."""
        table = self.file.mqtt
        told = {"elsewhere": {key: list(table.sources(key)) for key in table.facts}}
        speakers = sorted([*key, node] for key, node in self.speakers.items())
        line = [table.broker, table.site, table.run, table.login, speakers]
        return {**told, "line": line} if self.listens else told


def heard_code(signed: SignedBindings) -> WorldCode | None:
    """Return what is signed for a world without code: whom it hears. None if it hears nobody."""
    if not signed.listens:
        return None
    return WorldCode(hardware=False, functions=[], bindings=digest_of(signed.elsewhere()))


def world_code(
    world: str, loaded: Loaded, bindings: Bindings, signed: SignedBindings, code: Mapping[str, str]
) -> WorldCode:
    """Return the code that ``bindings`` bind to a blueprint in a world.

    ``code`` has the SHA-256 of each plugin's code, by its location.
    """
    plugins = {one.location: one for one in loaded.plugins}
    own, entry = loaded.world(world)
    used = {f"world {world}": own.location, **dict(_used(bindings))}
    functions = [
        SignedFunction(
            function=name,
            plugin=plugins[location].name,
            version=plugins[location].version,
            code=code[location],
        )
        for name, location in sorted(used.items())
    ]
    bound = {
        "operations": {str(at): _called(one) for at, one in bindings.operations.items()},
        "costs": {str(at): _called(one) for at, one in bindings.costs.items()},
        "sensors": [
            [fact_text(one.branch, one.digit), *_called(one), one.period, one.max_age]
            for one in bindings.sensors
        ],
        **signed.elsewhere(),
    }
    return WorldCode(hardware=entry.hardware, functions=functions, bindings=digest_of(bound))


def used_locations(world: str, loaded: Loaded, bindings: Bindings) -> tuple[str, ...]:
    """Return the locations of the plugins whose code a signature covers: the one that offers the
    world, and those with a function that is bound. A run loads no others beside them."""
    own, _ = loaded.world(world)
    return tuple(dict.fromkeys((own.location, *(at for _, at in _used(bindings)))))


def _used(bindings: Bindings) -> Iterator[tuple[str, str]]:
    for operation in bindings.operations.values():
        yield operation.name, operation.location
    for cost in bindings.costs.values():
        yield f"cost {cost.name}", cost.location
    for sensor in bindings.sensors:
        yield f"sensor {sensor.name}", sensor.location


def _called(one: Any) -> list[Json]:
    """Return a bound function with its arguments, its stop and its time limit, as plain values."""
    arguments = json.dumps(dict(one.arguments), sort_keys=True, default=str)
    terms = [getattr(one, "stop", ""), float(getattr(one, "timeout", 0.0))]
    return [one.name, arguments, *terms]
