"""Edits a document in any form: it gets other values, and only the differences are changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.smsl.document import Document, Path
from smsl_studio.smsl.forms import form_named

Json = Any


def reconcile(document: Document, values: Mapping[str, Json]) -> Document:
    """Return a document with ``values``. Its text is changed only at the elements that differ."""
    return form_named(document.form).reconcile(document, values)


def keep_winner(document: Document, path: Path) -> Document:
    """Return the document with the doubled key at ``path`` written once.

    The last member counts. It takes the place of the first, because order has meaning: the values
    and their order stay the same. KeyError if there is no such key.
    """
    return form_named(document.form).keep_winner(document, path)
