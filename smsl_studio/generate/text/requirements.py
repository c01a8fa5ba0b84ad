"""What a generated blueprint must fulfil (the paper's alignment): a file of requirements, and a
verdict for each."""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.sources import sources_at
from smsl_studio.errors import Place, ReadError
from smsl_studio.generate.text.answers import AnswerFault, fitted
from smsl_studio.generate.text.blueprint_answer import read_values
from smsl_studio.inspection.rules.sources import cited_parts

Json = Any
HOLDS, FAILS, UNKNOWN = "holds", "fails", "unknown"
_Text = Annotated[str, StringConstraints(min_length=1, max_length=300)]
_Texts = Annotated[tuple[_Text, ...], Field(max_length=1000)]
Proof = Callable[[Blueprint], Mapping[str, tuple[str, str]]]
"""Returns, by the name of a property, its verdict and the reason."""


class TextRequirements(BaseModel):
    """The content of a file of requirements.

    ``properties`` are those of ``_properties``. ``required`` and ``forbidden`` are patterns of
    operations (``Op_Fix*``, ``LEG/Op_*``). ``sources`` are the only files that may be cited.
    ``words`` must not occur in what is written.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    properties: Annotated[tuple[dict[str, Json], ...], Field(max_length=1000)] = ()
    required: _Texts = ()
    forbidden: _Texts = ()
    sources: _Texts | None = None
    words: _Texts = ()


@dataclass(frozen=True)
class RequirementVerdict:
    """One requirement: its kind, what it says, ``holds``, ``fails`` or ``unknown``, and why."""

    kind: str
    name: str
    verdict: str
    reason: str

    def as_json(self) -> dict[str, str]:
        """Return the plain values."""
        return {"kind": self.kind, "name": self.name, "verdict": self.verdict,
                "reason": self.reason}  # fmt: skip


def read_requirements(raw: bytes, file: str) -> TextRequirements:
    """Return the requirements in a TOML file. ReadError if there are none."""
    try:
        return fitted(TextRequirements, tomllib.loads(raw.decode("utf-8")))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        words, found = f"the file is no TOML: {error}", re.search(r"at line (\d+)", str(error))
    except AnswerFault as error:
        words, found = f"the requirements do not fit: {error}", None
    place = Place(file, int(found[1]) if found else 1, 1)
    advice = "There may be properties, required, forbidden, sources and words."
    raise ReadError(words, place, advice)


def verdicts_of(
    wanted: TextRequirements, values: Mapping[str, Json], written: Mapping[str, str], proof: Proof
) -> tuple[RequirementVerdict, ...]:
    """Return a verdict for each requirement about the plain values of a blueprint. ``written`` are
    the texts of all files, by their names."""
    blueprint = read_values(values)
    return (
        *_properties(wanted.properties, values, proof),
        *_operations(wanted, blueprint),
        *_sources(wanted.sources, blueprint),
        *_words(wanted.words, written),
    )


def _properties(
    properties: Sequence[Mapping[str, Json]], values: Mapping[str, Json], proof: Proof
) -> Iterator[RequirementVerdict]:
    """Prove properties at a copy of the blueprint that has them and no others."""
    names = [str(one.get("name", ""))[:300] for one in properties]
    told = proof(read_values({**values, "_properties": [dict(one) for one in properties]}))
    for name in names:
        twice = names.count(name) > 1
        verdict, reason = told.get(name, (UNKNOWN, "it cannot be read"))
        if twice or not name:
            verdict, reason = UNKNOWN, "it has no name of its own"
        yield RequirementVerdict("property", name, verdict, reason)


def _operations(wanted: TextRequirements, blueprint: Blueprint) -> Iterator[RequirementVerdict]:
    names = {
        (edge.name, f"{branch.name}/{edge.name}"): edge.address
        for branch in blueprint
        for edge in branch.edges()
    }
    for kind, patterns in (("required", wanted.required), ("forbidden", wanted.forbidden)):
        for pattern in patterns:
            found = [
                address
                for both, address in names.items()
                if any(fnmatchcase(name, pattern) for name in both)
            ]
            good = bool(found) == (kind == "required")
            reason = str(found[0]) if found else "no operation has this name"
            yield RequirementVerdict(kind, pattern, HOLDS if good else FAILS, reason)


def _sources(allowed: Sequence[str] | None, blueprint: Blueprint) -> Iterator[RequirementVerdict]:
    if allowed is None:
        return
    name = ", ".join(allowed) or "none"
    for address in cited_parts(blueprint):
        cited = sources_at(blueprint, address)
        other = next((one for one in cited if one.file not in allowed), None)
        if other is not None or not cited:
            reason = f"{address} cites {other.place}" if other else f"{address} has no source"
            yield RequirementVerdict("sources", name, FAILS, reason)
            return
    yield RequirementVerdict("sources", name, HOLDS, "every part cites them")


def unanswered(wanted: TextRequirements) -> tuple[RequirementVerdict, ...]:
    """Return a verdict for each requirement where no blueprint was made."""
    named = [("property", str(one.get("name", ""))[:300]) for one in wanted.properties]
    named += [("required", one) for one in wanted.required]
    named += [("forbidden", one) for one in wanted.forbidden]
    if wanted.sources is not None:
        named.append(("sources", ", ".join(wanted.sources) or "none"))
    named += [("word", one) for one in wanted.words]
    reason = "no blueprint was made"
    return tuple(RequirementVerdict(kind, name, UNKNOWN, reason) for kind, name in named)


def _words(words: Sequence[str], written: Mapping[str, str]) -> Iterator[RequirementVerdict]:
    plain = {name: _plain(text) for name, text in written.items()}
    for word in words:
        parts = [re.escape(part) for part in _plain(word).split()]
        if not parts:
            yield RequirementVerdict("word", word, UNKNOWN, "it is no word")
            continue
        whole = r"\s+".join(parts)
        pattern = re.compile(rf"(?<!\w){whole}(?!\w)", re.IGNORECASE)
        place = next((name for name, text in plain.items() if pattern.search(text)), "")
        reason = f"it stands in {place}" if place else "it stands nowhere"
        yield RequirementVerdict("word", word, FAILS if place else HOLDS, reason)


def _plain(text: str) -> str:
    """Return a text without characters that nobody sees, and with one form for each letter, so that
    a word cannot be hidden."""
    folded = unicodedata.normalize("NFKC", text)
    return "".join(char for char in folded if unicodedata.category(char) != "Cf")
