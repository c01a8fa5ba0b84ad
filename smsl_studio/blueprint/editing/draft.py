"""Draft: the values of a blueprint while an edit changes them, copied only where it writes."""

from __future__ import annotations

from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER, read_blueprint
from smsl_studio.errors import AddressError, EditRefused
from smsl_studio.smsl.splicing import reconcile

Json = Any


class Draft:
    """What one edit writes; ``done`` splices it into the text and reads the result.

    Objects the edit does not ask for stay the very same objects, so that splicing and reading
    can pass over them.
    """

    def __init__(self, before: Blueprint) -> None:
        self.before = before
        self._values: dict[str, Json] = dict(before.document.values)
        self._own: set[tuple[str, ...]] = set()

    def at(self, *path: str) -> dict[str, Json]:
        """The object at ``path``, free to be changed; KeyError where none stands."""
        if path:
            own_branch(self.before, path[0])
        node = self._values
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
        """The HEADER of an SB, made in front of its states where it has none."""
        inner = self.at(branch)
        if HEADER not in inner:
            rest = dict(inner)
            inner.clear()
            inner[HEADER] = {}
            inner.update(rest)
        return self.at(branch, HEADER)

    def table(self, branch: str, key: str) -> dict[str, Json]:
        """A table of annotations (``_layout``, ``_states``...), made at the end of the SB.

        EditRefused where something else than a map stands under its name.
        """
        inner = self.at(branch)
        inner.setdefault(key, {})
        if not isinstance(inner[key], dict):
            raise EditRefused(
                f"{key} of {branch} is no map, so nothing can be added to it",
                self.before.document.place((branch, key)),
                f"Write {key} as {{ ... }} in the text, or rename it.",
            )
        return self.at(branch, key)

    def tables(self, branch: str, *keys: str) -> list[dict[str, Json]]:
        """Those of the tables that are there and are maps."""
        inner = self.at(branch)
        return [self.at(branch, key) for key in keys if isinstance(inner.get(key), dict)]

    def done(self) -> Blueprint:
        """The edited blueprint; the one before where nothing differs."""
        before = self.before.document
        after = reconcile(before, self._values)
        if after is before:
            return self.before
        if before.doubled:
            lost = len(before.duplicates()) - len(after.duplicates())
            if lost > 0:
                _refuse_loss(self.before, {path for path, _ in after.duplicates()})
        return read_blueprint(after, self.before)


def rename_key(table: dict[str, Json], old: str, new: str) -> None:
    """Give a key another name in its place; nothing where it is absent.

    What stood under the new name (a note of something long gone) gives way.
    """
    if old not in table or old == new:
        return
    items = [(new if key == old else key, value) for key, value in table.items() if key != new]
    table.clear()
    table.update(items)


def branch_of(blueprint: Blueprint, branch: str) -> StateBranch:
    """The SB of that name; EditRefused where there is none."""
    existing(blueprint, Address(branch))
    return blueprint[branch]


def own_branch(blueprint: Blueprint, branch: str) -> None:
    """EditRefused where the SB stands in an imported file."""
    if branch in blueprint.imported:
        file = blueprint.imported[branch].file
        raise EditRefused(f"{branch} is imported from {file}", advice="Open that file to edit it.")


def existing(blueprint: Blueprint, address: Address) -> Address:
    """The address of something that exists; EditRefused otherwise."""
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
    """EditRefused where ``name`` cannot be the name of a new element beside ``taken``.

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


def _refuse_loss(before: Blueprint, left: set[tuple[str, ...]]) -> None:
    for path, places in before.document.duplicates():
        if path not in left:
            raise EditRefused(
                f"{'/'.join(path)} is written {len(places)} times, and this edit would drop "
                "what the graph does not show",
                places[-1],
                "Keep one of them first (the quick fix of R01 keeps the last).",
            )
