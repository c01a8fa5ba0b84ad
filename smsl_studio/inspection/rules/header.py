"""Rules about the HEADER, and about the facts in the names of states (R03 to R06)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import islice

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import MANY_LETTERS, carried, read_by_letters
from smsl_studio.blueprint.reading import HEADER, KNOWN
from smsl_studio.blueprint.wrong_kinds import kind_of
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity, edit
from smsl_studio.inspection.rules.given_values import values_fix
from smsl_studio.inspection.rules.words import NearNames, counted, listed, some

ERROR, WARNING, NOTE = Severity.ERROR, Severity.WARNING, Severity.NOTE


def r03_header_names_nothing(blueprint: Blueprint) -> Iterator[Remark]:
    """R03: INITIAL or ACTIVATING is unknown, an SB has no states, or NUM_STATES is wrong."""
    for branch in blueprint:
        if not branch.table:
            yield Remark(
                "R03",
                ERROR,
                branch.address,
                "has no states",
                advice="add the first state, or remove the SB",
            )
        header = branch.header
        for key in ("INITIAL", "ACTIVATING", "NUM_STATES"):
            yield from _odd(branch, key, "R03")
        for key, state in (("INITIAL", header.initial), ("ACTIVATING", header.activating)):
            if state is not None and state not in branch.table:
                yield _unknown_state(branch, key, state)
        if header.num_states is not None and header.num_states != len(branch.table):
            right = len(branch.table)
            yield Remark(
                "R03",
                ERROR,
                branch.address,
                f"NUM_STATES is {header.num_states}, but there are {right}",
                advice="write the right number, or leave NUM_STATES out",
                fix=replace(_set(branch, "NUM_STATES", right, f"Write {right}"), certain=True),
                below=(HEADER, "NUM_STATES"),
            )


def _odd(branch: StateBranch, key: str, rule: str) -> Iterator[Remark]:
    """Report a header key whose value is of the wrong kind. Such a key counts as left out."""
    if key not in branch.header.odd:
        return
    found = branch.header.odd[key]
    words = "the name of a state" if key in ("INITIAL", "ACTIVATING") else "a whole number"
    yield Remark(
        rule,
        ERROR,
        branch.address,
        f"{key} is {'empty' if found == '' else kind_of(found)}, not {words}",
        advice=f"write {key} as {words}, or leave it out",
        fix=_set(branch, key, None, f"Leave {key} to the default"),
        below=(HEADER, key),
    )


def _unknown_state(branch: StateBranch, key: str, state: str) -> Remark:
    like = NearNames(branch.table).near(state)
    fix = None
    if like:
        fix = _set(branch, key, like, f"Set {key} to {like}")
    elif branch.table:
        fix = _set(branch, key, None, f"Leave {key} to the default")
    return Remark(
        "R03",
        ERROR,
        branch.address,
        f"{key} is {state}, which is no state of {branch.name}",
        advice=f"did you mean {like}?" if like else f"name a state of {branch.name}",
        fix=fix,
        below=(HEADER, key),
    )


def _set(branch: StateBranch, key: str, value: str | int | None, words: str) -> Fix:
    return Fix(words, edit("set_header", branch=branch.name, key=key, value=value))


def r04_left_to_default(blueprint: Blueprint) -> Iterator[Remark]:
    """R04: INITIAL, ACTIVATING or NUM_FACTS is left to the default, or a header key is unknown."""
    for branch in blueprint:
        if branch.table:
            yield from _defaults(branch)
        for key in branch.header.unknown:
            yield Remark(
                "R04",
                NOTE,
                branch.address,
                f"{key} is no header key that is known",
                below=(HEADER, key),
                remedy=partial(_near_key, key),
            )


_KEYS = NearNames(KNOWN)


def _near_key(key: str) -> tuple[str, None]:
    like = _KEYS.near(key)
    return f"did you mean {like}?" if like else "it is kept as it is, and means nothing", None


def _defaults(branch: StateBranch) -> Iterator[Remark]:
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
    yield Remark(
        "R04",
        NOTE,
        branch.address,
        f"{listed(values)} {are} left to the default",
        advice=f"write {listed(f'{key} {value}' for key, value in values.items())}, "
        "so that reordering changes nothing",
        fix=Fix(words, partial(_write_all, branch=branch.name, values=values), certain=True),
        below=(HEADER,),
    )


def _write_all(blueprint: Blueprint, branch: str, values: dict[str, str | int]) -> Blueprint:
    for key, value in values.items():
        blueprint = editing.set_header(blueprint, branch, key, value)
    return blueprint


def r05_fact_strings(blueprint: Blueprint) -> Iterator[Remark]:
    """R05: fact strings have different lengths, or NUM_FACTS does not divide them."""
    for branch in blueprint:
        yield from _odd(branch, "NUM_FACTS", "R05")
        shape = branch.shape
        if not shape.misfits:
            yield from _letters(branch)
            continue
        if shape.written is None:
            yield _opaque(branch)
        elif len(shape.misfits) == len(branch.table):
            yield _no_division(branch, shape.written)
        else:
            yield from _odd_lengths(branch, shape.written)


def _letters(branch: StateBranch) -> Iterator[Remark]:
    """Report names that are ordinary words but are read as facts, letter by letter.

    This happens if a word has the right length. If other names do carry facts, it is a warning,
    because then a letter of the word is a value that no other state has.
    """
    words = read_by_letters(branch)
    if not words:
        return
    facts, mixed = branch.facts(words[0]), bool(carried(branch))
    letters = listed(islice(facts, MANY_LETTERS))
    yield Remark(
        "R05",
        WARNING if mixed else NOTE,
        Address(branch.name, words[0]),
        f"the name is read as the facts {letters}"
        if mixed and len(facts) <= MANY_LETTERS
        else f"the name is read as {len(facts)} facts of one letter each",
        advice="give it its fact values, or name it by them"
        if mixed
        else "name the states by their facts, such as State_0, or give each its fact values",
        fix=values_fix(branch),
        others=[Address(branch.name, name) for name in words[1:]],
    )


def _opaque(branch: StateBranch) -> Remark:
    return Remark(
        "R05",
        WARNING,
        branch.address,
        "the names of the states do not carry facts of one length, such as "
        f"{some(branch.shape.misfits)}; each state has one fact, its own name",
        advice="name the states by their facts, or give each its facts in _states",
        fix=values_fix(branch),
    )


def _no_division(branch: StateBranch, written: int) -> Remark:
    lengths = sorted({len(fact_string(name, written)) for name in branch.table})
    return Remark(
        "R05",
        ERROR,
        branch.address,
        f"NUM_FACTS is {written}, which does not divide the fact strings of "
        f"{listed(map(str, lengths), 'or')} characters",
        advice="write the number of facts, or leave NUM_FACTS out",
        fix=_set(branch, "NUM_FACTS", None, "Leave NUM_FACTS to be inferred"),
        below=(HEADER, "NUM_FACTS"),
    )


def _odd_lengths(branch: StateBranch, written: int) -> Iterator[Remark]:
    """Report the states whose fact string has another length than the rest. States of one length
    share one finding."""
    misfits = set(branch.shape.misfits)
    fitting = next(name for name in branch.table if name not in misfits)
    common = len(fact_string(fitting, written))
    by_length: dict[int, list[Address]] = {}
    for state in branch.shape.misfits:
        length = len(fact_string(state, written))
        by_length.setdefault(length, []).append(Address(branch.name, state))
    for length, addresses in by_length.items():
        yield Remark(
            "R05",
            ERROR,
            addresses[0],
            f"carries {counted(length, 'character')} of facts, where the others carry {common}",
            f"name it by its {counted(written, 'fact')}, or give it fact values",
            fix=values_fix(branch),
            others=addresses[1:],
        )


def r06_equal_facts(blueprint: Blueprint) -> Iterator[Remark]:
    """R06: states of one SB have equal facts, so no state check (paper, Eq. 4) can distinguish
    them. States with the same facts share one finding."""
    for branch in blueprint:
        seen: dict[tuple[str, ...], list[str]] = {}
        for state in branch.table:
            seen.setdefault(branch.facts(state), []).append(state)
        for facts, (other, *states) in seen.items():
            if not states:
                continue
            yield Remark(
                "R06",
                ERROR,
                Address(branch.name, states[0]),
                f"has the same facts as {other} ({' '.join(facts)}), "
                "so no state check can tell them apart",
                "give one of them other facts, or make them one state",
                others=[Address(branch.name, state) for state in states[1:]],
            )
