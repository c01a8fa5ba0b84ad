"""Reads JSON of other programs, with the limits of any blueprint."""

from __future__ import annotations

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.json_form import parse_json

_NO_OBJECT = "the file holds no State Branches"


def json_document(text: str, file: str) -> Document:
    """Return the document of a JSON object. ReadError, with its place, if it is none."""
    try:
        return parse_json(text, file)
    except ReadError as error:
        words = "it is no JSON object" if error.sentence == _NO_OBJECT else error.sentence
        raise ReadError(words, error.place, "Export it again, as JSON.") from None
