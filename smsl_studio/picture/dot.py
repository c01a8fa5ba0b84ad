"""State Branches as DOT, the language of Graphviz."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from smsl_studio.legible import one_line
from smsl_studio.picture.part import PicturePart
from smsl_studio.stop import heed


def as_dot(parts: Sequence[PicturePart]) -> str:
    """Return parts of SBs as DOT. Several SBs have a cluster each.

    A state is a node whose id is its name, with the name of its SB before it if there are several.
    INITIAL is bold and ACTIVATING has a second outline. A target that is no state is dashed.
    """
    ids = _Ids()
    lines = ["digraph {", '    node [shape="box", style="rounded"];']
    for at, part in enumerate(parts):
        if len(parts) == 1:
            lines.extend(_lines(part, ids, "", "    "))
            continue
        name = part.picture.branch.name
        lines.append(f"    subgraph {_quoted(f'cluster_{at}')} {{")
        lines.append(f"        label={_label(name)};")
        lines.extend(_lines(part, ids, f"{name}/", "        "))
        lines.append("    }")
    return "\n".join([*lines, "}", ""])


def _lines(part: PicturePart, ids: _Ids, before: str, indent: str) -> Iterator[str]:
    picture, branch = part.picture, part.picture.branch
    names = {state: ids.of(before + picture.names[state]) for state in part.states}
    gone: dict[str, str] = {}
    for state, known in names.items():
        name = picture.names[state]
        looks = [f"label={_label(name)}"]
        if name == branch.initial:
            looks.append('style="rounded,bold"')
        if name == branch.activating:
            looks.append("peripheries=2")
        yield f"{indent}{known} [{', '.join(looks)}];"
    for edge in part.edges:
        heed()
        source, target = int(picture.source[edge]), int(picture.target[edge])
        operation = picture.operations[edge]
        if target >= 0:
            end = names[target]
        else:
            absent = branch.table[picture.names[source]][operation]
            if absent not in gone:
                gone[absent] = ids.of(before + absent)
                yield f'{indent}{gone[absent]} [label={_label(absent)}, style="rounded,dashed"];'
            end = gone[absent]
        yield f"{indent}{names[source]} -> {end} [label={_label(operation)}];"


class _Ids:
    """The ids of nodes. Names that differ only in what cannot be seen get different ids."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def of(self, name: str) -> str:
        """Return a new id that shows a name."""
        shown = _quoted(name)
        rank = 2
        while shown in self._taken:
            shown, rank = _quoted(f"{name} ({rank})"), rank + 1
        self._taken.add(shown)
        return shown


def _quoted(text: str) -> str:
    """Return a text as an id. Only a quote, and the backslash before one, mean anything there."""
    escaped = one_line(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def _label(text: str) -> str:
    """Return a text as a label. Graphviz reads the entities of HTML in it."""
    return _quoted(text.replace("&", "&amp;"))
