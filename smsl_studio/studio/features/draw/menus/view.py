"""The View menu."""

from __future__ import annotations

from smsl_studio.picture.chip_words import has_words
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import AllWindows, DockSides, Shell
from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs

PANELS = "Panels"
"""The submenu of the menu View."""


def view_actions(
    drawing: DrawVerbs,
    docks: DockSides,
    windows: AllWindows,
    shell: Shell,
) -> tuple[Action, ...]:
    """The rows of the View menu."""
    canvas = drawing.canvas

    def drawn() -> bool:
        """Whether Draw mode is shown."""
        return shell.mode == "draw"

    def drawing_or_start() -> bool:
        """Whether Draw mode is shown, or the start page, which stands there for it."""
        return shell.mode in ("draw", "start", "merge", "rules", "physics", "cycle")

    def in_draw(name: str) -> Action:
        """The row that shows or hides the docks of one side."""
        shown = {"left": docks.left_shown, "right": docks.right_shown,
                 "bottom": docks.bottom_shown}[name]  # fmt: skip
        call = {"left": docks.toggle_left, "right": docks.toggle_right,
                "bottom": docks.toggle_bottom}[name]  # fmt: skip
        words = docks.words(name)
        key = {"left": "Ctrl+B", "right": "Ctrl+Alt+B", "bottom": "Ctrl+J"}[name]
        return Action(f"{name}_panel", words, call, "View", "sidebar" if name == "left" else "",
                      (key,), drawn, shown, section=2,
                      tip=f"Show or hide: {words}")  # fmt: skip

    def theme(name: str, words: str) -> Action:
        """The row that chooses a theme."""
        return Action(f"theme_{name}", words, lambda: windows.set_theme(name), "View",
                      checked=lambda: windows.theme == name, section=4, inner="Theme")  # fmt: skip

    def show_words() -> None:
        """Show words on the chips, or digits again; this is remembered."""
        canvas.set_words(not canvas.words)
        windows.settings.store_text("words", "shown" if canvas.words else "")
        sheet = canvas.sheet
        if canvas.words and sheet is not None and not has_words(sheet.picture.branch):
            canvas.say(
                "No fact here has a name or a meaning yet. Write them in the table of facts."
            )

    def seen() -> bool:
        """Whether the drawing is shown, or a run of it."""
        return shell.mode in ("draw", "run", "supervise")

    def bundle() -> None:
        """Draw the operations of this file as bundles, or show all of them, in every view of the
        file.
        """
        canvas.collapse_wanted.emit(not canvas.collapsed)

    def dim_mixed() -> None:
        """Dim load and mixed operations, or show them as the others; this is remembered."""
        canvas.set_quiet(not canvas.quiet)
        windows.settings.store_text("mixed", "dim" if canvas.quiet else "")

    canvas.set_quiet(windows.settings.text_of("mixed") == "dim")
    canvas.overlays.dense.mixed.clicked.connect(dim_mixed)
    canvas.set_words(windows.settings.text_of("words") == "shown")

    def enter(name: str) -> None:
        """Give the keyboard focus to a panel.

        If the panel has it already, give it to the canvas.
        """
        if not docks.enter_tab(name):
            canvas.setFocus()

    return (
        Action("mode_draw", "Draw mode", lambda: shell.set_mode("draw"), "View", "", ("Ctrl+1",),
               checked=drawing_or_start, short="Draw", tip="Draw and check the blueprint"),
        Action("mode_run", "Run mode", lambda: shell.set_mode("run"), "View", "", ("Ctrl+2",),
               checked=lambda: shell.mode == "run", short="Run", tip="Run it in a world"),
        Action("mode_supervise", "Supervise mode", lambda: shell.set_mode("supervise"), "View", "",
               ("Ctrl+3",), checked=lambda: shell.mode == "supervise", short="Supervise",
               tip="Watch a run by its current state, and step in"),
        Action("fit", "Fit everything", canvas.fit, "View", "fit", ("F", "Shift+1"), drawn,
               scope="canvas", section=1),
        Action("zoom_100", "Zoom to 100 %", lambda: canvas.zoom_to(1.0), "View", "", ("Shift+0",),
               drawn, scope="canvas", section=1),
        Action("zoom_in", "Zoom in", canvas.zoom_in, "View", "plus", ("Ctrl++", "Ctrl+="), drawn,
               section=1),
        Action("zoom_out", "Zoom out", canvas.zoom_out, "View", "minus", ("Ctrl+-",), drawn,
               section=1),
        Action("words", "Words instead of digits", show_words, "View", "", (), drawn,
               lambda: canvas.words, section=1,
               tip="Show what the values of facts mean; the file stays as it is"),
        Action("bundle", "Bundle operations", bundle, "View", "bundle", (), seen,
               lambda: canvas.collapsed, section=1,
               tip="Draw operations between the same two states as one line with their number; "
               "the file stays as it is"),
        Action("dim_mixed", "Dim load and mixed operations", dim_mixed, "View", "mixed", (), drawn,
               lambda: canvas.quiet, section=1,
               tip="Show those that change several facts at once, or load a sub-SB, paler"),
        in_draw("left"), in_draw("right"), in_draw("bottom"),
        Action("fold_panel", "Fold the lower panel", docks.fold_bottom, "View", "", (),
               lambda: drawn() and docks.bottom_shown(), docks.bottom_folded, section=2,
               tip="Show only the tabs of the lower panel, so that the drawing has its room"),
        Action("show_source", "Source", lambda: enter("Source"), "View", "",
               ("Ctrl+U",), drawn, section=3, inner=PANELS,
               tip="Show the exact text and type there; once more: back to the drawing"),
        Action("show_properties", "Properties", lambda: enter("Properties"), "View", "",
               ("Ctrl+Shift+P",), drawn, section=3, inner=PANELS),
        Action("show_facts", "Facts", lambda: enter("Facts"), "View", "", ("Ctrl+T",), drawn,
               section=3, inner=PANELS,
               tip="Show the table of facts; once more: back to the drawing"),
        Action("show_library", "Library", lambda: enter("Library"), "View", "", (), drawn,
               section=3, inner=PANELS),
        Action("show_history", "History", lambda: enter("History"), "View", "",
               ("Ctrl+H",), drawn, section=3, inner=PANELS),
        Action("show_table", "Table of states and operations", lambda: enter("Table"), "View", "",
               ("Ctrl+Shift+L",), drawn, section=3, inner=PANELS,
               tip="Read the State Branch as a table; once more: back to the drawing"),
        theme("light", "Light theme"), theme("dark", "Dark theme"),
        theme("contrast", "High-contrast theme"),
        theme("system", "Theme of the desktop"),
    )  # fmt: skip
