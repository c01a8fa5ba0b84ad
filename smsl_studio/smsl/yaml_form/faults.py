"""Faults of a YAML text: where, what is wrong, what to do. The library's errors are translated."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import yaml

from smsl_studio.errors import ReadError, TextFix
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.limits import MAX_FAULTS


class YamlFault(NamedTuple):
    """One fault, as offsets into the text."""

    start: int
    length: int
    sentence: str
    advice: str
    fix: TextFix | None = None


def as_error(faults: Iterable[YamlFault], document: Document) -> ReadError:
    """Return one error with all faults, in the order of the text. There must be at least one."""
    ordered = sorted(faults, key=lambda fault: fault.start)[:MAX_FAULTS]
    return ReadError.of([_error(fault, document) for fault in ordered])


def _error(fault: YamlFault, document: Document) -> ReadError:
    return ReadError(
        fault.sentence,
        document.place_at(min(fault.start, len(document.text))),
        fault.advice,
        length=max(1, fault.length),
        fix=fault.fix,
    )


def shown(text: str) -> str:
    """Return a text of the file in quotes for a sentence, shortened to 60 characters."""
    return repr(text if len(text) <= 60 else text[:57] + "...")


_WORDS = (
    (
        "mapping values are not allowed",
        "a ':' stands where no name can end",
        "Indent names of one level alike, put texts that hold ': ' in quotes, and write names of "
        "more than 1,000 characters as ? NAME on a line of its own.",
    ),
    (
        "could not find expected ':'",
        "a name without its ':'",
        "Write NAME: VALUE, with a space behind the colon.",
    ),
    (
        "expected ',' or ']'",
        "the list is not closed here, and no ',' parts its elements",
        "Check the commas and the ] of this list.",
    ),
    (
        "expected ',' or '}'",
        "the map is not closed here, and no ',' parts its members",
        "Check the commas and the } of this map.",
    ),
    (
        "node content",
        "a value is missing",
        "Check the commas and brackets around this place.",
    ),
    (
        "expected key",
        "neither a name nor the end of this map stands here",
        "Indent names of one level alike, and put texts that begin with a quote wholly in quotes.",
    ),
    (
        "expected '-' indicator",
        "neither a '-' nor the end of this list stands here",
        "Begin each element with '- ', all indented alike.",
    ),
    (
        "unexpected end of stream",
        "the text ends inside quotes",
        "Close the quotes.",
    ),
    (
        "unexpected document indicator",
        "the document ends inside quotes",
        "Close the quotes.",
    ),
    (
        "unknown escape character",
        "no such escape in double quotes",
        "Write a backslash as \\\\, or use single quotes.",
    ),
    (
        "tab character",
        "a tab cannot indent",
        "Indent with spaces.",
    ),
    (
        "cannot start any token",
        "no value can begin with this character",
        "Put the text in quotes.",
    ),
    (
        "expected <document start>",
        "something stands behind the end of the document",
        "Keep one document in the file.",
    ),
    (
        "incompatible YAML document",
        "this version of YAML is not known",
        "Leave the %YAML line out.",
    ),
    (
        "block sequence entries are not allowed",
        "an element of a list cannot begin here",
        "Write the list below its name, each element on a line that begins with '- '.",
    ),
    (
        "block mapping",
        "a map cannot begin here",
        "Indent names of one level alike.",
    ),
)


def syntax_fault(error: yaml.YAMLError, text: str, shift: int) -> YamlFault:
    """Return the fault at which the library stopped. ``shift`` is the offset at which it began to
    read.
    """
    problem = str(getattr(error, "problem", None) or getattr(error, "reason", None) or error)
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    at = min(mark.index + shift, len(text)) if mark is not None else shift
    if text[at : at + 1] == "\t":
        return YamlFault(
            at,
            1,
            "no valid YAML: a tab cannot indent",
            "Indent with spaces.",
            TextFix("Replace the tab by spaces", at, at + 1, "  "),
        )
    for piece, sentence, advice in _WORDS:
        if piece in problem:
            return YamlFault(at, 1, f"no valid YAML: {sentence}", advice)
    return YamlFault(at, 1, f"no valid YAML: {problem}", "Check the indentation and brackets here.")
