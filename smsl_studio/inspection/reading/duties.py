"""The sections "Who may do what" and "What is watched"."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.continuum import AUTOMATIC, HUMAN, SHARED
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.predicates.shown import shown_predicate, shown_sources
from smsl_studio.inspection.reading.plain_names import duration, listed, opened, people
from smsl_studio.inspection.reading.sections import ReadingLine, ReadingSection, bounded
from smsl_studio.inspection.reading.step_words import SYSTEM, StepWords, answer_time

_SUPERVISION = {
    HUMAN: "A person lets each step of the way begin.",
    SHARED: "A person may step in at any moment. No person is needed to let a step begin.",
    AUTOMATIC: "An automatic supervisor decides about each step.",
}
_INSPECTION = {
    HUMAN: "A person accepts what the inspection found before anything moves.",
    SHARED: "A person accepts what the inspection found, if it found errors or warnings.",
    AUTOMATIC: "Rules alone decide whether the procedure may start.",
}
ANYBODY = ""


def duties(words: StepWords) -> ReadingSection:
    """Return who carries out, agrees, answers, supervises and inspects."""
    roles = list(_by_role(words))
    lines = [*bounded(roles, len(roles), "role"), *_alone(words)]
    lines.append(ReadingLine("Supervision", (_SUPERVISION[words.levels.supervision],)))
    lines.append(ReadingLine("Inspection", (_INSPECTION[words.levels.inspection],)))
    return ReadingSection("duties", "Who may do what", tuple(lines))


def _by_role(words: StepWords) -> Iterator[ReadingLine]:
    tasks: dict[str, dict[str, dict[str, None]]] = {}

    def put(role: str, verb: str, thing: str) -> None:
        tasks.setdefault(role, {}).setdefault(verb, {})[thing] = None

    for branch in words.blueprint:
        for edge in words.one_of_each(branch) if words.levels.people_do(branch.name) else ():
            note, level = words.note(edge), words.levels.operation(edge)
            title = words.names.quoted(edge)
            if level == HUMAN:
                for role in note.roles or (ANYBODY,):
                    put(role, "Carries out", title)
            for role in note.confirm or ((ANYBODY,) if level == SHARED else ()):
                put(role, "Agrees before it begins", title)
            if note.escalates_to and (level in (HUMAN, SHARED) or note.confirm):
                put(note.escalates_to, "May answer in place of others, when half of the time is "
                    "over", title)  # fmt: skip
        for digit in _own_digits(branch):
            level = words.levels.fact(branch.name, digit)
            told = branch.fact_note(digit)
            if level == AUTOMATIC:
                continue
            verb = "Says" if level == HUMAN else "Says, if no sensor tells it"
            for role in _asked(told):
                put(role, verb, words.names.fact(branch, digit))
    for role, verbs in tasks.items():
        heading = opened(people([role]))
        text = [f"{verb}: {listed(list(things))}." for verb, things in verbs.items()]
        yield ReadingLine(heading, tuple(text))


def _asked(note: FactNote | None) -> tuple[str, ...]:
    return note.roles if note is not None and note.roles else (ANYBODY,)


def _alone(words: StepWords) -> Iterator[ReadingLine]:
    titles: dict[str, None] = {}
    for edge in words.one_of_each():
        if words.levels.operation(edge) == AUTOMATIC and not words.note(edge).confirm:
            titles[words.names.quoted(edge)] = None
    if titles:
        yield ReadingLine(SYSTEM, (f"Without a person: {listed(list(titles))}.",))


def watched(words: StepWords) -> ReadingSection:
    """Return what is known of each fact: its values, its source and its age."""
    facts = [(branch, digit) for branch in words.blueprint for digit in _own_digits(branch)]
    lines = bounded((_fact(words, *one) for one in facts), len(facts), "fact")
    return ReadingSection("watched", "What is watched", lines)


def _own_digits(branch: StateBranch) -> Iterator[int]:
    digits = range(branch.num_facts if branch.table else 0)
    return (digit for digit in digits if digit not in branch.subs)


def _fact(words: StepWords, branch: StateBranch, digit: int) -> ReadingLine:
    note = branch.fact_note(digit)
    values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
    known = dict.fromkeys(
        (*values, *(note.values if note else ()), *(note.failure if note else ()))
    )
    said = [words.names.value(branch, digit, value) for value in known]
    text = [f"It can be: {', or '.join(said[:8])}{', and so on' if len(said) > 8 else ''}."]
    text += list(_source(words, branch, digit, note))
    return ReadingLine(words.names.fact(branch, digit), tuple(text), about=(Address(branch.name),))


def _source(
    words: StepWords, branch: StateBranch, digit: int, note: FactNote | None
) -> Iterator[str]:
    source = words.source(branch, digit)
    level = words.levels.fact(branch.name, digit)
    sensors = note.sensors if note is not None else ()
    measured = note is not None and isinstance(note.predicate, dict)
    if level == AUTOMATIC and not sensors and not measured:
        yield "No sensor is written down. Where the world has none either, it is believed from "\
              "the steps that were done."  # fmt: skip
    elif sensors or not measured:
        yield f"{opened(source)}."
    if note is None:
        return
    if isinstance(note.predicate, dict):
        yield f"It is decided from what is measured: {shown_sources(note.sources)}."
        for value, text in note.predicate.items():
            yield f"It is {words.names.value(branch, digit, value)} if {shown_predicate(text)}."
    elif note.predicate:
        unit = f" ({note.unit})" if note.unit else ""
        yield f"It counts by this measure: {note.predicate}{unit}."
    if len(sensors) > 1:
        yield _agreement(note, len(sensors))
    if note.max_age is not None:
        yield f"A reading that is older than {duration(note.max_age)} counts as unknown."
    if note.critical:
        yield (
            "Critical: if it is not as it should be while a step runs, or not known, the step is "
            "stopped and the procedure holds."
        )
    if level != AUTOMATIC and note.question:
        yield f"The question is: “{note.question}”"
    if level != AUTOMATIC:
        if note.roles:
            yield f"It is answered by {people(note.roles)}."
        if late := answer_time(note):
            yield f"{late} Without an answer the fact is not known."


def _agreement(note: FactNote, many: int) -> str:
    """Return how several sensors become one value (``docs/monitoring.md``)."""
    if note.aggregation == "all":
        return "All of them must report, and they must agree."
    if note.aggregation == "k_of_n":
        return f"{many if note.k is None else note.k} of them must agree."
    if note.aggregation == "priority":
        rest = ", and no other may say otherwise" if note.critical else ""
        return f"The first of them that reports counts{rest}."
    return "One of them is enough; those that report must agree."
