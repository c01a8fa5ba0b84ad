"""The values of three versions of a file, to be changed while they are merged."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from typing import Any

from smsl_studio.blueprint.merge.conflict import ABSENT, KEY, Path
from smsl_studio.blueprint.merge.values import equal, equal_branches
from smsl_studio.blueprint.reading import HEADER

Json = Any
Values = dict[str, Json]


class Trees:
    """The values of base, ours and theirs (0, 1, 2).

    ``versions`` are changed while the merge settles clashes. The questions below are answered by
    the values as they were before, so that no answer depends on the order of the questions.
    """

    def __init__(self, base: Mapping[str, Json], ours: Mapping[str, Json],
                 theirs: Mapping[str, Json]) -> None:  # fmt: skip
        self.versions: tuple[Values, Values, Values] = dict(base), dict(ours), dict(theirs)
        for version in self.versions:
            version.pop(KEY, None)
        self._same = {
            key
            for key in self.versions[0]
            if all(
                (equal if key.startswith("_") else equal_branches)(
                    one.get(key, ABSENT), self.versions[0][key]
                )
                for one in self.versions
            )
        }
        self._before = tuple(dict(version) for version in self.versions)
        self._kept: set[Path] = set()
        for version in self.versions:
            for key, value in version.items():
                version[key] = value if key in self._same else deepcopy(value)

    def branches(self) -> list[str]:
        """The names of the SBs that stand in any version and are not equal in all."""
        names = dict.fromkeys(key for version in self._before for key in version)
        return [name for name in names if name not in self._same and not name.startswith("_")]

    def branches_of_all(self) -> list[str]:
        """The SBs of ``branches`` that stand in each version."""
        return [name for name in self.branches() if all(name in one for one in self._before)]

    def branch(self, at: int, branch: str) -> Mapping[str, Json]:
        """Return the values of an SB in a version, an empty map if it is not there."""
        return self.map(at, (branch,))

    def states(self, at: int, branch: str) -> list[str]:
        """Return the names of the states of an SB in a version."""
        return [key for key in self.branch(at, branch) if key != HEADER and not key.startswith("_")]

    def get(self, at: int, path: Path) -> Json:
        """Return the value at a path of a version, ABSENT if there is none."""
        return value_at(self._before[at], path)

    def now(self, at: int, path: Path) -> Json:
        """Return the value at a path of a version as it is now, ABSENT if there is none."""
        return value_at(self.versions[at], path)

    def map(self, at: int, path: Path) -> Mapping[str, Json]:
        """Return the map at a path of a version, an empty one if there is none."""
        value = self.get(at, path)
        return value if isinstance(value, dict) else {}

    def values_at(self, path: Path) -> tuple[Json, Json, Json]:
        """Return copies of the three values at a path."""
        base, ours, theirs = (deepcopy(self.get(at, path)) for at in range(3))
        return base, ours, theirs

    def put(self, at: int, path: Path, value: Json) -> None:
        """Set the value at a path of a version, or remove it with ABSENT.

        A missing map of annotations is made. Nothing happens if an SB or a state is missing.
        """
        node: Json = self.versions[at]
        for depth, key in enumerate(path[:-1]):
            # Annotations stand below a key with _, either of an SB or of the file.
            noted = path[1 if depth else 0].startswith("_")
            if isinstance(node, dict) and key not in node and noted:
                node[key] = {}
            node = node.get(key) if isinstance(node, dict) else None
        if not isinstance(node, dict):
            return
        if value is ABSENT:
            node.pop(path[-1], None)
        else:
            node[path[-1]] = deepcopy(value)

    def keep_ours(self, path: Path) -> None:
        """Let ours count at a path: the other versions get its value."""
        self._kept.add(path)
        value = self.get(1, path)
        for at in (0, 2):
            self.put(at, path, value)

    def is_kept(self, path: Path) -> bool:
        """Whether ours was chosen at a path already."""
        return path in self._kept


def value_at(value: Json, path: Path) -> Json:
    """Return the value at a path of values, ABSENT if there is none."""
    for key in path:
        if not isinstance(value, dict) or key not in value:
            return ABSENT
        value = value[key]
    return value
