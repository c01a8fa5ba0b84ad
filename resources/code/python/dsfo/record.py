"""Inspection records: may this blueprint run under a trust policy?

Signed records (DSSE, Ed25519) name the digests of the blueprint. ``cryptography`` is loaded only
where a record or a policy is named. Keys come from the register that the policy names, else from
the store of this user. What cannot be judged here is refused.
"""

from __future__ import annotations

import base64
import binascii
import json
import os
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime, time, timedelta, timezone
from hashlib import sha256
from pathlib import Path
from typing import Any

from .elements import Blueprint
from .errors import RunRefused, UsageError
from .levels import Levels
from .people import same_name

if sys.version_info >= (3, 11):
    import tomllib

Json = Any
Refusal = tuple[str, str]
"""A code and a sentence."""
AHEAD = timedelta(minutes=5)
"""How far the clock of a signer may be ahead of ours."""
PROGRAMS = frozenset(("automatic", "recorder"))
HERTZ = 20.0
"""How often (Hz) the table world reads every fact."""
POLICY: Mapping[str, tuple[type, ...]] = {
    "roles": (dict,),
    "persons": (int,),
    "valid_days": (int, float),
    "automatic": (str,),
    "rules_unchanged": (bool,),
    "supervisor": (bool,),
    "generated_edges": (str,),
    "revoked": (list,),
    "register": (str,),
    "register_key": (str,),
}


class Doubt(Exception):
    """Why a record, a register or a policy is not believed."""

    def __init__(self, code: str, sentence: str) -> None:
        super().__init__(sentence)
        self.code, self.sentence = code, sentence


@dataclass(frozen=True)
class Key:
    """A public key, its person, the roles of the person, and when it may sign."""

    public: bytes
    person: str
    roles: frozenset[str]
    since: datetime | None = None
    until: datetime | None = None
    revoked: str = ""


@dataclass(frozen=True)
class Signed:
    """One record with a valid signature, and why it does not count, if so."""

    key: Key
    said: Mapping[str, Json]
    time: datetime
    faults: list[Refusal]

    @property
    def person(self) -> str:
        """The person, as names are compared."""
        return same_name(self.key.person)

    @property
    def is_program(self) -> bool:
        """Whether a program has signed."""
        return bool(self.key.roles & PROGRAMS) or same_name(self.said["role"]) in PROGRAMS

    @property
    def counts(self) -> bool:
        """Whether it is the approval of one person."""
        return not (self.faults or self.is_program or self.said["verdict"] == "rejected")


@dataclass(frozen=True)
class Trust:
    """Whether a run may start. ``asked``: a record or a policy was named. ``met`` are the typed
    conditions that are met. ``header`` is what the log says about it.
    """

    asked: bool = False
    refusals: list[Refusal] = field(default_factory=list)
    met: list[str] = field(default_factory=list)
    header: dict[str, Json] | None = None

    def must_hold(self) -> None:
        """Raise RunRefused if there are refusals."""
        if self.refusals:
            words = "; ".join(sentence for _, sentence in self.refusals)
            advice = "smsl-studio verify tells what is missing."
            raise RunRefused(f"it is not approved: {words}", advice, self.refusals)


def trusted(
    blueprint: Blueprint, policy: str | None, record: str | None, before: Mapping[str, str]
) -> Trust:
    """Return whether a run may start under a policy with a record. ``before`` are the levels that
    are set for it."""
    if policy is None and record is None:
        return Trust()
    grounds = _Grounds(blueprint, policy, record, before)
    try:
        return grounds.judged()
    except Doubt as doubt:
        return grounds.told([(doubt.code, doubt.sentence)])
    except (KeyError, TypeError, ValueError, RecursionError, binascii.Error):
        return grounds.told([("signature_invalid", "the record is not as Studio writes it")])


class _Grounds:
    """One question: the policy, the record, the keys, and the present moment."""

    def __init__(
        self,
        blueprint: Blueprint,
        policy: str | None,
        record: str | None,
        before: Mapping[str, str],
    ) -> None:
        self._blueprint, self._before = blueprint, before
        self._policy_file, self._record_file = policy, record
        self._policy: dict[str, Json] = {}
        self._now = datetime.now(timezone.utc)
        self._signed: list[Signed] = []
        self._met: list[str] = []
        self._words = ""

    def judged(self) -> Trust:
        """Return the answer."""
        self._policy = self._read_policy()
        keys = self._keys()
        if self._record_file is None:
            return self.told([("no_record", "nobody has signed a record of this blueprint")])
        raw = _bytes(self._record_file)
        wrong = list(self._read_records(raw, keys))
        last = self._last_words()
        wrong += self._against(last)
        wrong += self._missing(last)
        if self._policy.get("supervisor"):  # here only a script acts, which is no supervisor
            wrong.append(("supervisor_missing", "the policy wants a supervisor"))
        for one in last:
            if one.counts:
                wrong += self._conditions(one)
        less = list(Levels(self._blueprint, self._before).less_human())
        if less:
            words = f"levels of this run leave people less to do than what was signed: {less[0]}"
            wrong.append(("digest_differs", words))
        return self.told(list(dict.fromkeys(wrong)))

    def told(self, refusals: list[Refusal]) -> Trust:
        """Return the answer with these refusals."""
        signers = [
            {
                "person": one.key.person,
                "role": one.said["role"],
                "key": _identity(one.key.public),
                "time": one.said["time"],
                "verdict": one.said["verdict"],
            }
            for one in self._last_words()
        ]
        header = {
            "verdict": "refused" if refusals else "approved",
            "policy": _digest(self._policy_file),
            "record": _digest(self._record_file),
            "register": None,
            "serial": None,
            "keys": self._words,
            "signers": signers,
            "met": self._met,
        }
        return Trust(True, refusals, self._met, header)

    # policy and keys -----------------------------------------------------------------------------

    def _read_policy(self) -> dict[str, Json]:
        if self._policy_file is None:
            return {}
        found = _toml(_bytes(self._policy_file))
        for name, value in found.items():
            kinds = POLICY.get(name, ())
            if type(value) not in kinds:
                raise Doubt("policy_invalid", f"the policy is not valid: {name}")
        if found.get("rules_unchanged"):
            words = "the policy wants unchanged rules, which only Studio can compare"
            raise Doubt("rules_changed", words)
        return found

    def _keys(self) -> dict[str, Key]:
        named = self._policy.get("register")
        if named is None:
            self._words = "keys of this computer, not of a register"
            return dict(_stored_keys())
        assert self._policy_file is not None, "only a policy names a register"
        envelope = _read_json(_bytes(str(Path(self._policy_file).parent / named)))
        public = _from_base64(str(self._policy.get("register_key")))
        payload = _opened(envelope, "application/vnd.smsl-studio.register+json", lambda _: public)
        self._words = "keys of the register"
        return dict(_registered(_read_json(payload)["persons"]))

    # records -------------------------------------------------------------------------------------

    def _read_records(self, raw: bytes, keys: Mapping[str, Key]) -> Iterator[Refusal]:
        """Read all records in order, and yield what is wrong with those that do not count."""
        before: datetime | None = None
        for envelope in _read_json(raw)["records"]:
            name = envelope["signatures"][0]["keyid"]
            key = keys.get(name)
            if key is None:
                yield "key_unknown", f"a record is signed with the key {name[:80]}, not known"
                continue
            kind = "application/vnd.in-toto+json"
            payload = _opened(envelope, kind, lambda _, public=key.public: public)
            statement = _read_json(payload)
            said = statement["predicate"]
            moment = _moment(said["time"])
            if moment > self._now + AHEAD or (before is not None and moment <= before):
                yield "signature_invalid", f"the record of {key.person} is out of time or order"
                continue
            before = moment
            faults = list(self._faults(key, statement, moment, sha256(payload).hexdigest()))
            self._signed.append(Signed(key, said, moment, faults))

    def _faults(
        self, key: Key, statement: Json, moment: datetime, digest: str
    ) -> Iterator[Refusal]:
        said, named = statement["predicate"], statement["subject"][0]["digest"]
        who = f"the record of {key.person}"
        revoked = {one[-64:] for one in self._policy.get("revoked", ())}
        if key.revoked or _identity(key.public)[-64:] in revoked:
            yield "key_revoked", f"the key of {key.person} is revoked"
        if (key.since and moment < key.since) or (key.until and moment > key.until):
            yield "key_expired", f"the key of {key.person} was not valid at {said['time']}"
        if revoked & {digest, *named.values()}:
            yield "record_revoked", f"the policy revokes {who}"
        ends = [_moment(said["expires"])] if said["expires"] else []
        if "valid_days" in self._policy:
            ends.append(moment + timedelta(days=min(self._policy["valid_days"], 1e5)))
        if ends and self._now > min(ends):
            yield "record_expired", f"{who} was valid until {min(ends).isoformat()}"
        ours = dict(zip(("behaviour", "meaning", "closure"), self._blueprint.digests, strict=True))
        if named != ours:
            yield "digest_differs", f"the blueprint has changed since {who}, of {said['time']}"
        if said["relies_on"]:
            yield "sub_not_covered", f"{who} relies on records of parts, which are not read here"

    def _last_words(self) -> list[Signed]:
        found: dict[str, Signed] = {}
        for one in self._signed:
            found.pop(one.person, None)
            found[one.person] = one
        return list(found.values())

    def _against(self, last: Sequence[Signed]) -> Iterator[Refusal]:
        gone = {"digest_differs", "key_revoked", "key_expired", "record_revoked"}
        for one in last:
            codes = {code for code, _ in one.faults}
            if one.said["verdict"] == "rejected" and not codes & gone:
                yield "verdict_not_approved", f"{one.key.person} has rejected this blueprint"
            elif one.is_program and self._policy.get("automatic", "never") == "never":
                yield "policy_unmet", f"{one.key.person} is a program, and none may sign"

    def _missing(self, last: Sequence[Signed]) -> Iterator[Refusal]:
        """Yield the persons and roles that are missing."""
        good = [one for one in last if one.counts]
        roles: dict[str, int] = self._policy.get("roles", {})
        seats = [role for role, many in roles.items() for _ in range(min(many, 99))]
        persons = self._policy.get("persons", max(1, len(seats)))
        filled = _filled(seats, [one.key.roles for one in good])
        if len(good) >= persons and filled:
            return
        for one in last:
            if not one.is_program:
                yield from one.faults
        if len(good) < persons:
            yield "too_few_persons", f"{persons} must approve it, and {len(good)} did"
        if not filled:
            yield "role_missing", f"persons of these roles must approve it: {', '.join(seats)}"

    def _conditions(self, last: Signed) -> Iterator[Refusal]:
        """Yield the conditions of a person that are still open."""
        own = [one for one in self._signed if one.person == last.person and one.counts]
        for one in reversed(own):
            for text in one.said["conditions"]:
                yield from self._condition(one, text)
            if not one.said["met"]:
                return

    def _condition(self, setter: Signed, text: str) -> Iterator[Refusal]:
        met = self._typed(text)
        if met is None:
            met = any(
                one.counts
                and text in one.said["met"]
                and one.time > setter.time
                and one.key.roles & setter.key.roles
                for one in self._signed
            )
        elif met:
            self._met = list(dict.fromkeys([*self._met, text]))
        if not met:
            yield "condition_unmet", f"this condition is not met: {text}"

    def _typed(self, text: str) -> bool | None:
        """Return whether a condition that a program can check is met; None for free text."""
        if text.startswith("world = "):
            return text == "world = table"
        if text == "supervisor present":
            return False
        if sensor := re.fullmatch(r"sensor .+/\d+ at (\d+(?:\.\d+)?) Hz", text, re.ASCII):
            return float(sensor[1]) <= HERTZ
        if until := re.fullmatch(r"until (\S+)", text):
            return self._now <= _moment(until[1], end=True)
        return None


def _filled(seats: Sequence[str], persons: Sequence[frozenset[str]]) -> bool:
    """Return whether each seat gets a person of its own who has that role."""
    if len(seats) > len(persons):
        return False
    free = [frozenset(range(len(persons)))]
    for seat in map(same_name, seats):
        free = list(
            dict.fromkeys(left - {one} for left in free for one in left if seat in persons[one])
        )
    return bool(free)


# files, keys, envelopes --------------------------------------------------------------------------


def _bytes(file: str) -> bytes:
    try:
        return Path(file).read_bytes()
    except OSError as error:
        raise UsageError(f"{file}:1:1: cannot be read: {error.strerror or error}") from None


def _digest(file: str | None) -> str | None:
    return sha256(Path(file).read_bytes()).hexdigest() if file and Path(file).is_file() else None


if sys.version_info >= (3, 11):

    def _toml(raw: bytes) -> dict[str, Any]:
        try:
            return tomllib.loads(raw.decode())
        except (ValueError, RecursionError) as error:
            raise Doubt("policy_invalid", f"the policy is not valid: {error}") from None

else:

    def _toml(raw: bytes) -> dict[str, Any]:
        raise UsageError("a trust policy needs Python 3.11 or later to be read")


def _read_json(raw: bytes) -> Any:
    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        """Return an object. ValueError for a member that stands twice."""
        if len(dict(pairs)) < len(pairs):
            raise ValueError("a member stands twice")
        return dict(pairs)

    return json.loads(raw.decode(), object_pairs_hook=once)


def _from_base64(text: str) -> bytes:
    raw = base64.b64decode(text, validate=True)
    if base64.b64encode(raw).decode() != text:
        raise ValueError("the base64 is not canonical")
    return raw


def _identity(public: bytes) -> str:
    return f"sha256:{sha256(public).hexdigest()}"


def _opened(envelope: Any, kind: str, public_of: Any) -> bytes:
    """Return the payload of an envelope with the right signature. Doubt if it has not."""
    try:
        from cryptography.exceptions import InvalidSignature
        from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey
    except ImportError:
        words = "no signature can be checked: the package cryptography is not installed"
        raise Doubt("signature_invalid", words) from None

    members = {"payload", "payloadType", "signatures"}
    if set(envelope) != members or envelope["payloadType"] != kind:
        raise Doubt("signature_invalid", "an envelope is not as Studio writes it")
    (signature,) = envelope["signatures"]
    payload = _from_base64(envelope["payload"])
    public = public_of(signature["keyid"])
    signed = b"DSSEv1 %d %b %d %b" % (len(kind), kind.encode(), len(payload), payload)
    try:
        key = Ed25519PublicKey.from_public_bytes(public)
        key.verify(_from_base64(signature["sig"]), signed)
    except InvalidSignature:
        raise Doubt("signature_invalid", "a signature is wrong") from None
    return payload


def _moment(text: str, end: bool = False) -> datetime:
    """Return the time in a text. A day alone is its end, or its begin."""
    if "T" not in text:
        at = time.max if end else time.min
        return datetime.combine(datetime.fromisoformat(text).date(), at, timezone.utc)
    found = datetime.fromisoformat(text.replace("Z", "+00:00"))
    if found.tzinfo is None:
        raise ValueError("a time without a zone")
    return found


def _registered(persons: Sequence[Mapping[str, Any]]) -> Iterator[tuple[str, Key]]:
    for one in persons:
        since, until = one.get("from"), one.get("until")
        for text in one["keys"]:
            public = _from_base64(text)
            yield (
                _identity(public),
                Key(
                    public,
                    one["person"],
                    frozenset(map(same_name, one["roles"])),
                    _moment(since) if since else None,
                    _moment(until, end=True) if until else None,
                ),
            )


def _stored_keys() -> Iterator[tuple[str, Key]]:
    """Yield the public keys in the store of this user."""
    given = os.environ.get("SMSL_STUDIO_HOME")
    usual = Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config") / "smsl-studio"
    for file in sorted(((Path(given) if given else usual) / "store" / "keys").glob("*.json")):
        found = _read_json(file.read_bytes())
        public = _from_base64(found["public"])
        roles = frozenset([same_name(found["role"])])
        yield _identity(public), Key(public, found["person"], roles, revoked=found["revoked"])
