"""The words on the buttons of each stage, and what each stage is, in a sentence."""

from __future__ import annotations

from typing import NamedTuple

from smsl_studio.front.design import stages

Button = tuple[str, str]
"""The words on a button and its tooltip."""


class StageActs(NamedTuple):
    """The buttons of a stage; None where there is none. ``start`` takes the place of ``edit`` as
    long as the stage was not begun."""

    hint: str
    act: Button | None
    edit: Button | None
    open: Button | None
    start: Button | None


AGAIN = (
    "Generate again…",
    "Make a new blueprint of the texts. The old one stays until you take it",
)
_DRAW = ("Edit by hand", "Go to the drawing")
FROM_TEXT = ("From text…", "Choose texts and make a blueprint of them")
_START = "Start by hand"

ACTS: dict[int, StageActs] = {
    stages.TEXT: StageActs(
        "What people who know the procedure have written, and which hardware is there.",
        FROM_TEXT,
        ("Edit by hand", "Open the text in the program for it"),
        ("Open", "Read the text here"),
        (_START, "Choose texts and make a blueprint of them"),
    ),
    stages.FSM: StageActs(
        "States and operations. Nothing of an answer was run, opened or fetched.",
        AGAIN, _DRAW, ("Open", "Show it in the drawing"), (_START, "Draw the first state"),
    ),
    stages.BRANCHES: StageActs(
        "Which states are a State Branch of their own, under a fact.",
        ("Try the cuts", "Let rules try which states could be a sub-SB"), _DRAW,
        ("Open", "Suggest sub-SBs, and cut one out"), (_START, "Attach a sub-SB in the drawing"),
    ),
    stages.HFSM: StageActs(
        "The whole blueprint, as it is inspected and signed.",
        AGAIN, _DRAW, ("Open", "Show the findings below the drawing"), (_START, "Draw it"),
    ),
    stages.CODE: StageActs(
        "A program that carries the blueprint out without Studio. Parts that you write in it stay.",
        ("Write the program…", "Write Python into a folder beside the blueprint"), None,
        ("Open", "Show the folder"), None,
    ),
    stages.HARDWARE: StageActs(
        "Which devices meet the needs, who acts and senses. Depends on the site.",
        AGAIN, ("Edit by hand", "Edit the levels"), ("Open", "Edit the levels"),
        (_START, "Edit the levels: who acts and senses"),
    ),
    stages.TESTING: StageActs(
        "Each operation alone (a sweep), and the whole with seeds and faults (a campaign).",
        ("Sweep now", "Run every operation alone, in the world that Run would use"), None,
        ("Open", "Go to the page Campaign"), None,
    ),
    stages.INSPECTION: StageActs(
        "Rules and proofs, before anything runs. The same each time.",
        None, None, ("Open", "Go to the page Inspection"), None,
    ),
    stages.APPROVAL: StageActs(
        "People look at every line in Review, and sign.",
        None, None, ("Open", "Go to Review"), (_START, "Look at it in Review, and sign"),
    ),
}  # fmt: skip
