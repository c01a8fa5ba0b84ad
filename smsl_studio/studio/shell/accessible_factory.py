"""Accessible interfaces for objects whose interface in Qt is missing or faulty."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QObject
from PySide6.QtGui import QAccessible, QAccessibleInterface

from smsl_studio.studio.base.canvas.accessible_tree import CanvasAccessible
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.shell.accessible_areas import area_of

INSTALLED = "smsl accessible factory"


class Factory:
    """Makes the interface of a canvas or a scroll area when an assistive tool asks for it.

    Qt calls it with the name of each class of an object, from the most special to the most general.
    """

    def __init__(self) -> None:
        self._kept: dict[int, CanvasAccessible] = {}

    def __call__(self, class_name: str, thing: QObject) -> QAccessibleInterface | None:
        if not isinstance(thing, Canvas):
            return area_of(class_name, thing)
        self._kept = {k: i for k, i in self._kept.items() if i.isValid()}
        made = CanvasAccessible(thing)
        self._kept[id(thing)] = made
        return made


def install(application: QCoreApplication) -> None:
    """Install the factory, once for each application."""
    if not application.property(INSTALLED):
        application.setProperty(INSTALLED, True)
        QAccessible.installFactory(Factory())
