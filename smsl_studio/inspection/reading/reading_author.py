"""Writes the reading of a blueprint from its titles and from what the engine has shown."""

from __future__ import annotations

from pathlib import PurePath

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.reading.controls import controls
from smsl_studio.inspection.reading.duties import duties, watched
from smsl_studio.inspection.reading.line_keys import keyed
from smsl_studio.inspection.reading.line_sources import with_sources
from smsl_studio.inspection.reading.paper_notation import in_notation
from smsl_studio.inspection.reading.plain_names import PlainNames, untitled
from smsl_studio.inspection.reading.preparation import preparation
from smsl_studio.inspection.reading.procedure import Procedure
from smsl_studio.inspection.reading.reading_grounds import ReadingGrounds
from smsl_studio.inspection.reading.sections import BlueprintReading
from smsl_studio.inspection.reading.since import since
from smsl_studio.inspection.reading.step_words import StepWords
from smsl_studio.inspection.reading.troubles import troubles


def written_reading(
    blueprint: Blueprint, grounds: ReadingGrounds, identifiers: bool = False
) -> BlueprintReading:
    """Return a blueprint as sentences for people who have never seen a state machine.

    Nothing is invented: each sentence repeats a title, an annotation, or an answer of the engine in
    ``grounds``. With ``identifiers`` the names in the file stand behind the titles, and everything
    stands once more in the notation of the paper.
    """
    names = PlainNames(blueprint, identifiers)
    words = StepWords(names)
    bare = untitled(blueprint)
    procedure = Procedure(words, grounds)
    steps = procedure.section()
    sections = [
        preparation(words, grounds, bare),
        steps,
        procedure.others(),
        troubles(words, grounds),
        controls(words, grounds),
        duties(words),
        watched(words),
    ]
    if identifiers:
        sections.append(in_notation(blueprint))
    if grounds.difference is not None:
        sections.insert(0, since(names, grounds.difference, grounds.former))
    title, purpose = _purpose(blueprint)
    kept = keyed(blueprint, (one for one in sections if one.lines or one.lead))
    kept = with_sources(blueprint, kept)
    file = PurePath(blueprint.file).name
    return BlueprintReading(title or file, purpose, file, digests(blueprint).closure, kept, bare)


def _purpose(blueprint: Blueprint) -> tuple[str, str]:
    """Return the title, which is that of the situation at the end, and one sentence about it.

    Of several roots the one with the most states below it gives the title.
    """
    plain = "What happens, who does it, and how one knows that it is done."
    if not blueprint.roots:
        return "", plain
    branch = blueprint[max(blueprint.roots, key=lambda name: _weight(blueprint, name))]
    end, begin = (branch.state_note(state) for state in (branch.activating, branch.initial))
    title = end.title if end is not None else ""
    if not title or begin is None or not begin.title:
        return title, plain
    return title, f"From “{begin.title}” to “{title}”. {plain}"


def _weight(blueprint: Blueprint, root: str) -> int:
    """Return the number of states of an SB and all its sub-SBs."""
    found, waiting = {root}, [root]
    while waiting:
        for sub in blueprint[waiting.pop()].subs.values():
            if sub in blueprint.branches and sub not in found:
                found.add(sub)
                waiting.append(sub)
    return sum(len(blueprint[name].table) for name in found)
