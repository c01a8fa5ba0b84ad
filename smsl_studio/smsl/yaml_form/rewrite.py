"""Edits of a YAML text: it is written anew as a whole, with the comments of the remaining
elements.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.errors import EditRefused, ReadError
from smsl_studio.smsl.document import Document, Path
from smsl_studio.smsl.document.comments import NO_COMMENTS, Comments
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.yaml_form.comments import comments_of
from smsl_studio.smsl.yaml_form.faults import shown
from smsl_studio.smsl.yaml_form.nodes import Tree
from smsl_studio.smsl.yaml_form.reader import parse
from smsl_studio.smsl.yaml_form.spans import YamlSpans
from smsl_studio.smsl.yaml_form.writer import write

Json = Any


def reconcile(document: Document, values: Mapping[str, Json]) -> Document:
    """Return a document with ``values`` (see ``splice``).

    EditRefused if a key is doubled, because the values that the graph does not show would be lost.
    """
    if same(document.values, values):
        return document
    kept = comments_in(document) if "#" in document.text else NO_COMMENTS
    if len(kept):
        kept = kept.moved(_Renamed(document.values, values).path)
    return _written(document, values, kept)


def keep_winner(document: Document, path: Path) -> Document:
    """Return the document with the doubled key at ``path`` written once (see ``splice``).

    The text is cut and joined, so other doubled keys stay as they are. KeyError if there is no such
    key. EditRefused if the rest would be read with other values.
    """
    members = document.members(path[:-1])
    places = [index for index, member in enumerate(members) if member.key == path[-1]]
    if not places:
        raise KeyError(path)
    text, winner, first = document.text, members[places[-1]], members[places[0]]
    for index in reversed(places[1:]):
        text = text[: members[index - 1].value_end] + text[members[index].value_end :]
    winning = document.text[winner.key_start : winner.value_end]
    text = text[: first.key_start] + winning + text[first.value_end :]
    try:
        kept = parse(text, document.file)
    except ReadError:
        kept = None
    if kept is None or not same(kept.values, document.values):
        raise EditRefused(
            f"{shown(path[-1])} is written in ways that cannot be made one without you",
            document.place_at(first.key_start),
            "Take all but one of them out of the text.",
        )
    return kept


def tidy(document: Document) -> Document:
    """Return the document in the canonical layout. Comments, ``_`` fields and order stay."""
    return _written(document, document.values, comments_in(document))


def comments_in(document: Document) -> Comments:
    """Return the comments of a text with their elements."""
    return comments_of(_spans(document))


def _written(document: Document, values: Mapping[str, Json], kept: Comments) -> Document:
    if document.doubled:
        path, places = document.duplicates()[0]
        raise EditRefused(
            f"{'/'.join(path)} is written {len(places)} times, and a YAML file is written whole: "
            "what the graph does not show would be lost",
            places[-1],
            "Keep one of them first (the quick fix of R01 keeps the last).",
        )
    text = write(values, kept)
    if document.newline != "\n":
        text = text.replace("\n", document.newline)
    if document.text.startswith("\ufeff"):
        text = "\ufeff" + text
    if text == document.text:
        return document
    values = dict(values)
    return Document(text, document.file, document.form, values, lambda text: YamlSpans(Tree(text)))


def _spans(document: Document) -> YamlSpans:
    spans = document.spans
    assert isinstance(spans, YamlSpans), "a YAML document has the spans of YAML"
    return spans


class _Renamed:
    """Finds the new path of an element from its path in the old values.

    In one map, if the same number of keys was removed and added, they are renamings in their order.
    """

    def __init__(self, old: Mapping[str, Json], new: Mapping[str, Json]) -> None:
        self._known: dict[Path, tuple[Path, Json, Json] | None] = {(): ((), old, new)}

    def path(self, path: Path) -> Path | None:
        """Return the new path, None if the element is removed."""
        found = self._at(path)
        return found[0] if found else None

    def _at(self, path: Path) -> tuple[Path, Json, Json] | None:
        if path not in self._known:
            above = self._at(path[:-1])
            self._known[path] = None
            if above is not None:
                self._list_below(path[:-1], *above)
        return self._known[path]

    def _list_below(self, path: Path, now: Path, old: Json, new: Json) -> None:
        if isinstance(old, Mapping) and isinstance(new, Mapping):
            went = [str(key) for key in old if key not in new]
            came = [str(key) for key in new if key not in old]
            other = dict(zip(went, came, strict=True)) if len(went) == len(came) else {}
            for key, value in old.items():
                kept = str(other.get(key, key))
                found = ((*now, kept), value, new[kept]) if kept in new else None
                self._known[(*path, key)] = found
        elif isinstance(old, list) and isinstance(new, list):
            for index, value in enumerate(old):
                place = str(index)
                found = ((*now, place), value, new[index]) if index < len(new) else None
                self._known[(*path, place)] = found
