"""Detects a text in another form under a native name."""

from __future__ import annotations

from pathlib import PurePath

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import WORDS, Document
from smsl_studio.smsl.json_form.refusals import other_form
from smsl_studio.smsl.native_form.spans import NativeSpans
from smsl_studio.smsl.native_form.tokens import content_start


def form_within(text: str) -> str:
    """Return the other form in which a text clearly is, or the empty text."""
    form = other_form(text)
    if form == "smsl":
        return ""
    inner = text[content_start(text) :]
    if inner.startswith("{") and inner[1:].lstrip().startswith('"'):
        return "json"
    return form


def misnamed(text: str, file: str) -> ReadError | None:
    """Return the one fault of a text that is in another form. None if it is in no other form."""
    form = form_within(text)
    if not form:
        return None
    blank = Document(text, file, "smsl", {}, NativeSpans)
    return ReadError(
        f"this is {WORDS[form]}, not native {WORDS['smsl']}",
        blank.place_at(content_start(text)),
        f"Name it {PurePath(file).stem}.{form}, or write it in the native form.",
    )
