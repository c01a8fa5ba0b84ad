"""ClaimEdits: what is written with the form. Every change is one step of the history."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.claim_rows import ClaimRow
from smsl_studio.studio.document.attempt import try_edit
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.inspection.claim_entry import (
    HAZARDS,
    ClaimEntry,
    ClaimPlace,
    entry_of,
    free_claim_name,
    put_entry,
    without_entry,
    written_at,
)
from smsl_studio.studio.features.inspection.claim_form import ClaimForm
from smsl_studio.studio.features.inspection.claim_preview import ClaimPreview, preview_words

LONGEST = 10_000
"""A condition with more characters is not shown in the form."""


class ClaimEdits(QObject):
    """Fills the form, and carries out what the person wants."""

    ended = Signal(object)
    """Address: the form is left, and this is written; None if nothing is."""

    def __init__(self, session: Session, form: ClaimForm) -> None:
        super().__init__(form)
        self._session, self._form = session, form
        self.open = False
        """Whether the form is shown."""
        self._place: ClaimPlace | None = None
        self._address: Address | None = None
        self.preview = ClaimPreview(self)
        form.typed.connect(self._look)
        form.written.connect(self._write)
        form.left.connect(lambda: self._end(None))
        form.duplicated.connect(self._duplicate)
        form.deleted.connect(self._delete_shown)
        session.blueprint_changed.connect(self._follow)

    def begin(self, claim: ClaimRow | None = None) -> bool:
        """Show a hazard or property in the form, or a new one; False if it is too long for it."""
        blueprint = self._session.blueprint
        if claim is None:
            self.open, self._place, self._address = True, None, None
            self._form.show_entry(blueprint, ClaimEntry(), new=True)
        else:
            place = _place(claim)
            entry = entry_of(claim.kind, written_at(blueprint, place), blueprint)
            if max(len(entry.first), len(entry.second)) > LONGEST:
                return False
            self.open, self._place, self._address = True, place, claim.address
            self._form.show_entry(blueprint, entry, new=False)
        return True

    def holds(self, claim: ClaimRow | None) -> bool:
        """Whether the form stays when a row is chosen: it has typed text, or shows this row."""
        if not self.open:
            return False
        if self._form.changed or self._place is None or claim is None:
            return True
        if claim.address == self._address:
            return True
        self.open = False
        return False

    def drop(self) -> None:
        """Leave the form, because another file was opened."""
        self.open = False
        self.preview.drop()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.preview.stop()

    def take_over(self) -> str:
        """Write what is typed, because a save or another file comes next.

        Returns why that is not possible, as a sentence; empty if nothing is left in the form.
        """
        form, entry = self._form, self._form.entry
        if not self.open or not form.changed or form.is_empty:
            return ""
        fault = entry.fault(self._session.blueprint)
        if fault is None and self._write(entry):
            return ""
        kind = "hazard" if entry.key == HAZARDS else "property"
        named = f" “{entry.name.strip()}”" if entry.name.strip() else ""
        done = "added" if self._place is None else "changed"
        why = fault.sentence if fault is not None else form.fault.text()
        return f"The {kind}{named} in Inspection is not {done} yet: {why}"

    def delete(self, claim: ClaimRow) -> None:
        """Delete a hazard or property."""
        place = _place(claim)
        self._edit(f"Delete “{claim.name}”", lambda bp: without_entry(bp, place))

    def _delete_shown(self) -> None:
        place, name = self._place, self._address.state if self._address else ""
        if place is None:
            return
        if self._edit(f"Delete “{name}”", lambda bp: without_entry(bp, place)):
            self._end(None)

    def _write(self, entry: ClaimEntry) -> bool:
        place, file, name = self._place, self._file, entry.name.strip()
        words = f"{'Add' if place is None else 'Change'} “{name}”"
        if not self._edit(words, lambda bp: put_entry(bp, entry, place, file)):
            return False
        self._end(Address(entry.key, name))
        return True

    def _duplicate(self) -> None:
        place, blueprint = self._place, self._session.blueprint
        if place is None:
            return
        entry = self._form.entry
        name = free_claim_name(blueprint, entry.key, entry.name.strip(), place.file)
        copy = replace(entry, name=name)
        fault = copy.fault(blueprint)
        if fault is not None:
            self._form.refuse(fault.sentence)
        elif self._edit(f"Duplicate “{entry.name}”",
                        lambda bp: put_entry(bp, copy, None, place.file)):  # fmt: skip
            self._end(Address(copy.key, name))

    def _look(self, entry: ClaimEntry | None) -> None:
        """Ask whether what is typed would hold."""
        self.preview.drop()
        if self.open and entry is not None:
            where = self._place, self._file
            self.preview.look(self._session.blueprint, entry, where, self._seen)

    def _seen(self, row: ClaimRow | None) -> None:
        if row is not None and self.open:
            self._form.tell(row.verdict, preview_words(row))

    def _edit(self, words: str, change: Callable[[Blueprint], Blueprint]) -> bool:
        return try_edit(self._session, words, change, self._form.refuse)

    def _end(self, address: Address | None) -> None:
        self.open = False
        self.preview.drop()
        self._place = self._address = None
        self.ended.emit(address)

    def _follow(self, before: Blueprint, after: Blueprint) -> None:
        """Use the names of the new blueprint. A written entry that has moved or gone is left."""
        if not self.open:
            return
        place = self._place
        if place is not None and _written(before, place) != _written(after, place):
            self._end(None)
        else:
            self._form.set_blueprint(after)

    @property
    def _file(self) -> str:
        """The file of the SB that is shown."""
        blueprint, branch = self._session.blueprint, self._session.branch
        known = branch in blueprint.branches
        return blueprint.home(branch).file if known else blueprint.file


def _place(claim: ClaimRow) -> ClaimPlace:
    return ClaimPlace(claim.address.branch, claim.index, claim.file)


def _written(blueprint: Blueprint, place: ClaimPlace) -> object:
    if all(one.file != place.file for one in blueprint.documents):
        return None
    return written_at(blueprint, place)
