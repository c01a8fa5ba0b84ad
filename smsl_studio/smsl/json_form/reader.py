"""Reads JSON: from text to Document. ``spans`` finds the places later."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from math import isfinite
from typing import TYPE_CHECKING, Any, NoReturn

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.budget import refused_by_budget
from smsl_studio.smsl.document.limits import MAX_DEPTH, too_large
from smsl_studio.smsl.json_form.characters import ESCAPED_HALF, half_pair
from smsl_studio.smsl.json_form.count import beyond_budget
from smsl_studio.smsl.json_form.quick import LONG, quick_values
from smsl_studio.smsl.json_form.spans import STRING, JsonSpans

if TYPE_CHECKING:
    from smsl_studio.smsl.document.comments import Comments

_BRACKET = re.compile(STRING.pattern + r"|[\[{]|[\]}]", re.DOTALL)


def parse(text: str, file: str) -> Document:
    """Read a JSON text. ReadError, with all its faults, if it is not a JSON object.

    A BOM is accepted and kept. A doubled key is no error: the last value counts, in the place of
    the first, and ``Document.duplicates`` finds all of them.
    """
    over = beyond_budget(text)
    if over is not None:
        raise refused_by_budget(Document(text, file, "json", {}, JsonSpans), over)
    quick = quick_values(text.removeprefix("\ufeff"), MAX_DEPTH) if len(text) >= LONG else None
    values, doubled = (quick, False) if quick is not None else _exact_values(text, file)
    return Document(text, file, "json", values, JsonSpans, doubled)


def recover(text: str, file: str) -> Document:
    """Return a document with everything that could be read of a faulty text, in the canonical
    layout.
    """
    from smsl_studio.smsl.json_form.recovery import Recovery

    values: Any = Recovery(text).values if beyond_budget(text) is None else {}
    return Document(write(values), file, "json", values, JsonSpans)


def form_within(text: str) -> str:
    """Return the other form in which a faulty text clearly is, or the empty text. It is empty too
    for a text that exceeds the limits.
    """
    from smsl_studio.smsl.json_form.refusals import other_form

    return other_form(text) if beyond_budget(text) is None else ""


def write(values: Mapping[str, Any], comments: Comments | None = None) -> str:
    """Return values as a new text in the canonical layout: four spaces, one member on each line.

    JSON has no comments, so ``comments`` are ignored. ValueError if JSON cannot express a value.
    """
    from smsl_studio.smsl.json_form.style import CANONICAL, render

    return render(dict(values), CANONICAL, "", 0) + "\n"


def comments_in(document: Document) -> Comments:
    """Return no comments, because JSON has none."""
    from smsl_studio.smsl.document.comments import NO_COMMENTS

    return NO_COMMENTS


def _exact_values(text: str, file: str) -> tuple[dict[str, Any], bool]:
    """Return the values, and whether a key is doubled, from the reader that reads every number
    exactly.
    """
    doubled = False

    def keep(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        """Return the object, and set ``doubled`` if a key occurs twice in it."""
        nonlocal doubled
        found = dict(pairs)
        if len(found) != len(pairs):
            doubled = True
        return found

    body = text.removeprefix("\ufeff")
    try:
        values = json.loads(
            body,
            object_pairs_hook=keep,
            parse_constant=_no_number,
            parse_float=_number,
            parse_int=_whole_number,
        )
    except (ValueError, RecursionError):
        raise _refusal(text, file) from None
    if (
        not isinstance(values, dict)
        or _is_deep(values)
        or (doubled and _hides_depth(text))
        or _has_half_pair(text)
    ):
        raise _refusal(text, file)
    return values, doubled


def _no_number(name: str) -> NoReturn:
    raise ValueError(name)


def _whole_number(text: str) -> int:
    if too_large(text):
        raise ValueError(text)
    return int(text)


def _number(text: str) -> float:
    """Return a float. ValueError if it is too large (Python would read infinity)."""
    value = float(text)
    if not isfinite(value):
        raise ValueError(text)
    return value


def _refusal(text: str, file: str) -> ReadError:
    from smsl_studio.smsl.json_form.refusals import refusal

    return refusal(text, file)


def _is_deep(values: Any) -> bool:
    """Return whether values are nested too deep. This is much faster than searching the text."""
    layer = [values]
    for _ in range(MAX_DEPTH):
        objects = (one.values() if isinstance(one, dict) else one for one in layer)
        layer = [value for inner in objects for value in inner if type(value) in (dict, list)]
        if not layer:
            return False
    return True


def _hides_depth(text: str) -> bool:
    """Return whether brackets are nested too deep, also in a value that a doubled key hides."""
    depth = 0
    for match in _BRACKET.finditer(text):
        if match[0] in "[{":
            depth += 1
            if depth > MAX_DEPTH:
                return True
        elif match[0] in "]}":
            depth -= 1
    return False


def _has_half_pair(text: str) -> bool:
    """Return whether the text has half a surrogate pair, which no file can hold."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return True
    if not ESCAPED_HALF.search(text):
        return False
    return any(half_pair(text, *found.span()) is not None for found in STRING.finditer(text))
