"""What an edit brought about without saying so, in one line for the person who made it."""

from __future__ import annotations

from smsl_studio.blueprint.model import Blueprint


def goal_moved(before: Blueprint, after: Blueprint) -> str:
    """A new state took over as ACTIVATING because the header leaves that to the last one listed.

    The empty text where it did not. The first states of an SB are passed over: while it is being
    drawn, the last one drawn is what people expect.
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
