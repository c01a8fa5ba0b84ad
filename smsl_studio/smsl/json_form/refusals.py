"""The errors of a text that is not in the JSON form: all faults with places, or the form that it
has.
"""

from __future__ import annotations

import re
from pathlib import PurePath

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import WORDS, Document
from smsl_studio.smsl.json_form.recovery import Recovery
from smsl_studio.smsl.json_form.spans import JsonSpans, skip_space

_HEADER_LINE = re.compile(r"^[ \t]*#[ \t]*(?:NAME|INITIAL|ACTIVATING|NUM_\w+|SUB_SBS)[ \t]*:", re.M)
_NATIVE_STATE = re.compile(
    r"(?:\s|//[^\n]*(?:\n|\Z)|,)*"
    r"\{\s*[^\s\"{}\[\]:,#]+[ \t]*:[ \t]*\[\s*(?:\]|[^\s\"{}\[\]:,#]+[ \t]*->)"
)
_YAML = re.compile(
    r"(?:[ \t]*(?:#[^\n]*)?\n)*(?:---|%YAML|[^\s\"{}\[\],:#/][^\n\"{}\[\]]*:(?:\s|$))"
)


def refusal(text: str, file: str) -> ReadError:
    """Return the error for a text that could not be read as JSON."""
    blank = Document(text, file, "json", {}, JsonSpans)
    start = skip_space(text, 1 if text.startswith("\ufeff") else 0)
    if start == len(text):
        sentence, advice = "the file is empty", "An empty blueprint is written {}."
        return ReadError(sentence, blank.place_at(start), advice)
    form = other_form(text)
    if form:
        suffix = f".{form}"
        return ReadError(
            f"this is {_FULL[form]}, not JSON",
            blank.place_at(start),
            f"Name it {PurePath(file).stem}{suffix}, or write it as JSON.",
        )
    faults = [
        ReadError(
            fault.sentence,
            blank.place_at(fault.at),
            fault.advice,
            length=fault.length,
            fix=fault.fix,
        )
        for fault in Recovery(text).faults
    ]
    if not faults:
        return ReadError("this is no valid JSON", blank.place_at(start), "Check its spelling.")
    return ReadError.of(faults)


_FULL = {"smsl": f"native {WORDS['smsl']}", "yaml": WORDS["yaml"]}


def other_form(text: str) -> str:
    """Return the other form in which a text clearly is, or the empty text."""
    text = text.removeprefix("\ufeff")
    if _HEADER_LINE.search(text) or _NATIVE_STATE.match(text):
        return "smsl"
    return "yaml" if _YAML.match(text) else ""
