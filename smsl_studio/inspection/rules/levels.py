"""Rules about base SBs and their sub-SBs (R07, R08, R13, R14; paper, Hierarchical State
Representation)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import read_by_letters
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.blueprint.reading import HEADER, sub_entries
from smsl_studio.blueprint.wrong_kinds import kind_of
from smsl_studio.graph.effects import effects_of
from smsl_studio.graph.hierarchy import cycles
from smsl_studio.graph.shape import reachable
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity, edit
from smsl_studio.inspection.rules.given_values import values_fix
from smsl_studio.inspection.rules.words import NearNames, fact_words, some

ERROR, WARNING, NOTE = Severity.ERROR, Severity.WARNING, Severity.NOTE


def r07_sub_sbs(blueprint: Blueprint) -> Iterator[Remark]:
    """R07: faults of SUB_SBS: an unknown SB, a digit out of range or with three values, two
    sub-SBs on one digit, one sub-SB twice in a list, one sub-SB in two bases (a note)."""
    owner: dict[str, str] = {}
    names = NearNames(blueprint.branches)
    for branch in blueprint:
        if not branch.header.subs_as_written:
            continue
        taken: dict[int, str] = {}
        digits: dict[str, int] = {}
        spots = _Entries(branch)
        yield from _no_digits(branch)
        for sub, digit in branch.header.sub_sbs:
            if sub in digits:
                yield spots.remark(
                    sub,
                    f"{sub} is written twice in SUB_SBS, for digit {digits[sub]} and digit {digit}",
                    "let each sub-SB expand one digit",
                    fix=_detach(branch, sub),
                )
            digits[sub] = digit
            if sub not in blueprint.branches:
                remedy = partial(_other_sub, names, branch, sub, digit)
                words = f"the sub-SB {sub} is no SB of this file"
                yield spots.remark(sub, words)._replace(remedy=remedy)
            yield from _digit(spots, sub, digit)
            first = taken.setdefault(digit, sub)
            if first != sub:
                yield spots.remark(
                    sub,
                    f"{sub} expands digit {digit}, which {first} expands already",
                    "let it expand another digit, or detach it",
                    fix=_detach(branch, sub),
                )
            base = owner.setdefault(sub, branch.name)
            if base != branch.name:
                yield spots.remark(
                    sub,
                    f"{sub} also expands a fact of {base}: both share one instance",
                    "make a copy of it if they are two things",
                    severity=NOTE,
                )


def _no_digits(branch: StateBranch) -> Iterator[Remark]:
    """Report SUB_SBS or entries of it that are of the wrong kind. They count as left out."""
    advice = 'write SUB_SBS as {"SB2": 1}: the sub-SB and the digit it expands, counted from 0'
    at = (HEADER, "SUB_SBS")
    if "SUB_SBS" in branch.header.odd:
        words = f"SUB_SBS is {kind_of(branch.header.odd['SUB_SBS'])}, not a map"
        yield Remark("R07", ERROR, branch.address, words, advice, below=at)
    for path, sub, digit in sub_entries(branch.header.subs_as_written):
        if sub and type(digit) is int:
            continue
        where, words = (*at, *path), f"the digit of {sub} is {kind_of(digit)}, not a whole number"
        if not sub:
            words = f"{kind_of(digit)} in SUB_SBS names no sub-SB and its digit"
        fix = _detach(branch, sub) if sub else None
        yield Remark("R07", ERROR, branch.address, words, advice, fix, below=where)


def _other_sub(
    names: NearNames, branch: StateBranch, sub: str, digit: int
) -> tuple[str, Fix | None]:
    """Return the advice and the fix for a sub-SB that does not exist."""
    like = names.near(sub, {branch.name, *(one for one, _ in branch.header.sub_sbs)})
    if not like:
        return "add that SB, or detach it", _detach(branch, sub)
    fix = _detach(branch, sub)
    if 0 <= digit < branch.num_facts:
        swap = partial(_swap, base=branch.name, sub=sub, digit=digit, other=like)
        fix = Fix(f"Use {like}", swap)
    return f"did you mean {like}?", fix


def _swap(blueprint: Blueprint, base: str, sub: str, digit: int, other: str) -> Blueprint:
    return editing.attach_sub(editing.detach_sub(blueprint, base, sub), base, digit, other)


def _digit(spots: _Entries, sub: str, digit: int) -> Iterator[Remark]:
    branch = spots.branch
    count = branch.num_facts
    if not 0 <= digit < count:
        yield spots.remark(
            sub,
            f"{sub} expands digit {digit}, but {branch.name} has "
            + ("only digit 0" if count == 1 else f"the digits 0 to {count - 1}"),
            "digits are counted from 0, from the left",
            fix=_named_or_detached(branch, sub),
        )
    elif digit < len(branch.alphabet) and len(branch.alphabet[digit]) > 2:
        values, words = branch.alphabet[digit], read_by_letters(branch)
        yield spots.remark(
            sub,
            f"digit {digit} takes {len(values)} values ({some(values)}), "
            f"and a fact that {sub} expands is only on or off",
            "give the states whose names are words their fact values"
            if words
            else "let the sub-SB expand a fact with two values",
            fix=_named_or_detached(branch, sub),
        )


def _named_or_detached(branch: StateBranch, sub: str) -> Fix:
    """Return a fix for a fact that has more than two values although a sub-SB expands it.

    If the names of states are words, the fix gives these states fact values, because the sub-SB may
    be right then. Else the fix detaches the sub-SB.
    """
    unread = branch.shape.opaque or read_by_letters(branch)
    named = values_fix(branch) if unread else None
    return named or _detach(branch, sub)


def _detach(branch: StateBranch, sub: str) -> Fix:
    return Fix(f"Detach {sub}", edit("detach_sub", base=branch.name, sub=sub))


class _Entries:
    """Makes remarks at the entries of one SUB_SBS. Where a sub-SB is written twice, the remark
    stands at its last entry."""

    def __init__(self, branch: StateBranch) -> None:
        self.branch = branch
        written = branch.header.subs_as_written
        self._last = {
            sub: str(index)
            for index, item in enumerate(written if isinstance(written, list) else ())
            if isinstance(item, dict)
            for sub in item
        }

    def below(self, sub: str) -> tuple[str, ...]:
        """Return the keys that lead from the SB to the entry of a sub-SB."""
        return (HEADER, "SUB_SBS", *([self._last[sub]] if sub in self._last else []), sub)

    def remark(
        self,
        sub: str,
        message: str,
        advice: str = "",
        *,
        fix: Fix | None = None,
        rule: str = "R07",
        severity: Severity = ERROR,
    ) -> Remark:
        """Return a remark at the entry of a sub-SB."""
        address = self.branch.address
        return Remark(rule, severity, address, message, advice, fix, self.below(sub))


def r08_cycles(blueprint: Blueprint) -> Iterator[Remark]:
    """R08: a cycle among SBs, an import that fails, or a blueprint that no operation can run."""
    for fault in blueprint.import_faults:
        yield Remark(
            "R08",
            ERROR,
            Address(fault.path[0]),
            f"{fault.sentence} ({' > '.join(fault.chain)})",
            fault.advice[:1].lower() + fault.advice[1:].rstrip("."),
            spot=fault.place,
        )
    for wrong in procedures_of(blueprint).faults:
        home = blueprint.home(wrong.branch)
        yield Remark(
            "R08",
            ERROR,
            Address(wrong.branch),
            wrong.sentence,
            wrong.advice[:1].lower() + wrong.advice[1:].rstrip("."),
            spot=(home, (wrong.branch, "_operations", wrong.key)),
        )
    for cycle in cycles(blueprint):
        last = blueprint[cycle[-1]]
        yield _Entries(last).remark(
            cycle[0],
            f"{_chain(cycle)} is a cycle: an SB cannot stand below itself",
            "detach one of them",
            fix=_detach(last, cycle[0]),
            rule="R08",
        )


_SHOWN = 12
"""The largest number of SBs of a cycle that a message names."""


def _chain(cycle: tuple[str, ...]) -> str:
    """Write a cycle, from its first SB back to this SB. The SBs in the middle of a long cycle are
    only counted."""
    shown = list(cycle)
    if len(shown) > _SHOWN:
        half = _SHOWN // 2
        shown[half:-half] = [f"({len(shown) - 2 * half:,} more)"]
    return " > ".join((*shown, cycle[0]))


def r13_sub_cannot_serve(blueprint: Blueprint) -> Iterator[Remark]:
    """R13: a sub-SB that cannot reach its ACTIVATING state, or cannot leave it again."""
    falls = _Falls(blueprint)
    for name in blueprint.bases:
        sub = blueprint.branches.get(name)
        if sub is None or not {sub.initial, sub.activating} <= sub.table.keys():
            continue
        if sub.initial == sub.activating:
            yield _useless(
                sub,
                f"INITIAL and ACTIVATING are both {sub.initial}, so its fact is never off",
                "choose another ACTIVATING state",
                "ACTIVATING",
            )
        elif sub.activating not in reachable(sub, sub.initial):
            yield _useless(
                sub,
                f"no operations lead from {sub.initial} to {sub.activating}, so its fact is "
                "never on",
                "add an operation on the way",
                "ACTIVATING",
            )
        falling = falls.of(name)
        if falling and sub.initial not in reachable(sub, sub.activating):
            yield _useless(
                sub,
                f"no operations lead back from {sub.activating} to {sub.initial}, although "
                f"{falling.address} lets the fact fall",
                f"add an operation that leads back, or mark {falling.name} as load",
                "INITIAL",
            )


def _useless(sub: StateBranch, message: str, advice: str, key: str) -> Remark:
    return Remark("R13", ERROR, sub.address, message, advice, below=(HEADER, key))


class _Falls:
    """Finds the first base edge that turns the fact of a sub-SB off and is not marked as load."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._known: dict[str, dict[int, Operation]] = {}

    def of(self, sub: str) -> Operation | None:
        """Return this edge of the first base that has one, or None."""
        for base, digit in self._blueprint.bases[sub]:
            if base not in self._known:
                self._known[base] = dict(_first_falls(self._blueprint[base]))
            if digit in self._known[base]:
                return self._known[base][digit]
        return None


def _first_falls(branch: StateBranch) -> Iterator[tuple[int, Operation]]:
    """Yield each digit with a sub-SB, with the first edge that turns it off."""
    left = {digit for digit in branch.subs if 0 <= digit < branch.num_facts}
    for edge, digits in _sub_changes(branch):
        for digit in left.intersection(digits):
            if branch.is_on(edge.source, digit):
                left.discard(digit)
                yield digit, edge


def _sub_changes(branch: StateBranch) -> Iterator[tuple[Operation, tuple[int, ...]]]:
    """Yield the edges that change digits with sub-SBs and are not marked as load, each with all
    digits that it changes."""
    effects, subs = effects_of(branch), branch.subs.keys()
    kinds = [tuple(digit for digit, _ in kind) for kind in effects.kinds]
    wanted = {number for number, digits in enumerate(kinds) if not subs.isdisjoint(digits)}
    for number, kind in enumerate(effects.of):
        if kind in wanted:
            edge = effects.edge(number)
            if branch.operation_note(edge.source, edge.name).subs != "load":
                yield edge, kinds[kind]


def r14_mixed(blueprint: Blueprint) -> Iterator[Remark]:
    """R14: base edges that change the fact of a sub-SB together with other facts, and bases of one
    sub-SB whose INITIAL states contradict each other."""
    yield from _disagreeing(blueprint)
    for branch in blueprint:
        if not branch.subs:
            continue
        spots = _Entries(branch)
        mixed: dict[int, list[Operation]] = {}
        for edge, digits in _sub_changes(branch):
            if len(digits) > 1:
                for digit in branch.subs.keys() & set(digits):
                    mixed.setdefault(digit, []).append(edge)
        for digit, sub in branch.subs.items():
            if digit in mixed and sub in blueprint.branches:
                yield _mixed(spots, digit, mixed[digit])


def _disagreeing(blueprint: Blueprint) -> Iterator[Remark]:
    spots: dict[str, _Entries] = {}
    for sub, bases in blueprint.bases.items():
        starts = [
            (branch, digit, branch.is_on(branch.initial, digit))
            for branch, digit in ((blueprint[base], digit) for base, digit in bases)
            if 0 <= digit < branch.num_facts and branch.initial in branch.table
        ]
        for branch, digit, on in starts[1:]:
            first, _, wanted = starts[0]
            if on != wanted:
                if branch.name not in spots:
                    spots[branch.name] = _Entries(branch)
                yield spots[branch.name].remark(
                    sub,
                    f"{branch.name} starts with {fact_words(branch, digit)} "
                    f"{'on' if on else 'off'}, while {first.name} starts with {sub} "
                    f"{'on' if wanted else 'off'}",
                    "choose INITIAL states that agree, or start the run elsewhere",
                    rule="R14",
                    severity=WARNING,
                )


def _mixed(spots: _Entries, digit: int, mixed: list[Operation]) -> Remark:
    branch = spots.branch
    one = len(mixed) == 1
    fact, sub = fact_words(branch, digit), branch.subs[digit]
    message = f"changes {fact} together with other facts"
    if not one:
        places = some(f"{edge.name} in {edge.source}" for edge in mixed)
        message = f"{len(mixed):,} operations change {fact} together with other facts: {places}"
    return Remark(
        "R14",
        WARNING,
        mixed[0].address if one else branch.address,
        message,
        f"{sub} moves first, then the operation; mark as load what needs no move of {sub}",
        below=() if one else spots.below(sub),
    )
