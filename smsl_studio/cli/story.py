"""Run events as lines for people: the time, the name of the event, and its fields."""

from __future__ import annotations

import json
from typing import Any

from smsl_studio.runlog.decoder import event_of
from smsl_studio.runlog.events import EdgeSwept, Event, RunFinished, SweepFinished, Within

_LEFT_OUT = ("event", "t", "sensed")
_PLACES = ("start", "configuration", "candidates")
"""The fields that map an SB to a state. They are written ``SB/State``; other fields ``name
value``."""


def line_of(event: Event) -> str:
    """Return one line of text for one event."""
    if isinstance(event, EdgeSwept):
        return _edge(event)
    if isinstance(event, SweepFinished):
        return f"{event.passed} of {event.edges} edges passed"
    if isinstance(event, Within):
        return _within(event)
    values = event.as_json()
    words = event.event.replace("_", " ")
    if isinstance(event, RunFinished):
        count = f"{event.operations} operation{'' if event.operations == 1 else 's'}"
        return f"{event.t:9.3f} s  {words}: {event.reason}, {count}. {event.sentence}"
    rest = [
        f"{key} {_said(value, '/' if key in _PLACES else ' ')}"
        for key, value in values.items()
        if key not in _LEFT_OUT and not _blank(value)
    ]
    return f"{event.t:9.3f} s  {words}: {', '.join(rest)}".rstrip(": ")


def _within(event: Within) -> str:
    """Return the line of what an operation runs, one level down."""
    try:
        told = event_of(json.loads(event.told))
    except (ValueError, TypeError, AttributeError, RecursionError):
        told = None
    if told is None or isinstance(told, Within):
        return f"{event.t:9.3f} s    > {event.told}"
    return f"{event.t:9.3f} s    > {line_of(told)[13:]}"


def _edge(event: EdgeSwept) -> str:
    verdict = "pass" if event.passed else "FAIL"
    why = f": {event.sentence}" if event.sentence else ""
    checks = f"source {event.source}, target {event.target}"
    met = f", meets the hazard {event.hazard}" if event.hazard else ""
    return f"{verdict}  {event.address}  ({checks}, {event.t:.3f} s{met}){why}"


def _blank(value: Any) -> bool:
    return value is None or value in ("", [], {})


def _said(value: Any, between: str) -> str:
    if isinstance(value, dict):
        pairs = value.items()
        return ", ".join(f"{name}{between}{_said(inner, between)}" for name, inner in pairs)
    if isinstance(value, list):
        return "; ".join(_said(one, between) for one in value)
    return str(value)
