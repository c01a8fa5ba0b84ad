"""The lines about asking people, shared by the forms of operations and facts."""

from __future__ import annotations

from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.lines.line import FormLine
from smsl_studio.studio.base.lines.roles import RolesLine
from smsl_studio.studio.base.lines.text import NumberBounds, NumberLine, TextLine
from smsl_studio.studio.features.draw.panels.note_form import NoteForm

WITHIN = "120"
"""The default time for an answer, in seconds, shown as the placeholder."""


class AskingLines:
    """Question, roles, time and escalation.

    The lines are hidden if nobody is asked and nothing is written.
    """

    def __init__(self, form: NoteForm, question: str, hint: str) -> None:
        self.heading = label("What people are asked", "heading")
        self.heading.setContentsMargins(0, 6, 0, 0)
        form.column.addWidget(self.heading)
        self.question = form.add("question", TextLine("Question", question, hint)).field
        self.roles = form.add("roles", RolesLine(
            "Whose task", "A role for each person that must answer, with commas between; "
            "“anybody” is a person of any role", "one person, anybody"
        )).field  # fmt: skip
        self.within = form.add("answer_within", NumberLine(
            "Answer in", "Seconds of simulated time. Then the task has timed out, and "
            "the run holds", NumberBounds(0, open=True), "s", WITHIN
        )).field  # fmt: skip
        self.escalation = form.add("escalates_to", TextLine(
            "Then also", "The role that may answer too after half of the time", "nobody else"
        )).field  # fmt: skip
        words = ("question", "roles", "answer_within", "escalates_to")
        self._lines: dict[str, FormLine] = {word: form.line(word) for word in words}

    def show(self, asked: bool, written: frozenset[str]) -> None:
        """Show the lines if somebody is asked.

        A written line is always shown, so that it can be removed.
        """
        for word, line in self._lines.items():
            line.setVisible(asked or word in written)
        self.heading.setVisible(asked or bool(written & self._lines.keys()))
