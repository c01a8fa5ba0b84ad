"""Times in records: UTC, in the form of RFC 3339. A date means the end of that day."""

from __future__ import annotations

import re
from datetime import UTC, date, datetime, time, timedelta

_TIME = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d{1,6})?Z", re.ASCII)
_DATE = re.compile(r"\d{4}-\d\d-\d\d", re.ASCII)
_OFFSET = re.compile(rf"{_TIME.pattern[:-1]}[+-]\d\d:\d\d", re.ASCII)

AHEAD = timedelta(minutes=5)
"""How far the clock of another computer may be ahead of ours."""


def written_time(moment: datetime) -> str:
    """Return a time as records write it, with microseconds."""
    return moment.astimezone(UTC).isoformat(timespec="microseconds").replace("+00:00", "Z")


def read_time(text: str) -> datetime:
    """Return the time in a text such as ``2026-11-26T08:00:00Z``. ValueError if it is no time."""
    if not _TIME.fullmatch(text):
        raise ValueError(f"{text[:40]!r} is no time such as 2026-11-26T08:00:00Z")
    return datetime.fromisoformat(text)


def end_of(text: str) -> datetime:
    """Return the end of a day such as ``2026-11-26``. A text with a time gives that time.

    ValueError if the text is neither.
    """
    if _DATE.fullmatch(text):
        return datetime.combine(date.fromisoformat(text), time.max, UTC)
    return _moment(text)


def begin_of(text: str) -> datetime:
    """Return the beginning of a day. A text with a time gives that time.

    ValueError if the text is neither.
    """
    if _DATE.fullmatch(text):
        return datetime.combine(date.fromisoformat(text), time.min, UTC)
    return _moment(text)


def _moment(text: str) -> datetime:
    """Return the time in a text that others have written. It may have any offset of RFC 3339."""
    found = _OFFSET.fullmatch(text)
    if found is None:
        return read_time(text)
    return datetime.fromisoformat(text).astimezone(UTC)


def later(moment: datetime, days: float) -> datetime:
    """Return the time ``days`` days later, but at most the last time that Python can hold."""
    try:
        return moment + timedelta(days=days)
    except OverflowError:
        return datetime.max.replace(tzinfo=UTC)
