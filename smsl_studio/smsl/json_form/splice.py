"""Edits a JSON text: it gets other values, and only the differences are changed.

It works object by object. ``_`` keys and an SB's HEADER keep their slots. Other keys follow the
order of the new values, except in a HEADER, where order has no meaning. A removed key and a new key
in the same gap are a renaming: the key is replaced, and its value is compared. Equal elements keep
every character. New elements get the separators and the indentation of their neighbours.

A doubled key stays doubled, and only its last value, which counts, is changed. If it is removed,
renamed or moved, all its occurrences are.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.smsl.document import Document, Member
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.document.pieces import spliced
from smsl_studio.smsl.json_form.containers import Splicer
from smsl_studio.smsl.json_form.reader import parse
from smsl_studio.smsl.json_form.spans import JsonSpans
from smsl_studio.smsl.json_form.style import JsonStyle

Json = Any


def reconcile(document: Document, values: Mapping[str, Json]) -> Document:
    """Return a document with ``values``. Its text is changed only at the elements that differ.

    It gets the places of its long objects from the former document, so they are not searched again.
    """
    if same(document.values, values):
        return document
    splicer = Splicer(document)
    written = splicer.container((), splicer.spans.root, dict(document.values), dict(values))
    changed = spliced(document.text, written.pieces)
    if changed == document.text:
        return document
    if document.doubled:
        return parse(changed, document.file)
    after = Document(changed, document.file, document.form, written.values, JsonSpans)
    # This is where the ``cached_property`` would keep them.
    after.__dict__["spans"] = JsonSpans(changed, splicer.rows_after())
    return after


def keep_winner(document: Document, path: tuple[str, ...]) -> Document:
    """Return the document with the doubled key at ``path`` written once.

    The last member counts. It takes the place of the first, because order has meaning: the values
    and their order stay the same. KeyError if there is no such key.
    """
    return parse(winner_kept(document.text, path), document.file)


def winner_kept(text: str, path: tuple[str, ...]) -> str:
    """Return a JSON text with the doubled key at ``path`` written once (see ``keep_winner``)."""
    members = JsonSpans(text).members(path[:-1])
    same_key = [index for index, member in enumerate(members) if member.key == path[-1]]
    if not same_key:
        raise KeyError(path)
    first, winner = members[same_key[0]], members[same_key[-1]]
    winning = text[winner.key_start : winner.value_end]
    for index in reversed(same_key[1:]):
        start, end = members[index - 1].value_end, members[index].value_end
        text = text[:start] + text[end:]
    return text[: first.key_start] + winning + text[first.value_end :]


def spliced_value(text: str, old: Json, new: Json) -> str:
    """Return the text of one JSON value on one line, changed only where it differs from the old
    value.
    """
    colon = ":" if '":' in text and '": ' not in text else ": "
    style = JsonStyle(unit="", colon=colon, comma="," if colon == ":" else ", ", inline_from=0)
    splicer = Splicer(Document(text, "", "json", {}, JsonSpans), style)
    # The path is below an SB, where HEADER has no meaning.
    changed = splicer.change(("", "", ""), Member("", 0, 0, 0, len(text)), old, new, "")
    return text if changed is None else spliced(text, changed.pieces)
