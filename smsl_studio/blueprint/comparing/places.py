"""Places of many paths in one text: each map of it is read once, however many are asked for."""

from __future__ import annotations

from dataclasses import dataclass, field

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place
from smsl_studio.smsl.document import Document

Path = tuple[str, ...]


@dataclass(eq=False)
class Places:
    """Where things stand in the texts of a blueprint; worked out when it is asked."""

    blueprint: Blueprint
    _starts: dict[tuple[str, Path], dict[str, int]] = field(default_factory=dict)

    def of(self, path: Path) -> Place | None:
        """The place of what stands at a path, or of the nearest thing above it; None for none."""
        if not path:
            return None
        document = self.blueprint.imported.get(path[0], self.blueprint.document)
        while path:
            start = self._in(document, path[:-1]).get(path[-1])
            if start is not None:
                return document.place_at(start)
            path = path[:-1]
        return document.place(())

    def _in(self, document: Document, path: Path) -> dict[str, int]:
        """The keys of the map at a path, and where each stands; of a doubled one the last."""
        key = document.file, path
        found = self._starts.get(key)
        if found is None:
            try:
                members = document.members(path)
            except KeyError:
                members = ()
            found = self._starts[key] = {member.key: member.key_start for member in members}
        return found
