"""Rules about State Branches above and below each other."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import attach_sub, detach_sub
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER, sub_entries
from smsl_studio.blueprint.wrong_kinds import kind_of
from smsl_studio.graph.hierarchy import cycles
from smsl_studio.graph.shape import reachable
from smsl_studio.inspection.finding import Finding, Fix, Severity
from smsl_studio.inspection.rules.wording import fact_words, near, some

ERROR, WARNING, NOTE = Severity.ERROR, Severity.WARNING, Severity.NOTE


def r07_sub_sbs(blueprint: Blueprint) -> Iterator[Finding]:
    """SUB_SBS: unknown SB, digit out of range or of three values, two subs on one digit, one sub
    twice in a list, one sub in two bases (a note)."""
    owner: dict[str, str] = {}
    for branch in blueprint:
        taken: dict[int, str] = {}
        digits: dict[str, int] = {}
        yield from _no_digits(blueprint, branch)
        for sub, digit in branch.header.sub_sbs:
            if sub in digits:
                yield _entry(
                    blueprint,
                    branch,
                    sub,
                    f"{sub} is written twice in SUB_SBS, for digit {digits[sub]} and digit {digit}",
                    "let each sub-SB expand one digit",
                    fix=_detach(branch, sub),
                )
            digits[sub] = digit
            if sub not in blueprint.branches:
                yield _unknown_sub(blueprint, branch, sub, digit)
            yield from _digit(blueprint, branch, sub, digit)
            first = taken.setdefault(digit, sub)
            if first != sub:
                yield _entry(
                    blueprint,
                    branch,
                    sub,
                    f"{sub} expands digit {digit}, which {first} expands already",
                    "let it expand another digit, or detach it",
                    fix=_detach(branch, sub),
                )
            base = owner.setdefault(sub, branch.name)
            if base != branch.name:
                yield _entry(
                    blueprint,
                    branch,
                    sub,
                    f"{sub} also expands a fact of {base}: both share one instance",
                    "make a copy of it if they are two things",
                    severity=NOTE,
                )


def _no_digits(blueprint: Blueprint, branch: StateBranch) -> Iterator[Finding]:
    """SUB_SBS, or entries of it, that are of the wrong kind; they count as left out."""
    advice = 'write SUB_SBS as {"SB2": 1}: the sub-SB and the digit it expands, counted from 0'
    at = (HEADER, "SUB_SBS")
    if "SUB_SBS" in branch.header.odd:
        words = f"SUB_SBS is {kind_of(branch.header.odd['SUB_SBS'])}, not a map"
        yield Finding.at(blueprint, "R07", ERROR, branch.address, words, advice=advice, below=at)
    for path, sub, digit in sub_entries(branch.header.subs_as_written):
        if sub and type(digit) is int:
            continue
        where, words = (*at, *path), f"the digit of {sub} is {kind_of(digit)}, not a whole number"
        if not sub:
            words = f"{kind_of(digit)} in SUB_SBS names no sub-SB and its digit"
        fix = _detach(branch, sub) if sub else None
        yield Finding.at(
            blueprint, "R07", ERROR, branch.address, words, advice=advice, fix=fix, below=where
        )


def _unknown_sub(blueprint: Blueprint, branch: StateBranch, sub: str, digit: int) -> Finding:
    known = [
        name
        for name in blueprint.branches
        if name not in {branch.name, *(other for other, _ in branch.header.sub_sbs)}
    ]
    like = near(sub, known)
    fix = _detach(branch, sub)
    if like and 0 <= digit < branch.num_facts:
        swap = partial(_swap, base=branch.name, sub=sub, digit=digit, other=like)
        fix = Fix(f"Use {like}", swap)
    return _entry(
        blueprint,
        branch,
        sub,
        f"the sub-SB {sub} is no SB of this file",
        f"did you mean {like}?" if like else "add that SB, or detach it",
        fix=fix,
    )


def _swap(blueprint: Blueprint, base: str, sub: str, digit: int, other: str) -> Blueprint:
    return attach_sub(detach_sub(blueprint, base, sub), base, digit, other)


def _digit(blueprint: Blueprint, branch: StateBranch, sub: str, digit: int) -> Iterator[Finding]:
    count = branch.num_facts
    if not 0 <= digit < count:
        yield _entry(
            blueprint,
            branch,
            sub,
            f"{sub} expands digit {digit}, but {branch.name} has "
            + ("only digit 0" if count == 1 else f"the digits 0 to {count - 1}"),
            "digits are counted from 0, from the left",
            fix=_detach(branch, sub),
        )
    elif digit < len(branch.alphabet) and len(branch.alphabet[digit]) > 2:
        values = branch.alphabet[digit]
        yield _entry(
            blueprint,
            branch,
            sub,
            f"digit {digit} takes {len(values)} values ({some(values)}), "
            f"and a fact that {sub} expands is only on or off",
            "let the sub-SB expand a fact with two values",
            fix=_detach(branch, sub),
        )


def _detach(branch: StateBranch, sub: str) -> Fix:
    return Fix(f"Detach {sub}", partial(detach_sub, base=branch.name, sub=sub))


def _entry(
    blueprint: Blueprint,
    branch: StateBranch,
    sub: str,
    message: str,
    advice: str,
    *,
    fix: Fix | None = None,
    rule: str = "R07",
    severity: Severity = ERROR,
) -> Finding:
    """A finding at one entry of SUB_SBS."""
    return Finding.at(
        blueprint,
        rule,
        severity,
        branch.address,
        message,
        advice=advice,
        fix=fix,
        below=_below(branch, sub),
    )


def _below(branch: StateBranch, sub: str) -> tuple[str, ...]:
    """The keys that lead to an entry of SUB_SBS, the last one where it is written twice."""
    written = branch.header.subs_as_written
    at = [
        str(index)
        for index, item in enumerate(written if isinstance(written, list) else ())
        if isinstance(item, dict) and sub in item
    ]
    return (HEADER, "SUB_SBS", *at[-1:], sub)


def r08_cycles(blueprint: Blueprint) -> Iterator[Finding]:
    """A cycle among SBs, or an import that fails."""
    for fault in blueprint.import_faults:
        yield Finding(
            "R08",
            ERROR,
            Address(fault.path[0]),
            fault.place,
            f"{fault.sentence} ({' > '.join(fault.chain)})",
            "import a file that can be read and does not lead back",
        )
    for cycle in cycles(blueprint):
        last = blueprint[cycle[-1]]
        yield _entry(
            blueprint,
            last,
            cycle[0],
            f"{' > '.join((*cycle, cycle[0]))} is a cycle: an SB cannot stand below itself",
            "detach one of them",
            fix=_detach(last, cycle[0]),
            rule="R08",
        )


def r13_sub_cannot_serve(blueprint: Blueprint) -> Iterator[Finding]:
    """A sub-SB that cannot bring its fact about, or cannot let it fall again."""
    for name in blueprint.bases:
        sub = blueprint.branches.get(name)
        if sub is None or not {sub.initial, sub.activating} <= set(sub.table):
            continue
        if sub.initial == sub.activating:
            yield _useless(
                blueprint,
                sub,
                f"INITIAL and ACTIVATING are both {sub.initial}, so its fact is never off",
                "choose another ACTIVATING state",
                "ACTIVATING",
            )
        elif sub.activating not in reachable(sub, sub.initial):
            yield _useless(
                blueprint,
                sub,
                f"no operations lead from {sub.initial} to {sub.activating}, so its fact is "
                "never on",
                "add an operation on the way",
                "ACTIVATING",
            )
        falling = _first_fall(blueprint, name)
        if falling and sub.initial not in reachable(sub, sub.activating):
            yield _useless(
                blueprint,
                sub,
                f"no operations lead back from {sub.activating} to {sub.initial}, although "
                f"{falling.address} lets the fact fall",
                f"add an operation that leads back, or mark {falling.name} as load",
                "INITIAL",
            )


def _useless(
    blueprint: Blueprint, sub: StateBranch, message: str, advice: str, key: str
) -> Finding:
    return Finding.at(
        blueprint, "R13", ERROR, sub.address, message, advice=advice, below=(HEADER, key)
    )


def _first_fall(blueprint: Blueprint, sub: str) -> Operation | None:
    """The first base edge that lets the sub-SB's fact fall and does not load it."""
    for base, digit in blueprint.bases[sub]:
        branch = blueprint[base]
        if not 0 <= digit < branch.num_facts:
            continue
        for edge in branch.edges():
            if (
                edge.target in branch.table
                and branch.is_on(edge.source, digit)
                and not branch.is_on(edge.target, digit)
                and branch.operation_note(edge.source, edge.name).subs != "load"
            ):
                return edge
    return None


def r14_mixed(blueprint: Blueprint) -> Iterator[Finding]:
    """Base edges that change a sub-SB's fact together with others; bases of one sub-SB whose
    INITIAL states cannot hold together."""
    yield from _disagreeing(blueprint)
    for branch in blueprint:
        for digit, sub in branch.subs.items():
            if not 0 <= digit < branch.num_facts or sub not in blueprint.branches:
                continue
            mixed = [edge for edge in branch.edges() if _is_mixed(branch, edge, digit)]
            if mixed:
                yield _mixed(blueprint, branch, digit, mixed)


def _disagreeing(blueprint: Blueprint) -> Iterator[Finding]:
    for sub, bases in blueprint.bases.items():
        starts = [
            (branch, digit, branch.is_on(branch.initial, digit))
            for branch, digit in ((blueprint[base], digit) for base, digit in bases)
            if 0 <= digit < branch.num_facts and branch.initial in branch.table
        ]
        for branch, digit, on in starts[1:]:
            first, _, wanted = starts[0]
            if on != wanted:
                yield _entry(
                    blueprint,
                    branch,
                    sub,
                    f"{branch.name} starts with {fact_words(branch, digit)} "
                    f"{'on' if on else 'off'}, while {first.name} starts with {sub} "
                    f"{'on' if wanted else 'off'}",
                    "choose INITIAL states that agree, or start the run elsewhere",
                    rule="R14",
                    severity=WARNING,
                )


def _is_mixed(branch: StateBranch, edge: Operation, digit: int) -> bool:
    if edge.target not in branch.table:
        return False
    before, after = branch.facts(edge.source), branch.facts(edge.target)
    changed = [d for d, (a, b) in enumerate(zip(before, after, strict=True)) if a != b]
    return (
        digit in changed
        and len(changed) > 1
        and branch.operation_note(edge.source, edge.name).subs != "load"
    )


def _mixed(
    blueprint: Blueprint, branch: StateBranch, digit: int, mixed: list[Operation]
) -> Finding:
    one = len(mixed) == 1
    fact, sub = fact_words(branch, digit), branch.subs[digit]
    places = some(f"{edge.name} in {edge.source}" for edge in mixed)
    message = f"changes {fact} together with other facts"
    if not one:
        message = f"{len(mixed)} operations change {fact} together with other facts: {places}"
    return Finding.at(
        blueprint,
        "R14",
        WARNING,
        mixed[0].address if one else branch.address,
        message,
        advice=f"{sub} moves first, then the operation; mark as load what needs no move of {sub}",
        below=() if one else _below(branch, sub),
    )
