"""A text under the name of a native one that is clearly in another form."""

from __future__ import annotations

from pathlib import PurePath

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import WORDS, Document
from smsl_studio.smsl.json_form.refusals import other_form
from smsl_studio.smsl.native_form.spans import NativeSpans
from smsl_studio.smsl.native_form.tokens import content_start


def form_within(text: str) -> str:
    """The form that a text which is no native one is clearly in; the empty text for none."""
    form = other_form(text)
    if form == "smsl":
        return ""
    inner = text[content_start(text) :]
    if inner.startswith("{") and inner[1:].lstrip().startswith('"'):
        return "json"
    return form


def misnamed(text: str, file: str) -> ReadError | None:
    """The one thing that is wrong with a text in another form; None where it is in none."""
    form = form_within(text)
    if not form:
        return None
    blank = Document(text, file, "smsl", {}, NativeSpans)
    return ReadError(
        f"this is {WORDS[form]}, not native {WORDS['smsl']}",
        blank.place_at(content_start(text)),
        f"Name it {PurePath(file).stem}.{form}, or write it in the native form.",
    )
