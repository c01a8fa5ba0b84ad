"""Errors for values that cannot be part of a blueprint: an SB, HEADER, state or target of the wrong
kind.

One error has all of a document, each with its place and an advice. If the intention is clear, it
also has a repair of the text.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from smsl_studio.errors import ReadError, TextFix
from smsl_studio.smsl.document import Document, Member, Path
from smsl_studio.smsl.document.limits import MAX_FAULTS, MAX_NAME, TOO_MANY_BRANCHES

Json = Any
ONE_TOO_MANY = "one of fewer State Branches"
A_BRANCH, A_STATE, A_TARGET, A_NAME = "a State Branch", "a state", "a target", "a name"
_BY_DEPTH = ("a State Branch", "a state", "an operation")


def refused(document: Document, wrong: Sequence[tuple[Path, str, Json]]) -> ReadError:
    """Return one error for all wrong values: the place, the kind that should stand there, and the
    value.
    """
    errors = [_error(document, *one) for one in wrong[:MAX_FAULTS]]
    return ReadError.of(sorted(errors, key=lambda error: error.place or document.place(())))


def _error(document: Document, path: Path, what: str, value: Json) -> ReadError:
    sentence, advice = _words(path, what, value)
    try:
        member = document.member(path)
    except KeyError:
        return ReadError(sentence, document.place(path), advice)
    fix = None
    if what == A_TARGET and path[-1]:
        if _is_header(path[-2]):
            fix = _renamed(document, document.member(path[:-1]), "HEADER")
        elif document.form == "json":
            fix = _in_quotes(document.text[member.value_start : member.value_end], value, member)
    elif what in (A_BRANCH, A_STATE) and path[-1]:
        fix = _renamed(document, member, "HEADER" if _is_header(path[-1]) else f"_{path[-1]}")
    length = max(1, member.key_end - member.key_start)
    return ReadError(sentence, document.place_at(member.key_start), advice, length=length, fix=fix)


def _is_header(name: str) -> bool:
    """Return whether a name is HEADER in another spelling."""
    return name.strip().casefold() == "header"


def _words(path: Path, what: str, value: Json) -> tuple[str, str]:
    """Return the sentence and the advice."""
    name = path[-1]
    if what == ONE_TOO_MANY:
        return TOO_MANY_BRANCHES
    if what == A_NAME:
        element = _BY_DEPTH[len(path) - 1]
        if not name:
            return f"{element} has no name", "Give it a name."
        sentence = f"the name of {element} has {len(name):,} characters"
        return sentence, f"Give it a shorter name: {MAX_NAME:,} characters are the most."
    if what == A_TARGET:
        sentence = f"the target of {name!r} is {kind_of(value)}, not the name of a state"
        if _is_header(path[-2]):
            return sentence, f"Did you mean HEADER? {path[-2]} is read as a state."
        return sentence, 'Write the operation as "Operation": "TargetState".'
    sentence = f"{name!r} is {kind_of(value)}, not {what}"
    if what == A_STATE and _is_header(name):
        return sentence, "Did you mean HEADER?"
    return sentence, f"Write {what} as {{ ... }}, or start the name with _ to have it skipped."


def _in_quotes(written: str, value: Json, member: Member) -> TextFix | None:
    """Return the repair of a number, true or false that was meant as the name of a state."""
    if not isinstance(value, bool | int | float):
        return None
    return TextFix(f'Write "{written}"', member.value_start, member.value_end, f'"{written}"')


def _renamed(document: Document, member: Member, new: str) -> TextFix | None:
    """Return the repair that renames a key and keeps its quotes. None if it is written in an
    unusual way.
    """
    start, end = member.key_start, member.key_end
    written = document.text[start:end]
    quote = written[:1] if written[:1] in ("'", '"') else ""
    if written != f"{quote}{member.key}{quote}":
        return None
    return TextFix(f"Write {new}", start, end, f"{quote}{new}{quote}")


def kind_of(value: Json) -> str:
    """Return the kind of a value in words, such as ``a text``, ``a list`` or ``null``."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    kinds = {str: "a text", int: "a number", float: "a number", list: "a list", dict: "a map"}
    return kinds.get(type(value), "something else")
