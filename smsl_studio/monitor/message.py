"""The messages of a node: JSON with a version. The reader trusts no message.

A fact::

    {"version": 1, "node": "bench", "boot": 1763654321000, "sequence": 17, "time": 12.3,
     "value": "1", "quality": "good", "reason": ""}

A status: ``{"version": 1, "boot": 1763654321000, "state": "alive"}``, or ``gone``.
``docs/monitoring.md`` explains each word.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.predicates.measure import measure_text
from smsl_studio.monitor.sample import BAD, GOOD, UNCERTAIN, Sample
from smsl_studio.monitor.topics import FactTopic
from smsl_studio.seal.strict_json import strict_decoder

VERSION = 1
LARGEST = 8192
"""The largest size of a message, in bytes. It is far more than any fact needs."""
MOST = 2**53 - 1
"""The largest boot or sequence. Every JSON reader reads whole numbers up to this one exactly."""
ALIVE, GONE = "alive", "gone"


class UnreadableError(Exception):
    """A message cannot be used. The text is the reason, for people."""


@dataclass(frozen=True, slots=True)
class Status:
    """The state of a node: ``alive`` after its start, ``gone`` at its end. The broker sends
    ``gone`` if the node's connection is lost (its MQTT will)."""

    boot: int
    state: str


def read_status(payload: bytes) -> Status:
    """Read a status message. UnreadableError if it is not valid."""
    said = _object(payload)
    state = said.get("state")
    if state not in (ALIVE, GONE):
        raise UnreadableError(f"state is {_shown(state)}, not {ALIVE} or {GONE}")
    return Status(_count(said, "boot"), state)


def read_fact(
    topic: FactTopic, payload: bytes, received: float | None = None, *, measures: bool = False
) -> tuple[str, Sample]:
    """Read a fact message. Return the name of the node and the sample.

    The value of a source that ``measures`` is a number, or three for a position. ``received`` is
    the time (s) of its arrival on the monotonic clock. UnreadableError if the message is not
    valid.
    """
    said = _object(payload)
    if "value" not in said:
        raise UnreadableError("value is missing")
    value = said["value"]
    if measures and value is not None:
        text = measure_text(value)
        if text is None:
            raise UnreadableError(f"value is {_shown(value)}, not a number, three or null")
        value = text
    if value is not None and not _is_text(value):
        raise UnreadableError(f"value is {_shown(value)}, not a text or null")
    quality = said.get("quality", GOOD)
    if quality not in (GOOD, UNCERTAIN, BAD):
        raise UnreadableError(f"quality is {_shown(quality)}, not {GOOD}, {UNCERTAIN} or {BAD}")
    sample = Sample(
        topic.branch,
        topic.digit,
        topic.source,
        value,
        _seconds(said),
        _count(said, "sequence"),
        _count(said, "boot"),
        _text(said, "reason"),
        quality if value is not None else BAD,
        received,
    )
    return _text(said, "node"), sample


def status_payload(status: Status) -> bytes:
    """Return the bytes of a status message."""
    return _bytes({"version": VERSION, "boot": status.boot, "state": status.state})


def fact_payload(node: str, sample: Sample) -> bytes:
    """Return the bytes of a fact message."""
    return _bytes(
        {
            "version": VERSION,
            "node": node,
            "boot": sample.boot,
            "sequence": sample.sequence,
            "time": sample.time,
            "value": sample.value,
            "quality": sample.quality,
            "reason": sample.reason,
        }
    )


def _bytes(values: dict[str, Any]) -> bytes:
    return json.dumps(values, separators=(",", ":")).encode()


def _object(payload: bytes) -> dict[str, Any]:
    if len(payload) > LARGEST:
        raise UnreadableError(f"{len(payload):,} bytes, more than {LARGEST:,}")
    try:
        said = _JSON.decode(payload.decode())
    except (ValueError, RecursionError) as error:
        raise UnreadableError(f"no JSON: {str(error)[:80]}") from None
    if not isinstance(said, dict):
        raise UnreadableError("no JSON object")
    version = said.get("version")
    if type(version) is not int or version != VERSION:
        raise UnreadableError(f"version is {_shown(version)}, not {VERSION}")
    return said


_JSON = strict_decoder(ValueError, "a word is said twice")


def _count(said: dict[str, Any], name: str) -> int:
    value = said.get(name)
    if type(value) is not int or not 0 <= value <= MOST:
        raise UnreadableError(f"{name} is {_shown(value)}, not a count")
    return value


def _seconds(said: dict[str, Any]) -> float:
    value = said.get("time")
    if isinstance(value, int | float) and type(value) is not bool and abs(value) < 1e12:
        return float(value)
    raise UnreadableError(f"time is {_shown(value)}, not a number of seconds")


def _text(said: dict[str, Any], name: str) -> str:
    value = said.get(name, "")
    if not _is_text(value):
        raise UnreadableError(f"{name} is {_shown(value)}, not a text")
    return str(value)


def _is_text(value: object) -> bool:
    """Whether a value is a text that UTF-8 can encode. JSON may contain half surrogate pairs."""
    if not isinstance(value, str):
        return False
    try:
        value.encode()
    except UnicodeEncodeError:
        return False
    return True


def _shown(value: object) -> str:
    if value is None:
        return "missing"
    words = repr(value)
    return words if len(words) <= 40 else f"{words[:37]}..."
