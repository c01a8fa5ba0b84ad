"""Text documents as PDF, made by typst without a library of the system."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from smsl_studio.errors import ConvertError

STANDARDS: tuple[Literal["a-2a"], Literal["ua-1"]] = ("a-2a", "ua-1")
"""PDF/A-2a (kept for a long time) and PDF/UA-1 (for screen readers). typst checks the file against
them as far as it can; nobody has validated it."""


def as_document(source: str, inputs: Mapping[str, str]) -> bytes:
    """Return the PDF of a typst source. ``inputs`` are its data. ConvertError if it cannot be
    written.
    """
    import typst

    try:
        made = typst.compile(
            source.encode("utf-8"),
            format="pdf",
            sys_inputs=dict(inputs),
            pdf_standards=[*STANDARDS],
        )
    except typst.TypstError as error:
        raise ConvertError(
            f"the report cannot be written as PDF: {error}",
            advice="Write it as HTML instead.",
        ) from None
    return bytes(made)
