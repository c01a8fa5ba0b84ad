"""State Branches as a state diagram of Mermaid."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count

from smsl_studio.legible import one_line
from smsl_studio.picture.part import PicturePart
from smsl_studio.stop import heed

MOST_EDGES = 500
"""Mermaid refuses a diagram with more arrows, unless its settings are changed."""
_PLAIN = frozenset(" _-.,()+=*/!?'")
"""Characters that mean nothing in a state diagram, besides letters and digits."""


def as_mermaid(parts: Sequence[PicturePart]) -> str:
    """Return parts of SBs as a Mermaid state diagram. Several SBs are a composite state each.

    The states are ``s0``, ``s1`` and so on, with their names as descriptions. INITIAL has the arrow
    from the start, ACTIVATING a thick border. A target that is no state is dashed.
    """
    numbers = count()
    lines = ["stateDiagram-v2"]
    looks: dict[str, list[str]] = {"activating": [], "missing": []}
    for at, part in enumerate(parts):
        if len(parts) == 1:
            lines.extend(_lines(part, numbers, looks, "    "))
            continue
        lines.append(f'    state "{_text(part.picture.branch.name)}" as b{at} {{')
        lines.extend(_lines(part, numbers, looks, "        "))
        lines.append("    }")
    lines.append("    classDef activating stroke-width:4px")
    lines.append("    classDef missing stroke-dasharray:4 3")
    lines.extend(f"    class {','.join(ids)} {name}" for name, ids in looks.items() if ids)
    return "\n".join([*lines, ""])


def _lines(
    part: PicturePart, numbers: Iterator[int], looks: dict[str, list[str]], indent: str
) -> Iterator[str]:
    picture, branch = part.picture, part.picture.branch
    ids = {state: f"s{next(numbers)}" for state in part.states}
    gone: dict[str, str] = {}
    for state, known in ids.items():
        name = picture.names[state]
        yield f'{indent}state "{_text(name)}" as {known}'
        if name == branch.initial:
            yield f"{indent}[*] --> {known}"
        if name == branch.activating:
            looks["activating"].append(known)
    for edge in part.edges:
        heed()
        source, target = int(picture.source[edge]), int(picture.target[edge])
        operation = picture.operations[edge]
        if target >= 0:
            end = ids[target]
        else:
            absent = branch.table[picture.names[source]][operation]
            if absent not in gone:
                gone[absent] = f"s{next(numbers)}"
                looks["missing"].append(gone[absent])
                yield f'{indent}state "{_text(absent)}" as {gone[absent]}'
            end = gone[absent]
        label = _text(operation)
        yield f"{indent}{ids[source]} --> {end}{f' : {label}' if label.strip() else ''}"


def _text(text: str) -> str:
    """Return a text with every character that could mean something written as its number."""
    return "".join(
        char if char.isalnum() or char in _PLAIN else f"#{ord(char)};" for char in one_line(text)
    )
