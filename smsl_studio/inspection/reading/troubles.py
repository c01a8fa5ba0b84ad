"""The section "If something goes wrong": what is seen, what the system does, and who decides."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.continuum import AUTOMATIC
from smsl_studio.blueprint.failure_states import failures
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.inspection.proof.recovery import WayOut
from smsl_studio.inspection.reading.plain_names import counted, listed, opened
from smsl_studio.inspection.reading.reading_grounds import ReadingGrounds
from smsl_studio.inspection.reading.sections import ReadingLine, ReadingSection
from smsl_studio.inspection.reading.step_words import StepWords

MOST_SITUATIONS = 5
"""Of a failure in more situations the first ones are told and the others counted."""
_ALWAYS = (
    ReadingLine(
        "A step fails or takes too long",
        (
            "Nothing is undone by itself, and the facts are read again.",
            "If they are still as before the step, the system looks for another way. The step that "
            "failed is left out until a person allows it again.",
            "If they are otherwise, or nothing else leads on, the procedure holds.",
        ),
        who="A person decides how a procedure that holds goes on",
    ),
    ReadingLine(
        "A sensed fact is not as the procedure expects",
        ("The step under way is stopped, and the procedure holds.",),
        who="A person says whether to go on from what is sensed",
    ),
    ReadingLine(
        "A sensor is silent, late, or contradicts another one",
        (
            "The fact is then unknown. Unknown never counts as true.",
            "No step begins that needs this fact. If the step under way requires it, or if the "
            "fact is critical, that step is stopped and the procedure holds.",
        ),
    ),
)


def troubles(words: StepWords, grounds: ReadingGrounds) -> ReadingSection:
    """Return the section: what always holds, then each failure that the blueprint names."""
    lines = [*_ALWAYS, _stop(words), *_failures(words, grounds)]
    return ReadingSection("wrong", "If something goes wrong", tuple(lines))


def _stop(words: StepWords) -> ReadingLine:
    who = "An automatic supervisor decides; a person at the computer can stop too"
    if words.levels.supervision != AUTOMATIC:
        who = "Whoever supervises the procedure"
    text = "Stop ends the procedure. Pause holds it, and it can go on."
    return ReadingLine("Somebody wants to stop", (text,), who=who)


def _failures(words: StepWords, grounds: ReadingGrounds) -> Iterator[ReadingLine]:
    ways = {one.state: one for one in grounds.ways}
    found: dict[tuple[str, int, str], list[WayOut]] = {}
    for address, way in ways.items():
        for digit, value in failures(words.blueprint[address.branch], address.state):
            found.setdefault((address.branch, digit, value), []).append(way)
    for branch in words.blueprint:
        for digit, note in sorted(branch.notes.facts.items()):
            for value in note.failure if digit < branch.num_facts else ():
                some = found.get((branch.name, digit, value), [])
                yield _failure(words, grounds, branch, (digit, value), some)


def _failure(
    words: StepWords,
    grounds: ReadingGrounds,
    branch: StateBranch,
    fact: tuple[int, str],
    ways: list[WayOut],
) -> ReadingLine:
    digit, value = fact
    text = [f"How it is seen: {words.source(branch, digit)}."]
    inner = tuple(_way(words, grounds, way) for way in ways[:MOST_SITUATIONS])
    if not ways:
        text.append("No situation of the procedure is described for it: the procedure holds.")
    elif len(ways) > MOST_SITUATIONS:
        many = counted(len(ways), "situation")
        text.append(f"It can be so in {many}; the first {MOST_SITUATIONS} are told here.")
    return ReadingLine(
        opened(words.names.fact_is(branch, digit, value)),
        tuple(text),
        open_point=not ways or any(_is_open(grounds, way) for way in ways),
        about=tuple(way.state for way in ways),
        inner=inner,
    )


def _is_open(grounds: ReadingGrounds, way: WayOut) -> bool:
    """Return whether no way leads out of a failure, or none from there to the end."""
    return way.path is None or (bool(way.path) and grounds.costs.get(way.state) is None)


def _way(words: StepWords, grounds: ReadingGrounds, way: WayOut) -> ReadingLine:
    branch = words.blueprint[way.state.branch]
    heading = f"While {words.names.facts(branch, enumerate(branch.facts(way.state.state)))}"
    if way.path is None:
        text = f"It is not shown whether there is a way out: {way.bound}." if way.bound else (
            "There is no way out that the blueprint permits."
        )  # fmt: skip
        return ReadingLine(heading, (text,), open_point=True, about=(way.state,))
    if not way.path:
        return ReadingLine(heading, ("The procedure may rest here.",), about=(way.state,))
    onward = "From there it goes on to the end."
    if grounds.costs.get(way.state) is None:
        onward = "From there no way to the end is shown."
    return ReadingLine(
        heading,
        (f"The way out: {words.names.path(way.path)}.", onward),
        who=opened(_deciders(words, way.path)),
        open_point=_is_open(grounds, way),
        about=(way.state,),
    )


def _deciders(words: StepWords, path: tuple[Address, ...]) -> str:
    who = dict.fromkeys(words.who(edge) for edge in path)
    return f"carried out by: {listed([one[:1].lower() + one[1:] for one in who])}"
