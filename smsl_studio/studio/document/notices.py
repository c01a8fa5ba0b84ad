"""What an edit brought about without saying so, in one line for the person who made it."""

from __future__ import annotations

from smsl_studio.blueprint.model import Blueprint


def step_notice(before: Blueprint, after: Blueprint) -> tuple[str, bool]:
    """What there is to say of a step, and whether it is a warning; the empty text for nothing."""
    kept = goal_kept(before, after)
    return (kept, False) if kept else (goal_moved(before, after), True)


def goal_kept(before: Blueprint, after: Blueprint) -> str:
    """ACTIVATING was written because states came in behind the one that was listed last.

    The empty text where it was not.
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
    """A state took over as ACTIVATING because the header leaves that to the last one listed.

    The empty text where it did not. Edits keep what held, but a text that is typed stays as it is
    typed. The first states of an SB are passed over: while it is being drawn, the last one drawn
    is what people expect.
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
