"""Notices: consequences of an edit that its author may not expect, in one sentence."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.editing import turned_facts
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.plain_words import has_only_words

ENDS = (("INITIAL", "initial", "first"), ("ACTIVATING", "activating", "last"))
"""The keys of the two ends of an SB, what their states are called, and where they stand if the
keys are not written."""


DOUBLED = "because no other ones are free"
"""Words of a sentence that warns: two states with the same facts cannot be told apart."""


@dataclass(frozen=True)
class StepNotice:
    """A notice about a step; without a ``sentence`` there is none.

    ``severity`` is ``W`` or none. ``undo`` offers to undo the step. A notice that is said ``once``
    comes again with each similar step, and is not repeated.
    """

    sentence: str = ""
    severity: str = ""
    undo: bool = False
    once: bool = False


def step_notice(before: Blueprint, after: Blueprint) -> StepNotice:
    """The notice about a step."""
    kept = (
        goal_kept(before, after), facts_kept(before, after), on_kept(before, after),
        values_given(before, after),
    )  # fmt: skip
    unasked = (ends_moved(before, after), facts_lost(before, after), facts_turned(before, after))
    said = " ".join(filter(None, (*kept, *unasked)))
    if said:
        warned = any(unasked) or DOUBLED in said
        return StepNotice(said, "W" if warned else "", undo=any(unasked))
    return StepNotice(goal_moved(before, after), "W", once=True)


def ends_moved(before: Blueprint, after: Blueprint) -> str:
    """A sentence that another state is initial or activating, because the former one is gone.

    Empty if that did not happen. SBs with fewer than two states are left out, because there is
    nothing to choose.
    """
    said = []
    for name, branch in after.branches.items():
        old = before.branches.get(name)
        if before.file != after.file or old is None or old is branch:
            continue
        # A state with another name is in its place. One that is gone leaves fewer.
        if not 2 <= len(branch.table) < len(old.table):
            continue
        for key, kind, place in ENDS:
            was, now = getattr(old, kind), getattr(branch, kind)
            if was in branch.table or was not in old.table or now not in branch.table:
                continue
            written = getattr(branch.header, kind) is not None
            why = f"{key} says so" if written else f"it is listed {place}"
            said.append(f"{was} is gone: {now} is the {kind} state of {name} now, and {why}.")
    return " ".join(said)


def facts_lost(before: Blueprint, after: Blueprint) -> str:
    """A sentence that no state has the former facts any more, because one name does not carry
    them. Empty if that did not happen.

    Words of one length are no facts. SBs with fewer than three states are only begun.
    """
    for name, branch in after.branches.items():
        old = before.branches.get(name)
        if before.file != after.file or old is None or old is branch or len(old.table) < 3:
            continue
        if not branch.table or old.shape.opaque or old.num_facts < 2:
            continue
        if not branch.shape.opaque or has_only_words(old):
            continue
        misfits = [state for state in branch.shape.misfits if state not in old.table]
        odd = (misfits or branch.shape.misfits or (name,))[0]
        return (
            f"{odd} does not carry {old.num_facts} facts like the other states, so no state of "
            f"{name} has them now: each has one fact, its own name. Rules about facts find nothing."
        )
    return ""


def facts_kept(before: Blueprint, after: Blueprint) -> str:
    """A sentence that ``_states`` has the facts now, because a new name does not carry them.

    Empty if that did not happen.
    """
    for name, branch in after.branches.items():
        old = before.branches.get(name)
        if before.file != after.file or old is None or old is branch or not old.shape.width:
            continue
        fresh = [state for state in branch.table if state not in old.table]
        if (
            fresh
            and len(branch.table) == len(old.table)
            and not branch.shape.width
            and (not branch.shape.opaque)
        ):
            return (
                f"{fresh[0]} does not carry facts in its name. All states of {name} keep theirs: "
                "they stand in _states now."
            )
    return ""


def facts_turned(before: Blueprint, after: Blueprint) -> str:
    """A sentence that another value of a fact with a sub-SB counts as on, after a typed text.

    Empty if that did not happen. An edit keeps the value (see ``on_kept``).
    """
    if before.file != after.file:
        return ""
    for branch, digit, was, now in turned_facts(before, after):
        fact = after[branch].fact_name(digit)
        return (
            f"{fact} of {branch} is on where it is {now} now, and no longer where it is {was}. "
            f'Write "on": "{was}" in its _facts to keep that.'
        )
    return ""


def on_kept(before: Blueprint, after: Blueprint) -> str:
    """The sentence if ``_facts`` says now which value of a fact counts as on, so that it stays.

    Empty if that did not happen.
    """
    for name, branch in after.branches.items():
        old = before.branches.get(name)
        if before.file != after.file or old is None or old is branch or old.table == branch.table:
            continue
        for digit in branch.subs:
            was, now = old.fact_note(digit), branch.fact_note(digit)
            unsaid = was is None or was.on is None
            if unsaid and now is not None and now.on is not None:
                return (
                    f"{now.on} stays the value with which {branch.fact_name(digit)} of {name} is "
                    "on, and _facts says so now."
                )
    return ""


def values_given(before: Blueprint, after: Blueprint) -> str:
    """A sentence that new states got fact values that nobody typed. Empty if there are none.

    New states get values if all other states have theirs in ``_states``.
    """
    for name, branch in after.branches.items():
        old = before.branches.get(name)
        if before.file != after.file or old is None or old is branch or not old.table:
            continue
        if not all(one.width == 0 and not one.opaque for one in (old.shape, branch.shape)):
            continue
        new = [state for state in branch.table if state not in old.table]
        if not new or any(state not in branch.table for state in old.table):
            continue
        facts, values = branch.facts(new[0]), " ".join(branch.facts(new[0]))
        same = [state for state in branch.table if state != new[0] and branch.facts(state) == facts]
        if same:
            return (
                f"{new[0]} has the fact values of {same[0]} ({values}), {DOUBLED}. "
                "Properties changes them."
            )
        others = f", and {len(new) - 1} more got some too" if new[1:] else ""
        return f"{new[0]} got the free fact values {values}{others}. Properties changes them."
    return ""


def goal_kept(before: Blueprint, after: Blueprint) -> str:
    """The sentence if ACTIVATING was written because new states are listed after the last one.

    Empty if that did not happen.
    """
    for name, branch in after.branches.items():
        old = before.branches.get(name)
        if before.file != after.file or old is None or old is branch:
            continue
        last = next(reversed(branch.table), "")
        kept = old.header.activating is None and branch.header.activating == old.activating
        if kept and last not in old.table:
            return (
                f"{old.activating} stays the activating state of {name}, and ACTIVATING says so "
                f"now: {last} is listed behind it."
            )
    return ""


def goal_moved(before: Blueprint, after: Blueprint) -> str:
    """The sentence if another state became activating because it is listed last now.

    Empty if that did not happen. An edit keeps the activating state, but a typed text is taken as
    it is. SBs with fewer than three states are left out: while people draw them, they expect the
    last state to be activating.
    """
    if before.file != after.file:
        return ""
    for name, branch in after.branches.items():
        old = before.branches.get(name)
        if old is None or old is branch or len(old.table) < 3:
            continue
        if branch.activating not in old.table and old.activating in branch.table:
            return (
                f"{branch.activating} is listed last, so it is the activating state of {name} now. "
                f"Set Activating in the branch header to keep {old.activating}."
            )
    return ""
