"""The blueprint of a run: the one with which it began, and the edges that count in it alone."""

from __future__ import annotations

from smsl_studio.blueprint.editing.generated_edges import with_edges
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus


class RunBlueprint:
    """``shown`` has all edges that count, and the one that is proposed; ``counting`` has not the
    proposed one. Both are None without a run.
    """

    def __init__(self) -> None:
        self.shown: Blueprint | None = None
        self.counting: Blueprint | None = None
        self._begun: Blueprint | None = None
        self._compared: tuple[Blueprint, Blueprint, bool] | None = None

    def begin(self, blueprint: Blueprint | None) -> None:
        """Begin a run of this blueprint; None forgets the last one."""
        self.shown = self.counting = self._begun = blueprint
        self._compared = None

    def extend(self, before: DispatchStatus | None, now: DispatchStatus) -> bool:
        """Follow the edges that are proposed and allowed. Return whether others count."""
        if self._begun is None:
            return False
        made, proposed = now.generated, now.proposed
        was = (before.generated, before.proposed) if before is not None else ({}, None)
        if (made, proposed) == was:
            return False
        if made != was[0]:
            self.counting = with_edges(self._begun, made)
        also = dict([proposed]) if proposed is not None else {}
        base = self.counting or self._begun
        self.shown = with_edges(base, also) if also else base
        return made != was[0]

    def differs(self, drawn: Blueprint) -> bool:
        """Whether the drawing has other content than the run began with."""
        begun, before = self._begun, self._compared
        if begun is None:
            return False
        if before is None or before[0] is not begun or before[1] is not drawn:
            # This is called for every frame, and comparing large blueprints is slow.
            before = self._compared = (begun, drawn, begun is not drawn and begun != drawn)
        return before[2]
