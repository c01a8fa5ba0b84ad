"""The oracle uses plain values only, and imports nothing of the program that it judges."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parent


def imported(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""
            if node.module == "tests.oracle":
                yield from (f"tests.oracle.{alias.name}" for alias in node.names)


def test_the_oracle_imports_nothing_of_the_program() -> None:
    waiting, seen = ["tests.oracle.oracle"], set()
    while waiting:
        module = waiting.pop()
        if module in seen or module == "tests.oracle":
            continue
        seen.add(module)
        if module.startswith("tests."):
            waiting += imported(HERE / f"{module.rpartition('.')[2]}.py")
    assert "tests.oracle.carriage" in seen
    assert not {one for one in seen if one.split(".")[0] == "smsl_studio"}
    assert not seen & {"tests.oracle.recorded_run", "tests.oracle.recorded_host"}
