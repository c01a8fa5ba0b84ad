"""The case of a blueprint: everything that decides whether it is approved, as frozen values."""

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
    """A record that this user's store has seen: the identity of its key, its digest, and what it
    follows. It counts only if the key is known as one of the same person, so that a foreign
    register cannot make the records of others look old."""

    key: str
    digest: str
    follows: str | None


@dataclass(frozen=True, slots=True)
class TrustGrounds:
    """Whose signatures count: the policy, the keys, and what the user's store knows.

    ``registered`` says that the keys are those of a register. ``revoked`` has digests that the
    store revoked, with the reasons; with a register they do not count. ``given`` says that a file
    names the policy.
    """

    policy: TrustPolicy = USUAL
    keys: KnownKeys = field(default_factory=dict)
    registered: bool = False
    given: bool = False
    seen: tuple[SeenRecord, ...] = ()
    revoked: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class PresentState:
    """What is there now: the digests, the code of the rules, the code in a world, open errors.

    ``code`` is None where a world has no code, or where no world is asked about. ``missing`` says
    what is not there in that world.
    """

    digests: Digests
    rules: Mapping[str, str] = field(default_factory=dict)
    world: str | None = None
    code: WorldCode | None = None
    missing: str = ""
    errors: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ApprovalCase:
    """One blueprint with its records. ``uncovered`` says why a file that was not looked at again
    has no valid record of its own; it returns the empty text if it has one."""

    records: tuple[SignedRecord, ...] | Refusal
    grounds: TrustGrounds
    present: PresentState
    asking: Asking
    uncovered: Callable[[SignedFile], str]
