"""Editing a JSON text: it gets other values, and only what differs is changed.

Object by object: ``_`` keys and a branch's HEADER keep their slot, other keys follow the order of
the new values (but for those in a HEADER, whose order means nothing). A key that goes and one that
comes in the same gap are a rename: the key is spliced, then its value is reconciled. What is equal
keeps its text to the character, and what is new takes the separators and indentation of its
neighbours.

A key that is written twice stays written twice: its last, winning value is the one that changes;
where it is removed, renamed or moved all its occurrences are.
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
    """A document that reads to ``values``, its text changed only at the elements that differ.

    It knows where its long objects stand from the former document, and does not look for them.
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
    # Kept there as the ``cached_property`` itself would keep them.
    after.__dict__["spans"] = JsonSpans(changed, splicer.rows_after())
    return after


def keep_winner(document: Document, path: tuple[str, ...]) -> Document:
    """The document with the doubled key at ``path`` written once.

    The last, winning member takes the place of the first, because order has meaning: the
    document reads to the same values in the same order. KeyError where no such key stands.
    """
    return parse(winner_kept(document.text, path), document.file)


def winner_kept(text: str, path: tuple[str, ...]) -> str:
    """A JSON text with the doubled key at ``path`` written once; see ``keep_winner``."""
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
    """The text of one JSON value on one line, changed only where it differs from the old one."""
    colon = ":" if '":' in text and '": ' not in text else ": "
    style = JsonStyle(unit="", colon=colon, comma="," if colon == ":" else ", ", inline_from=0)
    splicer = Splicer(Document(text, "", "json", {}, JsonSpans), style)
    # Somewhere below an SB, where no member is called HEADER.
    changed = splicer.change(("", "", ""), Member("", 0, 0, 0, len(text)), old, new, "")
    return text if changed is None else spliced(text, changed.pieces)
