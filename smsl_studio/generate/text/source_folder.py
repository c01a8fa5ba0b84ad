"""A folder of sources: which text describes the procedure, and which passages of the others go with
it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from smsl_studio.errors import ReadError
from smsl_studio.generate.text.expert_text import ExpertText
from smsl_studio.generate.text.passages import Passage, PassageIndex
from smsl_studio.generate.text.step_reader import read_steps
from smsl_studio.stop import heed

MOST_TRIED = 50
"""So many texts are looked at for steps."""


@dataclass(frozen=True)
class ChosenSources:
    """``procedure`` are the texts that describe it, ``passages`` what others say about it."""

    procedure: tuple[ExpertText, ...]
    passages: tuple[Passage, ...]


def chosen_sources(
    named: Sequence[ExpertText], folder: Sequence[ExpertText], wanted: Sequence[str]
) -> ChosenSources:
    """Choose from the texts of a folder. The procedure is what was ``named``; if nothing was, it is
    the text with steps that fits best what is ``wanted`` (the name of what is made)."""
    index = PassageIndex(folder)
    procedure = tuple(named) or (_with_steps(index, folder, wanted),)
    question = (line.text for text in procedure for line in text.lines)
    own = {id(text) for text in procedure}
    passages = [one for one in index.best(question) if id(one.text) not in own]
    return ChosenSources(procedure, tuple(passages))


def _with_steps(
    index: PassageIndex, folder: Sequence[ExpertText], wanted: Sequence[str]
) -> ExpertText:
    ranked = [one.text for one in index.best(wanted, len(folder))]
    order = list({id(text): text for text in (*ranked, *folder)}.values())
    for text in order[:MOST_TRIED]:
        heed()
        try:
            read_steps([text])
        except ReadError:
            continue
        return text
    return order[0]
