"""What an exploration has tried so far, kept in a file beside its result.

The first line says what is explored, each further line has the values of a state and where its
operations lead. A file of another exploration is begun anew, and a line that was cut is left out.
Any other file of this name is somebody's, and stays as it is.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Any, TypeGuard

from smsl_studio.errors import SaveError, UsageError
from smsl_studio.front.attempts import TriedState, Values
from smsl_studio.front.request import RunRequest
from smsl_studio.front.version import version
from smsl_studio.front.world_codes import surveyed
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.files import read_content
from smsl_studio.smsl.json_form import write_json

Json = Any


class ExploredPart:
    """The rows that are known. ``path`` None keeps nothing.

    UsageError if there is another kind of file at ``path``.
    """

    def __init__(self, path: Path | None, head: str) -> None:
        self.known: dict[Values, TriedState] = {}
        self._path, self._head = path, head
        self._file: IO[str] | None = None
        self._begun = path is not None and path.exists() and self._read(path)

    def keep(self, values: Values, tried: TriedState) -> None:
        """Keep what was tried in a state. SaveError if that is not possible."""
        self.known[values] = tried
        if self._path is None:
            return
        try:
            if self._file is None:
                self._file = self._path.open("a" if self._begun else "w", encoding="ascii")
                # A line that was cut ends here.
                self._file.write("\n" if self._begun else json.dumps({"head": self._head}) + "\n")
            self._file.write(json.dumps(tried_line(values, tried)) + "\n")
            self._file.flush()
        except OSError as error:
            words = error.strerror or str(error)
            raise SaveError(f"{self._path} was not written: {words}") from None

    def close(self) -> None:
        """Close the file. What is kept stays there."""
        if self._file is not None:
            self._file.close()
            self._file = None

    def _read(self, path: Path) -> bool:
        """Read the lines of an earlier exploration. Return whether it was the same one."""
        raw = read_content(path).raw
        if not raw:
            return False
        first, *lines = map(_line, raw.splitlines())
        if set(first) != {"head"}:
            raise UsageError(
                f"{path} exists and is not what an exploration has kept",
                advice="Move it away, or write to another file.",
            )
        if first != {"head": self._head}:
            return False
        for line in lines:
            if (told := tried_of_line(line)) is not None:
                self.known[told[0]] = told[1]
        return True


def tried_line(values: Values, tried: TriedState) -> dict[str, Json]:
    """Return what was tried in a state as JSON."""
    line: dict[str, Json] = {"state": values}
    if tried.rates:
        line |= {"rates": tried.rates, "lost": list(tried.lost)}
    if tried.idle:
        line["idle"] = tried.idle
    return {**line, "row": tried.row}


def tried_of_line(line: dict[str, Json]) -> tuple[Values, TriedState] | None:
    """Return the values of a state and what was tried there, None if the line is nonsense."""
    values, row = line.get("state"), line.get("row")
    rates, lost, idle = line.get("rates", {}), line.get("lost", []), line.get("idle", [])
    if not (_texts(values) and isinstance(row, dict) and all(map(_texts, row.values()))):
        return None
    if not (isinstance(lost, list) and all(map(_texts, lost)) and isinstance(rates, dict)):
        return None
    if not _texts(idle):
        return None
    if any(len(one) != len(values) for one in (*row.values(), *lost)):
        return None
    if any(name not in row or type(worked) is not int for name, worked in rates.items()):
        return None
    own = {name: tuple(target) for name, target in row.items()}
    return tuple(values), TriedState(own, rates, dict.fromkeys(map(tuple, lost)), idle)


def exploration_head(request: RunRequest, names: Sequence[str], repeats: int, rates: bool) -> str:
    """Return the digest of everything on which the rows of an exploration depend."""
    survey = surveyed(request.blueprint, request.world, request.plugin_paths)
    start = write_json({one.name: dict(one.fields) for one in request.blueprint})
    facts = [[one.name, one.alphabet, one.num_facts] for one in request.blueprint]
    parts = [version(), request.world, request.robot, survey.code, survey.bindings, names, repeats]
    parts += ["rates"] if rates else []
    return sha256_hex(json.dumps([*parts, start, facts], default=str).encode())


def _line(raw: bytes) -> dict[str, Json]:
    try:
        values = json.loads(raw)
    except (ValueError, RecursionError):
        return {}
    return values if isinstance(values, dict) else {}


def _texts(values: Json) -> TypeGuard[list[str]]:
    return isinstance(values, list) and all(isinstance(one, str) for one in values)
