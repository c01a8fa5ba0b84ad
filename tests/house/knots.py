"""Finds modules or folders that import each other, directly or through others."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path


def modules_below(root: Path, top: str) -> dict[str, set[str]]:
    """What each module below ``root`` imports of ``top``, whose folder lies in ``root``.

    Imports inside functions and under TYPE_CHECKING count as well.
    """
    found = {_name(root, path): path for path in sorted((root / top).rglob("*.py"))}
    return {module: _asked(path, module, set(found)) for module, path in found.items()}


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


def _asked(path: Path, module: str, known: set[str]) -> set[str]:
    asked: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            asked.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            whole = {f"{node.module}.{alias.name}" for alias in node.names}
            asked.update(name if name in known else node.module for name in whole)
    return (asked & known) - {module}
