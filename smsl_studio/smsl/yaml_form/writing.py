"""Writing YAML: values as block maps, two spaces a level, one member a line.

What would not come back as it is, is told by a core tag: a number as a target (``!!int 5``), a list
where a map is expected (``!!seq``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.smsl.comments import NO_COMMENTS, Comments
from smsl_studio.smsl.document import Path
from smsl_studio.smsl.yaml_form.levels import BRANCH, FILE, FREE, HEADER, NAME, STATE, below
from smsl_studio.smsl.yaml_form.scalars import LONGEST_NAME, written

Json = Any

_UNIT = "  "
_MAPS = (BRANCH, STATE, HEADER)
_UNFIT = re.compile(
    "[^\t -~\xa0-\u2027\u202a-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]"
)


def write(values: Mapping[str, Json], comments: Comments | None = None) -> str:
    """Values as a new text in the canonical layout."""
    lines = list(_Writing(comments or NO_COMMENTS).file(values))
    return "\n".join(lines) + "\n"


class _Writing:
    """The lines of one text; each comes with the comments that belong to it."""

    def __init__(self, comments: Comments) -> None:
        self._comments = comments

    def _above(self, path: Path, indent: str) -> Iterator[str]:
        return (f"{indent}#{_fit(words)}" for words in self._comments.over.get(path, ()))

    def _below(self, path: Path, indent: str) -> Iterator[str]:
        return (f"{indent}#{_fit(words)}" for words in self._comments.under.get(path, ()))

    def file(self, values: Mapping[str, Json]) -> Iterator[str]:
        if values:
            yield from self._map(values, (), FILE, "")
        else:
            yield "{}"
            yield from self._below((), "")

    def _map(
        self, values: Mapping[str, Json], path: Path, level: int, indent: str
    ) -> Iterator[str]:
        for key, value in values.items():
            here = (*path, key)
            yield from self._above(here, indent)
            name = written(key)
            lead = f"{indent}{name}:" if len(name) <= LONGEST_NAME else f"{indent}:"
            if len(name) > LONGEST_NAME:
                yield f"{indent}? {name}"
            yield from self._value(value, here, below(level, key), lead, indent)
        yield from self._below(path, indent)

    def _list(self, values: list[Json], path: Path, indent: str) -> Iterator[str]:
        for index, value in enumerate(values):
            here = (*path, str(index))
            yield from self._above(here, indent)
            lines = list(self._value(value, here, FREE, f"{indent}-", indent))
            if len(lines) > 1 and lines[0] == f"{indent}-" and lines[1].lstrip()[:1] != "#":
                lines[:2] = [f"{indent}- {lines[1].lstrip()}"]
            yield from lines
        yield from self._below(path, indent)

    def _value(self, value: Json, path: Path, level: int, lead: str, indent: str) -> Iterator[str]:
        """The lines of a value; ``lead`` is what stands before it on its first line."""
        behind = "".join(f"  #{_fit(words)}" for words in self._comments.beside.get(path, ()))
        if isinstance(value, dict) and value:
            yield f"{lead}{behind}"
            yield from self._map(value, path, level, indent + _UNIT)
            return
        if isinstance(value, list):
            lead += " !!seq" if level in _MAPS else ""
            if not self._is_flat(value, path):
                yield f"{lead}{behind}"
                yield from self._list(value, path, indent + _UNIT)
                return
            shown = f"[{', '.join(map(written, value))}]"
        else:
            shown = "{}" if isinstance(value, dict) else _scalar(value, level)
        yield f"{lead} {shown}{behind}" if shown else f"{lead}{behind}"
        yield from self._below(path, indent + _UNIT)

    def _is_flat(self, values: list[Json], path: Path) -> bool:
        """Whether a list stands on one line: of single values, none of them with a comment."""
        if any(isinstance(value, dict | list) for value in values):
            return False
        return not self._comments.of_elements(path, len(values))


def _fit(words: str) -> str:
    """What a comment says, with the characters that would end it, or that YAML has not, spelt."""
    return _UNFIT.sub(lambda one: one[0].encode("unicode_escape").decode("ascii"), words)


def _scalar(value: Json, level: int) -> str:
    """A value in a place of its level; the empty text is YAML's plainest word for nothing."""
    if level == NAME and not isinstance(value, str):
        if value is None:
            return ""
        kind = "bool" if isinstance(value, bool) else "int" if isinstance(value, int) else "float"
        return f"!!{kind} {written(value)}"
    if level in _MAPS and value is None:
        return "!!null null"
    return written(value)
