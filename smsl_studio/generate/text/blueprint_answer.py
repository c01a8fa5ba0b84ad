"""What the PSM answers: a blueprint as JSON. It is bounded, checked and cleaned before it is read.

Keys that would make a reader open another file (imports, procedures, stored blueprints) and keys
that bind code are refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import StudioError
from smsl_studio.generate.text.answers import AnswerFault, fitted
from smsl_studio.generate.text.expert_text import ExpertText, cited
from smsl_studio.generate.text.steps import Source
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.smsl.json_form import parse_json, write_json

Json = Any
MOST_BRANCHES = 200
MOST_STATES = 4_000
MOST_OPERATIONS = 20_000
LONGEST_NAME = 400
_UNREAD = "R29"
"""The rule about annotations that are left out of the meaning, such as a misspelt ``requires``."""
LONGEST_TEXT = 2_000
_OF_FILE = ("_hazards", "_properties", "_levels")
_OF_BRANCH = ("_facts", "_states", "_operations", "_sources", "_comment")
_DROPPED = ("_origin", "_comment", "_layout", "_notes")
"""Keys that an answer may have and that do not count: who made it is written here."""


def blueprint_of_answer(
    values: Mapping[str, Json], texts: Sequence[ExpertText]
) -> tuple[Blueprint, dict[str, Json]]:
    """Return the blueprint of an answer, and its plain values without what does not count.

    AnswerFault with sentences: what is not allowed, findings of severity E, citations of words that
    stand nowhere.
    """
    cleaned = {key: value for key, value in values.items() if key not in _DROPPED}
    faults = list(_odd(cleaned))
    if faults:
        raise AnswerFault(faults)
    for branch in _branches(cleaned).values():
        for key in ("_origin", "_layout", "_notes"):
            branch.pop(key, None)
        branch["_sources"] = _checked_sources(branch.get("_sources", {}))
    blueprint = read_values(cleaned)
    faults = [
        f"{finding.rule} {finding.address}: {finding.message}; {finding.advice}"
        for finding in inspect(blueprint)
        if finding.severity is Severity.ERROR or finding.rule == _UNREAD
    ]
    faults += _uncited(cleaned, texts)
    if faults:
        raise AnswerFault(faults)
    return blueprint, cleaned


def read_values(values: Mapping[str, Json]) -> Blueprint:
    """Return the blueprint of plain values. AnswerFault if they are none. No file is opened."""
    try:
        return read_blueprint(parse_json(write_json(dict(values)), "psm.json"))
    except StudioError as error:
        raise AnswerFault([str(error)]) from None


def _branches(values: Mapping[str, Json]) -> dict[str, Json]:
    return {key: value for key, value in values.items() if not key.startswith("_")}


def _odd(values: Mapping[str, Json]) -> Iterator[str]:
    """Yield what may not stand in an answer."""
    branches = _branches(values)
    if not branches:
        yield "the answer has no State Branch"
    if len(branches) > MOST_BRANCHES:
        yield f"the answer has more than {MOST_BRANCHES} State Branches"
    for key in values:
        if key.startswith("_") and key not in _OF_FILE:
            yield f"{key[:100]} is not allowed in an answer; of the file there may be {_OF_FILE}"
    states = operations = 0
    for name, branch in branches.items():
        if not isinstance(branch, dict):
            yield f"{name[:100]} must be an object with HEADER and states"
            continue
        table = {key: row for key, row in branch.items() if key[:1] != "_" and key != "HEADER"}
        states += len(table)
        operations += sum(len(row) for row in table.values() if isinstance(row, dict))
        for key in branch:
            if key.startswith("_") and key not in (*_OF_BRANCH, *_DROPPED):
                yield f"{name[:100]}: {key[:100]} is not allowed in an answer"
        notes = branch.get("_operations")
        for key, note in notes.items() if isinstance(notes, dict) else ():
            if isinstance(note, dict) and "binding" in note:
                yield f"{name[:100]}/{key[:100]}: an answer binds no code and no other file"
    if states > MOST_STATES or operations > MOST_OPERATIONS:
        yield f"more than {MOST_STATES:,} states or {MOST_OPERATIONS:,} operations"
    yield from _odd_texts(values)


def _odd_texts(value: Json) -> Iterator[str]:
    """Yield names and texts that are too long or hold control characters."""
    waiting: list[Json] = [value]
    while waiting:
        one = waiting.pop()
        if isinstance(one, str):
            if len(one) > LONGEST_TEXT:
                yield f"a text has {len(one):,} characters, more than {LONGEST_TEXT:,}"
            elif any(ord(char) < 32 or 0xD800 <= ord(char) <= 0xDFFF for char in one):
                yield f"a text holds control characters: {one[:100]!r}"
        elif isinstance(one, dict):
            waiting.extend(one.values())
            odd = [key for key in one if len(key) > LONGEST_NAME or not key.isprintable()]
            yield from (f"{key[:100]!r} is no name" for key in odd)
        elif isinstance(one, list):
            waiting.extend(one)


def _checked_sources(raw: Json) -> dict[str, Json]:
    if not isinstance(raw, dict):
        raise AnswerFault(["_sources must be an object: names of states and operations, and lists"])
    found: dict[str, Json] = {}
    for key, sources in raw.items():
        if not isinstance(sources, list) or len(sources) > 10:
            raise AnswerFault([f"_sources/{key[:100]} must be a list of at most 10 citations"])
        found[key] = [fitted(Source, one).citation.as_json() for one in sources]
    return found


def _uncited(values: Mapping[str, Json], texts: Sequence[ExpertText]) -> list[str]:
    found = []
    for name, branch in _branches(values).items():
        for key, sources in branch["_sources"].items():
            faults = uncited_faults(map(Source.model_validate, sources), texts)
            found += [f"{name}/{key}: {words}" for words in faults]
    return found


def uncited_faults(sources: Iterable[Source], texts: Sequence[ExpertText]) -> Iterator[str]:
    """Yield a sentence for each citation of words that do not stand where it says."""
    for source in sources:
        if not cited(texts, source.citation):
            yield f"the words do not stand there: {source.citation}{_where(source, texts)}"


def _where(source: Source, texts: Sequence[ExpertText]) -> str:
    """Return where the words of a citation stand in its file, in words."""
    lines = [line for text in texts for line in text.lines if line.file == source.file]
    if not lines:
        return f" (no text is called {source.file})"
    found = next((line for line in lines if source.words in line.text), None)
    if found is not None:
        page = f"page {found.page}, " if found.page else ""
        return f" (they stand in {page}line {found.number})"
    last = max(line.number for line in lines)
    return f" (the last line is {last})" if source.line > last else ""
