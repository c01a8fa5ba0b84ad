"""The value of a fact by the default predicates of a plugin, at one instant."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import isfinite
from typing import Any

from smsl_studio.blueprint.predicates.measure import Measure
from smsl_studio.library.fact_default import FactDefault
from smsl_studio.monitor.clauses import Look, PresentMeasure, truth_of


def decided(default: FactDefault) -> Callable[[Any], str | None]:
    """Return the function that reads the fact of a world. None means no valid reading.

    ValueError if a sensor returns no finite number, or if two values are true at once.
    """
    sources = {one.name: PresentMeasure(good=0.0) for one in default.sense.sources}
    look = Look(sources)
    truths = [(one.value, truth_of(one.clause, default.sense, look))
              for one in default.sense.predicates]  # fmt: skip
    measures = [partial(one.function, **one.arguments) for one in default.measures]

    def read(subject: Any) -> str | None:
        """Measure everything, and decide."""
        for (name, source), measure in zip(sources.items(), measures, strict=True):
            source.present = _number(measure(subject), name)
        said = [(value, truth()) for value, truth in truths]
        true = [value for value, truth in said if truth]
        if len(true) > 1:
            raise ValueError(f"{len(true)} values are true at once: {' and '.join(true)}")
        if any(truth is None for _, truth in said):
            return None
        return true[0] if true else default.otherwise or None

    return read


def _number(value: Any, name: str) -> Measure | None:
    """Return a measure as numbers, None for no valid measure."""
    if value is None:
        return None
    if isinstance(value, tuple | list) and len(value) == 3:
        x, y, z = (float(one) for one in value)
        if all(map(isfinite, (x, y, z))):
            return x, y, z
    elif isinstance(value, int | float) and isfinite(value):
        return float(value)
    raise ValueError(f"{name} returned no finite number and no position of three")
