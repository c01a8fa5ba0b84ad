"""The section "Before you start": what must be so at the start, what is needed, and the end."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from smsl_studio.blueprint.continuum import AUTOMATIC, HUMAN
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.inspection.reading.plain_names import counted, listed, opened, people
from smsl_studio.inspection.reading.reading_grounds import ReadingGrounds
from smsl_studio.inspection.reading.sections import ReadingLine, ReadingSection, Untitled
from smsl_studio.inspection.reading.step_words import StepWords


def preparation(words: StepWords, grounds: ReadingGrounds, bare: Untitled) -> ReadingSection:
    """Return the section. A missing title is an open point, because its step cannot be read."""
    lines = [*_start(words, grounds), *_needs(words), *_end(words, grounds), *_bare(bare)]
    return ReadingSection("start", "Before you start", tuple(lines))


def _start(words: StepWords, grounds: ReadingGrounds) -> Iterator[ReadingLine]:
    if grounds.start is None:
        why = f"{grounds.refusal}." if grounds.refusal else "No start fits all parts."
        yield ReadingLine("The procedure cannot start", (why,), open_point=True)
        return
    said = [
        f"{_situation(words, branch, state)}."
        for branch, state in _own_states(words, grounds.start)
        if branch.num_facts
    ]
    yield ReadingLine(
        "The situation at the start",
        tuple(said),
        check="Each sensed fact is read before the first step. If one is otherwise, or is not "
        "known, nothing begins.",
    )


def _own_states(
    words: StepWords, configuration: Mapping[str, str]
) -> Iterator[tuple[StateBranch, str]]:
    for name, state in configuration.items():
        yield words.blueprint[name], state


def _situation(words: StepWords, branch: StateBranch, state: str) -> str:
    """Return the facts of a state that no sub-procedure shows, as a sentence."""
    values = enumerate(branch.facts(state))
    subs = words.blueprint.branches
    own = [(digit, value) for digit, value in values if branch.subs.get(digit) not in subs]
    said = [words.names.fact_is(branch, digit, value) for digit, value in own]
    return "; ".join(said) or opened(words.names.state(branch, state))


def _needs(words: StepWords) -> Iterator[ReadingLine]:
    sensors: dict[str, None] = {}
    roles: dict[str, None] = {}
    anybody = False
    for branch in words.blueprint:
        for note in branch.notes.facts.values():
            sensors.update(dict.fromkeys(note.sensors))
            roles.update(dict.fromkeys(filter(None, note.roles)))
        for edge in words.one_of_each(branch) if words.levels.people_do(branch.name) else ():
            one, level = words.note(edge), words.levels.operation(edge)
            asked = one.roles if level == HUMAN else one.confirm
            roles.update(dict.fromkeys(filter(None, asked)))
            anybody = anybody or (level != AUTOMATIC and not any(asked))
    who = [people([role]) for role in roles] + (["one person of any role"] if anybody else [])
    if who:
        yield ReadingLine("People who take part", (f"{opened(listed(who))}.",))
    if sensors:
        yield ReadingLine("Sensors that must report", (f"{listed(list(sensors))}.",))


def _end(words: StepWords, grounds: ReadingGrounds) -> Iterator[ReadingLine]:
    blueprint = words.blueprint
    said = [
        f"{_situation(words, blueprint[name], blueprint[name].activating)}."
        for name in blueprint.roots
        if blueprint[name].activating in blueprint[name].table
    ]
    if not said:
        return
    steps = () if grounds.steps is None else (f"It takes {counted(len(grounds.steps), 'step')}.",)
    yield ReadingLine(
        "The procedure is done when",
        (*said, *steps),
        check="This is read anew at the end, after the last step.",
    )


def _bare(bare: Untitled) -> Iterator[ReadingLine]:
    if bare.sentence:
        yield ReadingLine(
            "What this reading cannot tell",
            (f"{opened(bare.sentence)}.", "Ask the engineer to write them down."),
            open_point=True,
        )
