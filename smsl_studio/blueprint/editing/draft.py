"""Draft: the values of a blueprint while an edit changes them. Only what changes is copied."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.blueprint.revision import revised
from smsl_studio.blueprint.stored import stored_place
from smsl_studio.errors import AddressError, EditRefused, did_you_mean
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.splice import reconcile

Json = Any


class Draft:
    """The changes of one edit. ``done`` splices them into the texts and reads the result.

    Each SB is changed in its own document. Objects that the edit does not ask for stay the same
    objects, so that splicing and reading can skip them.
    """

    def __init__(self, before: Blueprint) -> None:
        self.before = before
        self._values: dict[Document, dict[str, Json]] = {}
        self._own: set[tuple[str, ...]] = set()

    def file(self, document: Document | None = None) -> dict[str, Json]:
        """Return the values of one of the documents (by default its own) for changes."""
        chosen = document or self.before.document
        if chosen not in self._values:
            self._values[chosen] = dict(chosen.values)
        return self._values[chosen]

    def at(self, branch: str, *below: str) -> dict[str, Json]:
        """Return the object of an SB, or one below it, for changes. KeyError if there is none."""
        node = self.file(self.before.home(branch))
        path = (branch, *below)
        for depth, key in enumerate(path, start=1):
            child = node[key]
            if not isinstance(child, dict):
                raise KeyError(path[:depth])
            if path[:depth] not in self._own:
                child = dict(child)
                node[key] = child
                self._own.add(path[:depth])
            node = child
        return node

    def header(self, branch: str) -> dict[str, Json]:
        """Return the HEADER of an SB for changes. It is created before the states if there is
        none.
        """
        inner = self.at(branch)
        if HEADER not in inner:
            rest = dict(inner)
            inner.clear()
            inner[HEADER] = {}
            inner.update(rest)
        return self.at(branch, HEADER)

    def table(self, branch: str, key: str) -> dict[str, Json]:
        """Return a table of annotations (``_layout``, ``_states`` and so on) for changes. It is
        created at the end of the SB if there is none.

        EditRefused if the value under its name is no map.
        """
        inner = self.at(branch)
        inner.setdefault(key, {})
        if not isinstance(inner[key], dict):
            raise EditRefused(
                f"{key} of {branch} is no map, so nothing can be added to it",
                self.before.home(branch).place((branch, key)),
                f"Write {key} as {{ ... }} in the text, or rename it.",
            )
        return self.at(branch, key)

    def tables(self, branch: str, *keys: str) -> list[dict[str, Json]]:
        """Return the tables with these names that exist and are maps."""
        present = self.before.home(branch).values.get(branch, {})
        return [self.at(branch, key) for key in keys if isinstance(present.get(key), dict)]

    def done(self) -> Blueprint:
        """Return the edited blueprint, or the blueprint before if nothing differs."""
        changed = {}
        for before, values in self._values.items():
            after = reconcile(before, values)
            if after is before:
                continue
            _refuse_stored(before)
            if before.doubled and len(before.duplicates()) > len(after.duplicates()):
                _refuse_loss(before, {path for path, _ in after.duplicates()})
            changed[before] = after
        return revised(self.before, changed) if changed else self.before


def _refuse_stored(document: Document) -> None:
    """Refuse to change what stands in the user's store under its own digest."""
    if stored_place(document.file) is not None:
        raise EditRefused(
            f"{PurePath(document.file).name} stands in your store and cannot be changed there",
            advice="Copy the file into your project, and import the copy.",
        )


def rename_keys(table: dict[str, Json], names: Mapping[str, str]) -> None:
    """Give keys other names in their places. Missing keys are ignored.

    If a new name is a key already, its old value (a note of a former element) is removed.
    """
    present = {old: new for old, new in names.items() if old in table and old != new}
    if not present:
        return
    gone = set(present.values()) - present.keys()
    for key in gone & table.keys():
        del table[key]
    items = list(zip(map(present.get, table, table), table.values(), strict=True))
    table.clear()
    table.update(items)


def branch_of(blueprint: Blueprint, branch: str) -> StateBranch:
    """Return the SB of that name. EditRefused if there is none."""
    existing(blueprint, Address(branch))
    return blueprint[branch]


def document_named(blueprint: Blueprint, file: str | None) -> Document:
    """Return the document of that file, or its own without a name. EditRefused if there is none."""
    for document in blueprint.documents:
        if file is None or document.file == file:
            return document
    raise EditRefused(
        f"{file} is no file of this blueprint",
        advice=did_you_mean(str(file), (one.file for one in blueprint.documents)),
    )


def existing(blueprint: Blueprint, address: Address) -> Address:
    """Return the address of an existing element. EditRefused if it does not exist."""
    try:
        found = blueprint.resolve(address)
    except AddressError as error:
        raise EditRefused(error.sentence, error.place, error.advice) from None
    if found != address:
        raise EditRefused(
            f"there is no State Branch {address.branch!r}", advice=f"Do you mean {found}?"
        )
    return found


def free_name(name: str, taken: object, what: str) -> None:
    """Raise EditRefused if ``name`` cannot be the name of a new element beside ``taken``.

    ``what`` is the kind of element with its article, such as "a state".
    """
    if not name.strip():
        raise EditRefused(f"{what} needs a name", advice="Type a name.")
    if name.startswith("_"):
        raise EditRefused(
            f"{name!r} starts with _, and every SMSL reader skips such names",
            advice="Start the name with something else.",
        )
    if name == HEADER and "operation" not in what:
        raise EditRefused("HEADER is the name of an SB's header", advice="Choose another name.")
    odd = next((char for char in name if not _visible(char)), None)
    if odd is not None:
        raise EditRefused(
            f"the name holds the character U+{ord(odd):04X}, which no one can see",
            advice="Write the name in one line of visible characters.",
        )
    if name in taken:  # type: ignore[operator]
        raise EditRefused(f"there is already {what} {name!r}", advice="Choose another name.")


def _visible(char: str) -> bool:
    return char == " " or char.isprintable()


def _refuse_loss(before: Document, left: set[tuple[str, ...]]) -> None:
    for path, places in before.duplicates():
        if path not in left:
            raise EditRefused(
                f"{'/'.join(path)} is written {len(places)} times, and this edit would drop "
                "what the graph does not show",
                places[-1],
                "Keep one of them first (the quick fix of R01 keeps the last).",
            )
