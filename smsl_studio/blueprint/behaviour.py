"""The digest of the parts of State Branches that are carried out."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.blueprint.meaning import MeantBranch
from smsl_studio.seal.digest import digest_of

_RUNS = ("initial", "activating", "facts", "sub_sbs", "states")


def behaviour_of(branches: Iterable[MeantBranch]) -> str:
    """Return the SHA-256 of some SBs: their states, operations and headers, without annotations."""
    return digest_of([[one.name, {key: one.meaning[key] for key in _RUNS}] for one in branches])
