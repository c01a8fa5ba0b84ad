"""Formulas: conditions over the facts and states of a blueprint, as hazards and properties say
them.

::

    F    := T { or T }        T := L { and L }
    L    := not L | ( F ) | FACT = VALUE | FACT != VALUE | SB in STATE
    FACT := [SB/]DIGIT | [SB/]"plain name" | SB
"""

from __future__ import annotations

from smsl_studio.blueprint.properties.formula import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    StateTerm,
    Term,
)
from smsl_studio.blueprint.properties.formula_text import read_formula
from smsl_studio.blueprint.properties.meaning import Meaning, meaning_of

__all__ = [
    "AllOf",
    "AnyOf",
    "FactTerm",
    "Formula",
    "Meaning",
    "Negation",
    "StateTerm",
    "Term",
    "meaning_of",
    "read_formula",
]
