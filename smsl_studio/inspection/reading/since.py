"""The section "What changed": what was removed, changed and added since a former version."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.difference import Change, ChangeKind, Difference
from smsl_studio.inspection.reading.plain_names import PlainNames
from smsl_studio.inspection.reading.sections import ReadingLine, ReadingSection

_ORDER = (
    ChangeKind.REMOVED,
    ChangeKind.RETARGETED,
    ChangeKind.CHANGED,
    ChangeKind.RENAMED,
    ChangeKind.ADDED,
)
_WORDS = {
    ChangeKind.REMOVED: "Removed",
    ChangeKind.RETARGETED: "Leads elsewhere",
    ChangeKind.CHANGED: "Changed",
    ChangeKind.RENAMED: "Renamed",
    ChangeKind.ADDED: "Added",
}
_KINDS = {
    "branch": "a whole part of the procedure",
    "state": "the situation",
    "operation": "the step",
    "header": "how a part begins, ends or is divided",
    "fact": "a fact",
    "note": "what is known of",
    "hazard": "the hazard",
    "property": "what must hold",
    "level": "who does or supervises",
    "import": "a file that belongs to it",
    "field": "a note of the file",
    "order": "the order of its parts",
}
_FIELDS = {
    "title": "its title",
    "note": "its note",
    "safe": "whether the procedure may rest there",
    "cost": "its cost",
    "risk": "its risk",
    "actor": "who carries it out",
    "confirm": "who must agree",
    "forecast": "what a forecast of it does that differs",
    "duration": "how long it takes",
    "timeout": "its time limit",
    "stop": "what a pause does to it",
    "resumes": "whether it goes on after a pause",
    "repeatable": "whether it may be tried again",
    "requires": "what must hold before it begins",
    "subs": "how its sub-procedure is brought about",
    "binding": "the function that carries it out",
    "question": "the question",
    "roles": "who is asked",
    "answer_within": "the time for an answer",
    "escalates_to": "who may answer in place of others",
    "name": "its name",
    "values": "what its values mean",
    "on": "the value that counts as on",
    "failure": "which values are failures",
    "critical": "whether it is critical",
    "sensors": "its sensors",
    "unit": "its unit",
    "sources": "what measures it",
    "predicate": "how it is measured",
    "range": "what its sources can measure",
    "log_rate": "how often the log keeps what its sources measure",
    "aggregation": "how its sensors become one value",
    "k": "how many sensors must agree",
    "max_age": "the age after which it is unknown",
    "conflict_after": "how long its sensors may disagree",
    "touches": "what is unknown after it was broken off",
    "facts": "its facts",
}


def since(names: PlainNames, difference: Difference, former: str) -> ReadingSection:
    """Return the changes since ``former``, removals first."""
    own = PlainNames(difference.before), names
    changes = sorted(difference.changes, key=lambda one: _ORDER.index(one.kind))
    lines = tuple(_line(own, one) for one in changes)
    lead = f"Compared with {former}." if lines else f"Nothing has changed since {former}."
    return ReadingSection("since", "What changed", lines, lead)


def _line(own: tuple[PlainNames, PlainNames], change: Change) -> ReadingLine:
    at = change.address
    kind = _KINDS.get(change.what, "a part")
    named = " ".join(_named(own, change))
    return ReadingLine(
        f"{_WORDS[change.kind]}: {kind}{f' {named}' if named else ''}",
        tuple(_text(own, change)),
        about=(at,) if at is not None else (),
    )


def _named(own: tuple[PlainNames, PlainNames], change: Change) -> Iterator[str]:
    """Yield the element in words. One that is gone has the title of the former version."""
    before, now = own
    names = now if change.after is not None else before
    at = change.address
    if change.what in ("hazard", "property"):
        yield f"“{at.state if at is not None and at.state else change.field}”"
    elif at is None:
        return
    elif at.operation:
        yield _operation(names, at)
    elif at.state and at.branch in names.blueprint.branches:
        branch = names.blueprint[at.branch]
        if at.state in branch.table:
            yield names.state(branch, at.state)
    elif change.what in ("branch", "header", "fact"):
        yield f"({at.branch})"


def _operation(names: PlainNames, at: Address) -> str:
    branch = names.blueprint.branches.get(at.branch)
    title = names.quoted(at)
    if branch is None or at.state not in branch.table:
        return title
    return f"{title} while {names.state(branch, at.state)}"


def _text(own: tuple[PlainNames, PlainNames], change: Change) -> Iterator[str]:
    before, now = own
    at = change.address
    if change.kind is ChangeKind.RETARGETED and at is not None:
        old, new = str(change.old), str(change.new)
        one, other = before.blueprint.branches.get(at.branch), now.blueprint.branches.get(at.branch)
        if one is not None and other is not None and old in one.table and new in other.table:
            yield f"It led to {before.state(one, old)}."
            yield f"It leads to {now.state(other, new)}."
        return
    word = _FIELDS.get(change.field, "")
    if change.kind is ChangeKind.CHANGED and word:
        yield f"Changed is {word}: it was {_value(change.old)}, and it is {_value(change.new)}."
    elif change.kind is not ChangeKind.RENAMED and change.what not in ("state", "operation"):
        yield f"{change.words[:1].upper()}{change.words[1:]}."


def _value(value: object) -> str:
    if value is None or value in ("", [], {}):
        return "not written"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list | tuple):
        return ", ".join(str(one) for one in value)
    if isinstance(value, dict):
        return ", ".join(f"{key}: {one}" for key, one in value.items())
    return str(value)
