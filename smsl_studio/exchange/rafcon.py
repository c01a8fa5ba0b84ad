"""Reads a state machine of RAFCON: a folder with ``statemachine.json``, one folder a state.

Scripts of states are neither read nor run, libraries are not opened, links are not followed.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from smsl_studio.errors import Place, ReadError
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.json_text import json_document
from smsl_studio.exchange.outcomes import OutcomeNode, alone, values_of_machine
from smsl_studio.smsl.document.limits import LARGEST_FILE, MAX_DEPTH
from smsl_studio.smsl.files import read_content, text_of
from smsl_studio.stop import heed

Json = Any
MACHINE, CORE = "statemachine.json", "core_data.json"
MOST_FOLDERS = 20_000
_CONCURRENT = ("BarrierConcurrencyState", "PreemptiveConcurrencyState")
_LEFT_OUT = ("data_flows", "input_data_ports", "output_data_ports", "scoped_variables")


def rafcon_folder(file: str) -> str:
    """Return the folder of the machine that a file or folder is, empty if it is none."""
    path = Path(file)
    try:
        if path.name in (MACHINE, CORE) and path.is_file():
            path = path.parent
        elif not path.is_dir():
            return ""
        found = (path / CORE).is_file() or any(path.glob(f"*/{CORE}"))
        return os.fspath(path) if found else ""
    except (OSError, ValueError):  # the name is none of the system, or the folder is shut
        return ""


def rafcon_values(folder: str, findings: ExchangeFindings) -> dict[str, Json]:
    """Return the plain values of the blueprint that a machine shows. ReadError if it is none."""
    reader = _RafconReader(folder, findings)
    root = reader.state(reader.root(), None)
    reader.tell()
    if not root.children or root.concurrent:
        root = alone(root)
    return values_of_machine(root, os.fspath(Path(folder) / CORE), findings)


class _RafconReader:
    def __init__(self, folder: str, findings: ExchangeFindings) -> None:
        self._folder, self._findings = Path(folder), findings
        self._inside = os.path.realpath(folder)
        self._left, self._bytes = MOST_FOLDERS, LARGEST_FILE
        self._counts: dict[str, int] = {}

    def root(self) -> Path:
        """Return the folder of the outermost state. Old machines keep it one folder deeper."""
        if (self._folder / CORE).is_file():
            return self._folder
        within = [one for one in self._folders(self._folder) if (one / CORE).is_file()]
        if len(within) != 1:
            words = f"{len(within)} folders in it hold a state, and one is needed"
            place = Place(os.fspath(self._folder / MACHINE), 1, 1)
            raise ReadError(words, place, f"Name the folder with {CORE}.")
        return within[0]

    def state(self, folder: Path, parent: OutcomeNode | None, depth: int = 0) -> OutcomeNode:
        """Return the state in a folder, with all states in it."""
        heed()
        file = folder / CORE
        self._left -= 1
        if self._left < 0 or depth > MAX_DEPTH:
            words = f"more than {MOST_FOLDERS:,} states, or deeper than {MAX_DEPTH} levels"
            raise ReadError(words, Place(os.fspath(file), 1, 1), "Split the machine.")
        values = self._values(file)
        kind = str(values.get("__jsonqualname__", "")).rpartition(".")[2]
        known = _word(values.get("state_id")) or folder.name
        name = _word(values.get("name")) or known
        node = OutcomeNode(known, name, (1, 1), parent=parent)
        node.machine, node.concurrent = kind != "ExecutionState", kind in _CONCURRENT
        for key, one in _entries(values.get("outcomes")):
            node.outcomes[_number(one.get("outcome_id"), key)] = _word(one.get("name")) or key
        if kind == "LibraryState":
            node.machine = False
            library = f"{_word(values.get('library_path'))}/{_word(values.get('library_name'))}"
            words = f"The library {library[:200]!r} is not opened: it becomes one state."
            self._findings.add("library", name, words)
        for word in _LEFT_OUT:
            self._count(word, len(_entries(values.get(word))))
        self._count("script.py", (folder / "script.py").is_file())
        for below in self._folders(folder) if node.machine else ():
            if (below / CORE).is_file():
                child = self.state(below, node, depth + 1)
                node.children[child.id] = child
        self._transitions(node, values)
        return node

    def _transitions(self, node: OutcomeNode, values: dict[str, Json]) -> None:
        for _, one in _entries(values.get("transitions")):
            source, target = _word(one.get("from_state")), _word(one.get("to_state"))
            outcome = _number(one.get("to_outcome"), "")
            child = "" if target == node.id and outcome else target
            if not source or (source == node.id and one.get("from_outcome") is None):
                node.start = child
                continue
            node.ways[source, _number(one.get("from_outcome"), "")] = child, outcome
        started = values.get("start_state_id")
        node.start = node.start or _word(started)

    def _values(self, file: Path) -> dict[str, Json]:
        real = os.path.realpath(file)
        if not real.startswith(self._inside + os.sep):
            words = "a link leads out of the machine's folder"
            raise ReadError(words, Place(os.fspath(file), 1, 1), "Copy the state into the folder.")
        text = text_of(read_content(real, self._inside), os.fspath(file))
        self._bytes -= len(text)
        if self._bytes < 0:
            words = f"the machine is larger than {LARGEST_FILE >> 20} MB"
            raise ReadError(words, Place(os.fspath(file), 1, 1), "Split the machine.")
        return dict(json_document(text, os.fspath(file)).values)

    def _folders(self, folder: Path) -> list[Path]:
        try:
            with os.scandir(folder) as entries:
                inner = [Path(one.path) for one in entries if one.is_dir(follow_symlinks=False)]
        except OSError as error:
            words = f"a folder cannot be read: {error.strerror or error}"
            place = Place(os.fspath(folder), 1, 1)
            raise ReadError(words, place, "Check the right to read it.") from None
        return sorted(inner)

    def _count(self, word: str, many: int) -> None:
        if many:
            self._counts[word] = self._counts.get(word, 0) + many

    def tell(self) -> None:
        """Tell how much was left out of all states together."""
        for word, many in self._counts.items():
            how = "neither read nor run" if word == "script.py" else "not carried over"
            words = f"{word.replace('_', ' ')}: {many:,}, {how}."
            self._findings.add(word, "", words)


def _entries(value: Json) -> list[tuple[str, dict[str, Json]]]:
    """Return the entries of a map, or of a list, that are maps."""
    if isinstance(value, list):
        value = dict(enumerate(value))
    pairs = value.items() if isinstance(value, dict) else ()
    return [(str(key), one) for key, one in pairs if isinstance(one, dict)]


def _word(value: Json) -> str:
    return value if isinstance(value, str) else ""


def _number(value: Json, otherwise: str) -> str:
    return str(value) if isinstance(value, int | str) else otherwise
