"""Predicates of facts (paper, Eq. 5): how a fact follows from what its sources measure.

::

    P := C { and C } | C { or C }
    C := [not] ( E OP NUMBER UNIT | ( P ) ) [ for NUMBER UNIT-OF-TIME ]      OP := < <= > >=
    E := A { + A | - A }
    A := name | age(name) | abs(E) | min(E, ...) | max(E, ...) | distance(name, name) | ( E )
"""

from __future__ import annotations

from smsl_studio.blueprint.predicates.fact_sense import FactSense, SenseFault, sense_of
from smsl_studio.blueprint.predicates.predicate import ValuePredicate
from smsl_studio.blueprint.predicates.predicate_text import read_predicate
from smsl_studio.blueprint.predicates.units import Unit, read_unit

__all__ = [
    "FactSense",
    "SenseFault",
    "Unit",
    "ValuePredicate",
    "read_predicate",
    "read_unit",
    "sense_of",
]
