"""The C++17 package of a blueprint: every file as text, by its path."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.blueprint.address import Address, escape, fact_text, note_key
from smsl_studio.blueprint.annotations import FactNote, OperationNote
from smsl_studio.blueprint.check import off_value
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.generate.code.blueprint_parts import (
    CodeRequest,
    counted,
    identity,
    sensed_digits,
)
from smsl_studio.generate.code.bound_functions import BoundFunctions
from smsl_studio.generate.code.cpp_literals import TAKEN, number, pieces, text
from smsl_studio.generate.code.identifiers import Namer
from smsl_studio.generate.code.kept_parts import mark_key
from smsl_studio.generate.code.templates import BY, remark, rendered
from smsl_studio.library.bindings_file import BindingsFile
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.shipped import resources_dir

Json = Any


class CppPackage:
    """Makes the files of one package. ``files`` has them by their paths in the folder."""

    suffixes = (".cpp", ".hpp")

    def __init__(self, request: CodeRequest, file: BindingsFile | None = None) -> None:
        self._request = request
        self._blueprint = request.blueprint
        self._hierarchy = Hierarchy(request.blueprint)
        self._bound = BoundFunctions(request.blueprint, file, TAKEN)
        self._numbers = {one.name: at for at, one in enumerate(request.blueprint)}
        modules = Namer("sb", {*TAKEN, "branches"})
        self._modules = {one.name: modules.name(one.name, one.name) for one in request.blueprint}
        readers = Namer("fact", TAKEN)
        self._readers: dict[tuple[str, int], str] = {}
        for one in request.blueprint:
            for digit in sensed_digits(one):
                note = one.fact_note(digit)
                word = note.name if note and note.name else str(digit)
                key = (one.name, digit)
                self._readers[key] = readers.name(key, f"{one.name}_{word}")

    @property
    def files(self) -> dict[str, str]:
        """Every file as text."""
        core = self.core
        cmake = self._text("CMakeLists.txt", sources=self._sources(core))
        return {
            **core,
            "tests/test_run.cpp": self._cpp("test_run.cpp"),
            "CMakeLists.txt": f"# {BY}.\n{cmake}",
            "README.md": f"<!-- {BY}. -->\n\n{self._readme(len(self._functions()))}",
        }

    def _sources(self, core: Mapping[str, str]) -> list[str]:
        """Return the paths of what is compiled into the library."""
        main = f"{self._request.name}/main.cpp"
        return [path for path in core if path.endswith(".cpp") and path != main]

    @property
    def core(self) -> dict[str, str]:
        """The blueprint, the dispatcher, and the functions to fill in."""
        name = self._request.name
        branches = {
            f"{name}/branches/{self._modules[one.name]}.cpp": self._branch(one)
            for one in self._blueprint
        }
        functions, sensors = self._functions(), self._sensors()
        engine = self._engine()
        modules = list(self._modules.values())
        return {
            f"{name}/main.cpp": self._cpp("main.cpp"),
            f"{name}/blueprint.hpp": self._cpp("blueprint.hpp"),
            f"{name}/blueprint.cpp": self._whole(),
            f"{name}/branches/branches.hpp": self._cpp("branches.hpp", branches=modules),
            **branches,
            f"{name}/operations.hpp": self._cpp("operations.hpp", functions=functions),
            f"{name}/operations.cpp": self._cpp("operations.cpp", functions=functions),
            f"{name}/sensors.hpp": self._cpp("sensors.hpp", sensors=sensors),
            f"{name}/sensors.cpp": self._cpp("sensors.cpp", sensors=sensors),
            **engine,
        }

    # texts ----------------------------------------------------------------------------------------

    def _text(self, template: str, **values: Json) -> str:
        request = self._request
        said = {"package": request.name, "file_name": remark(request.file_name), **values}
        return rendered("cpp", template, **said)

    def _cpp(self, template: str, **values: Json) -> str:
        return self._headed(self._text(template, **values))

    def _headed(self, text: str) -> str:
        """Return a C++ text under the licence, and the words by which it is known."""
        lines = [f"// {line}".rstrip() for line in self._request.licence.splitlines()]
        whole = [f"{line} //" if line.endswith("\\") else line for line in lines]
        return "\n".join([*whole, f"// {BY}.", "", text])

    def _engine(self) -> dict[str, str]:
        folder = resources_dir() / "code" / "cpp" / "dsfo"
        return {
            f"{self._request.name}/dsfo/{one.name}": self._headed(one.read_text("utf-8"))
            for one in sorted(folder.glob("*.?pp"))
        }

    # the blueprint --------------------------------------------------------------------------------

    def _whole(self) -> str:
        request = self._request
        hazards = [
            {
                "name": text(one.name),
                "facts": [
                    {"at": f"{self._numbers[branch]}, {digit}", "value": text(value)}
                    for (branch, digit), value in one.facts
                ],
            }
            for one in request.hazards
        ]
        header = json.dumps(identity(request, self._bound.by_edge()), separators=(",", ":"))
        return self._cpp(
            "blueprint.cpp",
            digests=request.digests,
            file_digest=sha256_hex(self._blueprint.document.encoded()),
            record=request.record_digest,
            identity=pieces(header[1:-1]),
            branches=list(self._modules.values()),
            hazards=hazards,
            levels=[(text(key), text(level)) for key, level in self._blueprint.levels.items()],
            findings=text(request.findings),
            left_out=[(text(at), text(sentence)) for at, sentence in request.left_out],
            behaviour=text(self._blueprint.behaviour),
        )

    # State Branches -------------------------------------------------------------------------------

    def _branch(self, branch: StateBranch) -> str:
        numbers = {name: at for at, name in enumerate(branch.table)}
        said = {
            "function": self._modules[branch.name],
            "doc": remark(branch.name),
            "counts": counted(branch),
            "bases": self._bases(branch),
            "name": text(branch.name),
            "initial": numbers[branch.initial],
            "activating": numbers[branch.activating],
            "flags": [list(self._flag(branch, digit)) for digit in range(branch.num_facts)],
            "states": [
                {"number": at, "row": ", ".join(map(text, (name, *branch.facts(name))))}
                for name, at in numbers.items()
            ],
            "edges": [
                {
                    "source": numbers[edge.source],
                    "operation": text(edge.name),
                    "target": numbers[edge.target],
                    "address": remark(str(edge.address)),
                }
                for edge in branch.edges()
            ],
            "failures": [
                {"state": at, "why": text(why)}
                for name, at in numbers.items()
                if (why := _failure(branch, name))
            ],
            "operations": list(self._operations(branch)),
        }
        return self._cpp("branch.cpp", branch=said)

    def _bases(self, branch: StateBranch) -> str:
        return " and ".join(
            f"{remark(self._blueprint[base].fact_name(digit))} of {remark(base)}"
            for base, digit in self._hierarchy.bases[branch.name]
        )

    def _flag(self, branch: StateBranch, digit: int) -> Iterator[str]:
        note, sub = branch.fact_note(digit), branch.subs.get(digit, "")
        if note is not None and note.name:
            yield f"name = {text(note.name)}"
        yield f"values = {_texts(branch.alphabet[digit])}"
        if sub:
            yield f"sub = {text(sub)}"
            yield f"on = {text(branch.on_value(digit))}"
            yield f"off = {text(off_value(branch, digit))}"
        else:
            yield f"read = sensors::{self._readers[branch.name, digit]}"
        if note is not None and note.failure:
            yield f"failure = {_texts(note.failure)}"
        if note is not None and note.critical:
            yield "critical = true"
        if note is not None:
            yield from _told(note)

    def _operations(self, branch: StateBranch) -> Iterator[Mapping[str, Json]]:
        for name in branch.operation_names:
            note = branch.notes.operations.get(note_key(name)) or OperationNote()
            yield self._operation(branch, note, name)
        for state, operations in branch.table.items():
            for name in operations:
                own = note_key(name, state) in branch.notes.operations
                if own or self._bound.differs(branch, name, state):
                    yield self._operation(branch, branch.operation_note(state, name), name, state)

    def _operation(
        self, branch: StateBranch, note: OperationNote, name: str, state: str = ""
    ) -> Mapping[str, Json]:
        key = note_key(name, state) if state else note_key(name)
        return {
            "address": remark(f"{escape(branch.name)}/{key}"),
            "key": text(key),
            "lines": list(self._terms(branch, note, name, state)),
        }

    def _terms(
        self, branch: StateBranch, note: OperationNote, name: str, state: str
    ) -> Iterator[str]:
        function, arguments = self._bound.of(branch, name, state)
        yield f"run = operations::{function.name}"
        yield f"function = {text(function.name)}"
        if note.title:
            yield f"title = {text(note.title)}"
        if note.cost is not None and note.cost != 1.0:
            yield f"cost = {number(note.cost)}"
        if note.risk:
            yield f"risk = {text(note.risk)}"
        if note.actor in ("human", "shared"):
            yield f"actor = {text(note.actor)}"
        if note.confirm:
            yield f"confirm = {_texts(note.confirm)}"
        if note.timeout is not None:
            yield f"timeout = {number(note.timeout)}"
        if note.stop and note.stop != "hold":
            yield f"stop = {text(note.stop)}"
        if note.subs == "load":
            yield "load = true"
        if note.resumes is False:
            yield "resumes = false"
        yield from _asked(note)
        touches = [digit for digit in note.touches if digit < branch.num_facts]
        if touches:
            yield f"touches = {{{', '.join(map(str, touches))}}}"
        for fact, value in note.requires.items():
            yield f"requires_facts.emplace_back({text(fact)}, {text(value)})"
        if arguments:
            yield f"arguments = {text(json.dumps(dict(arguments)))}"

    # functions to fill in -------------------------------------------------------------------------

    def _functions(self) -> list[dict[str, str]]:
        for branch in self._blueprint:
            list(self._operations(branch))
        return [
            {
                "name": one.name,
                "key": mark_key(one.key),
                "serves": remark(" and ".join(one.serves)),
            }
            for one in self._bound.functions
        ]

    def _sensors(self) -> list[dict[str, Json]]:
        return [
            {
                "name": reader,
                "key": mark_key(fact_text(*key)),
                "serves": remark(f"{self._blueprint[key[0]].fact_name(key[1])} of {key[0]}"),
                "alphabet": remark(", ".join(self._blueprint[key[0]].alphabet[key[1]])),
                "branch": self._numbers[key[0]],
                "digit": key[1],
            }
            for key, reader in self._readers.items()
        ]

    def _readme(self, count: int) -> str:
        root = self._blueprint[self._hierarchy.roots[0]]
        edge = next((one.address for branch in self._blueprint for one in branch.edges()), "")
        return self._text(
            "README.md",
            goal=remark(str(Address(root.name, root.activating))),
            edge=remark(str(edge)),
            function_count=count,
            record=self._request.record_digest,
            branches=[
                {
                    "module": self._modules[one.name],
                    "cell": remark(one.name),
                    "counts": counted(one),
                }
                for one in self._blueprint
            ],
        )


def _texts(values: tuple[str, ...]) -> str:
    return f"{{{', '.join(f'std::string({text(one)})' for one in values)}}}"


def _told(note: FactNote) -> Iterator[str]:
    """Yield what a flag says of the people who tell it."""
    if note.aggregation == "human":
        yield "told_by_people = true"
    if note.max_age is not None:
        yield f"max_age = {number(note.max_age)}"
    for value, meaning in note.values.items():
        yield f"meanings.emplace_back({text(value)}, {text(meaning)})"
    if note.unit:
        yield f"unit = {text(note.unit)}"
    yield from _asked(note)


def _asked(note: FactNote | OperationNote) -> Iterator[str]:
    """Yield who is asked, how, and how long."""
    if note.question:
        yield f"asked.question = {text(note.question)}"
    if note.roles:
        yield f"asked.roles = {_texts(note.roles)}"
    if note.answer_within is not None:
        yield f"asked.within = {number(note.answer_within)}"
    if note.escalates_to:
        yield f"asked.escalates_to = {text(note.escalates_to)}"


def _failure(branch: StateBranch, state: str) -> str:
    """Return the facts that make a state a failure state, in words; empty if it is none."""
    found = []
    for digit, value in enumerate(branch.facts(state)):
        note = branch.fact_note(digit)
        if note is not None and value in note.failure:
            found.append(f"{branch.fact_name(digit)} would be {value}")
    return " and ".join(found)
