"""Statuses of runs as plain values, for tests without a run."""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Reading, Scene
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus, Possible
from smsl_studio.dispatch.status_now import look_at_nothing
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.files import parse_text, read_document


def at(text: str) -> Address:
    return Address(*Address.split(text))


def sample(name: str) -> Blueprint:
    return read_blueprint(read_document(samples_dir() / name))


def written(text: str) -> Blueprint:
    """The blueprint of a text."""
    return read_blueprint(parse_text(text, "here.json"))


def possible(text: str, target: str, **said: object) -> Possible:
    """One edge that may be asked for, unless ``said`` says otherwise."""
    plain = Possible(at(text), target, True, (), 1.0, False)
    return replace(plain, **said)  # type: ignore[arg-type]


def status(configuration: dict[str, str], **said: object) -> DispatchStatus:
    """A run that is paused at 60 s, unless ``said`` says otherwise."""
    plain = replace(look_at_nothing("paused", (), None), time=60.0, configuration=configuration)
    return replace(plain, **said)  # type: ignore[arg-type]


def scene(**facts: str | None) -> Scene:
    """``SB_0="1"``: what is read of each fact; None: unknown."""
    readings = {}
    for name, value in facts.items():
        branch, _, digit = name.rpartition("_")
        why = "" if value is not None else "no reading for 1.2 s"
        readings[branch, int(digit)] = Reading(value, why, 0.02)
    return Scene(readings, 60.0)
