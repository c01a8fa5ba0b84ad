"""The design cycle of a blueprint as one value."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.approval_badge import ApprovalWords, approval_words
from smsl_studio.front.check_findings import CheckAnswer, whole_check
from smsl_studio.front.design.found import KeptVerdict, TextBeside, kept_verdicts
from smsl_studio.front.design.functions import NO_FUNCTIONS, FunctionsBeside
from smsl_studio.front.design.made_design import (
    branches_stage,
    states_stage,
    text_stage,
    whole_stage,
)
from smsl_studio.front.design.made_system import (
    approval_stage,
    code_stage,
    hardware_stage,
    inspection_stage,
    testing_stage,
)
from smsl_studio.front.design.matter import DesignMatter
from smsl_studio.front.design.next_steps import next_steps
from smsl_studio.front.design.notes import DesignNotes
from smsl_studio.front.design.parts import MadePart, made_parts
from smsl_studio.front.design.stages import WORDS, DesignStage, NextStep
from smsl_studio.generate.text.equipment import NeededEquipment
from smsl_studio.library.loaded import Loaded

_MAKE: tuple[Callable[[DesignMatter], DesignStage], ...] = (
    text_stage, states_stage, branches_stage, whole_stage, code_stage,
    hardware_stage, testing_stage, inspection_stage, approval_stage,
)  # fmt: skip


@dataclass(frozen=True)
class DesignCycle:
    """The nine stages, what is to be done next, and what is shown beside them.

    ``parts`` are states and operations with the words from which they were made. ``requirements``
    are the verdicts kept with the last generation. ``digests`` are those of what is there now, by
    the names that notes use, and ``generation`` is the blueprint as it was generated last.
    ``fault`` says why notes beside the file were passed over.
    """

    stages: tuple[DesignStage, ...]
    next: tuple[NextStep, ...]
    parts: tuple[MadePart, ...]
    texts: tuple[TextBeside, ...]
    hardware: tuple[TextBeside, ...]
    requirements: tuple[KeptVerdict, ...]
    notes: DesignNotes
    digests: dict[str, str]
    check: CheckAnswer
    approval: ApprovalWords
    functions: FunctionsBeside = NO_FUNCTIONS
    equipment: NeededEquipment | None = None
    generation: Blueprint | None = None
    fault: str = ""

    def stage(self, number: int) -> DesignStage:
        """Return a stage by its number, 1 to 9."""
        return self.stages[number - 1]

    def counts(self) -> dict[str, int]:
        """Return how many stages stand how."""
        found: dict[str, int] = {}
        for one in self.stages:
            found[one.standing] = found.get(one.standing, 0) + 1
        return found


def design_cycle(
    blueprint: Blueprint,
    path: Path | None = None,
    loaded: Loaded | None = None,
    approval: ApprovalWords | None = None,
    check: CheckAnswer | None = None,
) -> DesignCycle:
    """Return the design cycle of a blueprint, with what lies beside its file ``path``.

    ``loaded`` is what plugins offer, ``approval`` the words of the badge and ``check`` the whole
    check; what is not given is found out, which may take long and heeds a stop. Nothing that lies
    there is run. What cannot be read is told as missing and raises nothing.
    """
    said, result = approval or approval_words(blueprint), check or whole_check(blueprint)
    matter = DesignMatter(blueprint, path, said, result, loaded)
    made = tuple(_inherited(make(matter) for make in _MAKE))
    return DesignCycle(
        made,
        next_steps(made, matter),
        made_parts(blueprint),
        matter.texts,
        matter.hardware_texts,
        kept_verdicts(matter.folder),
        matter.notes,
        matter.digests,
        result,
        said,
        matter.functions,
        matter.equipment,
        matter.generation,
        matter.fault,
    )


def _inherited(made: Iterator[DesignStage]) -> Iterator[DesignStage]:
    """Yield the stages, each also with what changed below the stages of which it is made."""
    changed: dict[int, set[int]] = {}
    for one in made:
        if one.maker is not None:
            below = {at for number in WORDS[one.number].made_of for at in changed.get(number, ())}
            changed[one.number] = {*one.own, *below}
            yield replace(one, changed=tuple(sorted(changed[one.number])))
        else:
            yield one
