"""The parts that all features of one window share."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtWidgets import QMainWindow

from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.toast import Toast
from smsl_studio.studio.document.files.collapse_choice import CollapseChoice
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.inspector import Inspector
from smsl_studio.studio.document.session import Session


@dataclass(frozen=True)
class WindowParts:
    """The shared parts, made by the shell before any feature.

    ``tokens`` are the colours at the start.
    """

    session: Session
    files: Files
    inspector: Inspector
    settings: Settings
    collapse: CollapseChoice
    toast: Toast
    tokens: Tokens
    window: QMainWindow
