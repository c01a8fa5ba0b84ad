"""The rows about hazards and properties: what each says, and what was shown about it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.annotations import read_hazards
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.follow import terms_of
from smsl_studio.blueprint.properties.formula import FactTerm
from smsl_studio.blueprint.properties.meaning import fact_of
from smsl_studio.blueprint.properties.words import hazard_words, property_words
from smsl_studio.front.proof import Proof, proof_in
from smsl_studio.inspection.proof.claims import Claim, claims_of
from smsl_studio.inspection.proof.exploration import Tell, nobody
from smsl_studio.inspection.proof.prove import Scope
from smsl_studio.inspection.proof.verdict import (
    FAILS,
    HAZARD,
    HOLDS,
    UNKNOWN,
    Counterexample,
    PropertyVerdict,
)

CLAIMS = ("_hazards", "_properties")
"""The keys under which hazards and properties are written."""
KIND_WORDS: Mapping[str, str] = {
    HAZARD: "hazard",
    "never": "never",
    "before": "before",
    "after": "after",
    "way_back": "way back",
    "reachable": "possible",
    "at_most": "at most",
    "cost": "cost",
}
"""Each kind in words."""
ORDER = {FAILS: 0, UNKNOWN: 1, HOLDS: 2}


@dataclass(frozen=True)
class ClaimRow:
    """One hazard or property with its verdict. ``looked_at`` says how much was looked at, or the
    bound that was met. ``file`` and ``index`` are its place: ``_hazards[index]`` of the file.
    """

    address: Address
    kind: str
    severity: str
    sentence: str
    why: str
    file: str
    index: int
    verdict: str
    looked_at: str
    engine: str = ""
    run: Counterexample | None = None
    met: frozenset[tuple[str, int]] = frozenset()
    """The facts (SB, digit) that meet a hazard or ``never`` at the end of the run."""

    @property
    def name(self) -> str:
        """The name of the hazard or property."""
        return self.address.state


@dataclass(frozen=True)
class ClaimAnswers:
    """What was shown about one blueprint, and the same in rows: fails, unknown, holds; then as
    written."""

    proof: Proof
    rows: tuple[ClaimRow, ...] = ()


def has_claims(blueprint: Blueprint) -> bool:
    """Return whether a hazard or a property is written, whether or not it can be read."""
    return any(one.values.get(key) for one in blueprint.documents for key in CLAIMS)


def unanswered(blueprint: Blueprint) -> tuple[ClaimRow, ...]:
    """Return a row for each hazard and property, as written, before anything was shown."""
    return tuple(_row(blueprint, claim, None) for claim in claims_of(blueprint))


def answered(blueprint: Blueprint, limit: int, tell: Tell = nobody) -> ClaimAnswers:
    """Return a row with a verdict for each hazard and property. The work can be called off.

    ``tell`` is called now and then with the number of configurations found so far.
    """
    if not any(key in one.values for one in blueprint.documents for key in CLAIMS):
        return ClaimAnswers(Proof((), ()))
    proof = proof_in(blueprint, Scope(limit, tell=tell))
    rows = [
        _row(blueprint, claim, verdict)
        for claim, verdict in zip(claims_of(blueprint), proof.verdicts, strict=True)
    ]
    return ClaimAnswers(proof, tuple(sorted(rows, key=lambda row: ORDER[row.verdict])))


def _row(blueprint: Blueprint, claim: Claim, verdict: PropertyVerdict | None) -> ClaimRow:
    run = verdict.counterexample if verdict else None
    return ClaimRow(
        Address(claim.path[0], claim.name),
        claim.kind,
        claim.severity,
        _sentence(blueprint, claim),
        claim.written.why if claim.written else "",
        claim.document.file,
        int(claim.path[1]),
        verdict.verdict if verdict else UNKNOWN,
        looked_at(verdict) if verdict else "not answered yet",
        verdict.engine if verdict else "",
        run,
        frozenset(_met(blueprint, claim, run)),
    )


def _sentence(blueprint: Blueprint, claim: Claim) -> str:
    if claim.written is not None:
        return property_words(claim.written, blueprint)
    if claim.kind == HAZARD and claim.meanings is not None:
        return hazard_words(_facts_of(claim), blueprint)
    return "It cannot be read. Its finding R29 says why"


def _met(
    blueprint: Blueprint, claim: Claim, run: Counterexample | None
) -> Iterator[tuple[str, int]]:
    if run is None:
        return
    if claim.kind == HAZARD:
        for text in _facts_of(claim):
            fact = split_fact(text)
            if fact is not None:
                yield fact
    elif claim.kind == "never" and claim.written is not None:
        for term in terms_of(claim.written.formulas[0]):
            fact = fact_of(term, blueprint) if isinstance(term, FactTerm) else None
            if isinstance(term, FactTerm) and fact is not None:
                value = blueprint[fact[0]].facts(run.end[fact[0]])[fact[1]]
                if (value == term.value) == term.equal:
                    yield fact


def _facts_of(claim: Claim) -> Mapping[str, str]:
    """Return the facts of a hazard that can be read."""
    written = claim.document.values[CLAIMS[0]][int(claim.path[1])]
    return read_hazards([written])[0][0].facts


def looked_at(verdict: PropertyVerdict) -> str:
    """How much was looked at, in words, or the bound that was met."""
    if verdict.verdict == UNKNOWN and verdict.bound:
        limit = "configurations" in verdict.bound
        return f"{verdict.bound}, limit" if limit else verdict.bound
    if verdict.configurations is None:
        if verdict.kind not in ("at_most", "cost"):
            return "not counted: a part of the SBs is enough"
        run = verdict.counterexample
        if run is not None and run.path:
            return f"cheapest route, {_counted(len(run.path), 'operation')}"
        return "no route" if run is not None else "cheapest route"
    number = _counted(verdict.configurations, "configuration")
    return f"{number}, limit" if verdict.bound else f"{number}, all"


def _counted(number: int, noun: str) -> str:
    return f"{number:,} {noun}{'' if number == 1 else 's'}"
