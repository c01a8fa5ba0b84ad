"""The Blueprint with its State Branches: frozen values that are equal if they mean the same.

The tables (state -> operation -> target) are the plain dictionaries from the reader, so that a file
with 177,144 operations loads without an object for each edge. ``State`` and ``Operation`` are made
when they are asked for. Nobody may change a table: edits make new ones (see ``editing``).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.elements import EMPTY, Header, Operation, State
from smsl_studio.blueprint.facts import FactShape, shape_of
from smsl_studio.blueprint.notes import NO_NOTES, Notes, read_notes
from smsl_studio.blueprint.resolution import resolved
from smsl_studio.errors import AddressError, Place, did_you_mean

if TYPE_CHECKING:
    from smsl_studio.blueprint.annotations import FactNote, Hazard, OperationNote, StateNote
    from smsl_studio.blueprint.drawn import Drawn
    from smsl_studio.blueprint.imported_files import Imports
    from smsl_studio.smsl.document import Document

Json = Any
Table = dict[str, Mapping[str, str]]


@dataclass(frozen=True, eq=False)
class StateBranch:
    """One FSM: its header, its states in order, and its ``_`` fields as they were read.

    ``state_fields`` has the ``_`` fields inside states.
    """

    name: str
    table: Table
    header: Header = field(default_factory=Header)
    fields: Mapping[str, Json] = field(default_factory=lambda: EMPTY)
    state_fields: Mapping[str, Mapping[str, Json]] = field(default_factory=lambda: EMPTY)

    @property
    def address(self) -> Address:
        """The address of this State Branch."""
        return Address(self.name)

    @cached_property
    def states(self) -> Mapping[str, State]:
        """Every state by name, in written order."""
        return MappingProxyType({name: self._state(name) for name in self.table})

    @property
    def initial(self) -> str:
        """INITIAL, or the first state. Empty if there are no states."""
        return self.header.initial or next(iter(self.table), "")

    @property
    def activating(self) -> str:
        """ACTIVATING, or the last state. Empty if there are no states."""
        return self.header.activating or next(reversed(self.table), "")

    @cached_property
    def shape(self) -> FactShape:
        """How the names of the states show their facts. ``_states`` may give facts for opaque
        names.
        """
        given = {n: note.facts for n, note in self.notes.states.items() if note.facts}
        counts = {len(facts) for facts in given.values()}
        if given and len(counts) == 1 and all(name in given for name in self.table):
            return FactShape(counts.pop(), 0)
        return shape_of(self.table, self.header.num_facts)

    @property
    def num_facts(self) -> int:
        """The number of facts of each state."""
        return self.shape.num_facts

    def facts(self, state: str) -> tuple[str, ...]:
        """Return the fact values of a state, digit 0 first."""
        found = self._facts.get(state)
        if found is None:
            found = self._facts[state] = self._read_facts(state)
        return found

    @cached_property
    def _facts(self) -> dict[str, tuple[str, ...]]:
        return {}

    def _read_facts(self, state: str) -> tuple[str, ...]:
        shape = self.shape
        if shape.width == 0 and not shape.opaque:
            note = self.notes.states.get(state)
            return note.facts if note else ()
        return shape.values(state)

    def states_with(self, digit: int, value: str) -> frozenset[str]:
        """Return the states in which a fact has a value.

        The result is kept, because many conditions ask for the same states.
        """
        found = self._having.get((digit, value))
        if found is None:
            pairs = ((name, self.facts(name)[digit : digit + 1]) for name in self.table)
            found = frozenset(name for name, known in pairs if known == (value,))
            self._having[digit, value] = found
        return found

    @cached_property
    def _having(self) -> dict[tuple[int, str], frozenset[str]]:
        return {}

    @cached_property
    def subs(self) -> Mapping[int, str]:
        """The sub-SB of each digit that has one. Of several the first one counts, and R07 reports
        the others.
        """
        found: dict[int, str] = {}
        for sub, digit in self.header.sub_sbs:
            found.setdefault(digit, sub)
        return MappingProxyType(found)

    @cached_property
    def operation_names(self) -> Mapping[str, None]:
        """The names of all operations, each once, in written order."""
        return dict.fromkeys(chain.from_iterable(self.table.values()))

    @cached_property
    def alphabet(self) -> tuple[tuple[str, ...], ...]:
        """The values of each digit in the states, sorted. Empty if there are no states."""
        if self.shape.width or self.shape.opaque:
            return self.shape.alphabet(self.table)
        columns = zip(*(self.facts(name) for name in self.table), strict=True)
        return tuple(tuple(sorted(set(column))) for column in columns)

    def on_value(self, digit: int) -> str:
        """Return the value of ``digit`` that counts as on.

        It is the value in ``_facts``. Otherwise it is ``1`` if the values are in {0, 1}, or else
        the digit's value in the ACTIVATING state (clause 1).
        """
        note = self.notes.facts.get(digit)
        return self.default_on_value(digit) if note is None or note.on is None else note.on

    def default_on_value(self, digit: int) -> str:
        """Return the value of ``digit`` that counts as on if ``_facts`` does not say it."""
        found = self._on_values.get(digit)
        if found is None:
            found = self._on_values[digit] = self._work_out_on_value(digit)
        return found

    @cached_property
    def _on_values(self) -> dict[int, str]:
        return {}

    def _work_out_on_value(self, digit: int) -> str:
        values = self.alphabet[digit] if 0 <= digit < len(self.alphabet) else ()
        if set(values) <= {"0", "1"}:
            return "1"
        facts = self.facts(self.activating) if self.activating in self.table else ()
        return facts[digit] if 0 <= digit < len(facts) else "1"

    def is_on(self, state: str, digit: int) -> bool:
        """Return whether ``digit`` is on in ``state``. A digit that the SB does not have is never
        on.
        """
        facts = self.facts(state)
        return 0 <= digit < len(facts) and facts[digit] == self.on_value(digit)

    @cached_property
    def notes(self) -> Notes:
        """The annotations of this SB with their types."""
        if not any(k in self.fields for k in ("_facts", "_states", "_operations", "_layout")):
            return NO_NOTES
        return read_notes(self.fields)

    @cached_property
    def drawn(self) -> Drawn:
        """The notes and groups on the drawing of this SB. They have no meaning."""
        from smsl_studio.blueprint.drawn import read_drawn

        return read_drawn(self.fields, self.table)

    def fact_name(self, digit: int) -> str:
        """Return the name of a fact, or ``Fact 1`` (counted from 1) if it has none."""
        note = self.fact_note(digit)
        return note.name if note and note.name else f"Fact {digit + 1}"

    def fact_note(self, digit: int) -> FactNote | None:
        """Return the note of a digit (counted from 0), None if there is none."""
        return self.notes.facts.get(digit)

    def state_note(self, state: str) -> StateNote | None:
        """Return the note of a state, None if there is none."""
        return self.notes.states.get(state)

    def operation_note(self, state: str, operation: str) -> OperationNote:
        """Return the annotations of one edge. Those of ``State/Operation`` override those of the
        name.
        """
        return self.notes.operation(state, operation)

    def cost(self, state: str, operation: str) -> float:
        """Return the declared cost of an edge, or 1."""
        if "_operations" not in self.fields:
            return 1.0
        cost = self.operation_note(state, operation).cost
        return 1.0 if cost is None else cost

    def edges(self) -> Iterator[Operation]:
        """Yield every operation, in written order."""
        for source, operations in self.table.items():
            for name, target in operations.items():
                yield Operation(self.name, source, name, target)

    def operation(self, state: str, operation: str) -> Operation:
        """Return one operation as a value. KeyError if the SB has no such state or operation."""
        return Operation(self.name, state, operation, self.table[state][operation])

    @cached_property
    def edge_count(self) -> int:
        """The number of operations of all states."""
        return sum(map(len, self.table.values()))

    def _state(self, name: str) -> State:
        operations = {
            op: Operation(self.name, name, op, target) for op, target in self.table[name].items()
        }
        return State(self.name, name, self.facts(name), MappingProxyType(operations))

    @cached_property
    def meaning(self) -> Json:
        """This SB as plain values, with explicit defaults, without layout and comments."""
        from smsl_studio.blueprint.meaning import branch_meaning

        return branch_meaning(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, StateBranch):
            return NotImplemented
        return self.name == other.name and self.meaning == other.meaning

    __hash__ = None  # type: ignore[assignment]


@dataclass(frozen=True, slots=True)
class ImportFault:
    """An import that failed: its place, the reason, the files that led to it, and an advice."""

    path: tuple[str, ...]
    sentence: str
    chain: tuple[str, ...]
    document: Document
    advice: str

    @property
    def place(self) -> Place:
        """The place of the failed import in its file."""
        return self.document.place(self.path)


@dataclass(frozen=True, eq=False)
class Blueprint:
    """The whole hFSM of one procedure: an ordered set of State Branches, and its documents.

    The SBs of imported files come after its own. ``imported`` has the document of each imported SB,
    where edits change it. ``imports`` says how the files lead to each other.
    """

    branches: Mapping[str, StateBranch]
    document: Document
    fields: Mapping[str, Json] = field(default_factory=lambda: EMPTY)
    imported: Mapping[str, Document] = field(default_factory=lambda: EMPTY)
    import_faults: tuple[ImportFault, ...] = ()
    imports: Imports | None = None

    def __getitem__(self, branch: str) -> StateBranch:
        try:
            return self.branches[branch]
        except KeyError:
            raise AddressError(
                f"there is no State Branch {branch!r}", advice=did_you_mean(branch, self.branches)
            ) from None

    def __iter__(self) -> Iterator[StateBranch]:
        return iter(self.branches.values())

    def __len__(self) -> int:
        return len(self.branches)

    @property
    def file(self) -> str:
        """The name of the file in messages."""
        return self.document.file

    @property
    def documents(self) -> tuple[Document, ...]:
        """Every document of the blueprint, its own first, each once."""
        files = self.imports.files if self.imports else ()
        return (self.document, *(item.document for item in files))

    def home(self, branch: str) -> Document:
        """Return the document of an SB, or the blueprint's own document for an unknown name."""
        return self.imported.get(branch, self.document)

    @cached_property
    def bases(self) -> Mapping[str, tuple[tuple[str, int], ...]]:
        """For each sub-SB its bases: pairs (base SB, digit), in file order."""
        found: dict[str, list[tuple[str, int]]] = {}
        for branch in self:
            for digit, sub in branch.subs.items():
                found.setdefault(sub, []).append((branch.name, digit))
        return MappingProxyType({sub: tuple(pairs) for sub, pairs in found.items()})

    @cached_property
    def roots(self) -> tuple[str, ...]:
        """The SBs that are in no SUB_SBS, in file order."""
        named = {sub for branch in self for sub, _ in branch.header.sub_sbs}
        return tuple(name for name in self.branches if name not in named)

    @cached_property
    def hazards(self) -> tuple[Hazard, ...]:
        """The hazards in all documents: facts that must never hold together."""
        return tuple(hazard for one in self.documents for hazard in self.hazards_of(one))

    def hazards_of(self, document: Document) -> tuple[Hazard, ...]:
        """Return the hazards in one of its documents."""
        if "_hazards" not in document.values:
            return ()
        from smsl_studio.blueprint.annotations import read_hazards

        return read_hazards(document.values["_hazards"])[0]

    @cached_property
    def levels(self) -> Mapping[str, str]:
        """The levels that its documents declare. Of equal keys the first document counts."""
        found: dict[str, str] = {}
        for document in self.documents:
            for key, level in self.levels_of(document).items():
                found.setdefault(key, level)
        return MappingProxyType(found)

    def levels_of(self, document: Document) -> Mapping[str, str]:
        """Return the levels that one of its documents declares."""
        if "_levels" not in document.values:
            return EMPTY
        from smsl_studio.blueprint.annotations import read_levels

        return read_levels(document.values["_levels"])[0]

    @property
    def state_count(self) -> int:
        """The number of states of all SBs, also imported ones."""
        return sum(len(branch.table) for branch in self)

    @cached_property
    def operation_count(self) -> int:
        """The number of operations of all SBs, also imported ones."""
        return sum(branch.edge_count for branch in self)

    def resolve(self, text: str | Address) -> Address:
        """Return the address of an element that exists. AddressError, with a similar name, if it
        does not.

        The SB may be left out if the file has one root: ``State_aaa/Op_1c``.
        """
        return resolved(self, text)

    def place(self, address: Address, *below: str) -> Place:
        """Return the place of an address (or of a key below it, such as HEADER, INITIAL) in the
        text.
        """
        return self.home(address.branch).place((*address.path, *below))

    @cached_property
    def meaning(self) -> Json:
        """Everything that digests cover, as plain values. The order of SBs counts."""
        from smsl_studio.blueprint.meaning import blueprint_meaning

        return blueprint_meaning(self)

    @cached_property
    def behaviour(self) -> str:
        """SHA-256 of the SBs (also imported ones), their states, operations and headers."""
        from smsl_studio.blueprint.behaviour import behaviour_of

        return behaviour_of(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Blueprint):
            return NotImplemented
        return bool(self.meaning == other.meaning)

    __hash__ = None  # type: ignore[assignment]
