"""Editing a document in any form: it gets other values, and only what differs is changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.smsl.document import Document, Path
from smsl_studio.smsl.forms import form_named

Json = Any


def reconcile(document: Document, values: Mapping[str, Json]) -> Document:
    """A document that reads to ``values``, its text changed only at the elements that differ."""
    return form_named(document.form).reconcile(document, values)


def keep_winner(document: Document, path: Path) -> Document:
    """The document with the doubled key at ``path`` written once.

    The last, winning member takes the place of the first, because order has meaning: the
    document reads to the same values in the same order. KeyError where no such key stands.
    """
    return form_named(document.form).keep_winner(document, path)
