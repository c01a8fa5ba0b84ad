"""What people sign: it is read strictly, and a record that contradicts itself is none."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from smsl_studio.errors import SealError
from smsl_studio.inspection.approval.record_file import read_record_file, written_record_file
from smsl_studio.inspection.approval.statement import read_statement
from tests.approval import ADA, BEN, door, signed

Json = Any
PAYLOAD = signed(door(), ADA).envelope.payload


def nested(depth: int) -> Json:
    found: Json = {}
    for _ in range(depth):
        found = {"a": found}
    return [found]


def changed(change: Callable[[Json], object]) -> bytes:
    values = json.loads(PAYLOAD)
    change(values)
    return json.dumps(values, separators=(",", ":"), sort_keys=True, ensure_ascii=False).encode()


def test_what_is_written_is_read_again() -> None:
    assert read_statement(PAYLOAD).payload() == PAYLOAD
    assert read_statement(PAYLOAD) == signed(door(), ADA).statement


@pytest.mark.parametrize(
    "change",
    [
        lambda v: v.update(more=1),
        lambda v: v["predicate"].update(more=1),
        lambda v: v["predicate"].pop("follows"),
        lambda v: v["predicate"].update(verdict="fine"),
        lambda v: v["predicate"].update(time="2026-03-01 12:00"),
        lambda v: v["predicate"].update(time="2026-13-01T12:00:00Z"),
        lambda v: v["predicate"].update(expires="2026-03-01"),
        lambda v: v["predicate"].update(follows="abc"),
        lambda v: v["predicate"].update(conditions="x"),
        lambda v: v["predicate"].update(person=""),
        lambda v: v["predicate"]["options"].update(limit="5"),
        lambda v: v["predicate"]["options"].update(limit=True),
        lambda v: v["predicate"]["options"].update(limit=0),
        lambda v: v["predicate"]["content"]["test.json"].update(meaning=nested(900)),
        lambda v: v["predicate"]["content"]["test.json"].update(meaning=[2**60]),
        lambda v: v["predicate"]["rules"][0].update(result="fine"),
        lambda v: v["predicate"]["content"].update(other={}),
        lambda v: v["predicate"]["content"]["test.json"].update(meaning=[]),
        lambda v: v["predicate"]["content"]["test.json"].update(behaviour={}),
        lambda v: v["predicate"]["content"]["test.json"].update(imported=[]),
        lambda v: v["predicate"]["content"]["test.json"].pop("missing"),
        lambda v: v["subject"][0]["digest"].update(behaviour="0" * 64),
        lambda v: v["subject"].append(v["subject"][0]),
        lambda v: v.update(subject=[]),
        lambda v: v.update(predicateType="urn:other"),
    ],
)
def test_what_studio_does_not_write_is_refused(change: Callable[[Json], object]) -> None:
    with pytest.raises(SealError):
        read_statement(changed(change))


def test_other_bytes_of_the_same_values_are_refused() -> None:
    for raw in (
        json.dumps(json.loads(PAYLOAD)).encode(),
        PAYLOAD + b" ",
        PAYLOAD.replace(b'"DOOR"', b'"\\u0044OOR"', 1),
        b"",
        b"[]",
        b"\xff",
    ):
        with pytest.raises(SealError):
            read_statement(raw)


def test_a_record_file_has_one_spelling() -> None:
    both = [signed(door(), ADA).envelope, signed(door(), BEN, 1).envelope]
    raw = written_record_file(both)
    assert [one.envelope for one in read_record_file(raw)] == both
    assert read_record_file(raw.rstrip()) == read_record_file(raw), "the newline may be missing"
    assert json.dumps(json.loads(raw)).encode() == raw.rstrip(), "as others write it"
    values = json.loads(raw)
    for other in (
        raw + b"\n",
        b" " + raw,
        json.dumps(values, indent=2).encode(),
        json.dumps({**values, "more": 1}).encode(),
        json.dumps({"records": {}}).encode(),
        json.dumps([]).encode(),
        raw.replace(b'"keyid"', b'"key\\u0069d"', 1),
        b"",
    ):
        with pytest.raises(SealError):
            read_record_file(other)
