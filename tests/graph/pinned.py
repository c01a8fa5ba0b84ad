"""SBs with pinned states, and a plain look at which nodes cover each other."""

from __future__ import annotations

from collections.abc import Mapping
from random import Random
from types import MappingProxyType

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.graph.arrangement import KINDS
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.picture import Picture
from smsl_studio.smsl.json_form import parse_json, write_json
from tests.graph.edited import random_branch

Places = Mapping[str, tuple[float, float]]


def pinned_branch(branch: StateBranch, pins: Places) -> StateBranch:
    """Return the SB with these states pinned at these places."""
    layout = {**{name: list(at) for name, at in pins.items()}, "_pinned": dict.fromkeys(pins, True)}
    fields = MappingProxyType({**branch.fields, "_layout": layout})
    return StateBranch(branch.name, branch.table, branch.header, fields)


def random_case(chance: Random) -> tuple[StateBranch, Places, str]:
    """Return an SB with pinned states, the places of all states, and a kind of layout.

    The states are strewn or stand in a tidy drawing, and some names are long.
    """
    plain = random_branch(chance)
    if chance.random() < 0.3:
        words = "with_a_long_name"
        longer = {name: f"{name}_{words[: chance.randrange(17)]}" for name in plain.table}
        plain = StateBranch(
            plain.name,
            {longer[n]: {o: longer[t] for o, t in own.items()} for n, own in plain.table.items()},
        )
    shown = place_states(plain)
    if chance.random() < 0.5:
        shown = {n: (chance.uniform(-900, 900), chance.uniform(-600, 600)) for n in shown}
    names = chance.sample(list(plain.table), chance.randrange(1, len(plain.table)))
    return pinned_branch(plain, {n: shown[n] for n in names}), shown, chance.choice(KINDS)


def covered(branch: StateBranch, places: Places) -> list[tuple[str, str]]:
    """Return the pairs of states whose nodes cover each other, but for two pinned ones."""
    written = write_json({branch.name: values_of_branch(branch)})
    blueprint = read_blueprint(parse_json(written, "f.json"))
    boxes = Figure(Picture(blueprint, branch.name), dict(places)).boxes.tolist()
    names, pins = list(branch.table), branch.notes.pinned
    return [
        (names[i], names[j])
        for i, (x, y, w, h) in enumerate(boxes)
        for j, (u, v, p, q) in enumerate(boxes[:i])
        if abs(x - u) < w + p and abs(y - v) < h + q
        and not (names[i] in pins and names[j] in pins)
    ]  # fmt: skip


def values_of_branch(branch: StateBranch) -> dict[str, object]:
    """Return an SB as it is written, without its layout."""
    header = {"INITIAL": branch.initial, "ACTIVATING": branch.activating}
    return {"HEADER": header, **{name: dict(own) for name, own in branch.table.items()}}
