"""A warm spare: a child that is started and has its imports done before a run asks for one.

With a recipe it has also found the plugins and built the world, so that a run begins at once. It
serves one run and never a second; it dies with its parent; there is at most one.
"""

from __future__ import annotations

import threading
from pathlib import Path

from smsl_studio.host.child import Recipe
from smsl_studio.host.started_child import Child, start_child
from smsl_studio.library.stamp import library_stamp


class Spare:
    """At most one child in waiting. Any thread may call."""

    def __init__(self) -> None:
        self._child: Child | None = None
        self._for: tuple[Recipe | None, object] = (None, None)
        self._using = threading.Lock()

    @property
    def pid(self) -> int | None:
        """The waiting child's process number, None where there is none."""
        child = self._child
        return child.pid if child is not None else None

    def warm(self, recipe: Recipe | None = None) -> None:
        """Have a child ready for ``recipe``, or with nothing but its imports done; does not wait.

        One that fits already is left alone. Where none can be started there is none, and the next
        run starts its own.
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
        """The waiting child for a run of ``recipe``, which is then the run's; None for none.

        A child that was prepared for something else, or from plugins that have changed since, is
        ended and not handed out.
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
        """End the waiting child; twice is harmless."""
        with self._using:
            self._drop()

    def _drop(self) -> None:
        if self._child is not None:
            self._child.kill()
        self._child = None


def _stamp(recipe: Recipe | None) -> object:
    """What the plugins and the bindings file of a recipe are made of; it changes with them."""
    if recipe is None:
        return library_stamp()
    return library_stamp([Path(path) for path in recipe.plugin_paths], recipe.documents[0][0])
