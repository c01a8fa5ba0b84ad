"""Tells whether what stands in the form would hold, before it is written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from PySide6.QtCore import QObject

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.claim_rows import ClaimRow, answered
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.inspector import LIMIT
from smsl_studio.studio.features.inspection.claim_entry import (
    PROPERTIES,
    ClaimEntry,
    ClaimPlace,
    put_entry,
)
from smsl_studio.studio.features.inspection.run_view import BAD_END

NAMELESS = "\N{ZERO WIDTH SPACE}"
"""The name of an entry that has none yet. Nobody types it."""


class ClaimPreview(QObject):
    """Answers an entry of the form in a second thread. A further question ends the one before."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._beside = Beside(self)

    def look(
        self,
        blueprint: Blueprint,
        entry: ClaimEntry,
        where: tuple[ClaimPlace | None, str],
        then: Callable[[ClaimRow | None], object],
    ) -> None:
        """Answer an entry as if it was written. ``where`` is its place, None if it is new, and the
        file for a new one. ``then`` gets its row, None if it cannot be written so."""
        self._beside.drop()
        self._beside.do(partial(previewed, blueprint, entry, *where), then)

    def drop(self) -> None:
        """Forget the present question."""
        self._beside.drop()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()


def previewed(
    blueprint: Blueprint, entry: ClaimEntry, place: ClaimPlace | None, file: str
) -> ClaimRow | None:
    """Return the row of an entry as if it was written, None if it cannot be. Other properties are
    not answered. The worker thread calls this."""
    named = entry if entry.name.strip() else replace(entry, name=NAMELESS)
    try:
        drawn = put_entry(blueprint, named, place, file)
        for document in drawn.documents:
            written = document.values.get(PROPERTIES)
            if not isinstance(written, list):
                continue
            own = document.file == (place.file if place is not None else file)
            kept = [
                one
                for one in written
                if own and named.key == PROPERTIES and _name(one) == named.name.strip()
            ]
            drawn = editing.set_properties(drawn, kept, document.file)
        rows = answered(drawn, LIMIT).rows
    except (StudioError, ValueError):
        return None
    address = Address(named.key, named.name.strip())
    return next((row for row in rows if row.address == address), None)


def preview_words(row: ClaimRow) -> str:
    """What is known about an entry that is not written yet, in a few words."""
    if row.verdict == HOLDS:
        return f"Holds as drawn now: {row.looked_at}."
    if row.verdict != FAILS:
        return f"Not known as drawn now: {row.looked_at}."
    if row.kind not in BAD_END or row.run is None:
        return f"Fails as drawn now: {row.looked_at}."
    many = len(row.run.path)
    when = f"after {counted(many, 'operation')}" if many else "at the start"
    return f"Fails as drawn now, {when}."


def _name(entry: object) -> str:
    name = entry.get("name") if isinstance(entry, dict) else None
    return name if isinstance(name, str) else ""
