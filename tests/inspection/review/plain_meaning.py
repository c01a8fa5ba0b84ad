"""What a line of a reading means, worked out from its words and from the file. It shares no code
with the keys of lines.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.reading.sections import BlueprintReading, ReadingLine

_STEPS = re.compile(r"steps? (\d+)(?: to (\d+))?")


def plain_meanings(told: BlueprintReading, values: Mapping[str, Any]) -> dict[str, Any]:
    """What each line means, by its key. Numbers of steps are replaced by what the steps say."""
    steps = {line.mark: line.heading for _, line in told.lines() if line.mark.isdigit()}

    def named(text: str) -> str:
        def titles(found: re.Match[str]) -> str:
            first, last = int(found[1]), int(found[2] or found[1])
            return "|".join(steps[str(at)] for at in range(first, last + 1))

        return _STEPS.sub(titles, text)

    def said(line: ReadingLine, numbered: bool) -> Any:
        # "It takes 3 steps" counts; only other ways and other orders name steps by numbers.
        words = [line.heading, *line.text]
        if numbered:
            words = [
                named(one) if "instead of step" in one or "also be done" in one else one
                for one in words
            ]
        inner = [said(one, False) for one in line.inner]
        return [line.mark == "or", words, line.who, line.check, line.open_point, inner]

    def behind(line: ReadingLine) -> set[str]:
        own = {written(at, values) for at in line.about}
        return own.union(*(behind(one) for one in line.inner))

    return {
        line.key: (section.key, said(line, section.key == "procedure"), sorted(behind(line)))
        for section, line in told.lines()
    }


def written(at: Address, values: Mapping[str, Any]) -> str:
    """The annotations of an operation or a state as they are written, without defaults."""
    branch = values.get(at.branch, {})
    if at.operation:
        table = branch.get("_operations", {})
        note = {**table.get(at.operation, {}), **table.get(f"{at.state}/{at.operation}", {})}
    else:
        note = branch.get("_states", {}).get(at.state, {})
    return repr(sorted((key, one) for key, one in note.items() if one not in ("", None, [], 1)))
