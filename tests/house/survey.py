"""What the code of a folder imports and defines, read once for all rules of the house."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True)
class Asked:
    """An import: its line, its module with leading dots, and the names taken from it.

    ``import a.b`` has no names. ``literal`` marks a call such as ``import_module("a.b")``.
    """

    line: int
    module: str
    names: tuple[str, ...] = ()
    literal: bool = False


@dataclass(frozen=True)
class Surveyed:
    """A file: its imports, those inside functions too, its classes and its functions.

    A class is its name; a function is its line, its name and the number of its arguments without
    ``self``.
    """

    path: Path
    asked: tuple[Asked, ...]
    classes: tuple[str, ...]
    functions: tuple[tuple[int, str, int], ...]


@cache
def survey(folder: Path) -> tuple[Surveyed, ...]:
    """All files of Python below a folder, in the order of their paths."""
    return tuple(map(_surveyed, sorted(folder.rglob("*.py"))))


def _surveyed(path: Path) -> Surveyed:
    asked: list[Asked] = []
    classes, functions = [], []
    for node in ast.walk(ast.parse(path.read_text("utf-8"), str(path))):
        asked += _asked(node)
        if isinstance(node, ast.ClassDef):
            classes.append(node.name)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            functions.append((node.lineno, node.name, _arity(node)))
    return Surveyed(path, tuple(asked), tuple(classes), tuple(functions))


def _asked(node: ast.AST) -> Iterator[Asked]:
    if isinstance(node, ast.Import):
        yield from (Asked(node.lineno, alias.name) for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        names = tuple(alias.name for alias in node.names)
        yield Asked(node.lineno, "." * node.level + (node.module or ""), names)
    elif isinstance(node, ast.Call) and node.args and _imports_by_name(node.func):
        wanted = node.args[0]
        if isinstance(wanted, ast.Constant) and isinstance(wanted.value, str):
            yield Asked(node.lineno, wanted.value, literal=True)


def _imports_by_name(function: ast.expr) -> bool:
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
    return name in {"import_module", "__import__"}


def _arity(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    named = function.args.posonlyargs + function.args.args
    own = bool(named) and named[0].arg in ("self", "cls")
    return len(named) + len(function.args.kwonlyargs) - own
