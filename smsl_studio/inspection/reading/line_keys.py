"""The key of each line of a reading: what a person has answered belongs to it.

A key is made of what the line says and of the annotations of the operations and states behind it.
It holds no number of a step, so it stays when a step gets another number. It changes when the words
change, or when an operation with the same title now costs, asks or calls something else.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import OperationNote, StateNote
from smsl_studio.blueprint.meaning import note_meaning
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.reading.sections import ReadingLine, ReadingSection
from smsl_studio.stop import heed

Json = Any
OR = "or"


def keyed(blueprint: Blueprint, sections: Iterable[ReadingSection]) -> tuple[ReadingSection, ...]:
    """Return sections in which each line has its key. Lines that mean the same have a number in
    their key, so no two lines of a reading have one key.
    """
    annotations = _Annotations(blueprint)
    seen: dict[str, int] = {}
    return tuple(
        replace(
            section,
            lines=tuple(
                replace(line, key=_numbered(_key(section, line, annotations), seen))
                for line in section.lines
            ),
        )
        for section in sections
    )


def _numbered(key: str, seen: dict[str, int]) -> str:
    seen[key] = seen.get(key, 0) + 1
    return key if seen[key] == 1 else f"{key}-{seen[key]}"


def _key(section: ReadingSection, line: ReadingLine, annotations: _Annotations) -> str:
    heed()
    behind = sorted({annotations.of(address) for address in _about(line)})
    text = json.dumps([section.key, _said(line), behind])
    return hashlib.sha256(text.encode("ascii")).hexdigest()[:32]


def _said(line: ReadingLine) -> Json:
    """Return what a line says, without numbers of steps."""
    own = line.unnumbered or (line.heading, *line.text)
    inner = [_said(one) for one in line.inner]
    return [line.mark == OR, list(own), line.who, line.check, line.open_point, inner]


def _about(line: ReadingLine) -> Iterator[Address]:
    yield from line.about
    for one in line.inner:
        yield from _about(one)


class _Annotations:
    """The annotations behind addresses, as texts. Equal objects are written once."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._written: dict[int, tuple[OperationNote | StateNote, str]] = {}

    def of(self, address: Address) -> str:
        """Return the annotations of an operation or a state, empty if there are none."""
        branch = self._blueprint.branches.get(address.branch)
        if branch is None or address.state not in branch.table:
            return ""
        note: OperationNote | StateNote | None = branch.state_note(address.state)
        if address.operation:
            note = branch.operation_note(address.state, address.operation)
        if note is None:
            return ""
        known = self._written.get(id(note))
        if known is None:
            known = note, json.dumps(note_meaning(note), sort_keys=True)
            # The note is kept too, so that no other object gets its id.
            self._written[id(note)] = known
        return known[1]
