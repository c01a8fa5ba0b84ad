"""The procedures of a blueprint, as a run, a check and an approval ask for them."""

from __future__ import annotations

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import Procedures, procedures_of
from smsl_studio.dispatch.route.effort import refuse_too_large
from smsl_studio.errors import RunRefused
from smsl_studio.front.inputs import refuse_nonsense


def runnable_procedures(blueprint: Blueprint) -> Procedures:
    """Return the procedures of a blueprint. RunRefused if one of them cannot be run."""
    procedures = procedures_of(blueprint)
    if procedures.faults:
        fault = procedures.faults[0]
        raise RunRefused(f"{fault.branch}/{fault.key}: {fault.sentence}", advice=fault.advice)
    for part in procedures.parts:
        refuse_nonsense(part, "Mend the procedure, then run it again.")
        refuse_too_large(Hierarchy(part))
    return procedures
