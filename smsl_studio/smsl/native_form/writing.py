"""Values as a native text in the canonical layout."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.smsl.native_form.style import CANONICAL, values_text


def write(values: Mapping[str, Any]) -> str:
    """Values as a new text in the canonical layout; ConvertError for what has no spelling.

    A HEADER with nothing in it is left out: it says as much as none.
    """
    return values_text(values, CANONICAL)
