"""The code that is bound to a blueprint in a world, in the form that an approval signs."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.blueprint.address import fact_text
from smsl_studio.inspection.approval.statement import SignedFunction, WorldCode
from smsl_studio.library.bindings_file import BindingsFile
from smsl_studio.library.bound import Bindings
from smsl_studio.library.loaded import Loaded
from smsl_studio.seal.digest import digest_of

Json = Any


def world_code(
    world: str, loaded: Loaded, bindings: Bindings, file: BindingsFile, code: Mapping[str, str]
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
        "elsewhere": {key: list(file.mqtt.sources(key)) for key in file.mqtt.facts},
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
