"""Decides whether a blueprint is approved. Command line, window, Python and runs all use it.

It reads no file and no clock. The caller passes everything in the case.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from smsl_studio.inspection.approval.case import ApprovalCase
from smsl_studio.inspection.approval.conditions import TypedCondition, typed
from smsl_studio.inspection.approval.known_keys import name_of
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.signers import Signer, last_words, rolled_back, signers_of
from smsl_studio.inspection.approval.statement import APPROVED, CONDITIONS
from smsl_studio.stop import heed

Json = Any
REFUSED = "refused"
_TOLD = 20
"""The largest number of open errors that a refusal lists."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """The decision: approved, conditions or refused.

    ``refusals`` has the reasons against an approval. ``signers`` has, for each person with a valid
    signature, the last record. ``met`` has the typed conditions that are met. ``seen`` has every
    record with a valid signature, so that the store can remember the whole chain of each person.
    """

    verdict: str
    refusals: tuple[Refusal, ...] = ()
    signers: tuple[Signer, ...] = ()
    met: tuple[str, ...] = ()
    seen: tuple[Signer, ...] = ()

    @property
    def is_approved(self) -> bool:
        """Whether the blueprint is approved and every condition is met."""
        return self.verdict == APPROVED

    def as_json(self) -> dict[str, Json]:
        """Return the decision in the form that ``verify`` prints, without the name of the file."""
        return {
            "verdict": self.verdict,
            "refusals": [one.as_json() for one in self.refusals],
            "signers": [one.as_json() for one in self.signers],
        }


def judge(case: ApprovalCase) -> Judgement:
    """Decide whether the blueprint of a case is approved."""
    heed()
    if isinstance(case.records, Refusal):
        return refused(case.records)
    if not case.records:
        return refused(Refusal("no_record", "nobody has signed a record of this blueprint"))
    signers, refusals = signers_of(case, case.records)
    last = last_words(signers)
    for one in last:
        if rolled_back(case, one):
            words = f"{one.key.person} has signed a later record than the one that is shown"
            refusals.append(Refusal("rolled_back", words))
        if one.rejects:
            words = f"{one.key.person} has rejected this blueprint"
            refusals.append(Refusal("verdict_not_approved", words))
        if one.is_automatic and not one.faults and case.grounds.policy.automatic == "never":
            words = f"{one.key.person} is a program, and the policy lets none sign"
            refusals.append(Refusal("policy_unmet", words))
    refusals += _missing_persons(case, last)
    refusals += _hardware(case)
    if case.grounds.policy.supervisor and case.asking.supervised is False:
        refusals.append(Refusal("supervisor_missing", "the policy wants a supervisor"))
    errors = case.present.errors
    refusals += [Refusal("open_finding", words) for words in errors[:_TOLD]]
    met: list[str] = []
    for one in last:
        if one.counts:
            for setter in _setters(one, signers):
                refusals += _open_conditions(case, setter, signers, met)
    return replace(_judged(refusals, last, met), seen=tuple(signers))


def refused(*refusals: Refusal) -> Judgement:
    """Return the decision for a case that could not be read, with the reasons."""
    return Judgement(REFUSED, refusals)


def _judged(refusals: Sequence[Refusal], last: Sequence[Signer], met: list[str]) -> Judgement:
    told = tuple(dict.fromkeys(refusals))
    verdict = APPROVED
    if told:
        only = all(one.code == "condition_unmet" for one in told)
        verdict = CONDITIONS if only else REFUSED
    return Judgement(verdict, told, tuple(last), tuple(dict.fromkeys(met)))


def _missing_persons(case: ApprovalCase, last: Sequence[Signer]) -> Iterator[Refusal]:
    """If approvals are missing, yield the reasons.

    First come the faults of records that do not count. Then come the number of persons and the
    roles that are missing.
    """
    policy = case.grounds.policy
    good = [one for one in last if one.counts]
    unfilled = _unfilled(policy.roles, good)
    if len(good) >= policy.needed and not unfilled:
        return
    for one in last:
        if not one.is_automatic:
            yield from one.faults
    if len(good) < policy.needed:
        persons = "1 person" if policy.needed == 1 else f"{policy.needed} persons"
        have = f"{len(good)} {'does' if len(good) == 1 else 'do'}"
        yield Refusal("too_few_persons", f"{persons} must approve it, and {have}")
    for role in unfilled:
        many = policy.roles[role]
        persons = "a person" if many == 1 else f"{many} persons"
        words = f"{persons} of the role {role} must approve it; one person fills one role"
        yield Refusal("role_missing", words)


def _unfilled(roles: Mapping[str, int], good: Sequence[Signer]) -> list[str]:
    """Return the roles for which a person is missing.

    One person can fill only one role. Persons are assigned so that most roles are filled (a
    bipartite matching).
    """
    seats = [(role, name_of(role)) for role, many in roles.items() for _ in range(many)]
    taken: dict[int, int] = {}

    def place(seat: int, tried: set[int]) -> bool:
        """Find a person for a seat. A person who has a seat may move to another one."""
        for number, one in enumerate(good):
            if number in tried or seats[seat][1] not in one.roles:
                continue
            tried.add(number)
            if number not in taken or place(taken[number], tried):
                taken[number] = seat
                return True
        return False

    empty = [seats[seat][0] for seat in range(len(seats)) if not place(seat, set())]
    return list(dict.fromkeys(empty))


def _hardware(case: ApprovalCase) -> Iterator[Refusal]:
    code, grounds = case.present.code, case.grounds
    if code is None or not code.hardware:
        return
    where = f"{case.present.world} is hardware"
    if not grounds.given:
        yield Refusal("policy_unmet", f"{where}, and no policy is named")
    elif not grounds.registered:
        yield Refusal("register_invalid", f"{where}, and the policy names no register")


def _setters(last: Signer, signers: Sequence[Signer]) -> Iterator[Signer]:
    """Yield the records of a person whose conditions are still valid.

    They are the last record, and those before it, as long as each later one only says that
    conditions are met.
    """
    own = [one for one in signers if one.person == last.person and one.counts]
    for one in reversed(own):
        yield one
        if not one.said.met:
            return


def _open_conditions(
    case: ApprovalCase, one: Signer, signers: Sequence[Signer], met: list[str]
) -> Iterator[Refusal]:
    """Yield the open conditions of a signer. Typed conditions that are met go into ``met``."""
    for text in one.said.conditions:
        condition = typed(text)
        if condition is None:
            if not any(_closes(other, one, text) for other in signers):
                words = f"nobody of the role {one.role} has signed that it is met: {text}"
                yield Refusal("condition_unmet", words, text)
            continue
        answer = condition.is_met(case.asking)
        if answer:
            met.append(text)
            continue
        yield Refusal("condition_unmet", _unmet(condition, answer))
        if answer is False and condition.kind == "supervisor":
            yield Refusal("supervisor_missing", "nobody supervises the run")
        if answer is False and condition.kind == "sensor":
            yield Refusal("sensor_missing", f"no sensor is as quick as this: {text}")


def _unmet(condition: TypedCondition, answer: bool | None) -> str:
    if answer is None:
        return f"this is asked when a run starts, and cannot be asked here: {condition.text}"
    return f"this condition is not met: {condition.text}"


def _closes(other: Signer, setter: Signer, text: str) -> bool:
    """Whether the record ``other`` says that a condition of ``setter`` is met.

    It must be later, and its signer must have the same role.
    """
    return (
        other.counts
        and text in other.said.met
        and other.record.statement.time > setter.record.statement.time
        and bool(other.roles & setter.roles)
    )
