"""Estimates of all SBs, worked out again only where a value changed: ages alone change nothing."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.estimate import Estimate, estimate
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus


class Estimates:
    """The newest estimates of one run."""

    def __init__(self) -> None:
        self._key: object = None
        self._found: Mapping[str, Estimate] = {}

    def of(self, blueprint: Blueprint, status: DispatchStatus) -> Mapping[str, Estimate]:
        """Where each SB is, going by what is sensed."""
        values = tuple(reading.value for reading in status.scene.readings.values())
        key = (id(blueprint), values, tuple(status.configuration.items()))
        if key != self._key:
            self._key = key
            believed = status.configuration
            self._found = {
                name: estimate(blueprint, name, status.scene, believed) for name in believed
            }
        return self._found
