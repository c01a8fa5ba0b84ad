"""How the risk of an operation is made of its parts: ``_risk`` of a file, with a default.

Each part is a number from 0 to 1, and has a weight. The risk is ``1 - (1 - w1 p1)(1 - w2 p2) ...``:
parts that do not depend on each other, of which one is enough to go wrong.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from smsl_studio.errors import did_you_mean

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint

KEY = "_risk"
DEFAULT: Mapping[str, float] = MappingProxyType(
    {"declared": 1.0, "failures": 1.0, "forecast": 0.8, "hazard": 0.3, "age": 0.1}
)
"""The weights of the declared risk, the share of failures of the operation in this run, a forecast
that differs, the nearness of a hazard, and the age of the facts that it rests on."""
DECLARED: Mapping[str, float] = MappingProxyType({"low": 0.1, "": 0.4, "medium": 0.4, "high": 0.8})
"""The part of a declared risk. One that is not declared counts as medium."""


def weights_of(blueprint: Blueprint) -> Mapping[str, float]:
    """Return the weight of each part. What ``_risk`` leaves out, or says wrongly, has its default.

    The first file that has ``_risk`` counts: the blueprint's own, then those that it imports.
    """
    said = (one.values[KEY] for one in blueprint.documents if KEY in one.values)
    found: Any = next(said, None)
    written = found.items() if isinstance(found, dict) else ()
    own = {key: float(weight) for key, weight in written if not fault_of(key, weight)}
    return {**DEFAULT, **own}


def faults_in(value: Any) -> Iterator[tuple[str, str]]:
    """Yield each wrong entry of ``_risk`` with a sentence. The entry is empty for the whole."""
    if not isinstance(value, dict):
        yield "", "it is no map from a part to its weight"
        return
    for key, weight in value.items():
        if fault := fault_of(key, weight):
            yield key, fault


def fault_of(key: object, weight: object) -> str:
    """Return why an entry of ``_risk`` does not count. Empty if it does."""
    if not isinstance(key, str) or key not in DEFAULT:
        near = did_you_mean(str(key), DEFAULT)
        return f"there is no such part of a risk. {near or 'There are ' + ', '.join(DEFAULT)}"
    if isinstance(weight, bool) or not isinstance(weight, int | float) or not 0 <= weight <= 1:
        return "a weight is a number from 0 to 1"
    return ""


def combined(parts: Mapping[str, float], weights: Mapping[str, float]) -> float:
    """Return the risk from 0 to 1 of parts from 0 to 1, rounded to four digits."""
    safe = 1.0
    for name, part in parts.items():
        safe *= 1.0 - weights.get(name, 0.0) * part
    return round(1.0 - safe, 4)
