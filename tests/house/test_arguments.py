"""A function has at most six parameters."""

from __future__ import annotations

import ast
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "smsl_studio"
MOST = 6
VERBS = {"run", "open_run", "sweep", "try_edge"}
"""The verbs of the front door in their public form, with keywords."""


def _arity(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    named = function.args.posonlyargs + function.args.args
    own = bool(named) and named[0].arg in ("self", "cls")
    return len(named) + len(function.args.kwonlyargs) - own


def test_functions_have_six_arguments_at_most() -> None:
    found = set()
    for path in sorted(PACKAGE.rglob("*.py")):
        file = path.relative_to(PACKAGE).as_posix()
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and _arity(node) > MOST:
                public = file.startswith("front/") and node.name in VERBS
                if not public:
                    found.add(f"{file}:{node.lineno} {node.name}")
    assert not found
