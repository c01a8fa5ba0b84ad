"""What a revocation touches: stored blueprints and signed records that hold a digest."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass

from smsl_studio.blueprint.stored import plain_digest
from smsl_studio.errors import UsageError
from smsl_studio.inspection.approval.seen_index import entries
from smsl_studio.inspection.approval.seen_records import revoked_digests, seen_record
from smsl_studio.inspection.approval.shelf import StoredBlueprint, stored_blueprints

BLUEPRINT, RECORD = "blueprint", "record"


@dataclass(frozen=True, slots=True)
class Dependant:
    """A stored blueprint or a record that a revocation touches, and why."""

    kind: str
    digest: str
    file: str
    why: str

    def as_json(self) -> dict[str, str]:
        """Return it as the command prints it."""
        return {
            "kind": self.kind,
            "digest": f"sha256:{self.digest}",
            "file": self.file,
            "why": self.why,
        }


def dependants_of(digest: str) -> tuple[Dependant, ...]:
    """Return what a revocation of a digest touches: that of a record, or of a blueprint.

    Touched are the stored blueprints that import it or run it, directly or not, and the records
    about it or about one of them. UsageError if ``digest`` is no SHA-256.

    >>> dependants_of("sha256:" + 64 * "0")
    ()
    """
    plain = plain_digest(digest.removeprefix("store:"))
    if not plain:
        raise UsageError(
            f"{digest[:80]!r} is no SHA-256", advice="store list shows those of the store."
        )
    touched = _touched(plain)
    return (*_blueprints(plain, touched), *_records(plain, touched))


def revocation_of(entry: StoredBlueprint) -> str:
    """Return why a stored blueprint, or a part of it, is revoked by this user. Empty if none is.

    Parts of parts count, as for ``dependants_of``.
    """
    revoked = revoked_digests()
    held = _held(entry) if revoked else frozenset()
    return next((why for digest, why in revoked.items() if digest in held), "")


def _held(entry: StoredBlueprint) -> Set[str]:
    """Return the digests of a stored blueprint and of everything that it uses, directly or not."""
    known = {one.digest: one for one in stored_blueprints()} | {entry.digest: entry}
    held: set[str] = set()
    ahead = [entry.digest]
    while ahead:
        digest = ahead.pop()
        one = known.get(digest)
        if one is not None and digest not in held:
            held.add(one.behaviour)
            ahead += one.parts
        held.add(digest)
    return held


def _touched(digest: str) -> Set[str]:
    """Return the closure digests of the blueprints that a digest concerns."""
    touched = {digest}
    for name, _ in entries():
        if name == digest:
            record = seen_record(name)
            touched.add(record.statement.digests.closure)
    stored = stored_blueprints()
    touched |= {one.digest for one in stored if digest in (one.behaviour, one.meaning)}
    while True:
        more = {one.digest for one in stored if touched.intersection(one.parts)} - touched
        if not more:
            return touched
        touched |= more


def _blueprints(digest: str, touched: Set[str]) -> Iterator[Dependant]:
    for one in stored_blueprints():
        if one.digest in touched and one.digest != digest:
            uses = touched & set(one.parts)
            why = "it uses what is revoked" if uses else "it, or its record, is revoked"
            yield Dependant(BLUEPRINT, one.digest, one.root, why)


def _records(digest: str, touched: Set[str]) -> Iterator[Dependant]:
    for name, entry in entries():
        if name == digest:
            continue
        statement = seen_record(name).statement
        own = statement.digests
        parts = {one.digest.closure for one in statement.subject}
        if digest in (own.closure, own.behaviour, own.meaning) or own.closure in touched:
            yield Dependant(RECORD, name, entry["file"], "it is about a blueprint that is touched")
        elif touched & parts:
            yield Dependant(RECORD, name, entry["file"], "it is about a part that is touched")
