"""Finds modules or folders that import each other, directly or through others."""

from __future__ import annotations

from collections.abc import Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

from tests.house.survey import Surveyed, survey


def modules_below(root: Path, top: str) -> dict[str, set[str]]:
    """What each module below ``root`` imports of ``top``, whose folder lies in ``root``.

    Imports inside functions and under TYPE_CHECKING count as well.
    """
    found = {_name(root, one.path): one for one in survey(root / top)}
    return {module: _asked(one, module, set(found)) for module, one in found.items()}


def folders_of(modules: Mapping[str, set[str]]) -> dict[str, set[str]]:
    """The same for folders: a folder and one inside it are two, and may not know each other.

    A module at the very top counts as a folder of its own: the rooms there stand on many floors.
    """
    found: dict[str, set[str]] = {}
    packages = {name.rpartition(".")[0] for name in modules}
    for module, asked in modules.items():
        here = _folder(module, packages)
        found.setdefault(here, set()).update({_folder(one, packages) for one in asked} - {here})
    return found


def knot(graph: Mapping[str, set[str]]) -> list[str]:
    """One way round on which the last is the first; empty where there is none."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def _name(root: Path, path: Path) -> str:
    return ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__")


def _folder(module: str, packages: set[str]) -> str:
    at_the_top = module.count(".") == 1
    return module if module in packages or at_the_top else module.rpartition(".")[0]


def _asked(one: Surveyed, module: str, known: set[str]) -> set[str]:
    asked: set[str] = set()
    for item in one.asked:
        if not item.literal and item.module:
            whole = {f"{item.module}.{name}" for name in item.names} or {item.module}
            asked.update(name if name in known else item.module for name in whole)
    return (asked & known) - {module}
