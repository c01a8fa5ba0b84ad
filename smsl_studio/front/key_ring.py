"""Makes, lists, exports, imports and revokes the keys of this user's store."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

from smsl_studio.errors import SaveError, SealError, UsageError
from smsl_studio.inspection.approval.audit_log import append_act
from smsl_studio.inspection.approval.key_store import (
    StoredKey,
    check_id,
    check_words,
    keep_key,
    key_of_file,
    new_id,
    stored_key,
    stored_keys,
)
from smsl_studio.inspection.approval.register import PAYLOAD_TYPE, register_payload
from smsl_studio.inspection.approval.seen_records import revoke_digest as keep_revoked
from smsl_studio.inspection.approval.store_files import store_alone
from smsl_studio.inspection.approval.times import written_time
from smsl_studio.seal.ed25519 import new_private, public_of
from smsl_studio.seal.strict_json import read_strictly
from smsl_studio.seal.token import new_on_token
from smsl_studio.smsl.disk import settle, write_new
from smsl_studio.smsl.files import read_content, save_document

Name = str | os.PathLike[str]


def make_key(
    person: str,
    role: str,
    passphrase: bytes,
    key_id: str = "",
    now: datetime | None = None,
    token: str = "",
) -> StoredKey:
    """Make a key for a person in a role, and keep it in the store.

    ``key_id`` is its name in this store. The passphrase encrypts the private half. With the label
    of a ``token`` the private half is made there and stays there, and the passphrase is its PIN.
    UsageError if the name is taken. SealError if the passphrase is empty, if the token does not
    open, or if it does not sign with the new key: then nothing is kept.

    >>> make_key("L. Brandt", "engineer", b"a passphrase").id
    'l-brandt-engineer'
    """
    check_words(person, role)
    moment = now or datetime.now(UTC)
    name = _free_name(person, role, key_id)
    bare = StoredKey(name, person, role, b"", written_time(moment))
    if token:
        place, public = new_on_token(token, passphrase)
        key = replace(bare, public=public, box=place.as_values())
        key.prove(passphrase)
    else:
        private = new_private()
        key = replace(bare, public=public_of(private)).with_private(private, passphrase)
    with store_alone():
        key = replace(key, id=_free_name(person, role, key_id))
        append_act(moment, "make", key=key.identity, person=person, role=role)
        keep_key(key)
    return key


def _free_name(person: str, role: str, wanted: str) -> str:
    """Return the local name of a new key. UsageError if the wanted one is taken or is no name."""
    known = stored_keys()
    name = wanted or new_id(person, role, known)
    check_id(name)
    if name.casefold() in {one.casefold() for one in known}:
        raise UsageError(f"there is a key {name!r} already", advice="Choose another --id.")
    return name


def list_keys() -> tuple[StoredKey, ...]:
    """Return the keys of the store, sorted by their names.

    SealError if another user could have written a file of the store, or if a file is no key.

    >>> list_keys()
    ()
    """
    return tuple(stored_keys().values())


def export_key(
    key_id: str,
    output: Name,
    passphrase: bytes | None = None,
    new_passphrase: bytes | None = None,
) -> StoredKey:
    """Write a key to a new file.

    Without a passphrase the file gets only the public half. With the key's passphrase it gets both
    halves, and ``new_passphrase`` encrypts the private half there. SealError if the passphrase is
    wrong.

    >>> made = make_key("L. Brandt", "engineer", b"a passphrase")
    >>> export_key(made.id, "brandt.key.json").box is None
    True
    """
    key = stored_key(key_id)
    out = key.public_half
    if passphrase is not None:
        if not new_passphrase:
            raise UsageError("an exported private key needs a new passphrase")
        out = key.with_private(key.opened(passphrase), new_passphrase)
    raw = f"{json.dumps(out.as_file(), indent=2)}\n".encode("ascii")
    with store_alone():
        append_act(datetime.now(UTC), "export", key=key.identity, private=out.box is not None)
    if out.box is None:
        save_document(raw, output)
    else:
        _write_private(Path(output), raw)
    return out


def _write_private(path: Path, raw: bytes) -> None:
    try:
        write_new(path, raw, 0o600)
    except FileExistsError:
        raise UsageError(
            f"{path} is there already, and a key is never written over another file",
            advice="Name a new file.",
        ) from None
    except OSError as error:
        raise SaveError(f"{path} was not saved: {error.strerror or error}") from None
    settle([path.parent])


def import_key(file: Name, key_id: str = "") -> StoredKey:
    """Take a key from a file into the store. ``key_id`` becomes its name there.

    If there is no register, signatures of this key count from now on, with the person and role in
    the file. So compare its identity with what its owner tells you. SealError if the file is no
    key, or if it says that the key is revoked: anybody can write that into a file.

    >>> made = make_key("L. Brandt", "engineer", b"a passphrase")
    >>> _ = export_key(made.id, "brandt.key.json")
    >>> import_key("brandt.key.json").identity == made.identity
    True
    """
    values = read_strictly(read_content(file).raw, os.fspath(file))
    key = key_of_file(values)
    if key.revoked:
        raise SealError(
            f"{os.fspath(file)} says that its key is revoked, and a file cannot revoke a key",
            advice="To revoke a key of this store: smsl-studio keys revoke. No other key is taken "
            "in that does not count any more.",
        )
    with store_alone():
        known = stored_keys()
        same = next((one for one in known.values() if one.public == key.public), None)
        if same is not None:
            key = _joined(same, key)
        else:
            name = key_id or key.id
            check_id(name)
            if name.casefold() in {one.casefold() for one in known}:
                if key_id:
                    raise UsageError(f"there is another key {name!r}", advice="Name another --id.")
                name = new_id(key.person, key.role, known)
            key = replace(key, id=name)
        append_act(datetime.now(UTC), "import", key=key.identity, private=key.box is not None)
        keep_key(key)
    return key


def _joined(mine: StoredKey, other: StoredKey) -> StoredKey:
    """Return a key of the store, completed by a file: with its private half."""
    if (mine.person, mine.role) != (other.person, other.role):
        raise UsageError(
            f"this key is in your store as {mine.id}, of {mine.person} ({mine.role}), and the file "
            f"says {other.person} ({other.role})",
            advice="A key has one person and one role. Ask its owner.",
        )
    box = mine.box if mine.box is not None else other.box
    return replace(mine, box=box)


def sign_register(persons: Name, key: str, passphrase: bytes, output: Name) -> StoredKey:
    """Sign a register of persons, and write it to a file. Return the key that has signed.

    SealError if ``persons`` is no register, or if the passphrase is wrong.

    >>> made = make_key("Head of quality", "register", b"a passphrase")
    >>> _ = Path("persons.json").write_text('{"version": 1, "serial": 1, "persons": []}')
    >>> _ = sign_register("persons.json", made.id, b"a passphrase", "register.json")
    """
    found = stored_key(key)
    if found.revoked:
        raise UsageError(f"the key {found.id} is revoked: {found.revoked}")
    values = read_strictly(read_content(persons).raw, os.fspath(persons))
    payload = register_payload(values)
    envelope = found.signer(passphrase)(PAYLOAD_TYPE, payload)
    raw = json.dumps(envelope.as_json(), separators=(",", ":")).encode("ascii")
    with store_alone():
        append_act(datetime.now(UTC), "register", key=found.identity, serial=values["serial"])
    save_document(raw, output, made_of=[os.fspath(persons)])
    return found


def revoke_key(key_id: str, why: str, passphrase: bytes, by: str = "") -> StoredKey:
    """Revoke a key of the store. None of its signatures counts any more, not even an old one.

    The passphrase is that of this key, or that of another key ``by``. SealError if it is wrong.

    >>> made = make_key("L. Brandt", "engineer", b"a passphrase")
    >>> revoke_key(made.id, "the laptop was stolen", b"a passphrase").revoked
    'the laptop was stolen'
    """
    if not why.strip():
        raise UsageError("a revocation needs a reason", advice="Say it with --why TEXT.")
    key, opener = stored_key(key_id), stored_key(by or key_id)
    opener.prove(passphrase)
    revoked = replace(key, revoked=why)
    now = datetime.now(UTC)
    with store_alone():
        append_act(now, "revoke key", key=key.identity, by=opener.identity, why=why)
        keep_key(revoked)
    return revoked


def revoke_digest(digest: str, why: str, key: str, passphrase: bytes) -> str:
    """Revoke a record or a blueprint for this user, by its SHA-256. Return the digest.

    The passphrase is that of ``key``, a key of the store. If there is a register, this has no
    effect: then only the register and the policy can revoke.

    >>> made = make_key("L. Brandt", "engineer", b"a passphrase")
    >>> revoke_digest("sha256:" + 64 * "0", "a wrong file", made.id, b"a passphrase")[:4]
    '0000'
    """
    plain = digest.removeprefix("record:").removeprefix("sha256:").lower()
    if len(plain) != 64 or set(plain) - set("0123456789abcdef"):
        raise UsageError(
            f"{digest[:80]!r} is no SHA-256",
            advice="digest shows those of a blueprint, and approve that of a record.",
        )
    if not why.strip():
        raise UsageError("a revocation needs a reason", advice="Say it with --why TEXT.")
    opener = stored_key(key)
    opener.prove(passphrase)
    now = datetime.now(UTC)
    with store_alone():
        append_act(now, "revoke digest", digest=plain, by=opener.identity, why=why)
        keep_revoked(plain, why, opener.identity, written_time(now))
    return plain
