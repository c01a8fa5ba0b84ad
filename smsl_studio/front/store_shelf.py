"""The user's store of inspected blueprints and verified operations: adds, lists and finds them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.stored import plain_digest, stored_file, stored_folder
from smsl_studio.errors import ApprovalRefused, SealError, UsageError
from smsl_studio.inspection.approval.audit_log import append_act
from smsl_studio.inspection.approval.record_file import (
    SUFFIX,
    SignedRecord,
    read_record_file,
    record_beside,
)
from smsl_studio.inspection.approval.shelf import (
    StoredBlueprint,
    SweptOperation,
    Verification,
    keep_blueprint,
    stored_blueprint,
    stored_blueprints,
)
from smsl_studio.inspection.approval.store_files import store_alone
from smsl_studio.inspection.approval.times import written_time
from smsl_studio.smsl.files import read_content, read_document

if TYPE_CHECKING:
    from smsl_studio.front.approval_badge import ApprovalWords

Json = Any
Name = str | os.PathLike[str]


def is_record(file: Name) -> bool:
    """Whether a name is that of a record and not of a blueprint."""
    return os.fspath(file).endswith(SUFFIX)


def add_blueprint(
    blueprint: Blueprint,
    world: str = "",
    seeds: int = 1,
    by: str = "",
    now: datetime | None = None,
) -> StoredBlueprint:
    """Put an inspected blueprint into the store, with what it imports and its record.

    ``world`` asks for a sweep of its operations there with ``seeds`` seeds; ``by`` is who answers
    for it. ApprovalRefused if the check has an open error. SaveError if it cannot be written.

    >>> stored = add_blueprint(read("hanoi-2.json"), world=worlds()[0], by="L. Brandt")
    >>> stored.verified[0].words
    '24 of 24 passed in table, 1 seed, by L. Brandt'
    >>> [one.title for one in find_stored(["op_1c"])]
    ['hanoi-2']
    """
    from smsl_studio.front.check_findings import whole_check

    errors = whole_check(blueprint).errors()
    if errors:
        raise ApprovalRefused(
            "\n".join(dict.fromkeys(errors)), advice="The store holds what was inspected."
        )
    moment = now or datetime.now(UTC)
    files = _files(blueprint)
    entry = _entry(blueprint, next(iter(files)), written_time(moment))
    record = record_beside(blueprint.file)
    if os.path.lexists(record):
        files[f"{entry.root}{SUFFIX}"] = read_content(record).raw
    former = stored_blueprint(entry.digest)
    verified = () if former is None else former.verified
    if world:
        found = _verification(blueprint, world, seeds, by, written_time(moment))
        verified = (*(one for one in verified if one.world != world), found)
    entry = replace(entry, verified=verified)
    with store_alone():
        keep_blueprint(entry, files)
        append_act(moment, "add", closure=entry.digest, file=entry.root)
    return entry


def add_record(file: Name, now: datetime | None = None) -> tuple[str, ...]:
    """Take the records of a file into the store. Return the digests of the records.

    If the blueprint that they are about stands beside the file or in the store, it is added too,
    with the record. ApprovalRefused if a key is not known or a signature is wrong.
    """
    from smsl_studio.inspection.approval.seen_records import keep_record

    raw = read_content(file).raw
    records = read_record_file(raw)
    if not records:
        raise UsageError(f"{os.fspath(file)} holds no record")
    people = [_signer(one) for one in records]
    about = os.fspath(file).removesuffix(SUFFIX)
    moment = now or datetime.now(UTC)
    with store_alone():
        for one, person in zip(records, people, strict=True):
            keep_record(one, person, about)
            append_act(moment, "add record", record=one.digest)
    closure = records[-1].statement.digests.closure
    entry = stored_blueprint(closure)
    if entry is not None:
        with store_alone():
            keep_blueprint(entry, {f"{entry.root}{SUFFIX}": raw})
    elif os.path.lexists(about):
        blueprint = read_blueprint(read_document(about))
        if digests(blueprint).closure == closure:
            add_blueprint(blueprint, now=now)
    return tuple(one.digest for one in records)


def find_stored(words: Sequence[str] = ()) -> tuple[StoredBlueprint, ...]:
    """Return the stored blueprints in which each word stands: in the title, the name of the file,
    of an SB, an operation or a fact, or in one of their titles. No word: all of them.

    SealError if an entry is not what Studio wrote.

    >>> find_stored(["no such operation"])
    ()
    """
    wanted = [word.casefold() for word in words]
    return tuple(
        one
        for one in stored_blueprints()
        if all(any(word in text.casefold() for text in one.words) for word in wanted)
    )


def shown_stored(digest: str) -> StoredBlueprint:
    """Return the stored blueprint with a digest. UsageError if there is none.

    >>> stored = add_blueprint(read("hanoi-2.json"))
    >>> shown_stored(f"sha256:{stored.digest}").root
    'hanoi-2.json'
    """
    plain = plain_digest(digest.removeprefix("store:"))
    found = stored_blueprint(plain) if plain else None
    if found is None:
        raise UsageError(f"the store has no blueprint {digest[:80]!r}", advice="See store list.")
    return found


def opened_stored(entry: StoredBlueprint) -> Blueprint:
    """Return a stored blueprint. SealError if its content is not what its digest says."""
    file = stored_file(entry.digest)
    blueprint = read_blueprint(read_document(file)) if file else None
    if blueprint is None or digests(blueprint).closure != entry.digest:
        raise SealError(
            f"the store holds something else under {entry.digest}", advice="Add the file again."
        )
    return blueprint


REVOKED, ANOTHER_CONTENT = "Revoked", "Not what was stored"
"""The marks of what must not be used any more."""


def mark_of(entry: StoredBlueprint) -> ApprovalWords:
    """Return the words of a stored blueprint's badge: whether it is approved, and why not."""
    from smsl_studio.front.approval_badge import ApprovalWords, approval_words
    from smsl_studio.front.revocations import revocation_of

    try:
        blueprint = opened_stored(entry)
    except SealError as error:
        return ApprovalWords(ANOTHER_CONTENT, (error.sentence,), error.advice)
    reason = revocation_of(entry)
    if reason:
        return ApprovalWords(REVOKED, (reason,), "Do not use it any more.")
    return approval_words(blueprint)


def as_json(entry: StoredBlueprint, mark: str) -> dict[str, Json]:
    """Return an entry as the command prints it."""
    return {
        "digest": f"sha256:{entry.digest}",
        "title": entry.title,
        "file": entry.root,
        "mark": mark,
        "branches": list(entry.branches),
        "operations": list(entry.operations),
        "facts": list(entry.facts),
        "parts": [f"sha256:{one}" for one in entry.parts],
        "time": entry.time,
        "verified": [
            {
                "world": one.world,
                "seeds": one.seeds,
                "by": one.by,
                "time": one.time,
                "source": f"sha256:{entry.digest}",
                "operations": [vars(each) for each in one.operations],
            }
            for one in entry.verified
        ],
    }


def _signer(record: SignedRecord) -> str:
    """Return the name of the person who has signed a record, for comparison."""
    from smsl_studio.inspection.approval.key_store import stored_keys
    from smsl_studio.inspection.approval.known_keys import name_of
    from smsl_studio.seal.ed25519 import is_signed

    said = record.statement.predicate
    for key in stored_keys().values():
        if key.identity == record.envelope.keyid and is_signed(record.envelope, key.public):
            return name_of(key.person)
    raise ApprovalRefused(
        f"the record of {said.person} is signed with {record.envelope.keyid}, which is no key of "
        "this store, or its signature is wrong",
        advice="Take the public half of the key with smsl-studio keys import.",
    )


def _files(blueprint: Blueprint) -> dict[str, bytes]:
    """Return the bytes of a blueprint and of its imports in the project, by their paths below
    the folder that holds them all. The blueprint is the first.
    """
    store = os.path.realpath(stored_folder())
    run = (one for part in procedures_of(blueprint).parts for one in part.documents)
    paths = {os.path.realpath(one.file): one for one in (*blueprint.documents, *run)}
    first = next(iter(paths))
    if first.startswith(os.path.join(store, "")):  # noqa: PTH118
        raise UsageError(f"{blueprint.file} stands in the store already")
    own = [path for path in paths if not path.startswith(os.path.join(store, ""))]  # noqa: PTH118
    folder = os.path.commonpath([os.path.dirname(path) for path in own])  # noqa: PTH120
    return {
        PurePath(os.path.relpath(path, folder)).as_posix(): paths[path].encoded() for path in own
    }


def _entry(blueprint: Blueprint, root: str, time: str) -> StoredBlueprint:
    from smsl_studio.front.approval_files import parts_of

    found = digests(blueprint)
    brought = [part for _, part in list(parts_of(blueprint))[1:]]
    parts = [digests(part).closure for part in (*brought, *procedures_of(blueprint).parts)]
    operations: list[str] = []
    facts: list[str] = []
    for branch in blueprint:
        operations += branch.operation_names
        operations += [one.title for one in branch.notes.operations.values() if one.title]
        facts += [branch.fact_name(digit) for digit in range(branch.num_facts)]
    return StoredBlueprint(
        found.closure,
        found.behaviour,
        found.meaning,
        root,
        _title(blueprint),
        time,
        tuple(one.name for one in blueprint),
        tuple(dict.fromkeys(operations)),
        tuple(dict.fromkeys(facts)),
        tuple(dict.fromkeys(parts)),
    )


def _title(blueprint: Blueprint) -> str:
    return PurePath(blueprint.file).stem


def _verification(blueprint: Blueprint, world: str, seeds: int, by: str, time: str) -> Verification:
    """Sweep a blueprint in a world with each seed, and count by operation."""
    from smsl_studio.front.sweeps import sweep
    from smsl_studio.front.world_codes import surveyed
    from smsl_studio.library.bindings import bind
    from smsl_studio.runlog.events import EdgeSwept

    if not 0 < seeds <= 1000:
        raise UsageError(f"{seeds} is no number of seeds", advice="Write a number up to 1,000.")
    counts: dict[str, list[int]] = {}
    for seed in range(seeds):
        for event in sweep(blueprint, world, seed=seed):
            if isinstance(event, EdgeSwept):
                name = blueprint.resolve(event.address).operation
                count = counts.setdefault(name, [0, 0])
                count[0] += 1
                count[1] += event.passed
    survey = surveyed(blueprint, world)
    code = {} if survey.code is None else {one.function: one.code for one in survey.code.functions}
    functions: dict[str, str] = {}
    if survey.loaded is not None:
        bindings = bind(blueprint, survey.loaded, world, survey.bindings)
        for address, bound in bindings.operations.items():
            functions.setdefault(address.operation, bound.name)
    return Verification(
        world,
        seeds,
        by or "this computer",
        time,
        tuple(
            SweptOperation(name, functions.get(name, ""), code.get(functions.get(name, ""), ""), *n)
            for name, n in counts.items()
        ),
    )
