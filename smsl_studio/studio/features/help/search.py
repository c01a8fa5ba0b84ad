"""Search over all pages of the help."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.studio.features.help.pages import HelpSection, pages

MOST = 60
AROUND = 90
"""So many characters of the text are shown beside a hit."""


@dataclass(frozen=True)
class HelpHit:
    """A section that holds all words. ``words`` are a piece of its text about the first of them."""

    section: HelpSection
    page_title: str
    words: str


def find(typed: str) -> tuple[HelpHit, ...]:
    """The sections that hold every typed word, the best first; none if nothing is typed.

    A word in a heading counts most, then a word that is there as it was typed.
    """
    wanted = typed.casefold().split()
    if not wanted:
        return ()
    found: list[tuple[tuple[int, int], int, HelpHit]] = []
    for page in pages():
        for section in page.sections:
            title, text = section.title.casefold(), section.text.casefold()
            if all(word in title or word in text for word in wanted):
                rank = (-sum(word in title for word in wanted), -(" ".join(wanted) in text))
                hit = HelpHit(section, page.title, _around(section.text, text, wanted))
                found.append((rank, len(found), hit))
    return tuple(hit for _, _, hit in sorted(found, key=lambda one: one[:2])[:MOST])


def _around(text: str, folded: str, wanted: list[str]) -> str:
    """The piece of a text about the first of the words that it holds."""
    at = min((at for at in map(folded.find, wanted) if at >= 0), default=0)
    begin = text.rfind(" ", 0, max(0, at - AROUND // 3)) + 1
    piece = text[begin : begin + AROUND]
    return ("… " if begin else "") + piece + (" …" if begin + AROUND < len(text) else "")
