"""What each rule is worth: how many of some seeded faults it found in files that had none before.

The figures are measured by ``./dev bench seeded``, and ship with the program.
"""

from __future__ import annotations

import json
from collections.abc import Mapping

from smsl_studio.inspection.approval.statement import SignedScore
from smsl_studio.shipped import resources_dir


def rule_scores() -> Mapping[str, SignedScore]:
    """Return the score of each rule, by the number of the rule."""
    told = json.loads((resources_dir() / "rule_scores.json").read_bytes())
    return {
        rule: SignedScore(found=found, of=told["faults"]) for rule, found in told["found"].items()
    }
