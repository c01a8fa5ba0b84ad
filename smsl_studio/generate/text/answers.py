"""From the text of an answer to data: bounded JSON that fits a schema. Nothing of it is run."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

Json = Any
LONGEST_ANSWER = 2_000_000
"""The largest number of characters of an answer."""
_DEEPEST = 40
_MOST_TOLD = 20
Model = TypeVar("Model", bound=BaseModel)


class AnswerFault(Exception):  # noqa: N818
    """An answer does not fit. ``faults`` are sentences that are told to who gave it."""

    def __init__(self, faults: Sequence[str]) -> None:
        super().__init__("; ".join(faults))
        self.faults = tuple(faults)[:_MOST_TOLD]


def json_of(text: str, longest: int = LONGEST_ANSWER) -> dict[str, Json]:
    """Return the JSON object in an answer. Words around it, as models write them, are passed over.

    AnswerFault if there is none, or if it is too long, too deep, or has a name twice.
    """
    if len(text) > longest:
        raise AnswerFault([f"the answer has more than {longest:,} characters"])
    begin, end = text.find("{"), text.rfind("}")
    if begin < 0 or end < begin:
        raise AnswerFault(["the answer holds no JSON object"])
    body = text[begin : end + 1]
    if _depth(body) > _DEEPEST:
        raise AnswerFault([f"the answer is nested deeper than {_DEEPEST} levels"])
    try:
        found = json.loads(body, object_pairs_hook=_once, parse_constant=_refused)
    except (ValueError, RecursionError) as error:
        at = getattr(error, "pos", 0)
        more = "; its end seems to be missing" if at >= len(body) - 1 else ""
        raise AnswerFault([f"the answer is no JSON: {error}{more}"]) from None
    if not isinstance(found, dict):
        raise AnswerFault(["the answer is no JSON object"])
    return found


def fitted(kind: type[Model], values: Json) -> Model:
    """Return values as a model. AnswerFault with a sentence for each key that does not fit."""
    try:
        return kind.model_validate(values)
    except ValidationError as error:
        told = error.errors(include_url=False, include_input=False)
        raise AnswerFault(
            [f"{_place(one['loc']) or 'answer'}: {one['msg']}" for one in told]
        ) from None


def _place(parts: Sequence[int | str]) -> str:
    """Return where a value stands, with numbers from 1: ``device 2, kind``."""
    words: list[str] = []
    for part in parts:
        if isinstance(part, int) and words:
            words[-1] = f"{words[-1].removesuffix('s')} {part + 1}"
        else:
            words.append(str(part))
    return ", ".join(words)


def _once(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
    found = dict(pairs)
    if len(found) != len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"the name {twice[:100]!r} stands twice in one object")
    return found


def _refused(word: str) -> Json:
    raise ValueError(f"{word} is no number of JSON")


def _depth(text: str) -> int:
    """Return how deep brackets are nested, those in texts left out."""
    depth = deepest = 0
    inside = escaped = False
    for char in text:
        if inside:
            if escaped or char == "\\":
                escaped = not escaped
            elif char == '"':
                inside = False
        elif char == '"':
            inside = True
        elif char in "{[":
            depth += 1
            deepest = max(deepest, depth)
        elif char in "}]":
            depth -= 1
    return deepest
