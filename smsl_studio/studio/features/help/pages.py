"""The pages of the help: the files of docs/, with their sections, in the order of the index."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from smsl_studio.shipped import docs_dir

GROUPS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("First steps", ("engineer.md", "clinician.md", "shown.md", "plugin-author.md")),
    ("The window", ("window.md", "access.md", "gestures.md", "pictures.md")),
    ("Blueprints", ("language.md", "inspection.md", "drilling.md", "procedures.md", "approval.md",
                    "design-cycle.md", "text.md")),
    ("Runs", ("running.md", "supervision.md", "people.md", "monitoring.md", "predicates.md",
              "room.md", "failures.md", "record.md", "evidence.md")),
    ("Commands and plugins", ("command-line.md", "plugins.md")),
    ("How it is built", ("architecture.md", "decisions/README.md", "decisions/canvas.md",
                         "decisions/child.md", "decisions/operations.md", "decisions/splice.md",
                         "decisions/stops.md", "decisions/threads.md", "benches.md")),
)  # fmt: skip
"""The index: titles of groups, and the files of each."""
FIRST = "engineer.md"

_HEADING = re.compile(r"(#{1,4}) +(.*)")
_MARKS = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


@dataclass(frozen=True)
class HelpPlace:
    """A place in the help: a page, one of its sections, and a word to look for in it.

    ``anchor`` is empty for the top of the page.
    """

    page: str
    anchor: str = ""
    word: str = ""


@dataclass(frozen=True)
class HelpSection:
    """A part of a page below one heading. ``text`` is what a reader sees, without the heading."""

    page: str
    anchor: str
    title: str
    level: int
    text: str


@dataclass(frozen=True)
class HelpPage:
    """A page: its name below docs/, its title, its Markdown, and its sections from the top."""

    name: str
    title: str
    markdown: str
    sections: tuple[HelpSection, ...]


@cache
def page(name: str) -> HelpPage | None:
    """The page of this name; None if there is none, or if it cannot be read."""
    if name not in names():
        return None
    try:
        markdown = (docs_dir() / name).read_text("utf-8")
    except (OSError, UnicodeDecodeError):
        return None
    sections = tuple(_sections(name, markdown))
    return HelpPage(name, sections[0].title if sections else name, markdown, sections)


def names() -> tuple[str, ...]:
    """The names of all pages, in the order of the index."""
    return tuple(name for _, files in GROUPS for name in files)


def pages() -> tuple[HelpPage, ...]:
    """All pages that are there, in the order of the index."""
    return tuple(found for found in map(page, names()) if found is not None)


def anchor_of(heading: str) -> str:
    """The name by which links call a section, such as ``the-start-page``."""
    kept = re.sub(r"[^\w\- ]", "", plain(heading).lower())
    return kept.strip().replace(" ", "-")


def plain(markdown: str) -> str:
    """A line of Markdown as a reader sees it."""
    return _MARKS.sub(r"\1", markdown).replace("`", "").replace("*", "").replace("\\|", "|")


def file_of(name: str) -> Path:
    """The file of a page, or of a picture that stands on one."""
    return docs_dir() / name


def _sections(name: str, markdown: str) -> Iterator[HelpSection]:
    title, level, lines, fenced = "", 0, list[str](), False
    for line in (*_COMMENT.sub("", markdown).splitlines(), "# "):
        fenced ^= line.startswith("```")
        heading = None if fenced else _HEADING.match(line)
        if heading is None:
            lines.append(_cells(line))
            continue
        if level:
            text = " ".join(" ".join(lines).split())
            yield HelpSection(
                name, anchor_of(title) if level > 1 else "", plain(title), level, text
            )
        title, level, lines = heading[2], len(heading[1]), []


def _cells(line: str) -> str:
    """A line of text; the cells of a table stand apart, and its rule and fences are left out."""
    if re.fullmatch(r"\|[-| :]+\||```.*", line):
        return ""
    return plain(line).replace("|", " ") if line.startswith("|") else plain(line)
