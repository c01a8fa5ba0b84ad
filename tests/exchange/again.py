"""A blueprint, written for another program and read again."""

from __future__ import annotations

from random import Random

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.exchange.carried import blueprint_of
from smsl_studio.exchange.findings import ExchangeFinding, ExchangeFindings
from smsl_studio.exchange.table import reader_of, suffix_of, writer_of
from tests.blueprint.values import read
from tests.oracle.random_blueprint import SHAPES, RandomBlueprint

WHOLE = (".scxml", ".graphml", ".xstate.json")
"""The forms that hold a whole blueprint."""


def text_of(blueprint: Blueprint, suffix: str) -> str:
    """A blueprint in the form of a suffix."""
    return writer_of(suffix)(blueprint, ExchangeFindings())


def read_text(text: str, file: str) -> tuple[Blueprint, list[ExchangeFinding]]:
    """The blueprint in a text of another program, and what was left out."""
    findings = ExchangeFindings()
    values = reader_of(suffix_of(file, WHOLE))(text, file, findings)
    return blueprint_of(dict(values), file), list(findings)


def random_blueprint(seed: int) -> Blueprint:
    """A blueprint of one to three levels, with notes, people and two random hazards."""
    chance = Random(seed)
    quiet, peopled = chance.random() < 0.5, chance.random() < 0.5
    made = RandomBlueprint(chance, quiet=quiet, peopled=peopled, subs=chance.choice(SHAPES))
    hazards = []
    for name in ("one", "two"):
        facts: dict[str, str] = {}
        for _ in range(2):
            branch = chance.choice(list(made.alphabets))
            digit = chance.randrange(len(made.alphabets[branch]))
            facts[f"{branch}/{digit}"] = chance.choice(made.alphabets[branch][digit])
        hazards.append({"name": name, "facts": facts})
    return read({**made.values, "_hazards": hazards})
