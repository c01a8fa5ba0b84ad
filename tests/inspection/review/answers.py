"""Random reviews, and a plain oracle for their merge and for what they say of a line."""

from __future__ import annotations

from collections.abc import Iterable
from random import Random

from smsl_studio.inspection.review.entry import ReviewEntry

LINES = tuple(f"{digit}" * 32 for digit in "abc")
PEOPLE = (("M. Reyes", "surgeon"), ("m.reyes", "surgeon"), ("J. Lindqvist", "engineer"),
          ("A. Okoye", "surgeon"))  # fmt: skip


def random_entries(chance: Random, many: int) -> list[ReviewEntry]:
    """Entries in the order of their making. Some have equal times, and clocks go backwards."""
    made: list[ReviewEntry] = []
    for _ in range(many):
        person, role = chance.choice(PEOPLE)
        time = f"2026-03-01T12:00:{chance.randrange(30):02}.000000Z"
        comments = [one for one in made if one.kind == "comment"]
        kinds = ["approved", "taken back", "comment", *(["reply", "closed"] if comments else [])]
        kind = chance.choice(kinds)
        line, to, text = chance.choice(LINES), "", ""
        if kind in ("reply", "closed"):
            about = chance.choice(comments)
            line, to = about.line, about.id
        if kind in ("comment", "reply"):
            text = f"words {chance.randrange(3)}"
        made.append(
            ReviewEntry(kind, line, "procedure", "Fix the leg", person, role, time, text, to)
        )
    return made


def plain_merge(*sides: Iterable[ReviewEntry]) -> list[ReviewEntry]:
    """All entries of all sides, each once, by time, person and name, worked out plainly."""
    found: list[ReviewEntry] = []
    for side in sides:
        for entry in side:
            if not any(entry == other for other in found):
                found.append(entry)
    return sorted(found, key=lambda one: (one.time, one.person, one.id))


def plain_name(person: str) -> str:
    return person.replace(" ", "").lower()


def plain_approvers(entries: list[ReviewEntry], line: str) -> set[str]:
    """Who approves a line: the people whose last word about it is an approval."""
    people: dict[str, bool] = {}
    for entry in entries:
        if entry.line == line and entry.kind in ("approved", "taken back"):
            people[plain_name(entry.person)] = entry.kind == "approved"
    return {person for person, yes in people.items() if yes}


def plain_open(entries: list[ReviewEntry]) -> set[str]:
    """The names of comments that nobody of the same name or role has closed."""
    left = {one.id: one for one in entries if one.kind == "comment"}
    for entry in entries:
        asked = left.get(entry.to) if entry.kind == "closed" else None
        if asked is not None and (
            plain_name(entry.person) == plain_name(asked.person) or entry.role == asked.role
        ):
            del left[entry.to]
    return set(left)
