"""The written forms, and the form of a text.

A form is a package with the functions of ``Form``. It is loaded when it is first needed.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, Protocol

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.document import Document, Path

if TYPE_CHECKING:
    from smsl_studio.smsl.document.comments import Comments

Json = Any

SUFFIXES = {".json": "json", ".smsl": "smsl", ".yaml": "yaml", ".yml": "yaml"}
HOLD_COMMENTS = ("smsl", "yaml")
"""The forms with comments."""


class Form(Protocol):
    """The functions of every form."""

    def parse(self, text: str, file: str) -> Document:
        """Read a text. ReadError, with all its faults, if it is not in this form."""

    def recover(self, text: str, file: str) -> Document:
        """Return a new document with everything that could be read of a faulty text."""

    def form_within(self, text: str) -> str:
        """Return the other form in which a faulty text clearly is, or the empty text."""

    def write(self, values: Mapping[str, Json], comments: Comments | None = None) -> str:
        """Return values as a new text in the canonical layout. ConvertError if the form cannot
        express them.

        Comments are written with their elements if the form has comments (see ``HOLD_COMMENTS``).
        """

    def comments_in(self, document: Document) -> Comments:
        """Return the comments of a document with their elements."""

    def reconcile(self, document: Document, values: Mapping[str, Json]) -> Document:
        """Return a document with ``values`` (see ``splice``)."""

    def keep_winner(self, document: Document, path: Path) -> Document:
        """Return the document with a doubled key written once (see ``splice``)."""

    def tidy(self, document: Document) -> Document:
        """Return the document in the canonical layout, with its comments, ``_`` fields and
        order.
        """


def form_of(file: str, text: str) -> str:
    """Return the name of the form of a file, by its suffix, else by the beginning of the text."""
    suffix = PurePath(file).suffix.lower()
    return SUFFIXES.get(suffix) or _looks_like(text)


def form_named(name: str) -> Form:
    """Return the functions of a form. KeyError for an unknown name."""
    if name == "json":
        from smsl_studio.smsl import json_form

        return json_form
    if name == "smsl":
        from smsl_studio.smsl import native_form

        return native_form
    if name == "yaml":
        from smsl_studio.smsl import yaml_form

        return yaml_form
    raise KeyError(name)


def recovered(text: str, file: str) -> Document:
    """Return a new document with everything that could be read of a faulty text.

    If the text is clearly in another form than its name says, it is read in that form.
    """
    own = form_named(form_of(file, text))
    other = own.form_within(text)
    if other:
        try:
            return own.parse(own.write(form_named(other).recover(text, file).values), file)
        except (ConvertError, ValueError):
            pass  # This form cannot express a part of it.
    return own.recover(text, file)


_NATIVE = re.compile(r"(?:\s|//[^\n]*(?:\n|$))*(?:,\s*)?(?:#|\{\s*(?:#|//|[^\s\"}]))")
_JSON = re.compile(r"\s*(?:[\[\{]|$)")


def _looks_like(text: str) -> str:
    text = text.removeprefix("\ufeff")
    if text.lstrip().startswith("//") or _NATIVE.match(text):
        return "smsl"
    return "json" if _JSON.match(text) else "yaml"
