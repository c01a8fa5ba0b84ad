"""Times of records: UTC, RFC 3339. A DATE is the end of that day."""

from __future__ import annotations

import re
from datetime import UTC, date, datetime, time, timedelta

_TIME = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d{1,6})?Z", re.ASCII)
_DATE = re.compile(r"\d{4}-\d\d-\d\d", re.ASCII)
_OFFSET = re.compile(rf"{_TIME.pattern[:-1]}[+-]\d\d:\d\d", re.ASCII)

AHEAD = timedelta(minutes=5)
"""How far the clock of another machine may be ahead of ours."""


def written_time(moment: datetime) -> str:
    """Return a moment as a record writes it, in microseconds."""
    return moment.astimezone(UTC).isoformat(timespec="microseconds").replace("+00:00", "Z")


def read_time(text: str) -> datetime:
    """Return the moment of a text such as ``2026-11-26T08:00:00Z``. ValueError if it is none."""
    if not _TIME.fullmatch(text):
        raise ValueError(f"{text[:40]!r} is no time such as 2026-11-26T08:00:00Z")
    return datetime.fromisoformat(text)


def end_of(text: str) -> datetime:
    """Return the end of a date such as ``2026-11-26``, or the moment of a time. ValueError if it is
    neither."""
    if _DATE.fullmatch(text):
        return datetime.combine(date.fromisoformat(text), time.max, UTC)
    return _moment(text)


def begin_of(text: str) -> datetime:
    """Return the begin of a date, or the moment of a time. ValueError if it is neither."""
    if _DATE.fullmatch(text):
        return datetime.combine(date.fromisoformat(text), time.min, UTC)
    return _moment(text)


def _moment(text: str) -> datetime:
    """Return the moment of a time that others have written, with any offset of RFC 3339."""
    found = _OFFSET.fullmatch(text)
    if found is None:
        return read_time(text)
    return datetime.fromisoformat(text).astimezone(UTC)


def later(moment: datetime, days: float) -> datetime:
    """Return the moment so many days later. It is the last one there is if it lies beyond."""
    try:
        return moment + timedelta(days=days)
    except OverflowError:
        return datetime.max.replace(tzinfo=UTC)
