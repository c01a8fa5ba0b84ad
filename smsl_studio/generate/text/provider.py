"""Who answers: a reader without a model, a person, kept answers, or a server."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from smsl_studio.generate.text.equipment import NeededEquipment, PluginOffer
from smsl_studio.generate.text.expert_text import ExpertText
from smsl_studio.generate.text.functions import NeededFunction
from smsl_studio.generate.text.passages import Passage
from smsl_studio.generate.text.steps import TextProcedure

Json = Any


@dataclass
class Matter:
    """What is known at a stage: the texts, and the answers of the stages before."""

    texts: Sequence[ExpertText]
    hardware: Sequence[ExpertText] = ()
    passages: Sequence[Passage] = ()
    """What other texts say about the procedure."""
    offers: Sequence[PluginOffer] = ()
    procedure: TextProcedure | None = None
    equipment: NeededEquipment | None = None
    needed: Mapping[str, NeededFunction] = field(default_factory=dict)
    """The operations without a function."""
    names: Mapping[str, str] = field(default_factory=dict)
    """The names of their files."""

    @property
    def sources(self) -> tuple[ExpertText, ...]:
        """The texts that may be cited, without those of the hardware."""
        others = {one.text.file: one.text for one in self.passages}
        return (*self.texts, *others.values())


@dataclass(frozen=True)
class StageQuestion:
    """A question: the stage, the prompt, how often it was asked before, and the matter."""

    stage: str
    prompt: str
    attempt: int
    matter: Matter


@dataclass(frozen=True)
class StageAnswer:
    """The text of an answer, who gave it, and with which parameters."""

    text: str
    model: str
    parameters: Mapping[str, Json] = field(default_factory=dict)


class Unanswered(Exception):  # noqa: N818
    """Nobody has answered yet. ``sentence`` says what is missing, and where."""

    def __init__(self, sentence: str, advice: str = "") -> None:
        super().__init__(sentence)
        self.sentence, self.advice = sentence, advice


class StageProvider(Protocol):
    """Answers questions. ``by_file`` says that answers are files, ``attempts`` how often it may be
    asked about one stage."""

    by_file: bool
    attempts: int

    def answer(self, question: StageQuestion) -> StageAnswer:
        """Return the answer. Unanswered if there is none."""
