"""Cost functions of plugins: they return the present costs of edges. Only valid costs count."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from smsl_studio.blueprint.address import Address
from smsl_studio.host.brief import words_of
from smsl_studio.host.protocol import Happened, Priced
from smsl_studio.library.bound import BoundCost

MOST = 1e12
"""The largest cost of an edge. It keeps the cost of every route finite."""


class CostFunctions:
    """The cost functions bound to edges, their last answers, and the history of the run."""

    def __init__(self, bound: Mapping[Address, BoundCost]) -> None:
        self._bound = bound
        self._history: tuple[Happened, ...] = ()
        self._said: dict[Address, float | None] = {}

    def ask(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Ask every function about each of its edges. Return the answers that have changed.

        A function that raises an error, or returns an invalid cost, gives one fault. The declared
        costs of its edges count then.
        """
        self._history = (*self._history, *happened)
        seen = MappingProxyType(dict(scene))
        costs: dict[Address, float | None] = {}
        faults: dict[str, str] = {}
        for edge, bound in self._bound.items():
            cost, wrong = self._cost(edge, bound, seen)
            if wrong:
                words = f"the cost function {bound.name} {wrong}; what is declared stands"
                faults.setdefault(bound.name, words)
            if self._said.get(edge) != cost:
                self._said[edge] = costs[edge] = cost
        return Priced(costs, tuple(faults.values()))

    def _cost(
        self, edge: Address, bound: BoundCost, scene: Mapping[str, str | None]
    ) -> tuple[float | None, str]:
        """Return the cost of an edge (None: the declared cost), and the fault of the answer."""
        try:
            found = bound.function(edge.state, scene, self._history, **bound.arguments)
            if found is None:
                return None, ""
            if isinstance(found, (int, float)) and type(found) is not bool and 0 <= found <= MOST:
                return float(found), ""
            said = repr(found)[:60]
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # SystemExit, and what compiled libraries raise
            return None, f"raised an error for {edge}: {words_of(error, bound.location)}"
        return None, f"says {said} for {edge}, which is no number from 0 to 1e12"
