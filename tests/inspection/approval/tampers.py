"""Tampers with an approval: each kind changes files so that nobody has signed what they say now.

``tampered(kind, number)`` draws one from a number. A tamper is let through if the judgement is
``approved`` although the blueprint, the records or the register are not those that were signed. A
changed byte that changes no meaning of a blueprint is no tamper.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass, field, replace
from datetime import timedelta
from functools import cache
from random import Random
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_gathered
from smsl_studio.errors import ReadError, SealError
from smsl_studio.inspection.approval.case import (
    ApprovalCase,
    PresentState,
    SeenRecord,
    TrustGrounds,
)
from smsl_studio.inspection.approval.conditions import Asking
from smsl_studio.inspection.approval.judge import judge
from smsl_studio.inspection.approval.policy import TrustPolicy, policy_of
from smsl_studio.inspection.approval.record_file import read_record_file, written_record_file
from smsl_studio.inspection.approval.register import PAYLOAD_TYPE, read_register
from smsl_studio.inspection.approval.statement import SignedFunction, WorldCode
from smsl_studio.seal.canonical import canonical
from smsl_studio.seal.ed25519 import sealed
from smsl_studio.seal.strict_json import base64_text
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.files import parse_bytes
from tests.approval import ADA, BEN, DOOR, EVE, NOON, Member, entry, signed

Json = Any
FUNCTION = SignedFunction(function="arm.move", plugin="arm", version="1", code="a" * 64)
CODE = WorldCode(hardware=True, functions=[FUNCTION], bindings="b" * 64)
RULES: Mapping[str, str] = MappingProxyType(
    {f"R{number:02}": f"{number:064x}" for number in range(1, 31)}
)
STRANGER = Member("Mallory", "surgeon", bytes(range(40, 72)))


@dataclass(frozen=True)
class Files:
    """What lies on the disk, and what the verifier knows."""

    blueprint: bytes
    part: bytes
    record: bytes
    register: bytes
    policy: dict[str, Json]
    seen: tuple[SeenRecord, ...] = ()
    serial: int = 5
    rules: Mapping[str, str] = field(default_factory=lambda: RULES)
    code: WorldCode = CODE


def read(files: Files) -> Blueprint:
    """The blueprint with its imported file."""
    documents = [parse_bytes(files.blueprint, "door.json"), parse_bytes(files.part, "part.json")]
    return read_gathered(documents)


def verdict(files: Files) -> set[str]:
    """The codes of the refusals; the word ``unreadable`` for a blueprint that is none, and nothing
    for what is approved."""
    try:
        blueprint = read(files)
    except ReadError:
        return {"unreadable"}
    policy = policy_of(files.policy, "policy.toml")
    if not isinstance(policy, TrustPolicy):
        return {policy.code}
    try:
        register = read_register(files.register, policy.key)
    except SealError:
        return {"register_invalid"}
    if register.serial < files.serial:
        return {"register_invalid"}
    try:
        records = read_record_file(files.record)
    except SealError:
        return {"signature_invalid"}
    present = PresentState(digests(blueprint), files.rules, "arm", files.code)
    grounds = TrustGrounds(policy, register.keys, True, True, files.seen)
    now = Asking(NOON + timedelta(minutes=30), "arm")
    found = judge(ApprovalCase(records, grounds, present, now, lambda _: ""))
    assert found.is_approved == (not found.refusals)
    return {one.code for one in found.refusals}


def register(serial: int = 5, *persons: dict[str, Json], by: Member = EVE) -> bytes:
    """A register, signed."""
    listed = persons or (entry(ADA), entry(BEN))
    values = {"version": 1, "serial": serial, "persons": list(listed)}
    envelope = sealed(by.private, PAYLOAD_TYPE, canonical(values))
    return json.dumps(envelope.as_json(), separators=(",", ":")).encode()


@cache
def base(number: int) -> Files:
    """One of three blueprints that two people have approved."""
    root: Json = {"_imports": ["part.json"], **deepcopy(DOOR)}
    if number == 1:
        root["DOOR"]["_operations"] = {"open": {"title": "Open it", "cost": 2}}
        root["_hazards"] = [{"name": "Both", "facts": {"DOOR/0": "1", "PART/0": "1"}}]
    if number == 2:
        root = json.loads((samples_dir() / "hanoi-corrected.json").read_text())
        root["_imports"] = ["part.json"]
    blueprint = json.dumps(root, indent=1).encode()
    part = json.dumps({"PART": DOOR["DOOR"]}, indent=1).encode()
    policy = {
        "roles": {"engineer": 1, "surgeon": 1},
        "rules_unchanged": True,
        "register": "persons.json",
        "register_key": base64_text(EVE.public),
    }
    files = Files(blueprint, part, b"", register(), policy)
    return replace(files, record=record_of(read(files)))


def rules() -> list[Json]:
    """The rules as a record names them."""
    return [
        {"id": rule, "version": "1", "code": code, "result": "passed"}
        for rule, code in RULES.items()
    ]


def record_of(blueprint: Blueprint, *members: Member, **other: Json) -> bytes:
    """A record of some people, a minute after each other."""
    told = {"rules": rules(), "worlds": {"arm": CODE}, **other}
    found = [
        signed(blueprint, member, minute, **told)
        for minute, member in enumerate(members or (ADA, BEN))
    ]
    return written_record_file(one.envelope for one in found)


Tamper = Callable[[Random, Files], Files]


def flipped(draw: Random, raw: bytes) -> bytes:
    """Bytes with one to three of them changed, one taken out, or one put in."""
    found = bytearray(raw)
    for _ in range(draw.randint(1, 3)):
        at = draw.randrange(len(found))
        match draw.randrange(4):
            case 0:
                del found[at]
            case 1:
                found.insert(at, draw.randrange(256))
            case _:
                found[at] ^= draw.randint(1, 255)
    return bytes(found)


def edited(draw: Random, raw: bytes) -> bytes:
    """A blueprint with one operation taken out, put in, renamed or led elsewhere, or a header that
    says something else."""
    values = json.loads(raw)
    branch = draw.choice([one for name, one in values.items() if not name.startswith("_")])
    states = [name for name in branch if name != "HEADER" and not name.startswith("_")]
    state = branch[draw.choice([name for name in states if branch[name]])]
    name = draw.choice(sorted(state))
    match draw.randrange(5):
        case 0:
            del state[name]
        case 1:
            state[f"new {draw.random()}"] = draw.choice(states)
        case 2:
            state[f"{name}2"] = state.pop(name)
        case 3:
            state[name] = draw.choice([one for one in states if one != state[name]])
        case _:
            branch.setdefault("_operations", {})[name] = {"timeout": 1 + draw.random()}
    return json.dumps(values, indent=1).encode()


def in_blueprint(draw: Random, files: Files) -> Files:
    change = draw.choice((flipped, edited))
    return replace(files, blueprint=change(draw, files.blueprint))


def in_import(draw: Random, files: Files) -> Files:
    change = draw.choice((flipped, edited))
    return replace(files, part=change(draw, files.part))


def in_record(draw: Random, files: Files) -> Files:
    return replace(files, record=flipped(draw, files.record))


def in_register(draw: Random, files: Files) -> Files:
    """One byte of it is another. White space outside the signed text changes nothing, so it does
    not count."""
    while True:
        changed = flipped(draw, files.register)
        if not _reads_alike(changed, files.register):
            return replace(files, register=changed)


def _reads_alike(one: bytes, other: bytes) -> bool:
    try:
        return bool(json.loads(one) == json.loads(other))
    except ValueError:
        return False


def fields_swapped(draw: Random, files: Files) -> Files:
    """A member of a statement gets the value of another member, or another value."""
    values = json.loads(files.record)
    one = values["records"][draw.randrange(2)]
    envelope = read_record_file(files.record)[0].envelope
    said = json.loads(envelope.payload)["predicate"]
    name = draw.choice(sorted(said))
    before = said[name]
    while said[name] == before:
        said[name] = draw.choice([said[draw.choice(sorted(said))], None, "x", 7, []])
    statement = {**json.loads(envelope.payload), "predicate": said}
    raw = json.dumps(statement).encode() if draw.random() < 0.5 else canonical(statement)
    one["payload"] = base64_text(raw)
    return replace(files, record=json.dumps(values).encode())


def signature_moved(draw: Random, files: Files) -> Files:
    """A signature, a keyid or a payload comes from another record."""
    other = read_record_file(record_of(read(files), BEN, ADA, conditions=[], met=["x"]))
    mine = [one.envelope for one in read_record_file(files.record)]
    theirs = [one.envelope for one in other]
    at, there = draw.randrange(2), draw.choice([*theirs, *mine])
    one = mine[at]
    part = draw.choice(("payload", "keyid", "signature"))
    mine[at] = replace(one, **{part: getattr(there, part)})
    if mine[at] == one:
        mine[at] = replace(one, signature=theirs[0].signature)
    return replace(files, record=written_record_file(mine))


def record_replayed(draw: Random, files: Files) -> Files:
    """The record of another version of the blueprint, or of another one."""
    other = json.loads(files.blueprint)
    name = next(key for key in other if not key.startswith("_"))
    other[name]["_operations"] = {"x": {"title": f"{draw.random()}"}}
    record = record_of(read(replace(files, blueprint=json.dumps(other).encode())))
    if draw.random() < 0.5:
        kept = [one.envelope for one in read_record_file(files.record)]
        foreign = [one.envelope for one in read_record_file(record)]
        mixed = [kept[0], foreign[1]] if draw.random() < 0.5 else [foreign[0], kept[1]]
        record = written_record_file(mixed)
    return replace(files, record=record)


def rolled_back(draw: Random, files: Files) -> Files:
    """An old record is put back, and the store has seen a later one."""
    at = draw.randrange(2)
    old = read_record_file(files.record)[at]
    later = SeenRecord((ADA, BEN)[at].key, f"{draw.getrandbits(256):064x}", old.digest)
    return replace(files, seen=(later,))


def cut_or_reordered(draw: Random, files: Files) -> Files:
    """Records are left out, doubled, or stand in another order."""
    mine = [one.envelope for one in read_record_file(files.record)]
    other = draw.choice([[mine[0]], [mine[1]], [], mine[::-1], [*mine, mine[0]], 2 * mine])
    return replace(files, record=written_record_file(other))


def roles_inflated(draw: Random, files: Files) -> Files:
    """Nobody of a role has signed, whatever the record says of the role."""
    fake = Member(ADA.person, "surgeon", ADA.private)
    members = draw.choice([(fake,), (ADA, fake), (fake, ADA)])
    return replace(files, record=record_of(read(files), *members))


def one_person_as_two(draw: Random, files: Files) -> Files:
    """A person with two keys, or with two entries of one name, signs in both roles."""
    second = Member("ADA  lovelace", "surgeon", bytes(range(9, 41)))
    record = record_of(read(files), ADA, second)
    both = [base64_text(ADA.public), base64_text(second.public)]
    one = {"person": ADA.person, "roles": ["engineer", "surgeon"], "keys": both}
    two = (entry(ADA), {**entry(second), "person": draw.choice(["Ada Lovelace", "ADA LOVELACE"])})
    persons = draw.choice([(one,), two])
    return replace(files, record=record, register=register(5, *persons))


def chain_of_another_key(draw: Random, files: Files) -> Files:
    """Everything is signed anew, with keys of somebody else, or a register of somebody else."""
    fake = Member(BEN.person, BEN.role, STRANGER.private)
    if draw.random() < 0.5:
        return replace(files, record=record_of(read(files), ADA, fake))
    listed = (entry(ADA), entry(fake))
    foreign = register(draw.randint(5, 50), *listed, by=STRANGER)
    return replace(files, register=foreign, record=record_of(read(files), ADA, fake))


def old_register(draw: Random, files: Files) -> Files:
    """A register that was replaced, with a person who has left."""
    left = Member("Gone Away", "surgeon", STRANGER.private)
    listed = (entry(ADA), entry(left))
    record = record_of(read(files), ADA, left)
    return replace(files, record=record, register=register(draw.randrange(5), *listed))


def in_policy(draw: Random, files: Files) -> Files:
    """A policy that is none, or that names another register's key."""
    change: dict[str, Json] = draw.choice(
        [
            {"person": 1},
            {"persons": 0},
            {"persons": "2"},
            {"persons": True},
            {"roles": {"surgeon": 0}},
            {"roles": ["surgeon"]},
            {"automatic": "always"},
            {"valid_days": -1},
            {"valid_days": "x"},
            {"rules_unchanged": 1},
            {"revoked": ["x"]},
            {"register_key": base64_text(STRANGER.public)},
            {"register_key": "AAAA"},
            {"generated_edges": "always"},
            {"supervisor": "yes"},
            {f"x{draw.random()}": 1},
        ]
    )
    return replace(files, policy={**files.policy, **change})


def in_rules(draw: Random, files: Files) -> Files:
    """The code of a rule is another one."""
    rule = draw.choice(sorted(RULES))
    return replace(files, rules={**RULES, rule: f"{draw.getrandbits(256):064x}"})


def in_library(draw: Random, files: Files) -> Files:
    """The code of a function is another one, or it is bound to something else, or gone."""
    other = FUNCTION.model_copy(update={"code": f"{draw.getrandbits(256):064x}"})
    version = FUNCTION.model_copy(update={"version": f"{draw.random()}"})
    changes: dict[str, Json] = draw.choice(
        [
            {"functions": [other]},
            {"functions": [version]},
            {"functions": []},
            {"functions": [FUNCTION, other.model_copy(update={"function": "arm.stop"})]},
            {"bindings": f"{draw.getrandbits(256):064x}"},
            {"hardware": False},
        ]
    )
    return replace(files, code=CODE.model_copy(update=changes))


KINDS: Mapping[str, Tamper] = {
    "blueprint": in_blueprint,
    "imported file": in_import,
    "record": in_record,
    "register": in_register,
    "policy": in_policy,
    "fields swapped": fields_swapped,
    "signature moved": signature_moved,
    "record replayed": record_replayed,
    "rolled back": rolled_back,
    "cut or reordered": cut_or_reordered,
    "roles inflated": roles_inflated,
    "one person as two": one_person_as_two,
    "another key": chain_of_another_key,
    "old register": old_register,
    "rules": in_rules,
    "library code": in_library,
}

FITS: Mapping[str, frozenset[str]] = {
    "blueprint": frozenset({"digest_differs", "unreadable"}),
    "imported file": frozenset({"digest_differs", "unreadable"}),
    "record": frozenset({"signature_invalid", "key_unknown"}),
    "register": frozenset({"register_invalid"}),
    "policy": frozenset({"policy_invalid", "register_invalid"}),
    "fields swapped": frozenset({"signature_invalid"}),
    "signature moved": frozenset({"signature_invalid"}),
    "record replayed": frozenset({"digest_differs"}),
    "rolled back": frozenset({"rolled_back"}),
    "cut or reordered": frozenset({"too_few_persons", "no_record", "signature_invalid"}),
    "roles inflated": frozenset({"role_missing"}),
    "one person as two": frozenset({"too_few_persons", "register_invalid"}),
    "another key": frozenset({"key_unknown", "register_invalid"}),
    "old register": frozenset({"register_invalid"}),
    "rules": frozenset({"rules_changed"}),
    "library code": frozenset({"code_changed", "code_missing"}),
}
"""The codes that fit each kind: at least one of them must be told."""


def tampered(kind: str, number: int) -> tuple[Files, set[str]] | None:
    """A tamper and its refusals. None if it changes no meaning of a blueprint."""
    draw = Random(f"{kind} {number}")
    files = base(draw.randrange(3))
    found = KINDS[kind](draw, files)
    codes = verdict(found)
    in_blueprints = kind in ("blueprint", "imported file")
    if not codes and in_blueprints and digests(read(found)) == digests(read(files)):
        return None
    return found, codes
