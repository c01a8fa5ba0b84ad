"""What a state or operation is, in sentences: for assistive tools and for the table of an SB."""

from __future__ import annotations

from smsl_studio.blueprint.annotations import OperationNote, StateNote
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.picture.guards import needs_words
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.sub_marks import sub_mark
from smsl_studio.studio.base.chips import fact_words
from smsl_studio.studio.base.words import series

SAFE = {True: "Declared safe", False: "Declared not safe"}


def facts_told(branch: StateBranch, state: str) -> str:
    """The facts of a state: ``Clamp: fixed (1), Plan: 0``; empty without facts."""
    return ", ".join(fact_words(branch, at, value) for at, value in enumerate(branch.facts(state)))


def subs_told(branch: StateBranch) -> str:
    """Which facts of an SB have a sub-SB: ``Fact 2 is expanded by SB2``; empty without one."""
    return ", ".join(
        f"{branch.fact_name(digit)} is expanded by {sub}"
        for digit, sub in sorted(branch.subs.items())
    )


def state_details(branch: StateBranch, state: str) -> str:
    """Title, facts and annotations of a state, as sentences."""
    note = branch.state_note(state) or StateNote()
    said = (note.title, facts_told(branch, state), subs_told(branch),
            SAFE[note.safe] if note.safe is not None else "",
            "Pinned" if state in branch.notes.pinned else "", note.note)  # fmt: skip
    return _sentences(said)


def operation_details(picture: Picture, edge: int) -> str:
    """Title, cost and annotations of an operation, as sentences."""
    address, branch = picture.address(edge), picture.branch
    note = branch.operation_note(address.state, address.operation)
    needs = needs_words(picture.guards(edge))
    cost = f"Cost {branch.cost(address.state, address.operation):g}"
    effect = effect_told(branch, branch.operation(address.state, address.operation))
    return _sentences((note.title, effect, cost, *_annotated(note), needs[:1].upper() + needs[1:]))


def effect_told(branch: StateBranch, operation: Operation) -> str:
    """What an operation does to the facts of sub-SBs: ``Turns Fact 2 on, so SB2 moves first``.

    It says in words what the marks at the line show. Empty if it turns no fact of a sub-SB.
    """
    kind = sub_mark(branch, operation)
    if not kind:
        return ""
    turned = {
        digit: branch.is_on(operation.target, digit)
        for digit in sorted(branch.subs)
        if branch.is_on(operation.source, digit) != branch.is_on(operation.target, digit)
    }
    words = [f"{branch.fact_name(at)} {'on' if on else 'off'}" for at, on in turned.items()]
    subs = series([branch.subs[digit] for digit in turned])
    with_others = " together with other facts" if kind == "mixed" else ""
    note = branch.operation_note(operation.source, operation.name)
    how = f"without a move of {subs}" if note.subs == "load" else f"{subs} moves first"
    return f"Turns {series(words)}{with_others}, {how}"


def _annotated(note: OperationNote) -> list[str]:
    said = [f"Risk {note.risk}"] if note.risk else []
    roles = f" ({', '.join(note.roles)})" if note.roles else ""
    said += [f"Done by {note.actor}{roles}"] if note.actor else []
    said += [f"Confirmed by {', '.join(note.confirm)}"] if note.confirm else []
    said += [f"Takes {note.duration:g} s"] if note.duration is not None else []
    said += [f"Time limit {note.timeout:g} s"] if note.timeout is not None else []
    said += ["Repeatable"] if note.repeatable else []
    said += [note.question] if note.question else []
    return said


def _sentences(parts: tuple[str, ...]) -> str:
    return " ".join(f"{part.rstrip('.')}." for part in parts if part)
