"""What is to be done next in a design cycle, in the order of the stages, and who does it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from smsl_studio.front.design.matter import DesignMatter
from smsl_studio.front.design.stages import (
    APPROVAL,
    BRANCHES,
    CODE,
    FSM,
    HARDWARE,
    HFSM,
    INSPECTION,
    TESTING,
    TEXT,
    DesignStage,
    NextStep,
)
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.inspection.rules.sources import uncited
from smsl_studio.inspection.rules.words import counted

A_PERSON, BY_RULES = "a person", "rules"


def next_steps(made: Sequence[DesignStage], matter: DesignMatter) -> tuple[NextStep, ...]:
    """Return the steps. It does not follow from a stage below: that one has its own step."""
    return tuple(step for stage in made for step in _ASK[stage.number](stage, matter))


Ask = Callable[[DesignStage, DesignMatter], Iterator[NextStep]]


def _text(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    if stage.lacks:
        yield NextStep(TEXT, "choose the text again", A_PERSON)


def _states(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    bare = next(uncited(matter.blueprint), None)
    if stage.maker is None:
        yield NextStep(FSM, "generate it, or draw it", A_PERSON)
    elif stage.own:
        yield NextStep(FSM, "generate it again", A_PERSON)
    elif bare is not None and matter.origin.get("how") == "text":
        name = bare.operation or bare.state
        yield NextStep(FSM, f"cite {name} or drop it", A_PERSON, str(bare))
    elif stage.is_generated:
        yield NextStep(FSM, "read it against the text", A_PERSON)
        many = len(matter.notes.doubts)
        if many:
            yield NextStep(FSM, f"look again at {counted(many, 'point')}", A_PERSON)


def _branches(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    if stage.maker is None and matter.blueprint.state_count:
        yield NextStep(BRANCHES, "try which states could be a sub-SB", BY_RULES)
    elif stage.own:
        yield NextStep(BRANCHES, "try the cuts anew", BY_RULES)


def _whole(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    errors = matter.check.of(Severity.ERROR)
    if errors and matter.blueprint.state_count:
        words = f"mend {counted(len(errors), 'error')}"
        yield NextStep(HFSM, words, A_PERSON, str(errors[0].address))


def _code(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    if matter.blueprint.state_count and (stage.maker is None or stage.lacks):
        yield NextStep(CODE, "write the program", BY_RULES)
    elif stage.own:
        yield NextStep(CODE, "write the program again", BY_RULES)
    functions = matter.functions
    if functions.fault:
        yield NextStep(CODE, "mend the functions", A_PERSON)
    elif functions.unread:
        yield NextStep(CODE, f"read {counted(functions.unread, 'function')}", A_PERSON)
    elif functions.skeletons:
        yield NextStep(CODE, f"write {counted(functions.skeletons, 'function')}", A_PERSON)


def _hardware(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    if stage.maker is None and matter.blueprint.state_count:
        yield NextStep(HARDWARE, "bind operations, set levels", A_PERSON)
    elif stage.lacks:
        yield NextStep(HARDWARE, stage.lacks[:1].lower() + stage.lacks[1:], A_PERSON)
    elif stage.own:
        yield NextStep(HARDWARE, "look at it again", A_PERSON)


def _testing(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    if matter.blueprint.state_count and (stage.maker is None or stage.own or stage.lacks):
        yield NextStep(TESTING, "sweep every operation", BY_RULES)


def _inspection(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    if stage.lacks and not matter.check.of(Severity.ERROR):
        yield NextStep(INSPECTION, "look at what does not hold", A_PERSON)


def _approval(stage: DesignStage, matter: DesignMatter) -> Iterator[NextStep]:
    if matter.blueprint.state_count and stage.maker is None:
        yield NextStep(APPROVAL, "review it and sign", A_PERSON)
    elif stage.own or stage.lacks:
        yield NextStep(APPROVAL, "sign again", A_PERSON)


_ASK: dict[int, Ask] = {
    TEXT: _text, FSM: _states, BRANCHES: _branches, HFSM: _whole, CODE: _code,
    HARDWARE: _hardware, TESTING: _testing, INSPECTION: _inspection, APPROVAL: _approval,
}  # fmt: skip
