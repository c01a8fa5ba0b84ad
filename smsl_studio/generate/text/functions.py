"""What the RMM answers: a function for each operation that no library offers, as text.

Nothing here is imported or run. A function lies in a folder that is not loaded, until a person has
read and allowed it.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.generate.text.steps import Words
from smsl_studio.library.loaded import Loaded

Json = Any
LONGEST_CODE = 20_000
"""The largest number of characters of a function. A small motion needs far less."""


class FunctionCode(BaseModel):
    """The code of one operation, named ``SB/Operation``."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    operation: Words
    code: Annotated[str, StringConstraints(max_length=LONGEST_CODE)] = ""


class Functions(BaseModel):
    """The answer of the RMM."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    functions: Annotated[tuple[FunctionCode, ...], Field(max_length=1000)] = ()


def needed_functions(blueprint: Blueprint, loaded: Loaded) -> dict[str, str]:
    """Return, by ``SB/Operation``, the titles of the operations without a function: no person does
    them, no sub-SB, and no installed library."""
    edges, levels = Edges(Hierarchy(blueprint)), Levels(blueprint)
    found: dict[str, str] = {}
    for branch in blueprint:
        for state in branch.table:
            for edge in edges.out(branch.name, state):
                name = f"{branch.name}/{edge.name}"
                if name in found or not edge.function or levels.operation(edge.address) == HUMAN:
                    continue
                if not is_offered(loaded, branch.name, edge.name):
                    found[name] = branch.operation_note(state, edge.name).title
    return found


def is_offered(loaded: Loaded, branch: str, operation: str) -> bool:
    """Return whether an installed plugin has a function for an operation of this name."""
    return any(
        entry.pattern is not None and entry.texts(branch, operation) is not None
        for plugin in loaded.plugins
        for entry in plugin.library.operations
    )


def faults_of(functions: Functions, needed: Mapping[str, str]) -> list[str]:
    """Return what is wrong with functions. Their code is parsed and never run."""
    found = []
    for one in functions.functions:
        if one.operation not in needed:
            found.append(f"{one.operation} needs no function")
        elif one.code:
            try:
                tree = ast.parse(one.code)
            except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
                found.append(f"{one.operation}: the code is no Python: {error}")
                continue
            names = [part.name for part in tree.body if isinstance(part, ast.FunctionDef)]
            if function_name(one.operation) not in names:
                found.append(f"{one.operation}: it has no function {function_name(one.operation)}")
    return found


def function_files(
    functions: Functions, needed: Mapping[str, str], origin: Mapping[str, Json]
) -> Iterator[tuple[str, str]]:
    """Yield the name and the text of each file: the code of an answer, or a skeleton."""
    given = {one.operation: one.code for one in functions.functions if one.code}
    for operation, title in needed.items():
        code = given.get(operation, "")
        text = code if code else _skeleton(operation, title)
        yield file_name(operation), _with_origin(text, operation, origin, bool(code))


def file_name(operation: str) -> str:
    """Return the name of the file of an operation, such as ``LEG.Op_Fix.py``."""
    return re.sub(r"[^A-Za-z0-9_.-]", "_", operation.replace("/", ".", 1)) + ".py"


def function_name(operation: str) -> str:
    """Return the name of the function of an operation: ``Op_FixLeg`` is done by ``op_fix_leg``."""
    name = operation.rpartition("/")[2]
    name = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
    name = re.sub(r"[^a-z0-9]+", "_", name).strip("_")
    return name if name[:1].isalpha() else f"op_{name}"


def _skeleton(operation: str, title: str) -> str:
    said = json.dumps(f"{title}: nobody has written this motion yet", ensure_ascii=True)
    return (
        f"def {function_name(operation)}(world):\n"
        f"    yield\n"
        f"    raise NotImplementedError({said})\n"
    )


def _with_origin(text: str, operation: str, origin: Mapping[str, Json], is_answer: bool) -> str:
    kind = "generated" if is_answer else "a skeleton"
    head = [
        f"# {operation}: {kind}, not read and not allowed. It is not loaded from this folder.",
        f"_origin = {dict(origin)!r}",
        "",
    ]
    return "\n".join(head) + "\n" + text.rstrip("\n") + "\n"


def codes_of(files: Sequence[tuple[str, str]], needed: Mapping[str, str]) -> Functions:
    """Return the functions that people have put into files. A file that belongs to no operation is
    left out."""
    by_name = {file_name(operation): operation for operation in needed}
    return Functions(
        functions=tuple(
            FunctionCode(operation=by_name[name], code=text[:LONGEST_CODE])
            for name, text in files
            if name in by_name
        )
    )
