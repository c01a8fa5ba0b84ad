"""Rules about the HEADER, and about the facts that the names of states carry."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import set_header
from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER, KNOWN
from smsl_studio.blueprint.wrong_kinds import kind_of
from smsl_studio.inspection.finding import Finding, Fix, Severity
from smsl_studio.inspection.rules.wording import counted, listed, near, some

ERROR, WARNING, NOTE = Severity.ERROR, Severity.WARNING, Severity.NOTE


def r03_header_names_nothing(blueprint: Blueprint) -> Iterator[Finding]:
    """INITIAL or ACTIVATING unknown; SB without states; NUM_STATES written and wrong."""
    for branch in blueprint:
        if not branch.table:
            yield Finding.at(
                blueprint,
                "R03",
                ERROR,
                branch.address,
                "has no states",
                advice="add the first state, or remove the SB",
            )
        header = branch.header
        for key in ("INITIAL", "ACTIVATING", "NUM_STATES"):
            yield from _odd(blueprint, branch, key, "R03")
        for key, state in (("INITIAL", header.initial), ("ACTIVATING", header.activating)):
            if state is not None and state not in branch.table:
                yield _unknown_state(blueprint, branch, key, state)
        if header.num_states is not None and header.num_states != len(branch.table):
            right = len(branch.table)
            yield Finding.at(
                blueprint,
                "R03",
                ERROR,
                branch.address,
                f"NUM_STATES is {header.num_states}, but there are {right}",
                advice="write the right number, or leave NUM_STATES out",
                fix=_set(branch, "NUM_STATES", right, f"Write {right}"),
                below=(HEADER, "NUM_STATES"),
            )


def _odd(blueprint: Blueprint, branch: StateBranch, key: str, rule: str) -> Iterator[Finding]:
    """A header key whose value is of the wrong kind; it counts as left out."""
    if key not in branch.header.odd:
        return
    found = branch.header.odd[key]
    words = "the name of a state" if key in ("INITIAL", "ACTIVATING") else "a whole number"
    yield Finding.at(
        blueprint,
        rule,
        ERROR,
        branch.address,
        f"{key} is {'empty' if found == '' else kind_of(found)}, not {words}",
        advice=f"write {key} as {words}, or leave it out",
        fix=_set(branch, key, None, f"Leave {key} to the default"),
        below=(HEADER, key),
    )


def _unknown_state(blueprint: Blueprint, branch: StateBranch, key: str, state: str) -> Finding:
    like = near(state, branch.table)
    fix = None
    if like:
        fix = _set(branch, key, like, f"Set {key} to {like}")
    elif branch.table:
        fix = _set(branch, key, None, f"Leave {key} to the default")
    return Finding.at(
        blueprint,
        "R03",
        ERROR,
        branch.address,
        f"{key} is {state}, which is no state of {branch.name}",
        advice=f"did you mean {like}?" if like else f"name a state of {branch.name}",
        fix=fix,
        below=(HEADER, key),
    )


def _set(branch: StateBranch, key: str, value: str | int | None, words: str) -> Fix:
    return Fix(words, partial(set_header, branch=branch.name, key=key, value=value))


def r04_left_to_default(blueprint: Blueprint) -> Iterator[Finding]:
    """INITIAL, ACTIVATING or NUM_FACTS left to the default; an unknown header key."""
    for branch in blueprint:
        if branch.table:
            yield from _defaults(blueprint, branch)
        for key in branch.header.unknown:
            like = near(key, KNOWN)
            yield Finding.at(
                blueprint,
                "R04",
                NOTE,
                branch.address,
                f"{key} is no header key that is known",
                advice=f"did you mean {like}?"
                if like
                else "it is kept as it is, and means nothing",
                below=(HEADER, key),
            )


def _defaults(blueprint: Blueprint, branch: StateBranch) -> Iterator[Finding]:
    header = branch.header
    values: dict[str, str | int] = {}
    if header.initial is None and "INITIAL" not in header.odd:
        values["INITIAL"] = branch.initial
    if header.activating is None and "ACTIVATING" not in header.odd:
        values["ACTIVATING"] = branch.activating
    if header.num_facts is None and "NUM_FACTS" not in header.odd and not branch.shape.opaque:
        values["NUM_FACTS"] = branch.num_facts
    if not values:
        return
    words = ["Write " + next(iter(values)), "Write both", "Write all three"][len(values) - 1]
    are = "is" if len(values) == 1 else "are"
    yield Finding.at(
        blueprint,
        "R04",
        NOTE,
        branch.address,
        f"{listed(values)} {are} left to the default",
        advice=f"write {listed(f'{key} {value}' for key, value in values.items())}, "
        "so that reordering changes nothing",
        fix=Fix(words, partial(_write_all, branch=branch.name, values=values)),
        below=(HEADER,),
    )


def _write_all(blueprint: Blueprint, branch: str, values: dict[str, str | int]) -> Blueprint:
    for key, value in values.items():
        blueprint = set_header(blueprint, branch, key, value)
    return blueprint


def r05_fact_strings(blueprint: Blueprint) -> Iterator[Finding]:
    """Fact strings of different length, or not divisible by NUM_FACTS."""
    for branch in blueprint:
        yield from _odd(blueprint, branch, "NUM_FACTS", "R05")
        shape = branch.shape
        if not shape.misfits:
            continue
        if shape.written is None:
            yield _opaque(blueprint, branch)
        elif len(shape.misfits) == len(branch.table):
            yield _no_division(blueprint, branch, shape.written)
        else:
            yield from _odd_lengths(blueprint, branch, shape.written)


def _opaque(blueprint: Blueprint, branch: StateBranch) -> Finding:
    return Finding.at(
        blueprint,
        "R05",
        WARNING,
        branch.address,
        "the names of the states do not carry facts of one length, such as "
        f"{some(branch.shape.misfits)}; each state has one fact, its own name",
        advice="name the states by their facts, or give each its facts in _states",
    )


def _no_division(blueprint: Blueprint, branch: StateBranch, written: int) -> Finding:
    lengths = sorted({len(fact_string(name, written)) for name in branch.table})
    return Finding.at(
        blueprint,
        "R05",
        ERROR,
        branch.address,
        f"NUM_FACTS is {written}, which does not divide the fact strings of "
        f"{listed(map(str, lengths), 'or')} characters",
        advice="write the number of facts, or leave NUM_FACTS out",
        fix=_set(branch, "NUM_FACTS", None, "Leave NUM_FACTS to be inferred"),
        below=(HEADER, "NUM_FACTS"),
    )


def _odd_lengths(blueprint: Blueprint, branch: StateBranch, written: int) -> Iterator[Finding]:
    fitting = next(name for name in branch.table if name not in set(branch.shape.misfits))
    common = len(fact_string(fitting, written))
    for state in branch.shape.misfits:
        length = len(fact_string(state, written))
        yield Finding.at(
            blueprint,
            "R05",
            ERROR,
            Address(branch.name, state),
            f"carries {counted(length, 'character')} of facts, where the others carry {common}",
            advice=f"name it by its {counted(written, 'fact')}",
        )


def r06_equal_facts(blueprint: Blueprint) -> Iterator[Finding]:
    """Two states of one SB with equal facts: no state check can tell them apart."""
    for branch in blueprint:
        seen: dict[tuple[str, ...], str] = {}
        for state in branch.table:
            facts = branch.facts(state)
            other = seen.setdefault(facts, state)
            if other != state:
                yield Finding.at(
                    blueprint,
                    "R06",
                    ERROR,
                    Address(branch.name, state),
                    f"has the same facts as {other} ({' '.join(facts)}), "
                    "so no state check can tell them apart",
                    advice="give one of them other facts, or make them one state",
                )
