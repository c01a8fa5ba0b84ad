"""Decides whether a blueprint is approved. Command line, window, Python and runs ask this.

It reads no file and no clock: the whole case is handed in.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
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
"""The largest number of open errors that are told."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """Whether a blueprint is approved: approved, conditions or refused.

    ``refusals`` say what is against it. ``signers`` are the last words of all persons whose
    signature is right. ``met`` are the typed conditions that are met here.
    """

    verdict: str
    refusals: tuple[Refusal, ...] = ()
    signers: tuple[Signer, ...] = ()
    met: tuple[str, ...] = ()

    @property
    def is_approved(self) -> bool:
        """Whether it is approved, with every condition met."""
        return self.verdict == APPROVED

    def as_json(self) -> dict[str, Json]:
        """Return it as ``verify`` writes it, without the file."""
        return {
            "verdict": self.verdict,
            "refusals": [one.as_json() for one in self.refusals],
            "signers": [one.as_json() for one in self.signers],
        }


def judge(case: ApprovalCase) -> Judgement:
    """Decide a case."""
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
    return _judged(refusals, last, met)


def refused(*refusals: Refusal) -> Judgement:
    """Return the judgement of a case that could not even be looked at."""
    return Judgement(REFUSED, refusals)


def _judged(refusals: Sequence[Refusal], last: Sequence[Signer], met: list[str]) -> Judgement:
    told = tuple(dict.fromkeys(refusals))
    verdict = APPROVED
    if told:
        only = all(one.code == "condition_unmet" for one in told)
        verdict = CONDITIONS if only else REFUSED
    return Judgement(verdict, told, tuple(last), tuple(dict.fromkeys(met)))


def _missing_persons(case: ApprovalCase, last: Sequence[Signer]) -> Iterator[Refusal]:
    """Yield what is missing of the persons that the policy asks for, and why it is missing."""
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
    """Return the roles that lack a person. One person fills one role (a bipartite matching)."""
    seats = [(role, name_of(role)) for role, many in roles.items() for _ in range(many)]
    taken: dict[int, int] = {}

    def place(seat: int, tried: set[int]) -> bool:
        """Find a person for a seat. Persons who sit may move to another seat of theirs."""
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
    """Yield the records whose conditions hold for a person: the last word, and those before it as
    long as each only said that conditions are met."""
    own = [one for one in signers if one.person == last.person and one.counts]
    for one in reversed(own):
        yield one
        if not one.said.met:
            return


def _open_conditions(
    case: ApprovalCase, one: Signer, signers: Sequence[Signer], met: list[str]
) -> Iterator[Refusal]:
    """Yield the conditions of one signer that are open. The typed ones that are met go to
    ``met``."""
    for text in one.said.conditions:
        condition = typed(text)
        if condition is None:
            if not any(_closes(other, one, text) for other in signers):
                words = f"nobody of the role {one.role} has signed that it is met: {text}"
                yield Refusal("condition_unmet", words)
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
    """Whether a record says that a condition is met. It must be later, and of the same role."""
    return (
        other.counts
        and text in other.said.met
        and other.record.statement.time > setter.record.statement.time
        and bool(other.roles & setter.roles)
    )
