"""The generated functions beside a blueprint: which are written, and which a person has read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import StudioError
from smsl_studio.front.installed import generated_functions
from smsl_studio.generate.text.prompts import FILES, RMM
from smsl_studio.library.generated_proposal import GeneratedProposal, is_allowed


@dataclass(frozen=True)
class FunctionsBeside:
    """``written`` are the operations with a function, ``skeletons`` counts those without one.
    ``is_read`` says that a person has allowed just this code. ``fault`` says why none of it can be
    allowed."""

    written: tuple[str, ...] = ()
    skeletons: int = 0
    is_read: bool = False
    proposal: GeneratedProposal | None = None
    fault: str = ""

    @property
    def unread(self) -> int:
        """How many functions wait for a person who reads them."""
        return 0 if self.is_read else len(self.written)


NO_FUNCTIONS = FunctionsBeside()


def functions_beside(folder: Path) -> FunctionsBeside:
    """Return the functions in the folder of the RMM beside a blueprint. Nothing of them is run or
    loaded; what does not fit is told as a fault."""
    try:
        proposal = generated_functions(folder / FILES[RMM])
        if proposal is None:
            return NO_FUNCTIONS
        written = tuple(proposal.written())
        skeletons = len(proposal.manifest.generated) - len(written)
        read = bool(written) and is_allowed(proposal)
        return FunctionsBeside(written, skeletons, read, proposal)
    except (StudioError, OSError) as error:
        return FunctionsBeside(fault=getattr(error, "sentence", None) or str(error))
