"""The digest of the parts of State Branches that are carried out."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from smsl_studio.blueprint.meaning import MeantBranch
from smsl_studio.seal.digest import digest_of

Json = Any
_RUNS = ("initial", "activating", "facts", "sub_sbs", "states")


def behaviour_values(branches: Iterable[MeantBranch]) -> list[Json]:
    """Return, as plain values, those parts of some SBs that decide how a run behaves.

    There is a pair for each SB: its name, and its states, operations and headers.
    """
    return [[one.name, {key: one.meaning[key] for key in _RUNS}] for one in branches]


def behaviour_of(branches: Iterable[MeantBranch]) -> str:
    """Return the SHA-256 of some SBs: their states, operations and headers, without annotations."""
    return digest_of(behaviour_values(branches))
