"""The spare: a child process that is started before a run needs it, with its imports done.

A spare with a recipe has also found the plugins and built the world, so that a run begins at once.
A spare serves only one run and ends with its parent. There is at most one spare.
"""

from __future__ import annotations

import threading
from pathlib import Path

from smsl_studio.host.child import Recipe
from smsl_studio.host.started_child import Child, start_child
from smsl_studio.library.stamp import library_stamp


class Spare:
    """Holds at most one waiting child. Any thread may call its methods."""

    def __init__(self) -> None:
        self._child: Child | None = None
        self._for: tuple[Recipe | None, object] = (None, None)
        self._using = threading.Lock()

    @property
    def pid(self) -> int | None:
        """The process number of the waiting child. None if there is no child."""
        child = self._child
        return child.pid if child is not None else None

    def warm(self, recipe: Recipe | None = None) -> None:
        """Start a child for ``recipe``, or a child with only its imports done. It does not wait.

        A waiting child that fits already is kept. If no process can be started, there is no spare
        and the next run starts its own child.
        """
        wanted = (recipe, _stamp(recipe))
        with self._using:
            if self._child is not None and not self._child.dead and self._for == wanted:
                return
            self._drop()
            try:
                child = start_child()
            except OSError:
                return
            child.tell(*(("warm", ()) if recipe is None else ("prepare", (recipe,))))
            child.prepared = recipe is not None
            self._child, self._for = child, wanted

    def take(self, recipe: Recipe) -> Child | None:
        """Hand over the waiting child to a run of ``recipe``. None if there is no fitting child.

        A child that was prepared for another recipe, or from plugins that have changed since, is
        ended.
        """
        with self._using:
            child, made_for = self._child, self._for
            if child is None:
                return None
            wanted = None if made_for[0] is None else recipe
            fits = made_for == (wanted, _stamp(wanted))
            if child.dead or not fits:
                self._drop()
                return None
            self._child = None
        child.told()
        return child

    def close(self) -> None:
        """End the waiting child. A second call does nothing."""
        with self._using:
            self._drop()

    def _drop(self) -> None:
        if self._child is not None:
            self._child.kill()
        self._child = None


def _stamp(recipe: Recipe | None) -> object:
    """Return a value that changes with the plugins and the bindings file of a recipe."""
    if recipe is None:
        return library_stamp()
    return library_stamp([Path(path) for path in recipe.plugin_paths], recipe.documents[0][0])
