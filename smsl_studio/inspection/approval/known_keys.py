"""The public keys that count, with the person and the roles of each."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime

from smsl_studio.inspection.approval.statement import AUTOMATIC


@dataclass(frozen=True, slots=True)
class KnownKey:
    """A public key: its person, the roles of that person, and when it may sign.

    ``revoked`` says why it does not count any more; it is empty for a good key.
    """

    public: bytes
    person: str
    roles: tuple[str, ...]
    since: datetime | None = None
    until: datetime | None = None
    revoked: str = ""

    @property
    def is_automatic(self) -> bool:
        """Whether a program signs with it. Such a key never counts as a person."""
        return AUTOMATIC in map(name_of, self.roles)

    def may_sign_at(self, moment: datetime) -> bool:
        """Whether the key is valid at a moment."""
        begun = self.since is None or self.since <= moment
        return begun and (self.until is None or moment <= self.until)


KnownKeys = Mapping[str, KnownKey]
"""Keys by their identities."""


def name_of(person: str) -> str:
    """Return the name by which persons are told apart: without regard to case and white space."""
    plain = unicodedata.normalize("NFKC", person).casefold()
    return "".join(char for char in plain if not char.isspace())
