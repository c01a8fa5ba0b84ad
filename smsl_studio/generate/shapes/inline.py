"""Puts a sub-SB back into its base: the two become one SB that behaves alike."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import AUTOMATIC
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.editing.levels import levels_spread
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.errors import EditRefused, PlanningError
from smsl_studio.generate.flat import FlatBranch
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.generate.shapes.claims import named_places
from smsl_studio.generate.shapes.moves import FactMoves
from smsl_studio.inspection.equivalence.equivalence import ComparedView, equivalence
from smsl_studio.inspection.equivalence.transitions import label_of
from smsl_studio.inspection.explorer.part import restricted, touching

Json = Any
WORKED_IN = ("requires", "subs", "touches")
"""What the edges of one SB show by themselves."""


def put_back(blueprint: Blueprint, sub: str, limit: int) -> Blueprint:
    """Return the blueprint in which a sub-SB and its base are one SB, named as the base.

    EditRefused if it has not exactly one base, or if what is left out would decide about it;
    CutRefused, with a run, if the result would behave otherwise. PlanningError if more than
    ``limit`` configurations can be reached, RunRefused if there is no start.
    """
    inlined = _Inlined(blueprint, sub, limit)
    after = inlined.blueprint()
    before = touching(blueprint, sub)
    kept = [name for name in after.branches if name in before.branches]
    told = equivalence(before, restricted(after, kept), limit, inlined.view(before))
    if told.equal is None:
        raise PlanningError(f"{sub} was not put back: {told.reason}", advice="Raise --limit.")
    if not told.equal:
        words = f"the result would behave otherwise: {told.reason}"
        raise CutRefused(words, None, "Flatten the base with --sb instead.", told.path)
    return after


class _Inlined:
    """The base and its sub-SB, while they become one SB."""

    def __init__(self, blueprint: Blueprint, sub: str, limit: int) -> None:
        self._before = blueprint
        self._sub = blueprint[sub]
        self._levels = Levels(blueprint)
        bases = blueprint.bases.get(sub, ())
        if len(bases) != 1:
            words = "no base" if not bases else " and ".join(f"the base {b}" for b, _ in bases)
            raise EditRefused(
                f"{sub} has {words}, and only a sub-SB of one base can be put back into it",
                advice="Name a sub-SB that one SB has in SUB_SBS.",
            )
        self._base = blueprint[bases[0][0]]
        count = self._base.num_facts
        facts = {(self._base.name, d): (self._base.name, d) for d in range(count)}
        facts |= {(sub, d): (self._base.name, count + d) for d in range(self._sub.num_facts)}
        self._moves = FactMoves(blueprint, facts, renamed=True)
        self._refuse()
        self._refuse_people()
        self._flat = FlatBranch(self._part(), limit)

    def blueprint(self) -> Blueprint:
        """Return the blueprint."""
        draft = Draft(self._before)
        self._moves.follow(draft)
        levels_spread(draft, self._spread)
        file = draft.file(self._before.home(self._base.name))
        (values,) = self._flat.values().values()
        self._must_have_one_goal(values)
        file[self._base.name] = self._with_rest(values)
        del file[self._sub.name]
        after = draft.done()
        self._moves.must_be_named(after)
        return after

    def view(self, part: Blueprint) -> ComparedView:
        """Return what is compared: all facts of a part, and operations with their former SBs."""
        several = len(part.branches) > 1

        def one(address: Address) -> str:
            return label_of(address, several)

        def other(address: Address) -> str:
            inside = address.branch == self._base.name
            return address.operation if inside else label_of(address, several)

        return ComparedView(self._moves.keys(part), (one, other))

    def _refuse(self) -> None:
        names = {self._base.name, self._sub.name}
        edges = Edges(Hierarchy(self._before))
        for name in sorted(names):
            outside = sorted(edges.required_by(name) - names)
            if outside:
                raise EditRefused(
                    f"operations of {name} require facts of {outside[0]}, which would be left out",
                    advice="Flatten the whole file instead.",
                )
        home = self._before.home
        if home(self._base.name) is not home(self._sub.name):
            raise EditRefused(
                f"{self._sub.name} and {self._base.name} are written in different files",
                advice="Write them in one file first.",
            )
        for one in named_places(self._before):
            if one.branch in names:
                raise EditRefused(
                    f"the property {one.claim!r} names {one.state or 'operations'} of "
                    f"{one.branch}, which get other names",
                    advice="Write the property with facts, or take it out first.",
                )

    def _refuse_people(self) -> None:
        """Raise EditRefused if people would no longer be asked after the change.

        An operation of the base may drive operations of the sub-SB that people carry out or
        confirm. In one SB all of them are one operation, and nobody would ask these people.
        """
        before = (self._base.name, self._sub.name)
        edges = Edges(Hierarchy(self._before))
        digit = next(d for d, name in self._base.subs.items() if name == self._sub.name)
        drives = [
            edge
            for state in self._base.table
            for edge in edges.out(before[0], state)
            if digit in (*edge.falls, *edge.rises) and not edge.load
        ]
        own = [edge for state in self._sub.table for edge in edges.out(before[1], state)]
        asked = next((edge for edge in (*own, *drives) if self._asks(edge.address)), None)
        if drives and asked is not None:
            raise EditRefused(
                f"people carry out or confirm {asked}, and {drives[0]} would move {before[1]} "
                "without asking them",
                advice="Leave the two apart, or let no person be asked there.",
            )

    def _asks(self, edge: Address) -> bool:
        note = self._before[edge.branch].operation_note(edge.state, edge.operation)
        return bool(note.confirm) or self._levels.operation(edge) != AUTOMATIC

    def _must_have_one_goal(self, values: Mapping[str, Json]) -> None:
        if not self._before.bases.get(self._base.name):
            return
        more = [note for note in values["_states"].values() if note.get("note") == "goal"]
        if more:
            raise EditRefused(
                f"{self._base.name} is in ACTIVATING with several states of {self._sub.name}, "
                "and its own base needs one",
                advice="Flatten the whole file instead.",
            )

    def _part(self) -> Blueprint:
        """Return the two SBs alone. The facts of other sub-SBs are facts as any."""
        digit = next(d for d, name in self._base.subs.items() if name == self._sub.name)
        base = replace(
            self._base,
            header=replace(self._base.header, sub_sbs=((self._sub.name, digit),)),
        )
        sub = replace(self._sub, header=replace(self._sub.header, sub_sbs=()))
        pair = {base.name: base, sub.name: sub}
        return replace(self._before, branches=MappingProxyType(pair))

    def _with_rest(self, values: dict[str, Json]) -> dict[str, Json]:
        """Return the one SB with the other sub-SBs of both, and the notes of its operations."""
        header = dict(values.pop(HEADER))
        count = self._base.num_facts
        subs = {sub: d for d, sub in self._base.subs.items() if sub != self._sub.name}
        subs |= {sub: count + d for d, sub in self._sub.subs.items()}
        if subs:
            header["SUB_SBS"] = subs
        notes = {**self._notes(self._base), **self._notes(self._sub)}
        for key, note in self._edge_notes(values, bool(subs)):
            notes[key] = note
        named = {"_operations": notes} if notes else {}
        return {HEADER: header, **named, **values}

    def _notes(self, branch: StateBranch) -> dict[str, Json]:
        """Return the notes of the names of operations, under their new names."""
        found = {}
        for name in branch.operation_names:
            left = _kept(branch, note_key(name))
            if left:
                found[note_key(label_of(Address(branch.name, "", name), True))] = left
        return found

    def _edge_notes(
        self, values: Mapping[str, Json], has_subs: bool
    ) -> Iterator[tuple[str, dict[str, Json]]]:
        """Yield the notes of single operations, by their keys.

        If the base has other sub-SBs, an operation that sets their facts itself keeps ``"subs":
        "load"``.
        """
        for state, here in self._flat.places.items():
            for branch in (self._base, self._sub):
                at = here[branch.name]
                for name in branch.table[at]:
                    label = label_of(Address(branch.name, "", name), True)
                    note = _kept(branch, note_key(name, at))
                    if has_subs and branch.operation_note(at, name).subs == "load":
                        note["subs"] = "load"
                    if note and label in values[state]:
                        yield note_key(label, state), note

    def _spread(self, key: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
        """Yield the new keys in ``_levels`` for the key of an element that has moved."""
        if key[0] not in (self._base.name, self._sub.name) or len(key) not in (2, 3):
            yield key
            return
        fact = self._moves.facts.get((key[0], int(key[1]))) if key[1].isdecimal() else None
        label = label_of(Address(key[0], "", key[-1]), True)
        if len(key) == 2:
            yield (fact[0], str(fact[1])) if fact is not None else (self._base.name, label)
            return
        for state, here in self._flat.places.items():
            if here[key[0]] == key[1]:
                yield self._base.name, state, label


def _kept(branch: StateBranch, key: str) -> dict[str, Json]:
    """Return the note of an operation, without the words that the flat SB already expresses."""
    written = branch.fields.get("_operations")
    note = written.get(key) if isinstance(written, Mapping) else None
    kept = note if isinstance(note, Mapping) else {}
    return {word: value for word, value in kept.items() if word not in WORKED_IN}
