"""Saves what was done by hand in a run as a script file."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QWidget

from smsl_studio.errors import StudioError
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.base.toast import Toast
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.running.run_session import RunSession


def save_script(run: RunSession, folder: Path, toast: Toast, window: QWidget) -> None:
    """Ask for a file and write the script of the run into it, completely or not at all."""
    text = run.script
    if not text or run.blueprint is None:
        return
    path = Dialogs(window).script_to_save(folder / f"{Path(run.blueprint.file).stem}-by-hand.jsonl")
    if path is None:
        return
    try:
        save_document(text, path)
    except StudioError as error:
        toast.refuse(error)
        return
    acts = counted(len(run.lines), "act")
    toast.say(f"{path.name} holds {acts}. Its first line says how to run it")
