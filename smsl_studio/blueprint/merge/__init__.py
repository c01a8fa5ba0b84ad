"""Merges two versions of a blueprint that come from the same one: by meaning, not by lines.

``merge`` takes what only one side changed, and what both changed alike. The rest are conflicts. A
conflict keeps the value of the first side, and stands in the merged file under ``_conflicts``.
"""

from smsl_studio.blueprint.merge.choice import Side, choose, choose_all, chosen_side, open_conflicts
from smsl_studio.blueprint.merge.conflict import ABSENT, KEY, Conflict
from smsl_studio.blueprint.merge.merge import Merge, merge
from smsl_studio.blueprint.merge.written import read_conflicts

__all__ = [
    "ABSENT",
    "KEY",
    "Conflict",
    "Merge",
    "Side",
    "choose",
    "choose_all",
    "chosen_side",
    "merge",
    "open_conflicts",
    "read_conflicts",
]
