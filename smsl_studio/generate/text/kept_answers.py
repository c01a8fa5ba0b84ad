"""``answers.json``: the prompts, the answers, who gave them and with which parameters, and digests.

The same answers give the same bytes, so ``replay`` makes the same blueprint of this file again.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.errors import Place, ReadError
from smsl_studio.generate.text.answers import AnswerFault, fitted, json_of
from smsl_studio.generate.text.expert_text import ExpertText
from smsl_studio.generate.text.provider import StageAnswer, StageQuestion, Unanswered
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.inputs import read_ordinary

Json = Any
LARGEST = 16 << 20
"""The largest size of a file of answers (bytes)."""


class KeptAnswer(BaseModel):
    """A question and its answer. ``faults`` say what was wrong with it, if anything was."""

    model_config = ConfigDict(extra="forbid", frozen=True, protected_namespaces=())
    stage: Literal["pm", "him", "psm", "rmm", "edges"]
    attempt: Annotated[int, Field(ge=1, le=100)]
    model: str
    parameters: dict[str, Json] = {}
    prompt: str
    prompt_digest: str
    answer: str
    answer_digest: str
    faults: tuple[str, ...] = ()


class _Kept(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)
    version: Literal[1]
    texts: tuple[dict[str, str], ...]
    hardware: tuple[dict[str, str], ...]
    answers: Annotated[tuple[KeptAnswer, ...], Field(max_length=100)]


@dataclass(frozen=True)
class AnsweredQuestion:
    """A question that was asked, its answer, and what was wrong with it."""

    question: StageQuestion
    answer: StageAnswer
    faults: tuple[str, ...] = ()

    @property
    def origin(self) -> dict[str, Json]:
        """Return how something was made of this answer (``_origin``)."""
        digest = sha256_hex(self.question.prompt.encode())
        return {"stage": self.question.stage, "model": self.answer.model, "prompt": digest}

    def kept(self) -> dict[str, Json]:
        """Return the plain values of a kept answer."""
        return {
            "stage": self.question.stage,
            "attempt": self.question.attempt,
            "model": self.answer.model,
            "parameters": dict(self.answer.parameters),
            "prompt": self.question.prompt,
            "prompt_digest": sha256_hex(self.question.prompt.encode()),
            "answer": self.answer.text,
            "answer_digest": sha256_hex(self.answer.text.encode("utf-8", "replace")),
            "faults": list(self.faults),
        }


def kept_page(
    answered: Sequence[AnsweredQuestion],
    texts: Sequence[ExpertText],
    hardware: Sequence[ExpertText],
) -> str:
    """Return the file of kept answers."""
    told = {
        "version": 1,
        "texts": [{"file": one.file, "digest": one.digest} for one in texts],
        "hardware": [{"file": one.file, "digest": one.digest} for one in hardware],
        "answers": [one.kept() for one in answered],
    }
    return json.dumps(told, ensure_ascii=True, indent=1) + "\n"


class KeptAnswers:
    """The provider ``replay``: gives kept answers again, in their order."""

    by_file = False
    attempts = 4

    def __init__(self, kept: Sequence[KeptAnswer], file: str) -> None:
        self._file = file
        self._kept: Mapping[tuple[str, int], KeptAnswer] = {
            (one.stage, one.attempt): one for one in kept
        }
        self.by_file = any(one.model == "by hand" for one in kept)

    def answer(self, question: StageQuestion) -> StageAnswer:
        """Return the kept answer of a stage. Unanswered if there is none."""
        found = self._kept.get((question.stage, question.attempt))
        if found is None:
            raise Unanswered(
                f"{self._file} has no answer {question.attempt} of stage {question.stage}",
                "Ask the provider that gave the others.",
            )
        return StageAnswer(found.answer, found.model, found.parameters)


def read_kept(path: str) -> KeptAnswers:
    """Return a provider that gives the answers kept in a file. ReadError if it holds none."""
    place = Place(path, 1, 1)
    try:
        raw = read_ordinary(path, LARGEST).raw
        kept = fitted(_Kept, json_of_file(raw))
    except OSError as error:
        raise ReadError(f"the file cannot be read: {error.strerror or error}", place) from None
    except (AnswerFault, UnicodeDecodeError, ValidationError) as error:
        advice = "Name an answers.json that generate text has written."
        raise ReadError(f"these are no kept answers: {error}", place, advice) from None
    for one in kept.answers:
        if sha256_hex(one.answer.encode("utf-8", "replace")) != one.answer_digest:
            sentence = f"answer {one.attempt} of stage {one.stage} is not what its digest says"
            raise ReadError(sentence, place, "Somebody has changed it: ask for it again.")
    return KeptAnswers(kept.answers, Path(path).name)


def json_of_file(raw: bytes) -> dict[str, Json]:
    """Return the JSON object in the bytes of a file. AnswerFault if there is none."""
    if len(raw) > LARGEST:
        raise AnswerFault([f"the file is larger than {LARGEST >> 20} MB"])
    return json_of(raw.decode("utf-8"), LARGEST)
