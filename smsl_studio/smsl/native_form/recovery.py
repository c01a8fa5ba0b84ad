"""Recovers the sound parts of a faulty text."""

from __future__ import annotations

from smsl_studio.smsl.document import Document
from smsl_studio.smsl.native_form.parser import NativeParser, parse
from smsl_studio.smsl.native_form.writer import write


def recover(text: str, file: str) -> Document:
    """Return a new document with everything that could be read of a faulty text."""
    return parse(write(NativeParser(text, file).values), file)
