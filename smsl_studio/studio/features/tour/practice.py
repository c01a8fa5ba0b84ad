"""The blueprint of the tour: the Tower of Hanoi with one mislabelled operation."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.repair import mend
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.shipped import samples_dir

SAMPLE = "hanoi.json"
RULE = "R15"


def sample() -> Path:
    """The sample of which the tour opens a copy."""
    return samples_dir() / SAMPLE


def with_one_misprint(blueprint: Blueprint) -> Blueprint:
    """The blueprint with all mislabelled operations corrected but the first."""
    for finding in misprints(blueprint)[1:]:
        blueprint = mend(blueprint, finding)
    return blueprint


def misprints(blueprint: Blueprint) -> tuple[Finding, ...]:
    """The findings about mislabelled operations."""
    return inspect(blueprint, [RULE])


class Misprint:
    """The mislabelled operation of a blueprint, and what becomes of it."""

    def __init__(self, blueprint: Blueprint) -> None:
        finding = misprints(blueprint)[0]
        self.address = finding.address
        self._right = self._ways(mend(blueprint, finding))

    def is_mended(self, blueprint: Blueprint) -> bool:
        """Whether the operations of its state have the right names and targets."""
        return self._ways(blueprint) == self._right

    def is_there(self, blueprint: Blueprint) -> bool:
        """Whether the operation has its wrong name still."""
        return self.address.operation in self._ways(blueprint)

    def _ways(self, blueprint: Blueprint) -> Mapping[str, str]:
        """The operations of its state with their targets; none if the state is gone."""
        branch = blueprint.branches.get(self.address.branch)
        return dict(branch.table.get(self.address.state, {})) if branch is not None else {}
