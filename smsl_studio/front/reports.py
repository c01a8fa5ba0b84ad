"""Writes the report: the reading of a blueprint with its pictures, as one HTML or PDF file."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import PurePath
from typing import TYPE_CHECKING

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.recorded import blueprint_of_content
from smsl_studio.errors import UsageError
from smsl_studio.front.approval_badge import approval_words
from smsl_studio.front.former_record import newest_content
from smsl_studio.front.outputs import colours_of, map_panels, panels_of, svg_pages
from smsl_studio.front.readings import CLINICIAN, reading
from smsl_studio.smsl.files import save_document

if TYPE_CHECKING:
    from smsl_studio.inspection.reading.reading_page import Illustration
    from smsl_studio.inspection.reading.sections import BlueprintReading

Name = str | os.PathLike[str]
REPORTS = (".html", ".pdf")
MOST_DRAWN = 120
"""The largest number of states in all pictures: on a page nobody could read more."""
MOST_LINED = 600
"""The largest number of operations in all pictures."""
MUCH = 5_000
"""Of a blueprint with more operations nothing but the map is drawn: laying out takes too long."""
MOST_PARTS = 40
"""The largest number of SBs in the map."""


def report(
    blueprint: Blueprint, output: Name, record: str | None = None, reader: str = CLINICIAN
) -> BlueprintReading:
    """Write the reading of a blueprint, with pictures, as ``.html`` or ``.pdf``. Return it.

    It says at its top whether people have signed the blueprint, as the badge of the window does
    without a policy. The HTML file loads nothing and runs nothing. The PDF has an outline and tags.
    Equal blueprints give equal files on the same day. ``record`` is a signed record: the report
    then begins with what has changed since. UsageError for another suffix or reader, ReadError for
    a record that cannot be read, SaveError if it cannot be written.

    >>> told = report(read("registration-people.json"), "registration.html")
    >>> told.untitled.sentence
    '8 states have no title or name of their own'
    """
    suffix = report_form(output)
    told = told_since(blueprint, record, reader)
    day = datetime.now(UTC).date().isoformat()
    said = [line if line.endswith(".") else f"{line}." for line in approval_words(blueprint).lines]
    page = report_page if suffix == ".html" else _sheet
    save_document(page(told, day, blueprint, said), output, made_of=files_of(blueprint))
    return told


def report_form(output: Name) -> str:
    """Return the suffix of a report's file. UsageError if it is none."""
    suffix = PurePath(output).suffix.lower()
    if suffix not in REPORTS:
        raise UsageError(
            f"{os.fspath(output)!r} is no name of a report", advice="Let it end in .html or .pdf."
        )
    return suffix


def told_since(blueprint: Blueprint, record: str | None, reader: str) -> BlueprintReading:
    """Return the reading, with what has changed since a record was signed, if one is named."""
    if record is None:
        return reading(blueprint, reader)
    name, content = newest_content(blueprint, record)
    if content is None:
        raise UsageError(f"{record} holds no record of this blueprint")
    return reading(blueprint, reader, against=blueprint_of_content(content, name), former=name)


def files_of(blueprint: Blueprint) -> tuple[str, ...]:
    """Return the files that a report is made of, none of which it may replace."""
    return tuple(document.file for document in blueprint.documents)


def report_page(
    told: BlueprintReading, day: str, blueprint: Blueprint, said: Sequence[str] = ()
) -> bytes:
    """Return a reading with the pictures of its blueprint as one HTML file.

    ``day`` is the date that it bears, such as ``2026-11-26``, or empty. ``said`` are sentences
    about who has signed the blueprint, the badge first.
    """
    from smsl_studio.inspection.reading.reading_page import reading_page

    return reading_page(told, day, tuple(_pictures(blueprint)), said).encode("utf-8", "replace")


def _sheet(told: BlueprintReading, day: str, blueprint: Blueprint, said: Sequence[str]) -> bytes:
    from smsl_studio.inspection.reading.reading_sheet import reading_sheet

    return reading_sheet(told, day, tuple(_pictures(blueprint)), said)


def _pictures(blueprint: Blueprint) -> Iterator[Illustration]:
    """Yield the map of the SBs and the drawing of each SB that can be read on a page."""
    from smsl_studio.inspection.reading.reading_page import Illustration

    colours = colours_of("light")
    if 1 < len(blueprint) <= MOST_PARTS:
        title = "How the parts of the procedure belong together"
        (svg,) = svg_pages(map_panels(blueprint, colours), title, colours, True)
        yield Illustration(title, svg)
    states = lines = left = 0
    for branch in blueprint:
        states, lines = states + len(branch.table), lines + branch.edge_count
        if not branch.table:
            continue
        if states > MOST_DRAWN or lines > MOST_LINED or blueprint.operation_count > MUCH:
            left += 1
            continue
        title = f"{branch.name}: situations and the steps between them"
        panels = panels_of(blueprint, [branch.name], colours, True)
        (svg,) = svg_pages(panels, title, colours, True)
        yield Illustration(title, svg)
    if left:
        parts = f"{left:,} part{'' if left == 1 else 's'} of the procedure"
        yield Illustration(
            f"{parts} {'is' if left == 1 else 'are'} not drawn",
            reason="A page has no room for so many situations. The window shows them.",
        )
