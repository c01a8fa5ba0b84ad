"""Hosts and worlds: makes the host of a run, in this process or in a child, and lists the
worlds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.nested import NestedHost
from smsl_studio.errors import UsageError
from smsl_studio.front.procedure_parts import runnable_procedures
from smsl_studio.front.request import RunRequest
from smsl_studio.host.plugin_offers import describe
from smsl_studio.host.protocol import Host
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.loading import discover, refuse_hardware
from smsl_studio.world.engines import REMOTE, TABLE

if TYPE_CHECKING:
    from smsl_studio.host.child import Recipe
    from smsl_studio.host.process import ProcessHost
    from smsl_studio.host.spare import Spare


CONNECT = 3.0
"""The wall time (s) in which a program elsewhere must let this one connect."""


def make_host(
    request: RunRequest, loaded: Loaded | None = None, spare: Spare | None = None
) -> Host:
    """Make the host of a run: local or in a child process.

    ``loaded`` has plugins that were found before. A local host uses them directly. The child of a
    process host loads the plugins of the world again, and no others. ``spare`` may hold a child
    process that waits for work. RunRefused if the world is hardware and the run has no approval.
    """
    procedures = runnable_procedures(request.blueprint)
    host = _bare(request, loaded, spare, procedures.parts)
    if not procedures.bound:
        return host
    attended = request.by_hand if request.attended is None else request.attended
    return NestedHost(host, request.blueprint, procedures, attended, request.seed)


def _bare(
    request: RunRequest, loaded: Loaded | None, spare: Spare | None, parts: tuple[Blueprint, ...]
) -> Host:
    """Return the host of a run, without what carries out procedures. ``parts`` are theirs."""
    blueprint, world, seed = request.blueprint, request.world, request.seed
    trust = request.trust
    may_move = trust is not None
    if world == REMOTE:
        return _elsewhere(request, parts)
    if request.host == "local":
        from smsl_studio.host.local import LocalHost

        if loaded is None:
            loaded = known_world(world, request.plugin_paths)
        if loaded is not None:
            refuse_hardware(loaded, world, may_move)
        file = trust.bindings if trust is not None else None
        local = LocalHost(blueprint, world, seed, request.plugin_paths, loaded, file)
        local.choose(request.robot)
        local.carry(parts)
        return local
    return _in_child(request, loaded, spare, parts)


def _in_child(
    request: RunRequest, loaded: Loaded | None, spare: Spare | None, parts: tuple[Blueprint, ...]
) -> ProcessHost:
    from smsl_studio.host.process import ChildTerms, ProcessHost

    blueprint, world, seed = request.blueprint, request.world, request.seed
    trust = request.trust
    may_move = trust is not None
    if loaded is not None:
        refuse_hardware(loaded, world, may_move)
    signed = trust.code if trust is not None else None
    # A plugin that nobody signed does not run beside signed code: it could change it.
    only = tuple(signed) if signed else _locations(loaded, world)
    file = trust.bindings if trust is not None else None
    terms = ChildTerms(
        only, signed=signed, bindings=file, hardware=may_move, parts=parts, robot=request.robot,
        trial=request.trial,
    )  # fmt: skip
    return ProcessHost(blueprint, world, seed, request.plugin_paths, terms, spare)


def recipe_of(request: RunRequest, loaded: Loaded | None = None) -> Recipe:
    """Return what another process needs to build the world of a request. Its procedures are left
    out. RunRefused if the world is hardware and the run has no approval."""
    return _in_child(request, loaded, None, ()).recipe


def _elsewhere(request: RunRequest, parts: tuple[Blueprint, ...]) -> Host:
    """Return the host of a world that is a program somewhere else. Nothing is connected yet."""
    from smsl_studio.channel.address import read_address, read_token
    from smsl_studio.host.asked_program import ProgramTerms
    from smsl_studio.host.program_host import ProgramHost

    if not request.address:
        words = f"the world {REMOTE!r} needs the address of a program"
        raise UsageError(words, advice="Say --address unix:PATH, or --address 127.0.0.1:PORT.")
    where = read_address(request.address)
    terms = ProgramTerms(
        partial(where.connected, CONNECT),
        where.text,
        read_token(where, request.token_file),
        barred="policy_unmet" if request.trust is None else request.trust.barred,
    )
    return ProgramHost(request.blueprint, REMOTE, request.seed, terms, parts)


def make_ready(
    spare: Spare,
    blueprint: Blueprint,
    world: str,
    seed: int,
    loaded: Loaded | None = None,
    robot: str = "",
) -> None:
    """Let a child of ``spare`` build this world for a later run with the same ``loaded``. The call
    does not wait. A world that is hardware is not built before its run is approved."""
    from smsl_studio.host.process import ChildTerms, ProcessHost

    terms = ChildTerms(_locations(loaded, world), robot=robot)
    known = loaded is not None and world in loaded.worlds and world != TABLE
    if loaded is not None and known and loaded.world(world)[1].hardware:
        spare.warm()
        return
    spare.warm(ProcessHost(blueprint, world, seed, terms=terms).recipe)


def _locations(loaded: Loaded | None, world: str) -> tuple[str, ...] | None:
    """Return the locations of the plugins that a run needs. None if they are not known."""
    known = loaded is not None and world in loaded.worlds
    return loaded.locations(world) if loaded is not None and known else None


def known_world(
    world: str,
    plugin_paths: Sequence[Path] = (),
    host: str = "local",
    signed: Mapping[str, str] | None = None,
) -> Loaded | None:
    """Find the plugins of a world. None for the worlds table and remote, which need none.

    ``signed`` has the SHA-256 of signed code, by its location; then no other code is loaded. For
    the host ``process`` no plugin code runs in this process. WorldError if there is no such world;
    it suggests a similar name.
    """
    if world in (TABLE, REMOTE):
        return None
    if host == "local":
        # Where code is signed, no other plugin runs beside it: it could change what was signed.
        only = None if signed is None else tuple(signed)
        loaded = discover(plugin_paths, only, signed=signed)
    else:
        loaded = describe(plugin_paths)
    loaded.world(world)
    return loaded


def with_robot(request: RunRequest, loaded: Loaded | None) -> RunRequest:
    """Return the request with its robot, empty if that is the usual one of the world. UsageError if
    the world cannot be built with it."""
    if not request.robot:
        return request
    return replace(request, robot=(loaded or Loaded()).robot_name(request.world, request.robot))


def worlds(plugin_paths: Sequence[Path] = ()) -> tuple[str, ...]:
    """Return the names of all worlds, ``table`` first and ``remote`` last. No plugin's code runs in
    this process.

    >>> print(*worlds())
    table chess hanoi hanoi-mujoco registration river remote
    """
    return (*describe(plugin_paths).worlds, REMOTE)
