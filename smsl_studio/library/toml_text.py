"""TOML files with the places of their keys, which the parser of the standard library leaves out."""

from __future__ import annotations

import os
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.errors import Place, PluginError
from smsl_studio.smsl.inputs import read_ordinary

LARGEST = 4_000_000
"""The largest size of a TOML file, in bytes."""

_AT = re.compile(r" ?\(at (?:line (\d+), column (\d+)|end of document)\)$")


@dataclass(frozen=True, slots=True)
class TomlText:
    """The lines of a TOML file, to find the places of keys."""

    file: str
    lines: tuple[str, ...]

    def line_of(self, key: str) -> int:
        """Return the line (from 1) on which ``key`` is set or heads a table. It is 1 if the key is
        not found."""
        return self._find(key) or 1

    def has(self, key: str) -> bool:
        """Whether ``key`` is set or heads a table in the file."""
        return self._find(key) is not None

    def _find(self, key: str) -> int | None:
        quoted = re.escape(key)
        pattern = re.compile(rf"""(?:^|[.\[{{,\s])(?:"{quoted}"|'{quoted}'|{quoted})\s*[=.\]]""")
        for number, line in enumerate(self.lines, 1):
            if pattern.search(line):
                return number
        return None

    def place(self, key: str) -> Place:
        """Return the place of a key in the file. It is the first character if the key is not
        found."""
        line = self.line_of(key)
        text = self.lines[line - 1] if line <= len(self.lines) else ""
        return Place(self.file, line, max(text.find(key), 0) + 1)


def read_toml(
    path: Path, largest: int = LARGEST, inside: str = ""
) -> tuple[TomlText, dict[str, Any]]:
    """Read the text and the values of a TOML file.

    ``inside`` is the real path of a folder. If it is given, the file must lie below it after links
    are resolved. PluginError, with its place, if the file is no valid TOML, no ordinary file, or
    larger than ``largest`` bytes.
    """
    file = str(path)
    try:
        raw = read_ordinary(os.path.realpath(path), largest, inside).raw
    except OSError as error:
        raise PluginError(f"cannot be read: {error.strerror}", Place(file, 1, 1)) from None
    if len(raw) > largest:
        raise PluginError(f"it is longer than {largest} bytes", Place(file, 1, 1))
    lines, values = _read(raw, file)
    return TomlText(file, lines), values


def toml_values(raw: bytes, file: str) -> dict[str, Any]:
    """Return the values in the bytes of a TOML file. PluginError if they are no valid TOML."""
    return _read(raw, file)[1]


def _read(raw: bytes, file: str) -> tuple[tuple[str, ...], dict[str, Any]]:
    try:
        text = raw.decode("utf-8").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        raise PluginError(f"no UTF-8: {error.reason}", Place(file, 1, 1)) from None
    lines = tuple(text.splitlines())
    try:
        return lines, tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        words = str(error)
        at = _AT.search(words)
        line, column = (int(at[1]), int(at[2])) if at and at[1] else (max(len(lines), 1), 1)
        raise PluginError(
            f"no valid TOML: {_AT.sub('', words)}", Place(file, line, column)
        ) from None
    except RecursionError:
        raise PluginError("no valid TOML: it is nested too deeply", Place(file, 1, 1)) from None
    except ValueError as error:  # a number of very many digits
        raise PluginError(f"no valid TOML: {error}", Place(file, 1, 1)) from None
