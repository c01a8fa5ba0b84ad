"""Helpers for the dispatch tests: blueprints in one line, runs, and what happened in them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Self

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.host.protocol import Host
from smsl_studio.runlog.events import Event
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.json_form import parse_json
from tests.dispatch.fake_host import FakeHost

SAMPLES = Path(__file__).parents[2] / "samples"


def sample(name: str) -> Blueprint:
    return read_blueprint(read_document(SAMPLES / f"{name}.json"))


def blueprint(values: Mapping[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values), "test.json"))


def branch(
    edges: Mapping[str, str], *, initial: str = "", activating: str = "", **more: Any
) -> Any:
    """An SB in a few lines: ``{"00": "up>10, go>11"}``; more are subs and annotations."""
    header: dict[str, Any] = {"SUB_SBS": more.pop("subs", {})}
    if initial:
        header["INITIAL"] = f"State{initial}"
    if activating:
        header["ACTIVATING"] = f"State{activating}"
    table = {
        f"State{source}": {
            edge.split(">")[0]: "State" + edge.split(">")[1]
            for edge in filter(None, text.replace(" ", "").split(","))
        }
        for source, text in edges.items()
    }
    return {"HEADER": header, **{f"_{key}": value for key, value in more.items()}, **table}


def goals(blueprint: Blueprint, *texts: str) -> list[Address]:
    return [blueprint.resolve(text) for text in texts]


BESIDE = {"levels", "supervisor", "someone"}
"""What a dispatcher is given beside the terms of its run."""


class Story:
    """A run, driven by a test; every event that it told."""

    def __init__(self, blueprint: Blueprint, host: Host | None = None, **choices: Any) -> None:
        for key in ("goals", "avoid"):
            choices[key] = goals(blueprint, *choices.get(key, ()))
        self.blueprint = blueprint
        self.host = host if host is not None else FakeHost(blueprint)
        beside = {key: choices.pop(key) for key in BESIDE & set(choices)}
        self.dispatcher = Dispatcher(blueprint, self.host, RunTerms(**choices), **beside)
        self.events: list[Event] = list(self.dispatcher.open())

    def tick(self, count: int = 1) -> Self:
        for _ in range(count):
            self.events += self.dispatcher.tick()
        return self

    def run(self, most: int = 5000) -> Self:
        """Until it is over or waits for a person."""
        self.tick()
        while self.phase == "running" and most:
            self.tick()
            most -= 1
        assert most, "the run does not end"
        return self

    def ask(self, *texts: str) -> Self:
        """Ask for operations, one after the other, out of the states that are active then."""
        for text in texts:
            parts = Address.split(text)
            name = parts[0] if len(parts) > 1 else next(iter(self.blueprint.branches))
            self.dispatcher.ask(Address(name, self.configuration[name], parts[-1]))
            self.run()
        return self

    @property
    def phase(self) -> str:
        return self.dispatcher.phase

    @property
    def configuration(self) -> dict[str, str]:
        return dict(self.dispatcher.status.configuration)

    def of(self, *words: str) -> list[Any]:
        return [event for event in self.events if event.event in words]

    @property
    def words(self) -> list[str]:
        return [event.event for event in self.events]

    @property
    def started(self) -> list[str]:
        return [event.address for event in self.of("operation_started")]

    @property
    def commits(self) -> list[tuple[str, ...]]:
        return [event.operations for event in self.of("committed")]

    @property
    def reasons(self) -> list[str]:
        """Why operations were refused."""
        return [reason for event in self.of("operation_refused") for reason in event.reasons]

    @property
    def end(self) -> Any:
        return self.events[-1]


def short(addresses: Iterable[str]) -> list[str]:
    """The operations' names alone."""
    return [address.rpartition("/")[2] for address in addresses]
