"""Writes values as a native text in the canonical layout."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.smsl.document.comments import Comments
from smsl_studio.smsl.native_form.comments import with_comments
from smsl_studio.smsl.native_form.style import CANONICAL, values_text


def write(values: Mapping[str, Any], comments: Comments | None = None) -> str:
    """Return values as a new text in the canonical layout. ConvertError if it cannot express them.

    An empty HEADER is left out, because it means the same as none.
    """
    text = values_text(values, CANONICAL)
    return with_comments(text, comments) if comments else text
