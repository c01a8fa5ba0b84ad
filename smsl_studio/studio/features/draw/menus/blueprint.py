"""The Blueprint menu."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Shell
from smsl_studio.studio.features.draw.canvas.align_verbs import AlignVerbs, align_actions
from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs
from smsl_studio.studio.features.draw.panels.findings import Findings


def blueprint_actions(
    drawing: DrawVerbs,
    findings: Findings,
    choose_sub_sb: Callable[[], object],
    align: AlignVerbs,
    choose_align: Callable[[], object],
    shell: Shell,
) -> tuple[Action, ...]:
    """The rows of the Blueprint menu that edit the drawing."""

    def drawn() -> bool:
        """Whether Draw mode is shown."""
        return shell.mode == "draw"

    return (
        Action("add_state", "Add state", drawing.add_state, "Blueprint", "plus", ("Ctrl+Shift+N",),
               lambda: drawn() and drawing.has_branch(), short="State",
               tip="Add a state beside the others; a double click on the canvas adds one there"),
        Action("connect", "Connect", drawing.connect, "Blueprint", "arrow", ("C",),
               lambda: drawn() and drawing.has_states(), scope="canvas", short="Connect",
               tip="Click the source and then the target of an operation, or drag"),
        Action("add_operation", "Add operation", drawing.add_operation, "Blueprint", "",
               ("Ctrl+E",), lambda: drawn() and drawing.can_add_operation(),
               tip="From the selected state, or from the first of two to the second"),
        Action("add_branch", "Add State Branch", drawing.add_branch, "Blueprint", "layers",
               ("Ctrl+Shift+B",), drawn),
        Action("add_fact", "Add fact…", lambda: drawing.add_fact(), "Blueprint", "", (),
               lambda: drawn() and drawing.has_branch(),
               tip="Give every state a value of one more fact; first a card says what changes"),
        Action("sub_sb", "Attach a sub-SB…", choose_sub_sb, "Blueprint", "layers", (),
               lambda: drawn() and drawing.has_states(), short="Sub-SB",
               tip="Let a State Branch expand one of the facts"),
        Action("tidy", "Tidy the drawing", drawing.tidy, "Blueprint", "tidy", ("Ctrl+Shift+T",),
               lambda: drawn() and drawing.has_states(), section=1, short="Tidy",
               tip="Lay the State Branch out anew, or only the selected states, as one step that "
               "can be undone"),
        Action("tidy_layers", "Arrange in columns", drawing.tidy_in_layers, "Blueprint", "", (),
               lambda: drawn() and drawing.has_states(), section=1,
               tip="Lay out in columns from left to right, by the steps from the initial state",
               inner="Arrange"),
        Action("tidy_distance", "Arrange by distances", drawing.tidy_by_distance, "Blueprint", "",
               (), lambda: drawn() and drawing.has_states(), section=1,
               tip="Lay out so that states stand near those that operations join with them",
               inner="Arrange"),
        Action("align", "Align…", choose_align, "Blueprint", "align-left", ("Ctrl+Shift+A",),
               lambda: drawn() and align.can_align(), section=1, short="Align",
               tip="Line the selected states up, or space them equally; two or more",
               inner="Arrange"),
        *align_actions(align, shell),
        Action("enter", "Enter the sub-SB", drawing.enter, "Blueprint", "", ("Return",),
               lambda: drawn() and drawing.can_enter(), scope="canvas", section=2),
        Action("leave", "Back to the base SB", drawing.leave, "Blueprint", "", ("Backspace",),
               lambda: drawn() and drawing.can_leave(), scope="canvas", section=2),
        Action("next_finding", "Next finding", findings.next_finding, "Blueprint", "warning",
               ("F3",), lambda: drawn() and bool(findings.findings), section=3),
        Action("fix", "Fix the current finding", findings.fix_current, "Blueprint", "check",
               ("Ctrl+.",), lambda: drawn() and findings.can_fix(), section=3,
               tip="Apply the quick fix as one step that can be undone"),
    )  # fmt: skip
