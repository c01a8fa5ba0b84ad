"""The functions that operations run in generated code: named after them, or by a bindings file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.generate.code.identifiers import Namer
from smsl_studio.library.bindings_file import BindingsFile, BoundFunction, WorldTable

Json = Any
TABLE = "table"


@dataclass
class Function:
    """One function to fill in: its identifier, its key in the marks, what it serves in words, and
    its parameters with the types of their values.
    """

    name: str
    key: str
    serves: list[str] = field(default_factory=list)
    parameters: dict[str, str] = field(default_factory=dict)


class BoundFunctions:
    """The function and the arguments of every operation name, and of single edges that differ.

    UsageError if a bindings file names what the blueprint does not have.
    """

    def __init__(
        self, blueprint: Blueprint, file: BindingsFile | None, taken: Iterable[str]
    ) -> None:
        self.functions: list[Function] = []
        self._blueprint = blueprint
        self._table = _table_of(file)
        self._by_key: dict[str, Function] = {}
        self._namer = Namer("operation", taken)
        if file is not None:
            self._refuse_unknown(file)

    def of(
        self, branch: StateBranch, operation: str, state: str = ""
    ) -> tuple[Function, Mapping[str, Json]]:
        """Return the function and the arguments of an operation, or of its edge in a state."""
        found = self._bound(branch, operation, state)
        if found is None:
            key = str(Address(branch.name)) + "/" + note_key(operation)
            title = branch.notes.operations.get(note_key(operation))
            words = (title.title if title else "") or operation
            return self._function(key, words, str(key), {}), {}
        key = f"function {found.function}"
        where = note_key(operation, state) if state else note_key(operation)
        serves = f"{Address(branch.name)}/{where}"
        return self._function(key, found.function, serves, found.arguments), found.arguments

    def differs(self, branch: StateBranch, operation: str, state: str) -> bool:
        """Return whether a bindings file has a function for exactly this edge."""
        keys = (note_key(operation, state), str(Address(branch.name, state, operation)))
        return any(key in self._table.operations for key in keys)

    def by_edge(self) -> dict[Address, str]:
        """Return the name of the function that each edge runs."""
        found: dict[Address, str] = {}
        for branch in self._blueprint:
            for edge in branch.edges():
                single = note_key(edge.name, edge.source) in branch.notes.operations
                exact = single or self.differs(branch, edge.name, edge.source)
                function, _ = self.of(branch, edge.name, edge.source if exact else "")
                found[edge.address] = function.name
        return found

    def _bound(self, branch: StateBranch, operation: str, state: str) -> BoundFunction | None:
        known = self._table.operations
        exact = (str(Address(branch.name, state, operation)), note_key(operation, state))
        keys = (*(exact if state else ()), note_key(operation))
        return next((known[key] for key in keys if key in known), None)

    def _function(
        self, key: str, words: str, serves: str, arguments: Mapping[str, Json]
    ) -> Function:
        found = self._by_key.get(key)
        if found is None:
            found = self._by_key[key] = Function(self._namer.name(key, words), key)
            self.functions.append(found)
        if serves not in found.serves:
            found.serves.append(serves)
        for name, value in arguments.items():
            kind = type(value).__name__ if isinstance(value, str | int | float) else "object"
            known = found.parameters.setdefault(name, kind)
            if known != kind:
                found.parameters[name] = "object"
        return found

    def _refuse_unknown(self, file: BindingsFile) -> None:
        known = {key for branch in self._blueprint for key in _keys(branch)}
        for key, bound in self._table.operations.items():
            if key not in known:
                raise UsageError(
                    f"{file.place(key)}: the blueprint has no operation {key!r}",
                    advice=did_you_mean(key, sorted(known)),
                )
            for name in bound.arguments:
                if not name.isidentifier() or name in ("world", "edge"):
                    raise UsageError(
                        f"{file.place(key)}: {name!r} cannot be the name of a parameter",
                        advice="Choose a plain word; world and edge are taken.",
                    )


def _table_of(file: BindingsFile | None) -> WorldTable:
    """Return the bindings for the world ``table``, or those for the only world of the file."""
    if file is None or not file.worlds:
        return WorldTable()
    if TABLE in file.worlds:
        return file.worlds[TABLE]
    if len(file.worlds) > 1:
        raise UsageError(
            f"the bindings file is for {len(file.worlds)} worlds: {', '.join(file.worlds)}",
            advice="Write the bindings for generated code under [world.table.operations].",
        )
    return next(iter(file.worlds.values()))


def _keys(branch: StateBranch) -> Iterator[str]:
    for edge in branch.edges():
        yield note_key(edge.name)
        yield note_key(edge.name, edge.source)
        yield str(edge.address)
