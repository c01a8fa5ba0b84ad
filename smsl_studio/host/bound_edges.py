"""What a host tells of the functions that are bound to edges: everything but their code."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.host.protocol import Bound
from smsl_studio.library.bound import Bindings


def bounds_of(bindings: Bindings) -> dict[Address, Bound]:
    """Return the function of each edge. Equal ones are one object."""
    same: dict[Bound, Bound] = {}
    found: dict[Address, Bound] = {}
    for edge, function in bindings.operations.items():
        bound = Bound(
            function.name,
            function.exact,
            function.stop,
            function.timeout,
            function.resumes,
            function.touches,
            function.generated,
        )
        found[edge] = same.setdefault(bound, bound)
    return found
