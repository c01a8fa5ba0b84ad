"""The case of a blueprint: everything on which its approval depends, as frozen values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.digests import Digests
from smsl_studio.inspection.approval.conditions import Asking
from smsl_studio.inspection.approval.known_keys import KnownKeys
from smsl_studio.inspection.approval.policy import USUAL, TrustPolicy
from smsl_studio.inspection.approval.record_file import SignedRecord
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.statement import SignedFile, WorldCode


@dataclass(frozen=True, slots=True)
class SeenRecord:
    """A record that this user's store has seen.

    ``key`` is the identity of the signing key, and ``follows`` the digest of the record before it.
    The record counts only if the key is known as a key of the same person. Else a foreign register
    could make the records of other people look old. ``file`` is the real path for which it was
    first seen.

    If the record was signed here in a copy, while the first file still stood, it says nothing about
    that file: ``apart`` is its real path, and ``behind`` the digest of the record that the copy
    came from.
    """

    key: str
    digest: str
    follows: str | None
    file: str = ""
    apart: str = ""
    behind: str = ""


@dataclass(frozen=True, slots=True)
class TrustGrounds:
    """Whose signatures count, and which records the user's store knows.

    ``registered`` says that the keys come from a register. ``revoked`` has the digests that the
    user has revoked, with the reasons; they do not count if there is a register. ``given`` says
    that the policy comes from a file.
    """

    policy: TrustPolicy = USUAL
    keys: KnownKeys = field(default_factory=dict)
    registered: bool = False
    given: bool = False
    seen: tuple[SeenRecord, ...] = ()
    revoked: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class PresentState:
    """The present state: digests of the blueprint, code of the rules and of the world, open errors.

    ``code`` is None if the world has no code, or if no world is asked about. ``missing`` says what
    the world lacks.
    """

    digests: Digests
    rules: Mapping[str, str] = field(default_factory=dict)
    world: str | None = None
    code: WorldCode | None = None
    missing: str = ""
    errors: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ApprovalCase:
    """The records of one blueprint, and everything that is needed to judge them.

    ``uncovered`` takes an imported file that the signer did not check. It returns why that file has
    no valid record of its own, or the empty text if it has one. ``file`` is the real path of the
    blueprint; empty if it has none.
    """

    records: tuple[SignedRecord, ...] | Refusal
    grounds: TrustGrounds
    present: PresentState
    asking: Asking
    uncovered: Callable[[SignedFile], str]
    file: str = ""
