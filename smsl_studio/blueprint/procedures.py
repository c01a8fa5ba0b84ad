"""Procedures: blueprints that an operation of another blueprint runs as one operation.

``_operations`` names them: ``"binding": {"blueprint": FILE, "goal": SB/State}``. A procedure runs
one level down: it has no operations of this kind itself, and no SB has the name of one outside.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.project import real_path
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.stored import digest_named
from smsl_studio.errors import AddressError, ReadError
from smsl_studio.smsl.document import Document

if TYPE_CHECKING:
    from smsl_studio.blueprint.annotations import ProcedureBinding


def _closure(blueprint: Blueprint) -> str:
    """Return the digest of the closure. A check without such a name does not load what digests
    need, because that takes a tenth of its start."""
    from smsl_studio.blueprint.digests import digests

    return digests(blueprint).closure


@dataclass(frozen=True, eq=False)
class BoundProcedure:
    """A blueprint that an operation runs to ``goal``. ``name`` is what the binding writes."""

    name: str
    blueprint: Blueprint
    goal: Address


@dataclass(frozen=True)
class ProcedureFault:
    """Why an operation cannot run the blueprint that it names, with an advice."""

    branch: str
    key: str
    sentence: str
    advice: str = ""


@dataclass(frozen=True, eq=False)
class Procedures:
    """The procedures of a blueprint: for each edge that runs one, and each file once."""

    bound: Mapping[Address, BoundProcedure] = field(default_factory=dict)
    files: Mapping[str, Blueprint] = field(default_factory=dict)
    """The blueprints by the names in the bindings. Two names of one file have one blueprint."""
    faults: tuple[ProcedureFault, ...] = ()

    @property
    def parts(self) -> tuple[Blueprint, ...]:
        """Each blueprint once."""
        return tuple({id(one): one for one in self.files.values()}.values())


NONE = Procedures()
_DEEP = "it runs a blueprint itself, and procedures go one level down only"


def procedures_of(blueprint: Blueprint, opened: Iterable[Document] = ()) -> Procedures:
    """Return the procedures of a blueprint, with the faults of those that cannot be run.

    Files are read from the disk, except ``opened`` documents.
    """
    written = list(_written(blueprint))
    if not written:
        return NONE
    known = {real_path(one.file): one for one in opened}
    found = _ProcedureReader(blueprint, known)
    bound: dict[Address, BoundProcedure] = {}
    for branch, key, binding in written:
        procedure = found.procedure(branch, key, binding)
        if procedure is not None:
            bound |= dict.fromkeys(_edges(branch, binding), procedure)
    return Procedures(bound, found.files, tuple(found.faults))


def has_procedures(blueprint: Blueprint) -> bool:
    """Return whether an operation of a blueprint names another blueprint."""
    return next(_written(blueprint), None) is not None


def _written(blueprint: Blueprint) -> Iterator[tuple[StateBranch, str, ProcedureBinding]]:
    for branch in blueprint:
        if "_operations" in branch.fields:
            from smsl_studio.blueprint.annotations import ProcedureBinding

            for key, note in branch.notes.operations.items():
                if isinstance(note.binding, ProcedureBinding):
                    yield branch, key, note.binding


def _edges(branch: StateBranch, binding: ProcedureBinding) -> Iterator[Address]:
    for edge in branch.edges():
        if branch.operation_note(edge.source, edge.name).binding == binding:
            yield edge.address


class _ProcedureReader:
    """The files that were read so far, and the faults."""

    def __init__(self, blueprint: Blueprint, known: Mapping[str, Document]) -> None:
        self._blueprint, self._known = blueprint, known
        self._by_place: dict[str, Blueprint] = {}
        self.files: dict[str, Blueprint] = {}
        self.faults: list[ProcedureFault] = []

    def procedure(
        self, branch: StateBranch, key: str, binding: ProcedureBinding
    ) -> BoundProcedure | None:
        """Return the procedure of a binding. None, with a fault, if it cannot be run."""
        name = binding.blueprint
        try:
            part = self.files.get(name) or self._read(self._blueprint.home(branch.name), name)
            goal = part.resolve(binding.goal)
        except ReadError as error:
            return self._no(branch, key, f"{name} cannot be run: {error.sentence}", error.advice)
        except AddressError as error:
            return self._no(branch, key, f"its goal is not in {name}: {error}", error.advice)
        if goal.operation or not goal.state or str(goal) != binding.goal:
            return self._no(branch, key, f"its goal {binding.goal} is no state", "Write SB/State.")
        same = [one.name for one in part if one.name in self._blueprint.branches]
        same += [
            one.name
            for other in self.files.values()
            if other is not part
            for one in other
            if one.name in part.branches
        ]
        if same:
            words = f"{name} has a State Branch {same[0]}, and so has another blueprint of this run"
            return self._no(branch, key, words, "Rename one of the two.")
        if has_procedures(part):
            return self._no(branch, key, f"{name} cannot be run: {_DEEP}", "Import its SBs.")
        self.files[name] = part
        return BoundProcedure(name, part, goal)

    def _read(self, home: Document, name: str) -> Blueprint:
        from smsl_studio.blueprint.imports import named_document

        document = named_document(home, name)
        place = real_path(document.file)
        if place == real_path(self._blueprint.file):
            raise ReadError("it would run itself", None, "Name another file.")
        if place not in self._by_place:
            part = read_blueprint(self._known.get(place, document))
            digest = digest_named(name)
            if digest and _closure(part) != digest:
                words = "the store holds something else under this digest"
                raise ReadError(words, None, "Add the file to the store again.")
            self._by_place[place] = part
        return self._by_place[place]

    def _no(
        self, branch: StateBranch, key: str, sentence: str, advice: str
    ) -> BoundProcedure | None:
        self.faults.append(ProcedureFault(branch.name, key, sentence, advice))
        return None


def is_exact(branch: StateBranch, edge: Address) -> bool:
    """Return whether the binding of a procedure names exactly this ``State/Operation``."""
    from smsl_studio.blueprint.annotations import ProcedureBinding

    note = branch.notes.operations.get(note_key(edge.operation, edge.state))
    return note is not None and isinstance(note.binding, ProcedureBinding)
