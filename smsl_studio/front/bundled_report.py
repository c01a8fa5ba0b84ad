"""The report in a bundle of evidence, dated by the evidence: equal input gives equal bytes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import SealError
from smsl_studio.front.readings import reading
from smsl_studio.front.reports import report_page
from smsl_studio.inspection.approval.record_file import read_record_file
from smsl_studio.seal.strict_json import read_strictly

REPORT = "report.html"


def bundled_report(blueprint: Blueprint, logs: Sequence[bytes], records: Sequence[bytes]) -> bytes:
    """Return the page that tells a blueprint, for a bundle with these logs and record files.

    Its day is that on which the last of the logs was begun; without a log, that of the newest
    signature. Without either it has no day.
    """
    days = [_day_of_log(raw) for raw in logs] or [_day_of_record(raw) for raw in records]
    return report_page(reading(blueprint), max(days, default=""), blueprint)


def _day_of_log(raw: bytes) -> str:
    try:
        header = read_strictly(raw.partition(b"\n")[0], "it")
    except SealError:
        return ""
    said = header.get("wall_time") if isinstance(header, Mapping) else None
    return _day(said)


def _day_of_record(raw: bytes) -> str:
    try:
        return max((_day(one.statement.time) for one in read_record_file(raw)), default="")
    except SealError:
        return ""


def _day(time: object) -> str:
    """Return the day of a time that somebody has written. Empty if that is no time."""
    day = time[:10] if isinstance(time, str) else ""
    digits = day.replace("-", "")
    return day if len(day) == 10 and len(digits) == 8 and digits.isdecimal() else ""
