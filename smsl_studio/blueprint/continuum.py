"""The words of the human-automation continuum (paper, section on it): its levels and defaults.

``levels`` says which level everything in one blueprint has.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

HUMAN, SHARED, AUTOMATIC = LEVELS = ("human", "shared", "automatic")
INSPECTION, SUPERVISION = "inspection", "supervision"

DEFAULTS: Mapping[str, str] = MappingProxyType({INSPECTION: AUTOMATIC, SUPERVISION: SHARED})
"""Where nothing is said: rules alone inspect, and a person may step in at any tick."""

OF_ACTOR = {"human": HUMAN, "shared": SHARED}
NOTHING: Mapping[str, str] = MappingProxyType({})
