"""What a host tells of a sensor, without its code."""

from __future__ import annotations

from smsl_studio.host.protocol import SensorInfo
from smsl_studio.library.bound import BoundSensor


def info_of(sensor: BoundSensor) -> SensorInfo:
    """Return what is told of a sensor."""
    return SensorInfo(
        sensor.name,
        sensor.branch,
        sensor.digit,
        sensor.period,
        sensor.max_age,
        sensor.aggregation,
        dict(sensor.words),
        unit=sensor.unit,
        predicate={one.value: one.text for one in sensor.default.sense.predicates}
        if sensor.default
        else {},
    )
