"""The keys of this user. Public halves have a person and a role; private halves are encrypted."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from smsl_studio.errors import SealError, UsageError, did_you_mean
from smsl_studio.inspection.approval.known_keys import KnownKey
from smsl_studio.inspection.approval.store_files import read_stored, store_folder, write_stored
from smsl_studio.seal.canonical import canonical
from smsl_studio.seal.ed25519 import LENGTH, identity, is_signed, public_of, sealed
from smsl_studio.seal.envelope import Envelope, pae
from smsl_studio.seal.key_box import boxed, read_box, unboxed
from smsl_studio.seal.strict_json import base64_text, from_base64
from smsl_studio.seal.token import TokenKey, is_token, token_key

Json = Any
Signer = Callable[[str, bytes], Envelope]
"""Signs a payload of a type (see ``envelope``)."""
PROOF = "application/vnd.smsl-studio.proof"
"""The type of bytes that are signed to show that a key opens."""
FORMAT = "smsl-studio-key"
_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}", re.ASCII)
_MEMBERS = {"format", "version", "id", "person", "role", "public", "made", "revoked", "private"}


@dataclass(frozen=True, slots=True)
class StoredKey:
    """A key of the store. ``id`` is its name in this store.

    ``box`` has the encrypted private half, or says on which token it is. It is None if the store
    has only the public half.
    ``revoked`` says why the key no longer counts; it is empty for a valid key.
    """

    id: str
    person: str
    role: str
    public: bytes
    made: str
    revoked: str = ""
    box: Json = None

    @property
    def identity(self) -> str:
        """The name of the key in records and registers (see ``ed25519``)."""
        return identity(self.public)

    @property
    def known(self) -> KnownKey:
        """The key as ``judge`` sees it if there is no register."""
        return KnownKey(self.public, self.person, (self.role,), revoked=self.revoked)

    @property
    def token(self) -> TokenKey | None:
        """Where the private half is, if it is on a token."""
        return token_key(self.box) if is_token(self.box) else None

    @property
    def public_half(self) -> StoredKey:
        """The key without its private half."""
        return replace(self, box=None)

    def with_private(self, private: bytes, passphrase: bytes) -> StoredKey:
        """Return the key with its private half encrypted under a new passphrase."""
        return replace(self, box=boxed(private, passphrase, self._beside()))

    def opened(self, passphrase: bytes) -> bytes:
        """Return the private half. SealError if it is not here, or if the passphrase is wrong."""
        self._check_here()
        if self.token is not None:
            raise SealError(
                f"the private half of the key {self.id} never leaves its token",
                advice="Make another key on another token, and let it be registered.",
            )
        private = unboxed(self.box, passphrase, self._beside())
        if len(private) != LENGTH or public_of(private) != self.public:
            raise SealError(f"the two halves of the key {self.id} do not belong together")
        return private

    def signer(self, passphrase: bytes) -> Signer:
        """Return what signs with this key. The passphrase of a key on a token is its PIN.

        SealError if the private half is not here, or if the passphrase is wrong. A wrong PIN is
        found when the token signs.
        """
        self._check_here()
        token = self.token
        if token is None:
            private = self.opened(passphrase)
            return lambda kind, payload: sealed(private, kind, payload)

        def signed_there(kind: str, payload: bytes) -> Envelope:
            signature = token.signature(passphrase, pae(kind, payload))
            envelope = Envelope(kind, payload, self.identity, signature)
            if not is_signed(envelope, self.public):
                raise SealError(f"the token has not signed with the key {self.id}")
            return envelope

        return signed_there

    def prove(self, passphrase: bytes) -> None:
        """Raise SealError unless this passphrase, or PIN, lets the key sign. Nobody keeps what is
        signed.
        """
        self.signer(passphrase)(PROOF, os.urandom(32))

    def _check_here(self) -> None:
        if self.box is None:
            raise SealError(
                f"the private half of the key {self.id} is not in this store",
                advice="Sign where it is, or import your copy of it.",
            )

    def _beside(self) -> bytes:
        said = {"person": self.person, "role": self.role, "public": base64_text(self.public)}
        return canonical(said)

    def as_file(self) -> dict[str, Json]:
        """Return the content of the key's file, as plain values."""
        return {
            "format": FORMAT,
            "version": 1,
            "id": self.id,
            "person": self.person,
            "role": self.role,
            "public": base64_text(self.public),
            "made": self.made,
            "revoked": self.revoked,
            "private": self.box,
        }


def key_of_file(values: Json) -> StoredKey:
    """Return the key in the content of a file. SealError if the content is no key."""
    if not isinstance(values, dict) or set(values) != _MEMBERS:
        raise SealError("this is no key that Studio has written")
    if values["format"] != FORMAT or values["version"] != 1 or type(values["version"]) is not int:
        raise SealError("this is no key that Studio has written")
    texts = ("id", "person", "role", "public", "made", "revoked")
    if not all(isinstance(values[key], str) and len(values[key]) <= 1000 for key in texts):
        raise SealError("a member of this key is no text")
    public = from_base64(values["public"], "the public half")
    if len(public) != LENGTH:
        raise SealError(f"the public half of this key has not {LENGTH} bytes")
    check_id(values["id"])
    check_words(values["person"], values["role"])
    if is_token(values["private"]):
        token_key(values["private"])
    elif values["private"] is not None:
        read_box(values["private"])
    return StoredKey(
        values["id"],
        values["person"],
        values["role"],
        public,
        values["made"],
        values["revoked"],
        values["private"],
    )


def check_id(name: str) -> None:
    """Raise UsageError if a text cannot be the local name of a key."""
    if not _ID.fullmatch(name):
        raise UsageError(
            f"{name[:80]!r} cannot be the local name of a key",
            advice="Use letters, digits, dots, - and _, at most 64, and begin with a letter.",
        )


def check_words(person: str, role: str) -> None:
    """Raise UsageError if the words cannot be the name of a person and of a role."""
    for word, what in ((person, "person"), (role, "role")):
        if not word.strip() or len(word) > 1000:
            raise UsageError(f"the name of the {what} is empty or very long")


def new_id(person: str, role: str, taken: Mapping[str, StoredKey]) -> str:
    """Return a local name for a new key, made of its person and role. It is not in ``taken``."""
    plain = re.sub(r"[^a-z0-9]+", "-", f"{person} {role}".casefold()).strip("-")[:50] or "key"
    name, count = plain, 1
    while name.casefold() in {one.casefold() for one in taken}:
        count += 1
        name = f"{plain}-{count}"
    return name


def stored_keys() -> dict[str, StoredKey]:
    """Return all keys of the store by their local names.

    SealError if another person could have written a file, or if a file is no key.
    """
    folder = _folder()
    try:
        files = sorted(path for path in folder.iterdir() if path.suffix == ".json")
    except (FileNotFoundError, NotADirectoryError):
        return {}
    found: dict[str, StoredKey] = {}
    for path in files:
        key = key_of_file(read_stored(path))
        if path.name != f"{key.id}.json":
            raise SealError(f"{path} has the key {key.id}", advice="Give the file its own name.")
        found[key.id] = key
    return found


def stored_key(name: str) -> StoredKey:
    """Return the key with a local name or an identity. UsageError if there is none."""
    keys = stored_keys()
    for key in keys.values():
        if name in (key.id, key.identity):
            return key
    raise UsageError(
        f"there is no key {name!r} in your store",
        advice=did_you_mean(name, keys) or "smsl-studio keys list shows the keys.",
    )


def keep_key(key: StoredKey) -> None:
    """Write a key into the store. SaveError if it cannot be written."""
    check_id(key.id)
    write_stored(_folder() / f"{key.id}.json", key.as_file())


def _folder() -> Path:
    return store_folder() / "keys"
