"""What is reviewed: the reading of a blueprint, and what has changed since somebody signed it."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.recorded import blueprint_of_content
from smsl_studio.errors import StudioError
from smsl_studio.front.former_record import may_have_record, newest_content
from smsl_studio.front.readings import reading
from smsl_studio.inspection.reading.sections import BlueprintReading, ReadingLine
from smsl_studio.inspection.review.reviewed import SINCE


@dataclass(frozen=True)
class ReviewMatter:
    """What is reviewed.

    ``former`` names the newest record, empty for a blueprint that was never signed. ``changed`` are
    the keys of the lines that mean something else than in that record. ``fault`` says why the
    record cannot be read.
    """

    reading: BlueprintReading
    former: str = ""
    changed: frozenset[str] = frozenset()
    fault: str = ""

    @property
    def since(self) -> tuple[ReadingLine, ...]:
        """The changes since the newest record, removals first."""
        return next((one.lines for one in self.reading.sections if one.key == SINCE), ())


def review_matter(blueprint: Blueprint) -> ReviewMatter:
    """Return what is reviewed. It may take as long as the proofs of the blueprint, and heeds a
    stop.

    A record that cannot be read is no error here; ``fault`` says it.
    """
    fault, name, content = "", "", None
    try:
        if may_have_record(blueprint.file):
            name, content = newest_content(blueprint)
    except StudioError as error:
        fault = str(error)
    if content is None:
        return ReviewMatter(reading(blueprint), fault=fault)
    signed = blueprint_of_content(content, name)
    told = reading(blueprint, against=signed, former=name)
    before = {line.key for _, line in reading(signed).lines()}
    changed = frozenset(line.key for _, line in told.lines() if line.key not in before)
    return ReviewMatter(told, name, changed)
