"""The commands in the menu Blueprint that change the shape and keep the behaviour."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.features.draw.shape.shape_verbs import ShapeVerbs

SHAPE = "Change the shape"
"""The submenu of the menu Blueprint."""


def shape_actions(verbs: ShapeVerbs, drawn: Callable[[], bool]) -> tuple[Action, ...]:
    """The commands. Each one shows a preview of both sides before it changes anything."""
    return (
        Action("identify", "Identify sub-SBs…", verbs.identify, "Blueprint", "bulb", (),
               lambda: drawn() and verbs.can_identify(), section=2, inner=SHAPE,
               tip="List the states that could be a sub-SB, with what each cut saves"),
        Action("extract", "Extract as a sub-SB…", verbs.extract, "Blueprint", "layers", (),
               lambda: drawn() and verbs.can_extract(), section=2, inner=SHAPE, pointer=("state",),
               tip="Let the selected states become a sub-SB; the behaviour stays"),
        Action("inline", "Put this sub-SB back…", verbs.inline, "Blueprint", "", (),
               lambda: drawn() and verbs.can_inline(), section=2, inner=SHAPE,
               tip="Make one State Branch of this sub-SB and its base; the behaviour stays"),
        Action("flatten", "Flatten…", verbs.flatten, "Blueprint", "", (),
               lambda: drawn() and verbs.can_flatten(), section=2, inner=SHAPE,
               tip="Make one State Branch of all; the behaviour stays"),
    )  # fmt: skip
