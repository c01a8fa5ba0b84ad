"""What runs in some State Branches, as one digest."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.blueprint.meaning import MeantBranch
from smsl_studio.seal.digest import digest_of

_RUNS = ("initial", "activating", "facts", "sub_sbs", "states")


def behaviour_of(branches: Iterable[MeantBranch]) -> str:
    """SHA-256 of what runs in some SBs: states, operations, headers."""
    return digest_of([[one.name, {key: one.meaning[key] for key in _RUNS}] for one in branches])
