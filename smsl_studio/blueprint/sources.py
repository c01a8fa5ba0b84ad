"""``_sources`` of an SB: for a state (``State_10``), an operation (``Op_Fix``) or one edge
(``State_10/Op_Fix``) the words of a text from which it was made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.address import Address, note_key

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint, StateBranch

Json = Any
_MOST = 10
_LONGEST = 300


@dataclass(frozen=True, slots=True)
class SourceWords:
    """Quoted words with the file, the line, and in a PDF the page where they stand."""

    file: str
    line: int
    words: str
    page: int = 0

    @property
    def place(self) -> str:
        """Where they stand, for people."""
        page = f"page {self.page}, " if self.page else ""
        return f"{self.file}, {page}line {self.line}"

    def __str__(self) -> str:
        return f"“{self.words}” {self.place}"


def sources_of(branch: StateBranch, *keys: str) -> tuple[SourceWords, ...]:
    """Return the sources under the first of these keys that has any. What does not fit is left
    out."""
    table = branch.fields.get("_sources")
    if not isinstance(table, Mapping):
        return ()
    for key in keys:
        listed = table.get(key)
        if isinstance(listed, list):
            found = tuple(one for one in map(_source, listed[:_MOST]) if one is not None)
            if found:
                return found
    return ()


def sources_at(blueprint: Blueprint, address: Address) -> tuple[SourceWords, ...]:
    """Return the sources of a state or an operation."""
    branch = blueprint.branches.get(address.branch)
    if branch is None:
        return ()
    if not address.operation:
        return sources_of(branch, address.state)
    name, state = address.operation, address.state
    return sources_of(branch, note_key(name, state), note_key(name))


def _source(raw: Json) -> SourceWords | None:
    if not isinstance(raw, Mapping):
        return None
    file, line, words = raw.get("file"), raw.get("line"), raw.get("words")
    page = raw.get("page", 0)
    if not (isinstance(file, str) and isinstance(words, str) and file and words):
        return None
    if type(line) is not int or type(page) is not int or line < 1 or page < 0:
        return None
    return SourceWords(file[:_LONGEST], line, words[:_LONGEST], page)
