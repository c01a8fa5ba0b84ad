"""Writes a blueprint as the configuration of a machine of XState 5, in JSON."""

from __future__ import annotations

import json
from typing import Any

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.exchange.carried import branch_carried, file_carried, state_carried
from smsl_studio.exchange.engines import told_of_engines
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.identifiers import Identifiers
from smsl_studio.stop import heed

Json = Any


def as_xstate(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as a configuration that ``createMachine`` of XState 5 takes.

    Each SB is a region of a parallel machine. Events are the names of operations, with the SB
    before them if there are several. The rest stands in ``meta.smsl``.
    """
    told_of_engines(blueprint, "XState", findings)
    free = Identifiers()
    regions: dict[str, Json] = {}
    for branch in blueprint:
        known = free.of(branch.name)
        regions[known] = _region(branch, f"{known}." if len(blueprint) > 1 else "")
    machine = {
        "id": "blueprint",
        "type": "parallel",
        "meta": {"smsl": {"file": file_carried(blueprint)}},
        "states": regions,
    }
    return json.dumps(machine, indent=2) + "\n"


def _region(branch: StateBranch, before: str) -> dict[str, Json]:
    free, events = Identifiers(), Identifiers()
    keys = {state: free.of(state) for state in branch.table}
    names = {name: before + events.of(name, "e") for name in branch.operation_names}
    own: dict[str, Json] = {"branch": branch.name, "carried": branch_carried(branch)}
    region: dict[str, Json] = {"meta": {"smsl": own}}
    if branch.initial in keys:
        region["initial"] = keys[branch.initial]
    if branch.activating in keys:
        own["activating"] = keys[branch.activating]
    if keys:
        region["states"] = {keys[state]: _state(branch, state, keys, names) for state in keys}
        region.setdefault("initial", keys[next(iter(keys))])
    return region


def _state(
    branch: StateBranch, state: str, keys: dict[str, str], names: dict[str, str]
) -> dict[str, Json]:
    heed()
    own: dict[str, Json] = {"state": state}
    if carried := state_carried(branch, state):
        own["carried"] = carried
    found: dict[str, Json] = {"meta": {"smsl": own}}
    on = {
        names[name]: {"target": keys[target], "meta": {"smsl": {"operation": name}}}
        for name, target in branch.table[state].items()
        if target in keys
    }
    if on:
        found["on"] = on
    return found
