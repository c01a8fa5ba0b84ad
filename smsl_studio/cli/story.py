"""Run events as lines for people: the time, the word, and what matters of the rest."""

from __future__ import annotations

from typing import Any

from smsl_studio.runlog.events import EdgeSwept, Event, RunFinished, SweepFinished

_LEFT_OUT = ("event", "t")


def line_of(event: Event) -> str:
    """One line of text for one event."""
    if isinstance(event, EdgeSwept):
        return _edge(event)
    if isinstance(event, SweepFinished):
        return f"{event.passed} of {event.edges} edges passed"
    values = event.as_json()
    words = event.event.replace("_", " ")
    if isinstance(event, RunFinished):
        count = f"{event.operations} operation{'' if event.operations == 1 else 's'}"
        return f"{event.t:9.3f} s  {words}: {event.reason}, {count}. {event.sentence}"
    rest = [f"{k} {_said(v)}" for k, v in values.items() if k not in _LEFT_OUT and not _blank(v)]
    return f"{event.t:9.3f} s  {words}: {', '.join(rest)}".rstrip(": ")


def _edge(event: EdgeSwept) -> str:
    verdict = "pass" if event.passed else "FAIL"
    why = f": {event.sentence}" if event.sentence else ""
    checks = f"source {event.source}, target {event.target}"
    return f"{verdict}  {event.address}  ({checks}, {event.t:.3f} s){why}"


def _blank(value: Any) -> bool:
    return value is None or value in ("", [], {})


def _said(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name}/{_said(inner)}" for name, inner in value.items())
    if isinstance(value, list):
        return "; ".join(map(_said, value))
    return str(value)
