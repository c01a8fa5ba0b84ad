"""Files and folders of other programs: which they are, and what blueprint they show."""

from __future__ import annotations

from typing import Any

from smsl_studio.errors import UsageError
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.rafcon import rafcon_folder, rafcon_values
from smsl_studio.exchange.table import READ, reader_of, suffix_of
from smsl_studio.smsl.files import read_content, text_of

Json = Any
MANIFEST = ".xml"


def is_foreign(file: str) -> bool:
    """Whether a file or folder is one of another program, as its name says."""
    return bool(suffix_of(file, READ) or rafcon_folder(file))


def foreign_values(file: str, findings: ExchangeFindings) -> dict[str, Json]:
    """Return the plain values of the blueprint that a file or folder shows.

    ReadError, with its place, if it cannot be read. UsageError if its name is none of these.
    """
    if folder := rafcon_folder(file):
        return rafcon_values(folder, findings)
    suffix = suffix_of(file, READ)
    if not suffix:
        words = f"the suffix of {file} is none of another program's form"
        raise UsageError(words, advice=f"Studio reads {', '.join(READ)}, and folders of RAFCON.")
    text = text_of(read_content(file), file)
    if suffix == MANIFEST:
        from smsl_studio.exchange.flexbe_manifest import behavior_file

        file = behavior_file(text, file, findings)
        suffix, text = ".py", text_of(read_content(file), file)
    return dict(reader_of(suffix)(text, file, findings))
