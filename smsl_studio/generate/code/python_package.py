"""The Python package of a blueprint: every file as text, by its path."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import Address, escape, fact_text
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.generate.code import python_branches
from smsl_studio.generate.code.blueprint_parts import (
    CodeRequest,
    asks_people,
    counted,
    identity,
    sensed_digits,
)
from smsl_studio.generate.code.bound_functions import BoundFunctions, Function
from smsl_studio.generate.code.identifiers import Namer
from smsl_studio.generate.code.kept_parts import mark_key
from smsl_studio.generate.code.python_literals import (
    WIDTH,
    CallLiteral,
    Code,
    literal,
    text_literal,
)
from smsl_studio.generate.code.templates import BY, remark, rendered
from smsl_studio.library.bindings_file import BindingsFile
from smsl_studio.shipped import resources_dir

Json = Any


@dataclass(frozen=True)
class _BranchFile:
    """An SB with the name of its file."""

    own: StateBranch
    module: str


class PythonPackage:
    """Makes the files of one package. ``files`` has them by their paths in the folder."""

    suffixes = (".py",)

    def __init__(self, request: CodeRequest, file: BindingsFile | None = None) -> None:
        self._request = request
        self._blueprint = request.blueprint
        self._hierarchy = Hierarchy(request.blueprint)
        self._bound = BoundFunctions(request.blueprint, file, {"world", "edge", "Any", "Edge"})
        modules = Namer("sb")
        self._branches = [
            _BranchFile(one, modules.name(one.name, one.name)) for one in request.blueprint
        ]
        readers = Namer("fact", {"world", "fact", "Any", "FactKey"})
        self._readers = {
            (one.name, digit): readers.name((one.name, digit), f"{one.name}_{_word(one, digit)}")
            for one in request.blueprint
            for digit in sensed_digits(one)
        }

    @property
    def files(self) -> dict[str, str]:
        """Every file as text."""
        name = self._request.name
        branches = {
            f"{name}/branches/{one.module}.py": self._headed(self._branch(one))
            for one in self._branches
        }
        return {
            f"{name}/__init__.py": self._python("__init__.py"),
            f"{name}/__main__.py": self._python("__main__.py"),
            f"{name}/py.typed": "",
            f"{name}/branches/__init__.py": self._python("branches.py", **self._all_branches()),
            **branches,
            f"{name}/operations.py": self._python("operations.py", functions=self._functions()),
            f"{name}/sensors.py": self._python("sensors.py", sensors=self._sensors()),
            f"{name}/blueprint.py": self._whole(),
            f"{name}/identity.json": self._identity(),
            **self._engine(),
            "pyproject.toml": f"# {BY}.\n{self._text('pyproject.toml')}",
            "README.md": f"<!-- {BY}. -->\n\n{self._readme()}",
            f"tests/test_{name}.py": self._python("test.py"),
        }

    # texts ----------------------------------------------------------------------------------------

    def _text(self, template: str, **values: Json) -> str:
        request = self._request
        said = {"package": request.name, "file_name": remark(request.file_name), **values}
        return rendered("python", template, **said)

    def _python(self, template: str, **values: Json) -> str:
        return self._headed(self._text(template, **values))

    def _headed(self, text: str) -> str:
        """Return a Python text under the licence, and the words by which it is known."""
        licence = [f"# {line}".rstrip() for line in self._request.licence.splitlines()]
        lines = [*licence, f"# {BY}."]
        return "\n".join([*lines, "", text]) if text else "\n".join([*lines, ""])

    def _engine(self) -> dict[str, str]:
        folder = resources_dir() / "code" / "python" / "dsfo"
        return {
            f"{self._request.name}/dsfo/{one.name}": self._headed(one.read_text("utf-8"))
            for one in sorted(folder.glob("*.py"))
        }

    # the blueprint --------------------------------------------------------------------------------

    def _whole(self) -> str:
        request = self._request
        hazards = tuple(
            CallLiteral("Hazard", (("", one.name), ("", one.facts))) for one in request.hazards
        )
        return self._python(
            "blueprint.py",
            digests=request.digests,
            record=request.record_digest,
            hazards=hazards,
            hazard_values=_annotated(hazards, "tuple[Hazard, ...]", "HAZARDS"),
            levels=literal(dict(self._blueprint.levels), before=len("LEVELS: dict[str, str] = ")),
            left_out=literal(request.left_out, before=len("LEFT_OUT: ")),
            findings=literal(request.findings, before=len("FINDINGS = ")),
        )

    def _identity(self) -> str:
        said = {
            "generated": BY,
            "behaviour": self._blueprint.behaviour,
            "header": identity(self._request, self._bound.by_edge()),
        }
        return json.dumps(said, indent=1) + "\n"

    # State Branches -------------------------------------------------------------------------------

    def _branch(self, one: _BranchFile) -> str:
        branch = one.own
        readers = {digit: self._readers[branch.name, digit] for digit in sensed_digits(branch)}
        flags = tuple(python_branches.flags(branch, readers))
        states = python_branches.states(branch)
        operations = python_branches.operations(branch, self._bound)
        name = escape(branch.name)
        values = {
            "doc": remark(branch.name),
            "counts": counted(branch),
            "bases": self._bases(branch),
            "name": text_literal(branch.name),
            "initial": text_literal(branch.initial),
            "activating": text_literal(branch.activating),
            "flags": literal(flags, 4, len("flags="), 1),
            "states": [_row(f"{name}/{escape(key)}", key, call) for key, call in states.items()],
            "operations": [_row(f"{name}/{key}", key, call) for key, call in operations.items()],
            "modules": [*(["operations"] if operations else []), *(["sensors"] if readers else [])],
            "classes": ["Branch", "Flag", *(["Operation"] if operations else []), "State"],
        }
        return self._text("branch.py", branch=values)

    def _all_branches(self) -> dict[str, str]:
        modules = [one.module for one in self._branches]
        line = f"from . import {', '.join(sorted(modules, key=_natural))}"
        rows = "".join(f"    {one},\n" for one in sorted(modules, key=_natural))
        names = tuple(Code(f"{one}.BRANCH") for one in modules)
        return {
            "imports": line if len(line) <= WIDTH else f"from . import (\n{rows})",
            "names": literal(names, before=len("BRANCHES = ")),
        }

    def _bases(self, branch: StateBranch) -> str:
        blueprint = self._blueprint
        return " and ".join(
            f"{remark(blueprint[base].fact_name(digit))} of {remark(base)}"
            for base, digit in self._hierarchy.bases[branch.name]
        )

    # functions to fill in -------------------------------------------------------------------------

    def _functions(self) -> list[dict[str, str]]:
        for branch in self._blueprint:
            python_branches.operations(branch, self._bound)
        return [_function(one) for one in self._bound.functions]

    def _sensors(self) -> list[dict[str, str]]:
        return [
            {
                "name": reader,
                "key": mark_key(fact_text(*key)),
                "serves": remark(f"{self._blueprint[key[0]].fact_name(key[1])} of {key[0]}"),
                "alphabet": remark(", ".join(self._blueprint[key[0]].alphabet[key[1]])),
            }
            for key, reader in self._readers.items()
        ]

    def _readme(self) -> str:
        root = self._blueprint[self._hierarchy.roots[0]]
        edge = next((one.address for branch in self._blueprint for one in branch.edges()), "")
        functions = self._functions()
        example = self._text("operations.py", functions=functions[:1]).split("\n\n\n")[-1]
        branches = [
            {"module": one.module, "cell": remark(one.own.name), "counts": counted(one.own)}
            for one in self._branches
        ]
        return self._text(
            "README.md",
            goal=remark(str(Address(root.name, root.activating))),
            edge=remark(str(edge)),
            function_count=len(functions),
            example=textwrap.indent(example.strip("\n"), "   "),
            branches=branches,
            asks_people=asks_people(self._blueprint),
        )


def _row(address: str, key: str, call: CallLiteral) -> Mapping[str, str]:
    shown = text_literal(key)
    return {
        "address": remark(address),
        "key": shown,
        "value": literal(call, 8, len(shown) + 2, 1),
    }


def _function(one: Function) -> dict[str, str]:
    more = [f"{name}: {kind}" for name, kind in one.parameters.items()]
    return {
        "name": one.name,
        "key": mark_key(one.key),
        "serves": remark(" and ".join(one.serves)),
        "parameters": ", ".join(["world: Any", "edge: Edge", *(["*", *more] if more else [])]),
    }


def _natural(name: str) -> list[tuple[bool, int, str]]:
    """Return a key by which names are sorted as ruff sorts imports: numbers by their value."""
    parts = re.findall(r"\d+|\D+", name)
    return [(not part.isdigit(), int(part) if part.isdigit() else 0, part) for part in parts]


def _annotated(value: Json, kind: str, name: str) -> str:
    return literal(value, before=len(f"{name}: {kind} = "))


def _word(branch: StateBranch, digit: int) -> str:
    note = branch.fact_note(digit)
    return note.name if note and note.name else str(digit)
