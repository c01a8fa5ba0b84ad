"""The stored blueprints of a user: a folder for each, named by the digest of its closure.

``files/`` has the blueprint, what it imports, and its record. ``entry.json`` says what it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from smsl_studio.blueprint.stored import ENTRY, FILES, plain_digest, stored_folder
from smsl_studio.errors import SaveError, SealError
from smsl_studio.inspection.approval.record_file import SUFFIX
from smsl_studio.inspection.approval.store_files import read_stored, write_stored
from smsl_studio.smsl.files import save_document

Json = Any


@dataclass(frozen=True)
class SweptOperation:
    """How an operation did in a sweep: its function, the digest of the function's code (empty in
    the table world), how many edges were run in all seeds, and how many of them passed.
    """

    operation: str
    function: str
    code: str
    edges: int
    passed: int


@dataclass(frozen=True)
class Verification:
    """A sweep of a stored blueprint in a world, with the seeds, by whom and when."""

    world: str
    seeds: int
    by: str
    time: str
    operations: tuple[SweptOperation, ...] = ()

    @property
    def words(self) -> str:
        """What was found, in words."""
        passed = sum(one.passed for one in self.operations)
        edges = sum(one.edges for one in self.operations)
        seeds = f"{self.seeds} seed{'' if self.seeds == 1 else 's'}"
        return f"{passed} of {edges} passed in {self.world}, {seeds}, by {self.by}"


@dataclass(frozen=True)
class StoredBlueprint:
    """What the store knows about a blueprint.

    ``digest`` is that of its closure. ``root`` is its file below ``files``. ``parts`` are the
    closure digests of what it imports and of the procedures that it runs.
    """

    digest: str
    behaviour: str
    meaning: str
    root: str
    title: str
    time: str
    branches: tuple[str, ...] = ()
    operations: tuple[str, ...] = ()
    facts: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    verified: tuple[Verification, ...] = field(default_factory=tuple)

    @property
    def file(self) -> Path:
        """Where the blueprint stands."""
        return stored_folder() / self.digest / FILES / self.root

    @property
    def words(self) -> Iterator[str]:
        """The texts by which it is found: title, file, SBs, operations and facts."""
        yield from (self.title, self.root, *self.branches, *self.operations, *self.facts)


def stored_blueprints() -> tuple[StoredBlueprint, ...]:
    """Return all stored blueprints, sorted by title and digest.

    SealError if another user could have written an entry, or if it is not what Studio writes.
    """
    try:
        names = [one.name for one in stored_folder().iterdir() if plain_digest(one.name)]
    except (FileNotFoundError, NotADirectoryError):
        return ()
    found = [one for one in map(stored_blueprint, names) if one is not None]
    return tuple(sorted(found, key=lambda one: (one.title.casefold(), one.digest)))


def stored_blueprint(digest: str) -> StoredBlueprint | None:
    """Return the stored blueprint with a closure digest, or None. SealError as above."""
    path = stored_folder() / digest / ENTRY
    values = read_stored(path)
    if values is None:
        return None
    try:
        found = _of(values)
    except (KeyError, TypeError, ValueError):
        raise _odd(path) from None
    if found.digest != digest or not _is_below(found.root):
        raise _odd(path)
    return found


def keep_blueprint(entry: StoredBlueprint, files: Mapping[str, bytes]) -> None:
    """Put a blueprint into the store. The caller must hold the lock of the store.

    ``files`` are the bytes of its files by their paths below ``files``. SaveError if they cannot
    be written.
    """
    for name, raw in files.items():
        path = stored_folder() / entry.digest / FILES / name
        try:
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            raise SaveError(f"{path} cannot be written: {error.strerror or error}") from None
        save_document(raw, path)
        path.chmod(0o600 if name.endswith(SUFFIX) else 0o400)
    write_stored(stored_folder() / entry.digest / ENTRY, asdict(entry))


def _of(values: Mapping[str, Json]) -> StoredBlueprint:
    verified = tuple(
        Verification(
            **{
                **one,
                "operations": tuple(SweptOperation(**each) for each in one["operations"]),
            }
        )
        for one in values["verified"]
    )
    texts = {key: _texts(values[key]) for key in ("branches", "operations", "facts", "parts")}
    found = StoredBlueprint(**{**values, **texts, "verified": verified})
    if not all(isinstance(one, str) for one in (found.root, found.title, found.time)):
        raise ValueError
    return found


def _texts(listed: Json) -> tuple[str, ...]:
    if not isinstance(listed, list) or not all(isinstance(one, str) for one in listed):
        raise ValueError
    return tuple(listed)


def _is_below(root: str) -> bool:
    pure = PurePosixPath(root)
    return bool(root) and not pure.is_absolute() and ".." not in pure.parts and "\0" not in root


def _odd(path: Path) -> SealError:
    return SealError(f"{path} is not what Studio wrote", advice="Add the file again.")
