"""The written forms, and which one a text is in.

A form is a package whose functions are its doors; one that is not needed is not loaded.
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
"""The forms that have comments."""


class Form(Protocol):
    """The functions that every form has."""

    def parse(self, text: str, file: str) -> Document:
        """Read a text; ReadError (with all its faults) where it is not in this form."""

    def recover(self, text: str, file: str) -> Document:
        """A document of its own with everything that could be read of a faulty text."""

    def form_within(self, text: str) -> str:
        """The other form in which a faulty text clearly is; the empty text where it is in none."""

    def write(self, values: Mapping[str, Json], comments: Comments | None = None) -> str:
        """Values as a new text in the canonical layout; ConvertError for what has no spelling.

        Comments stand with what they belong to, where the form has any (see ``HOLD_COMMENTS``).
        """

    def comments_in(self, document: Document) -> Comments:
        """The comments of a document, by what they belong to."""

    def reconcile(self, document: Document, values: Mapping[str, Json]) -> Document:
        """A document that reads to ``values``; see ``splice``."""

    def keep_winner(self, document: Document, path: Path) -> Document:
        """The document with a doubled key written once; see ``splice``."""

    def tidy(self, document: Document) -> Document:
        """The document in the canonical layout: comments, ``_`` fields and order kept."""


def form_of(file: str, text: str) -> str:
    """The name of the form of a file: by its suffix, else by how the text begins."""
    suffix = PurePath(file).suffix.lower()
    return SUFFIXES.get(suffix) or _looks_like(text)


def form_named(name: str) -> Form:
    """The functions of a form; KeyError for a name that no form has."""
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
    """A document of its own with everything that could be read of a faulty text.

    Where the text is clearly in another form than its name says, it is what can be read there.
    """
    own = form_named(form_of(file, text))
    other = own.form_within(text)
    if other:
        try:
            return own.parse(own.write(form_named(other).recover(text, file).values), file)
        except (ConvertError, ValueError):
            pass  # There is something in it that has no spelling here.
    return own.recover(text, file)


_NATIVE = re.compile(r"(?:\s|//[^\n]*(?:\n|$))*(?:,\s*)?(?:#|\{\s*(?:#|//|[^\s\"}]))")
_JSON = re.compile(r"\s*(?:[\[\{]|$)")


def _looks_like(text: str) -> str:
    text = text.removeprefix("\ufeff")
    if text.lstrip().startswith("//") or _NATIVE.match(text):
        return "smsl"
    return "json" if _JSON.match(text) else "yaml"
