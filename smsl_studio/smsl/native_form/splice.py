"""Edits a native text: it gets other values, and only the differences are changed.

It works row by row, as the JSON form does (see ``arrangement``). Equal elements keep every
character. A renaming replaces the name. New elements get the layout of their neighbours. Comments
stay, except those inside a removed element and on its line. A state or edge whose name begins with
``_`` becomes a ``# _KEY`` line if its value changes.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.document.pieces import Piece, spliced
from smsl_studio.smsl.native_form.branches import BranchSplice
from smsl_studio.smsl.native_form.elements import ElementShapes
from smsl_studio.smsl.native_form.members import Map, MemberSplicer
from smsl_studio.smsl.native_form.parser import parse
from smsl_studio.smsl.native_form.rows import ElementRow, RowFrame, Slot
from smsl_studio.smsl.native_form.spans import NativeSpans
from smsl_studio.smsl.native_form.spellings import must_be_map

Json = Any


def reconcile(document: Document, values: Mapping[str, Json]) -> Document:
    """Return a document with ``values``. Its text is changed only at the elements that differ.

    ConvertError if the native form cannot express them. An empty HEADER is left out, because it
    means the same as none. If only the contents of SBs differ, the new document gets its places
    from the former one.
    """
    if same(document.values, values):
        return document
    splicer = _FileSplicer(document)
    text, merged = splicer.file(dict(document.values), dict(values))
    if text == document.text:
        return document
    if document.doubled:
        return parse(text, document.file)
    after = replace(document, text=text, values=merged)
    if splicer.shapes is not None:
        # This is where the ``cached_property`` would keep them.
        after.__dict__["spans"] = NativeSpans(text, splicer.shapes)
    return after


class _FileSplicer(MemberSplicer):
    """Writes the SBs and fields of one document anew.

    ``shapes`` are the elements of the new text if they are known.
    """

    shapes: ElementShapes | None = None

    def file(self, old: Map, new: Map) -> tuple[str, Map]:
        """Return the text for the new values, and the values in the order of the text."""
        if list(old) == list(new) and len(old) == len(self.spans.elements):
            changed = {key for key in new if not same(old[key], new[key])}
            if not any(key.startswith("_") for key in changed):
                return self._some(changed, old, new)
        text = self.text
        start = 1 if text.startswith("\ufeff") else 0
        elements, newline = self.spans.elements, self.newline
        row = ElementRow(RowFrame(text, start, len(text), elements, newline, outermost=True))
        if row.commas is None:
            row.commas = self.style.branch_commas

        def fresh(key: str, value: Json, indent: str) -> str:
            """Return the text of a new member of the file: a ``_`` field or an SB."""
            if key.startswith("_"):
                return self.style.field(key, value)
            return self.style.branch(key, value, indent)

        merged = self.members(row, list(row.slots), (old, new), "", self._branch_value, fresh)
        merged = {
            key: value if key[:1] == "_" else _as_read(value) for key, value in merged.items()
        }
        return text[:start] + row.whole("", None), merged

    def _some(self, changed: Collection[str], old: Map, new: Map) -> tuple[str, Map]:
        """Return the same if only some SBs differ, and all SBs keep their names and places."""
        shapes, pieces, found = self.spans.shapes, list[Piece](), list[tuple[int, BranchSplice]]()
        merged = dict(old)
        for index, key in enumerate(old):
            if key in changed:
                branch = self._branch(index, key, old[key], new[key])
                merged[key] = _as_read(branch.values)
                pieces += branch.pieces
                found.append((index, branch))
        text = spliced(self.text, pieces)
        grown, patches = 0, []
        for index, branch in found:
            former = shapes.shapes[index]
            now = branch.shape_after(text, grown, former)
            patches.append((index, index + 1, ElementShapes([now], [now.before + now.length])))
            grown += now.length - former.length
        self.shapes = shapes.patched(patches)
        return text, merged

    def _branch(self, index: int, name: str, old: Json, new: Json) -> BranchSplice:
        must_be_map((name,), new, "a State Branch")
        element, inner = self.spans.elements[index], self.spans.shapes.shapes[index].inner
        assert inner is not None, "an SB has elements"
        return BranchSplice(self, element, inner, name, (old, new))

    def _branch_value(self, slot: Slot, old: Json, new: Json) -> Json:
        element = slot.element
        assert element is not None
        if slot.key.startswith("_"):
            return self.field_value(slot, old, new)
        branch = self._branch(self._indices[element.start], slot.key, old, new)
        slot.text = spliced(self.text, branch.pieces, element.start, element.end)
        return branch.values

    @cached_property
    def _indices(self) -> dict[int, int]:
        """The indices of the elements of the file, by their offsets."""
        return {element.start: index for index, element in enumerate(self.spans.elements)}


def _as_read(branch: Map) -> Map:
    """Return a branch as it is read from a text: HEADER comes first, and an empty one is left
    out.
    """
    if "HEADER" not in branch or (branch["HEADER"] and next(iter(branch)) == "HEADER"):
        return branch
    rest = {key: value for key, value in branch.items() if key != "HEADER"}
    return {"HEADER": branch["HEADER"], **rest} if branch["HEADER"] else rest
