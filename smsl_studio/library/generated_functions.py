"""Makes functions of generated files: limited code, under the watch, as entries of a library."""

from __future__ import annotations

import ast
import builtins
import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from smsl_studio.errors import Place, PluginError
from smsl_studio.library.generated_reach import GIVEN, parsed
from smsl_studio.library.generated_watch import Steps, trusted, watched
from smsl_studio.library.operation_entry import OperationEntry
from smsl_studio.library.operation_library import OperationLibrary
from smsl_studio.library.pattern import read_pattern
from smsl_studio.library.signature import Signature
from smsl_studio.seal.digest import sha256_hex

if TYPE_CHECKING:
    from smsl_studio.library.manifest import GeneratedFunction
    from smsl_studio.library.sources import Sources

TIMEOUT = 60.0
"""The simulated seconds after which a generated function is given up."""
REFUSED = b"refused\0"
"""Goes before the bytes of a function that is not loaded, in its digest."""
DO = "do"
"""The name by which generated code asks for an operation that its world has."""
Operations = Callable[[Any, str], Steps]
"""Begins an operation of a world by its name: ``operations(world, name)``."""


def register_generated(
    library: OperationLibrary, functions: tuple[GeneratedFunction, ...], sources: Sources
) -> None:
    """Add generated functions to a library. Skeletons are left out. One that says what it may not
    raises that when it is called, with file and line; it does not keep the others away. PluginError
    if a file is missing."""
    taken: set[str] = set()
    for one in functions:
        file = str(sources.folder / one.file)
        raw = sources.modules.get(one.file)
        if raw is None:
            raise PluginError(f"the file {one.file} is missing", Place(file, 1, 1))
        code = digest_of(one.operation, raw)
        try:
            tree = parsed(read_code(raw, file), file, one.function)
            if is_skeleton(tree):
                continue
            function = _function(tree, one, file)
        except PluginError as error:
            function = _refusing(error)
            # Whatever this code has passed before, it was passed by code that could be loaded.
            code = digest_of(one.operation, REFUSED + raw)
        name = one.function
        while name in taken:
            name += "_"
        taken.add(name)
        library.operations.append(
            OperationEntry(
                function=function,
                name=f"{library.name}.{name}",
                pattern=read_pattern(literal_pattern(one.operation), {}),
                signature=Signature({}, frozenset(), False),
                stop="hold",
                timeout=TIMEOUT,
                code=code,
            )
        )


def _refusing(error: PluginError) -> Callable[..., Steps]:
    """Return a function that says why there is none."""

    def refused(world: Any, operations: Operations) -> Steps:
        raise error
        yield

    return refused


def digest_of(operation: str, raw: bytes) -> str:
    """Return the SHA-256 of a function: its operation and the bytes of its file."""
    return sha256_hex(operation.encode("utf-8", "replace") + b"\0" + raw)


def literal_pattern(operation: str) -> str:
    """Return the pattern that only this ``SB/Operation`` matches."""
    return operation.replace("{", "{{").replace("}", "}}")


def read_code(raw: bytes, file: str) -> str:
    """Return the text of a file. PluginError if it is no text."""
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError:
        raise PluginError("the code is not UTF-8", Place(file, 1, 1)) from None


def is_skeleton(tree: ast.Module) -> bool:
    """Return whether a file has only the place for a motion: its last line says so."""
    last = [one.body[-1] for one in tree.body if isinstance(one, ast.FunctionDef)][-1:]
    return bool(last) and isinstance(last[0], ast.Raise) and _is_unwritten(last[0].exc)


def _is_unwritten(error: ast.expr | None) -> bool:
    called = error.func if isinstance(error, ast.Call) else error
    return isinstance(called, ast.Name) and called.id == "NotImplementedError"


def _function(tree: ast.Module, one: GeneratedFunction, file: str) -> Callable[..., Steps]:
    """Return the function of an operation, called as ``function(world, operations=...)``."""
    body = [part for part in tree.body if isinstance(part, ast.FunctionDef)]
    for part in ast.walk(ast.Module(body=list(body), type_ignores=[])):
        if isinstance(part, ast.FunctionDef):
            part.returns = None
        elif isinstance(part, ast.arg):
            part.annotation = None
    names: dict[str, Any] = {
        "__builtins__": {name: getattr(builtins, name) for name in GIVEN},
        "__name__": one.function,
        "math": math,
    }
    module = ast.Module(body=list(body), type_ignores=[])
    try:
        exec(compile(module, str(Path(file)), "exec"), names)
    except (RecursionError, MemoryError):  # it was just compiled, but part by part
        raise PluginError("the code is nested too deeply", Place(file, 1, 1)) from None
    made = names[one.function]

    def motion(world: Any, operations: Operations) -> Steps:
        names[DO] = lambda _, name: trusted(operations(world, str(name)))
        return (yield from watched(lambda: made(world)))

    return motion
