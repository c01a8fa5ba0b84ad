"""Policies and registers: every key has a type, and nothing else is taken."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.errors import PluginError, SealError
from smsl_studio.inspection.approval.policy import TrustPolicy, policy_of, read_policy
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.register import read_register, register_payload
from smsl_studio.inspection.approval.times import begin_of, end_of, later, written_time
from smsl_studio.seal.strict_json import base64_text
from tests.approval import ADA, BEN, EVE, NOON, entry, register_of

WHOLE = f"""
roles = {{ surgeon = 1, engineer = 1 }}
persons = 3
valid_days = 365
automatic = "may_sign"
rules_unchanged = true
supervisor = true
generated_edges = "confirmed"
revoked = ["sha256:{"0" * 64}", "record:sha256:{"0" * 64}"]
register = "persons.json"
register_key = "{base64_text(EVE.public)}"
"""


def test_a_policy_with_every_key(tmp_path: Path) -> None:
    file = tmp_path / "policy.toml"
    file.write_text(WHOLE)
    found = read_policy(file)
    assert isinstance(found, TrustPolicy)
    assert (found.needed, found.valid_days, found.key) == (3, 365, EVE.public)
    file.write_text("")
    assert read_policy(file) == TrustPolicy()
    file.write_text("a = = 1")
    assert isinstance(read_policy(file), Refusal)
    with pytest.raises(PluginError):
        read_policy(tmp_path / "gone.toml")


def test_the_defaults() -> None:
    usual = TrustPolicy()
    assert usual.needed == 1
    assert TrustPolicy(roles={"a": 2, "b": 1}).needed == 3
    assert (usual.automatic, usual.generated_edges) == ("never", "never")
    assert (usual.rules_unchanged, usual.supervisor, usual.valid_days) == (False, False, None)


@pytest.mark.parametrize(
    "values",
    [
        {"role": {}},
        {"roles": {"a": "1"}},
        {"roles": {"a": 0}},
        {"roles": []},
        {"persons": 0},
        {"persons": 1.5},
        {"persons": True},
        {"valid_days": 0},
        {"valid_days": "365"},
        {"valid_days": True},
        {"automatic": True},
        {"automatic": "maybe"},
        {"rules_unchanged": 1},
        {"rules_unchanged": "true"},
        {"supervisor": "yes"},
        {"generated_edges": "always"},
        {"revoked": "sha256:" + "0" * 64},
        {"revoked": ["0" * 64]},
        {"register": "persons.json"},
        {"register_key": base64_text(EVE.public)},
        {"register": "x", "register_key": "AAAA"},
        {"register": "x", "register_key": "no"},
        {"register_file": "x"},
    ],
)
def test_another_key_or_type_is_no_policy(values: dict[str, Any]) -> None:
    found = policy_of(values, "policy.toml")
    assert isinstance(found, Refusal)
    assert found.code == "policy_invalid"
    assert "policy.toml" in found.sentence


def test_a_register_says_who_counts() -> None:
    raw = register_of(entry(ADA), entry(BEN, **{"from": "2026-01-01", "until": "2026-02-01"}))
    found = read_register(raw, EVE.public)
    assert found.serial == 1
    assert found.keys[ADA.key].roles == ("engineer",)
    ben = found.keys[BEN.key]
    assert ben.since == begin_of("2026-01-01")
    assert ben.until == end_of("2026-02-01")
    with pytest.raises(SealError, match="not signed"):
        read_register(raw, ADA.public)
    with pytest.raises(SealError):
        read_register(raw[:-1], EVE.public)


@pytest.mark.parametrize(
    "persons",
    [
        [entry(ADA), entry(ADA)],
        [entry(ADA), entry(BEN, person="ada  LOVELACE")],
        [entry(ADA), entry(BEN, keys=entry(ADA)["keys"])],
        [entry(ADA, keys=["AAAA"])],
        [entry(ADA, keys=["no"])],
        [entry(ADA, since="2026-01-01", role="x")],
        [entry(ADA, until="soon")],
        [entry(ADA, roles="engineer")],
        [{"person": "x"}],
        ["x"],
    ],
)
def test_a_register_that_is_not_clear_is_none(persons: list[Any]) -> None:
    with pytest.raises(SealError):
        read_register(register_of(*persons), EVE.public)
    with pytest.raises(SealError):
        register_payload({"version": 1, "serial": 1, "persons": persons})


@pytest.mark.parametrize(
    "change", [{"version": 2}, {"serial": -1}, {"serial": "1"}, {"serial": True}, {"more": 1}]
)
def test_the_head_of_a_register_is_checked(change: dict[str, Any]) -> None:
    values = {"version": 1, "serial": 1, "persons": []}
    assert json.loads(register_payload(values)) == values
    with pytest.raises(SealError):
        register_payload({**values, **change})


def test_a_date_is_the_end_of_its_day() -> None:
    assert written_time(end_of("2026-03-01")) == "2026-03-01T23:59:59.999999Z"
    assert written_time(begin_of("2026-03-01")) == "2026-03-01T00:00:00.000000Z"
    assert end_of("2026-03-01T12:00:00Z") == NOON
    assert begin_of("2026-03-01T13:00:00+01:00") == NOON
    assert later(NOON, 1e6) > NOON
    for text in ("2026-3-1", "2026-02-30", "today", "2026-03-01T12:00:00", ""):
        with pytest.raises(ValueError, match=r".+"):
            end_of(text)
