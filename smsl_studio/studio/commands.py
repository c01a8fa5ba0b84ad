"""The rows of the table of actions, menu by menu."""

from __future__ import annotations

from functools import partial
from typing import Protocol

from smsl_studio.shipped import samples_dir
from smsl_studio.studio.actions import Action
from smsl_studio.studio.drawing import Drawing
from smsl_studio.studio.files import Files
from smsl_studio.studio.panels.findings import Findings
from smsl_studio.studio.session import Session


class Shell(Protocol):
    """What actions ask of the window itself."""

    @property
    def mode(self) -> str: ...
    @property
    def theme(self) -> str: ...
    def set_mode(self, mode: str) -> None: ...
    def set_theme(self, theme: str) -> None: ...
    def open_palette(self) -> None: ...
    def choose_sub_sb(self) -> None: ...
    def toggle_left(self) -> None: ...
    def left_shown(self) -> bool: ...
    def toggle_right(self) -> None: ...
    def right_shown(self) -> bool: ...
    def toggle_bottom(self) -> None: ...
    def bottom_shown(self) -> bool: ...
    def show_tab(self, name: str) -> None: ...
    def show_shortcuts(self) -> None: ...
    def show_about(self) -> None: ...
    def quit(self) -> None: ...
    def stop_every_run(self) -> None: ...


class Transport(Protocol):
    """What actions ask of the run, in every mode."""

    def play(self) -> None: ...
    def pause(self) -> None: ...
    def step(self) -> None: ...


def file_actions(files: Files, session: Session, shell: Shell) -> tuple[Action, ...]:
    return (
        Action("new", "New blueprint", files.new, "File", "file", ("Ctrl+N",),
               tip="An empty blueprint with one State Branch"),
        Action("open", "Open…", files.open, "File", "folder", ("Ctrl+O",)),
        Action("save", "Save", files.save, "File", "save", ("Ctrl+S",), section=1),
        Action("save_as", "Save as…", files.save_as, "File", "", ("Ctrl+Shift+S",), section=1),
        Action("quit", "Quit", shell.quit, "File", "", ("Ctrl+Q",), section=2),
    )  # fmt: skip


def sample_actions(files: Files) -> tuple[Action, ...]:
    """In no menu: there is one of its own. The palette finds the samples by name."""
    return tuple(
        Action(f"sample_{path.stem}", f"Open sample {path.name}", partial(files.open_copy, path),
               icon="file", tip=f"Open a copy of the sample {path.name}")
        for path in sorted(samples_dir().glob("*.json"))
    )  # fmt: skip


def edit_actions(session: Session, drawing: Drawing, shell: Shell) -> tuple[Action, ...]:
    history = session.history
    return (
        Action("undo", "Undo", history.undo, "Edit", "undo", ("Ctrl+Z",), history.canUndo,
               tip="Undo the last step"),
        Action("redo", "Redo", history.redo, "Edit", "redo", ("Ctrl+Shift+Z", "Ctrl+Y"),
               history.canRedo, tip="Do the undone step again"),
        Action("rename", "Rename", drawing.rename, "Edit", "pencil", ("F2",),
               lambda: shell.mode == "draw" and drawing.can_rename(), scope="canvas", section=1,
               tip="Edit the name in place"),
        Action("delete", "Delete", drawing.delete, "Edit", "trash", ("Del",),
               lambda: shell.mode == "draw" and drawing.has_selection(), scope="canvas",
               section=1),
        Action("select_all", "Select all states", drawing.select_all, "Edit", "", ("Ctrl+A",),
               lambda: shell.mode == "draw" and drawing.has_states(), scope="canvas", section=1),
        Action("palette", "Find or run a command", shell.open_palette, "Edit", "search",
               ("Ctrl+K",), section=2),
    )  # fmt: skip


def view_actions(drawing: Drawing, shell: Shell) -> tuple[Action, ...]:
    canvas = drawing.canvas

    def drawn() -> bool:
        return shell.mode == "draw"

    def in_draw(name: str) -> Action:
        shown = {"left": shell.left_shown, "right": shell.right_shown,
                 "bottom": shell.bottom_shown}[name]  # fmt: skip
        call = {"left": shell.toggle_left, "right": shell.toggle_right,
                "bottom": shell.toggle_bottom}[name]  # fmt: skip
        words = {"left": "Outline and library", "right": "Properties and source",
                 "bottom": "Findings and history"}[name]  # fmt: skip
        key = {"left": "Ctrl+B", "right": "Ctrl+Alt+B", "bottom": "Ctrl+J"}[name]
        return Action(f"{name}_panel", words, call, "View", "sidebar" if name == "left" else "",
                      (key,), drawn, shown, section=2,
                      tip=f"Show or hide: {words}")  # fmt: skip

    def theme(name: str, words: str) -> Action:
        return Action(f"theme_{name}", words, lambda: shell.set_theme(name), "View",
                      checked=lambda: shell.theme == name, section=4)  # fmt: skip

    return (
        Action("mode_draw", "Draw mode", lambda: shell.set_mode("draw"), "View", "", ("Ctrl+1",),
               checked=drawn, short="Draw", tip="Draw and check the blueprint"),
        Action("mode_run", "Run mode", lambda: shell.set_mode("run"), "View", "", ("Ctrl+2",),
               checked=lambda: shell.mode == "run", short="Run", tip="Run it in a world"),
        Action("fit", "Fit everything", canvas.fit, "View", "fit", ("F", "Shift+1"), drawn,
               scope="canvas", section=1),
        Action("zoom_100", "Zoom to 100 %", lambda: canvas.zoom_to(1.0), "View", "", ("Shift+0",),
               drawn, scope="canvas", section=1),
        Action("zoom_in", "Zoom in", canvas.zoom_in, "View", "plus", ("Ctrl++", "Ctrl+="), drawn,
               section=1),
        Action("zoom_out", "Zoom out", canvas.zoom_out, "View", "minus", ("Ctrl+-",), drawn,
               section=1),
        in_draw("left"), in_draw("right"), in_draw("bottom"),
        Action("show_source", "Source", lambda: shell.show_tab("Source"), "View", "",
               ("Ctrl+U",), drawn, section=3, tip="Show the exact text"),
        Action("show_properties", "Properties", lambda: shell.show_tab("Properties"), "View", "",
               ("Ctrl+I",), drawn, section=3),
        Action("show_history", "History", lambda: shell.show_tab("History"), "View", "",
               ("Ctrl+H",), drawn, section=3),
        theme("light", "Light theme"), theme("dark", "Dark theme"),
        theme("system", "Theme of the desktop"),
    )  # fmt: skip


def blueprint_actions(drawing: Drawing, findings: Findings, shell: Shell) -> tuple[Action, ...]:
    def drawn() -> bool:
        return shell.mode == "draw"

    return (
        Action("add_state", "Add state", drawing.add_state, "Blueprint", "plus", ("Ctrl+Shift+N",),
               lambda: drawn() and drawing.has_branch(), short="State",
               tip="Add a state beside the others; a double click on the canvas adds one there"),
        Action("connect", "Connect", drawing.connect, "Blueprint", "arrow", ("Ctrl+E",),
               lambda: drawn() and drawing.can_connect(), short="Connect",
               tip="Connect the selected states, or the selected one with another"),
        Action("add_branch", "Add State Branch", drawing.add_branch, "Blueprint", "layers",
               ("Ctrl+Shift+B",), drawn),
        Action("sub_sb", "Attach a sub-SB…", shell.choose_sub_sb, "Blueprint", "layers", (),
               lambda: drawn() and drawing.has_states(), short="Sub-SB",
               tip="Let a State Branch expand one of the facts"),
        Action("tidy", "Tidy the drawing", drawing.tidy, "Blueprint", "tidy", ("Ctrl+Shift+T",),
               lambda: drawn() and drawing.has_states(), section=1, short="Tidy",
               tip="Lay the State Branch out anew, as one step that can be undone"),
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


def run_actions(run: Transport, shell: Shell) -> tuple[Action, ...]:
    def play() -> None:
        shell.set_mode("run")
        run.play()

    def step() -> None:
        shell.set_mode("run")
        run.step()

    return (
        Action("run_play", "Run", play, "Run", "play", ("F5",),
               tip="Start the run, or go on with it"),
        Action("run_pause", "Pause", run.pause, "Run", "pause", ("F6",)),
        Action("run_step", "One operation", step, "Run", "step", ("F10",)),
        Action("run_stop", "Stop", shell.stop_every_run, "Run", "stop", ("F8",), section=1,
               tip="A controlled stop, from anywhere"),
    )  # fmt: skip


def help_actions(shell: Shell) -> tuple[Action, ...]:
    return (
        Action("shortcuts", "Keyboard shortcuts", shell.show_shortcuts, "Help", "", ("F1",)),
        Action("about", "About SMSL Studio", shell.show_about, "Help"),
    )
