"""The words of the human-automation continuum (paper, section on it): its levels and defaults.

``levels`` finds the level of each element of a blueprint.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

HUMAN, SHARED, AUTOMATIC = LEVELS = ("human", "shared", "automatic")
INSPECTION, SUPERVISION = "inspection", "supervision"
FORECAST, GENERATION = "forecast", "generation"
SHOW, ASK, HOLD = FORECAST_LEVELS = ("show", "ask", "hold")
"""What a forecast that differs does, the most careful last: it is told alone, a person is asked, or
the run holds. These are the levels of the key ``forecast``."""

DEFAULTS: Mapping[str, str] = MappingProxyType({INSPECTION: AUTOMATIC, SUPERVISION: SHARED})
"""The levels if none are declared: rules alone inspect, and a person may intervene at any tick."""

GENERATES = SHARED
"""Who makes edges during a run, if nothing is declared: a provider proposes them, and a person
allows each. With ``human`` no program proposes any. With ``automatic`` a person allows each, too.
"""

OF_ACTOR = {"human": HUMAN, "shared": SHARED}
NOTHING: Mapping[str, str] = MappingProxyType({})


def levels_of(key: str) -> tuple[str, ...]:
    """Return the levels that a key of ``_levels`` may have."""
    return FORECAST_LEVELS if key == FORECAST else LEVELS
