"""What the RMM answers: a function for each operation that no library offers, as text.

Nothing here is imported or run. A function lies in a folder that is not loaded, until a person has
read and allowed it.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from keyword import iskeyword
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.generate.text.steps import Words
from smsl_studio.library.generated_functions import literal_pattern
from smsl_studio.library.generated_reach import LONGEST_CODE, code_faults
from smsl_studio.library.loaded import Loaded

Json = Any
MOST_FAULTS = 3
LONGEST_STEM = 150
MOST_WAYS = 20
"""A question tells so many edges of one operation."""


class FunctionCode(BaseModel):
    """The code of one operation, named ``SB/Operation``."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    operation: Words
    code: Annotated[str, StringConstraints(max_length=LONGEST_CODE)] = ""


class Functions(BaseModel):
    """The answer of the RMM."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    functions: Annotated[tuple[FunctionCode, ...], Field(max_length=1000)] = ()


@dataclass(frozen=True, slots=True)
class NeededFunction:
    """An operation that no library offers: its title, and the edges that it has to lead along."""

    title: str
    ways: tuple[str, ...] = ()
    """At most ``MOST_WAYS``: ``State_aaa -> State_baa: disk 1 from a to b``."""


def needed_functions(blueprint: Blueprint, loaded: Loaded) -> dict[str, NeededFunction]:
    """Return, by ``SB/Operation``, the operations without a function: no person does them, no
    sub-SB, and no installed library."""
    edges, levels = Edges(Hierarchy(blueprint)), Levels(blueprint)
    found: dict[str, NeededFunction] = {}
    for branch in blueprint:
        for state in branch.table:
            for edge in edges.out(branch.name, state):
                name = f"{branch.name}/{edge.name}"
                if not edge.function or levels.operation(edge.address) == HUMAN:
                    continue
                if name not in found:
                    if is_offered(loaded, branch.name, edge.name):
                        continue
                    found[name] = NeededFunction(branch.operation_note(state, edge.name).title)
                one = found[name]
                if len(one.ways) < MOST_WAYS:
                    way = _way(branch, state, edge.target)
                    found[name] = replace(one, ways=(*one.ways, way))
    return found


def _way(branch: StateBranch, state: str, target: str) -> str:
    """Return how an edge changes the facts of its SB, in words."""
    if target not in branch.table:
        return f"{state} -> {target}"
    told = []
    pairs = zip(branch.facts(state), branch.facts(target), strict=True)
    for digit, (before, after) in enumerate(pairs):
        if before != after:
            note = branch.fact_note(digit)
            name = (note.name if note else "") or f"fact {digit + 1}"
            told.append(f"{name} from {_value(note, before)} to {_value(note, after)}")
    return f"{state} -> {target}: {', '.join(told) or 'no fact changes'}"


def _value(note: FactNote | None, value: str) -> str:
    words = note.values.get(value, "") if note else ""
    return f"{value} ({words})" if words and words != value else value


def file_names(needed: Iterable[str]) -> dict[str, str]:
    """Return, by operation, the name of its file, such as ``LEG.Op_Fix.py``. It begins with a
    letter or a digit, as ``plugin.toml`` wants it. Names that differ by case alone count as
    equal."""
    found: dict[str, str] = {}
    taken: set[str] = set()
    for operation in needed:
        stem = re.sub(r"[^A-Za-z0-9_.-]", "_", operation.replace("/", ".", 1)).lstrip("._-")
        stem = stem or "operation"
        name, number = stem[:LONGEST_STEM], 1
        while name.casefold() in taken:
            number += 1
            name = f"{stem[:LONGEST_STEM]}_{number}"
        taken.add(name.casefold())
        found[operation] = f"{name}.py"
    return found


def is_offered(loaded: Loaded, branch: str, operation: str) -> bool:
    """Return whether an installed plugin has a function for an operation of this name. Generated
    ones do not count: they are asked for as before, so that the same answers give the same
    bytes."""
    return any(
        not entry.code and entry.texts(branch, operation) is not None
        for plugin in loaded.plugins
        for entry in plugin.library.operations
    )


def faults_of(functions: Functions, needed: Mapping[str, NeededFunction]) -> list[str]:
    """Return what is wrong with functions. Their code is parsed and never run."""
    found = []
    for one in functions.functions:
        if one.operation not in needed:
            found.append(f"{one.operation} needs no function")
        elif one.code:
            faults = islice(code_faults(one.code, function_name(one.operation)), MOST_FAULTS)
            found += [f"{one.operation}: line {fault.line}: {fault.sentence}" for fault in faults]
    return found


def function_files(
    functions: Functions,
    needed: Mapping[str, NeededFunction],
    names: Mapping[str, str],
    origin: Mapping[str, Json],
) -> Iterator[tuple[str, str]]:
    """Yield the name and the text of each file: the code of an answer, or a skeleton."""
    given = {one.operation: one.code for one in functions.functions if one.code}
    for operation, one in needed.items():
        code = given.get(operation, "")
        text = code if code else _skeleton(operation, one.title or operation)
        yield names[operation], _with_origin(text, operation, origin, bool(code))


def function_name(operation: str) -> str:
    """Return the name of the function of an operation: ``Op_FixLeg`` is done by ``op_fix_leg``."""
    name = operation.rpartition("/")[2]
    name = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
    name = re.sub(r"[^a-z0-9]+", "_", name).strip("_")[:LONGEST_STEM]
    return name if name[:1].isalpha() and not iskeyword(name) else f"op_{name}"


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


def functions_manifest(names: Mapping[str, str], called: str) -> str:
    """Return the ``plugin.toml`` of functions. ``names`` has the file of each operation, ``called``
    is the name of the blueprint. The folder is loaded from nowhere: a person reads and allows it
    first."""
    stem = re.sub(r"[^a-z0-9]+", "_", called.lower()).strip("_")[:40] or "blueprint"
    about = f"Generated functions of {called[:200]}: read by a person, and tried by a sweep."
    listed = ", ".join(_toml(literal_pattern(operation)) for operation in names)
    lines = [f'name = "rmm_{stem}"', f"description = {_toml(about)}", f"operations = [{listed}]"]
    for operation, file in names.items():
        lines += [
            "", "[[generated]]", f"operation = {_toml(operation)}", f"file = {_toml(file)}",
            f"function = {_toml(function_name(operation))}",
        ]  # fmt: skip
    return "\n".join(lines) + "\n"


def _toml(text: str) -> str:
    """Return a text of TOML in ASCII. TOML knows no pairs of surrogates, which JSON writes."""
    letters = (f"\\U{ord(one):08x}" if ord(one) > 0xFFFF else json.dumps(one)[1:-1] for one in text)
    return f'"{"".join(letters)}"'


def codes_of(files: Sequence[tuple[str, str]], names: Mapping[str, str]) -> Functions:
    """Return the functions that people have put into files. ``names`` has the file of each
    operation. A file that belongs to no operation is left out."""
    by_name = {name: operation for operation, name in names.items()}
    return Functions(
        functions=tuple(
            FunctionCode(operation=by_name[name], code=text[:LONGEST_CODE])
            for name, text in files
            if name in by_name
        )
    )
