"""Puts a sub-SB back into its base: the two become one SB that behaves alike."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.address import Address, fact_text, note_key, split_fact
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.editing.conditions import Facts, conditions_follow, properties_follow
from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.editing.levels import levels_follow
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.properties import FactTerm, Term
from smsl_studio.blueprint.properties.meaning import fact_of
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.errors import EditRefused, PlanningError
from smsl_studio.generate.flat import FlatBranch
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.generate.shapes.claims import named_places
from smsl_studio.inspection.equivalence.equivalence import ComparedView, equivalence
from smsl_studio.inspection.equivalence.transitions import FactAt, label_of
from smsl_studio.inspection.explorer.part import restricted, touching

Json = Any
Places = Mapping[str, Mapping[str, str]]
"""For each state of the one SB the states of the two."""
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
        self._before, self._limit = blueprint, limit
        self._sub = blueprint[sub]
        bases = blueprint.bases.get(sub, ())
        if len(bases) != 1:
            words = "no base" if not bases else " and ".join(f"the base {b}" for b, _ in bases)
            raise EditRefused(
                f"{sub} has {words}, and only a sub-SB of one base can be put back into it",
                advice="Name a sub-SB that one SB has in SUB_SBS.",
            )
        self._base = blueprint[bases[0][0]]
        count = self._base.num_facts
        self._facts = {(self._base.name, d): (self._base.name, d) for d in range(count)}
        self._facts |= {(sub, d): (self._base.name, count + d) for d in range(self._sub.num_facts)}
        self._refuse()

    def blueprint(self) -> Blueprint:
        """Return the blueprint."""
        draft = Draft(self._before)
        conditions_follow(draft, self._moved_facts)
        properties_follow(draft, self._moved_term)
        levels_follow(draft, self._moved_level)
        file = draft.file(self._before.home(self._base.name))
        flat = FlatBranch(self._part(), self._limit)
        (values,) = flat.values().values()
        self._must_have_one_goal(values)
        file[self._base.name] = self._with_rest(values, flat.places)
        del file[self._sub.name]
        return draft.done()

    def view(self, part: Blueprint) -> ComparedView:
        """Return what is compared: all facts of a part, and operations with their former SBs."""
        before: dict[str, FactAt] = {}
        after: dict[str, FactAt] = {}
        for branch in part:
            for digit in range(branch.num_facts):
                key, at = f"{branch.name}/{digit}", (branch.name, digit)
                before[key], after[key] = at, self._facts.get(at, at)
        several = len(part.branches) > 1

        def one(address: Address) -> str:
            return label_of(address, several)

        def other(address: Address) -> str:
            inside = address.branch == self._base.name
            return address.operation if inside else label_of(address, several)

        return ComparedView((before, after), (one, other))

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

    def _with_rest(self, values: dict[str, Json], places: Places) -> dict[str, Json]:
        """Return the one SB with the other sub-SBs of both, and the notes of its operations."""
        header = dict(values.pop(HEADER))
        count = self._base.num_facts
        subs = {sub: d for d, sub in self._base.subs.items() if sub != self._sub.name}
        subs |= {sub: count + d for d, sub in self._sub.subs.items()}
        if subs:
            header["SUB_SBS"] = subs
        notes = {**self._notes(self._base), **self._notes(self._sub)}
        loaded = self._loaded(values, places) if subs else {}
        for key, note in loaded.items():
            notes[key] = {**notes.get(key, {}), **note}
        named = {"_operations": notes} if notes else {}
        return {HEADER: header, **named, **values}

    def _notes(self, branch: StateBranch) -> dict[str, Json]:
        """Return the notes of the names of operations, under their new names."""
        written = branch.fields.get("_operations")
        found = {}
        for name in branch.operation_names:
            note = written.get(note_key(name)) if isinstance(written, Mapping) else None
            if isinstance(note, Mapping):
                left = {key: value for key, value in note.items() if key not in WORKED_IN}
                if left:
                    found[note_key(label_of(Address(branch.name, "", name), True))] = left
        return found

    def _loaded(self, values: Mapping[str, Json], places: Places) -> dict[str, Json]:
        """Return the notes of the operations whose function brings facts of other sub-SBs about."""
        found = {}
        for state, here in places.items():
            for branch in (self._base, self._sub):
                for name in branch.table[here[branch.name]]:
                    label = label_of(Address(branch.name, "", name), True)
                    loads = branch.operation_note(here[branch.name], name).subs == "load"
                    if loads and label in values[state]:
                        found[note_key(label, state)] = {"subs": "load"}
        return found

    def _moved_facts(self, facts: Facts) -> Facts:
        texts = {}
        for text in facts:
            fact = split_fact(text)
            if fact is not None and fact in self._facts:
                texts[text] = fact_text(*self._facts[fact])
        return {texts.get(text, text): value for text, value in facts.items()} if texts else facts

    def _moved_term(self, term: Term) -> Term:
        fact = fact_of(term, self._before) if isinstance(term, FactTerm) else None
        if fact is None or fact not in self._facts or not isinstance(term, FactTerm):
            return term
        branch, digit = self._facts[fact]
        return replace(term, branch=branch if term.branch else "", digit=digit, name="")

    def _moved_level(self, key: tuple[str, ...]) -> tuple[str, ...] | None:
        if key[0] not in (self._base.name, self._sub.name):
            return key
        if len(key) == 2 and key[1].isdecimal():
            fact = self._facts.get((key[0], int(key[1])))
            return None if fact is None else (fact[0], str(fact[1]))
        if len(key) == 2:
            return (self._base.name, f"{key[0]}.{key[1]}")
        return None
