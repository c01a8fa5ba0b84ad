"""The rows of the Blueprint menu that compare versions."""

from __future__ import annotations

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.features.draw.compare.comparison import Comparison
from smsl_studio.studio.features.draw.compare.keys import NEXT_KEYS, PREVIOUS_KEYS

COMPARE = "Compare"
"""The submenu of the menu Blueprint."""


def compare_actions(comparing: Comparison) -> tuple[Action, ...]:
    """The rows of the Blueprint menu that compare versions."""

    def saved() -> bool:
        """Whether the blueprint has a file."""
        return comparing.can_use_saved

    return (
        Action("compare_file", "Compare with a file…", comparing.with_file, "Blueprint", section=4,
               inner=COMPARE, tip="Show what changed in meaning from another file to this drawing"),
        Action("compare_saved", "Compare with the saved version", comparing.with_saved,
               "Blueprint", "", ("Ctrl+Alt+D",), saved, section=4, inner=COMPARE,
               tip="Show what changed in meaning since the file was last saved"),
        Action("compare_revision", "Compare with a revision…", comparing.with_revision,
               "Blueprint", "clock", (), saved, section=4, inner=COMPARE,
               tip="Show what changed in meaning since a commit of git"),
        Action("next_change", "Next change", comparing.next_change, "Blueprint", "chevron-down",
               (NEXT_KEYS,), lambda: comparing.is_open, section=4, inner=COMPARE),
        Action("previous_change", "Previous change", comparing.previous_change, "Blueprint",
               "chevron-up", (PREVIOUS_KEYS,), lambda: comparing.is_open, section=4, inner=COMPARE),
    )  # fmt: skip
