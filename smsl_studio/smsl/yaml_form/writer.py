"""Writes YAML: values as block maps, two spaces a level, one member a line.

Values deeper than ``DEEPEST`` levels without comments are on one line. Otherwise the indentation of
a text would grow with the square of its depth. Values that would be read differently get a core
tag: a number as a target (``!!int 5``), a list in the place of a map (``!!seq``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from smsl_studio.smsl.document import Path
from smsl_studio.smsl.document.comments import NO_COMMENTS, Comments
from smsl_studio.smsl.yaml_form.levels import BRANCH, FILE, FREE, HEADER, NAME, STATE, below
from smsl_studio.smsl.yaml_form.scalars import LONGEST_NAME, written

Json = Any

DEEPEST = 12
"""The most levels that are indented. SMSL itself has five."""
_UNIT = "  "
_MAPS = (BRANCH, STATE, HEADER)
_UNFIT = re.compile(
    "[^\t -~\xa0-\u2027\u202a-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]"
)


def write(values: Mapping[str, Json], comments: Comments | None = None) -> str:
    """Return values as a new text in the canonical layout."""
    writing = _Writing(comments or NO_COMMENTS)
    writing.file(values)
    return "\n".join(writing.lines) + "\n"


class _Writing:
    """Collects the lines of one text, in order, each with its comments."""

    def __init__(self, comments: Comments) -> None:
        self._comments = comments
        said = (*comments.over, *comments.beside, *comments.under)
        self._commented = {path[:deep] for path in said for deep in range(len(path) + 1)}
        self.lines: list[str] = []

    def _above(self, path: Path, indent: str) -> None:
        if path in self._commented:
            self._say(self._comments.over.get(path, ()), indent)

    def _below(self, path: Path, indent: str) -> None:
        if path in self._commented:
            self._say(self._comments.under.get(path, ()), indent)

    def _say(self, comments: Sequence[str], indent: str) -> None:
        self.lines.extend(f"{indent}#{_fit(words)}" for words in comments)

    def file(self, values: Mapping[str, Json]) -> None:
        """Write all lines of the file. A file without values is ``{}``."""
        if values:
            self._map(values, (), FILE, "")
        else:
            self.lines.append("{}")
            self._below((), "")

    def _map(self, values: Mapping[str, Json], path: Path, level: int, indent: str) -> None:
        for key, value in values.items():
            here = (*path, key)
            self._above(here, indent)
            name = written(key)
            lead = f"{indent}{name}:" if len(name) <= LONGEST_NAME else f"{indent}:"
            if len(name) > LONGEST_NAME:
                self.lines.append(f"{indent}? {name}")
            self._value(value, here, below(level, key), lead, indent)
        self._below(path, indent)

    def _list(self, values: list[Json], path: Path, indent: str) -> None:
        lines, dash = self.lines, f"{indent}-"
        for index, value in enumerate(values):
            here = (*path, str(index))
            self._above(here, indent)
            at = len(lines)
            self._value(value, here, FREE, dash, indent)
            if len(lines) > at + 1 and lines[at] == dash:
                first = lines[at + 1].lstrip()
                if first[:1] != "#":
                    lines[at : at + 2] = [f"{dash} {first}"]
        self._below(path, indent)

    def _value(self, value: Json, path: Path, level: int, lead: str, indent: str) -> None:
        """Write the lines of a value. ``lead`` is the text before it on its first line."""
        if len(path) > DEEPEST and path not in self._commented:
            self.lines.append(f"{lead} {_flow(value)}")
            return
        behind = "".join(f"  #{_fit(words)}" for words in self._comments.beside.get(path, ()))
        if isinstance(value, dict) and value:
            self.lines.append(f"{lead}{behind}")
            self._map(value, path, level, indent + _UNIT)
            return
        if isinstance(value, list):
            lead += " !!seq" if level in _MAPS else ""
            if not self._is_flat(value, path):
                self.lines.append(f"{lead}{behind}")
                self._list(value, path, indent + _UNIT)
                return
            shown = f"[{', '.join(map(written, value))}]"
        else:
            shown = "{}" if isinstance(value, dict) else _scalar(value, level)
        self.lines.append(f"{lead} {shown}{behind}" if shown else f"{lead}{behind}")
        self._below(path, indent + _UNIT)

    def _is_flat(self, values: list[Json], path: Path) -> bool:
        """Return whether a list is written on one line: it has only single values without
        comments.
        """
        if any(isinstance(value, dict | list) for value in values):
            return False
        return not self._comments.of_elements(path, len(values))


def _flow(value: Json) -> str:
    """Return a value of the level FREE on one line."""
    if isinstance(value, dict):
        members = (f"{_flow_name(key)}: {_flow(one)}" for key, one in value.items())
        return f"{{{', '.join(members)}}}"
    if isinstance(value, list):
        return f"[{', '.join(map(_flow, value))}]"
    return written(value)


def _flow_name(name: str) -> str:
    text = written(name)
    return text if len(text) <= LONGEST_NAME else f"? {text}"


def _fit(words: str) -> str:
    """Return the words of a comment, with escapes for characters that YAML does not allow in it."""
    return _UNFIT.sub(lambda one: one[0].encode("unicode_escape").decode("ascii"), words)


def _scalar(value: Json, level: int) -> str:
    """Return a single value on its level. A missing target is the empty text, YAML's shortest
    null.
    """
    if level == NAME and not isinstance(value, str):
        if value is None:
            return ""
        kind = "bool" if isinstance(value, bool) else "int" if isinstance(value, int) else "float"
        return f"!!{kind} {written(value)}"
    if level in _MAPS and value is None:
        return "!!null null"
    return written(value)
