"""The public keys whose signatures may count, with the person and the roles of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime

from smsl_studio.blueprint.person_names import same_name
from smsl_studio.inspection.approval.statement import AUTOMATIC, RECORDER


@dataclass(frozen=True, slots=True)
class KnownKey:
    """A public key, its person, the roles of the person, and the time in which it may sign.

    ``revoked`` says why the key no longer counts; it is empty for a valid key.
    """

    public: bytes
    person: str
    roles: tuple[str, ...]
    since: datetime | None = None
    until: datetime | None = None
    revoked: str = ""

    @property
    def is_automatic(self) -> bool:
        """Whether a program or a recorder signs with this key. Such a signature never counts as a
        person's."""
        return not {AUTOMATIC, RECORDER}.isdisjoint(map(name_of, self.roles))

    def may_sign_at(self, moment: datetime) -> bool:
        """Whether the key is valid at a moment."""
        begun = self.since is None or self.since <= moment
        return begun and (self.until is None or moment <= self.until)


KnownKeys = Mapping[str, KnownKey]
"""Keys by their identities."""


def name_of(person: str) -> str:
    """Return a person's name for comparison: without white space and in small letters.

    Characters that nobody sees do not matter either, so that one person does not count as two.
    """
    return same_name(person)
