"""Serves a simulated world to programs that are somewhere else."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_gathered
from smsl_studio.channel.address import read_address, read_token
from smsl_studio.channel.door import AskedQuestion, Door
from smsl_studio.channel.frames import ChannelError
from smsl_studio.channel.questions import OpenQuestion
from smsl_studio.dispatch.route.effort import refuse_too_large
from smsl_studio.errors import RunRefused, UsageError, WorldError
from smsl_studio.front.hosts import known_world
from smsl_studio.front.inputs import refuse_nonsense
from smsl_studio.host.protocol import Host
from smsl_studio.host.served_world import Built, ServedWorld
from smsl_studio.library.bindings_file import BindingsFile, bindings_beside
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.loading import refuse_hardware
from smsl_studio.smsl.forms import form_named
from smsl_studio.stop import heed
from smsl_studio.world.engines import REMOTE, TABLE

if TYPE_CHECKING:
    from socket import socket

Tell = Callable[[Mapping[str, Any]], object]
LOOK = 0.1
"""The longest wall time (s) between two looks whether the serving must end."""


def serve(
    world: str,
    address: str,
    *,
    token_file: str | os.PathLike[str] | None = None,
    blueprint: Blueprint | None = None,
    robot: str = "",
    tell: Tell = print,
) -> None:
    """Serve a simulated world at an address, until the work is called off (see ``stop``).

    One program is served at a time, and each gets a world of its own. A program that is lost leaves
    its world braked. Without a ``blueprint`` each program sends its own. ``tell`` gets what happens
    as JSON objects. UsageError for an address, a token or a robot that cannot be used. WorldError
    if there is no such world, or nobody can listen. RunRefused if it is hardware.

    >>> serve("chess", "127.0.0.1:0")
    Traceback (most recent call last):
        ...
    smsl_studio.errors.UsageError: '127.0.0.1:0' is no address
    """
    where = read_address(address)
    token = read_token(where, None if token_file is None else os.fspath(token_file))
    builder = WorldBuilder(world, robot)
    builder.own = blueprint
    try:
        listener = where.listening()
    except OSError as error:
        words = f"nobody can listen at {where.text}: {error.strerror or error}"
        raise WorldError(words, advice="Choose another address.") from None
    try:
        tell({"event": "serving", "world": world, "address": where.text})
        _serve(listener, token, ServedWorld(world, builder.build, blueprint is None), tell)
    finally:
        where.forget()


def _serve(listener: socket, token: str, served: ServedWorld, tell: Tell) -> None:
    door = Door(listener, token)
    try:
        while True:
            heed()
            serve_once(door, served, tell, LOOK)
    finally:
        served.brake()
        served.close()
        door.close()


def serve_once(door: Door, served: ServedWorld, tell: Tell, wait: float) -> None:
    """Answer the next question, if one comes within ``wait`` seconds."""
    try:
        question = door.next(wait)
        if question is None:
            return
        if question.verb == "close":
            door.leave()
            raise ChannelError("it said goodbye")
        _answer(door, served, question, tell)
    except ChannelError as error:
        door.leave()
        tell({"event": "program_left", "reason": str(error), "braked": served.brake()})


def _answer(door: Door, served: ServedWorld, question: AskedQuestion, tell: Tell) -> None:
    if question.verb == "hello":
        tell({"event": "program_came"})
        door.answer(question, served.card(door.session))
        return
    door.answer(question, served.answer(question))


class WorldBuilder:
    """Builds the world for each program. ``own`` is the blueprint of the one who serves."""

    def __init__(self, world: str, robot: str = "") -> None:
        if world == REMOTE:
            words = "a world that is somewhere else cannot be served from here"
            raise UsageError(words, advice="Serve a world of this computer.")
        # Library code may die. So it has a process of its own, and the next program is served.
        self._local = world == TABLE
        loaded = known_world(world, (), "process")
        if loaded is not None:
            refuse_hardware(loaded, world, False)
        self.own: Blueprint | None = None
        self._world, self._loaded = world, loaded
        self._robot = (loaded or Loaded()).robot_name(world, robot) if robot else ""

    def build(self, asked: OpenQuestion) -> Built:
        """Return the host and the blueprint for a program. RunRefused if it cannot be run."""
        blueprint = self.own
        if blueprint is None:
            blueprint = _sent(asked)
        elif asked.behaviour not in ("", blueprint.behaviour):
            words = f"{PurePath(blueprint.file).name} is served, and this is another blueprint"
            raise RunRefused(words, advice="Run the blueprint that is served.")
        refuse_nonsense(blueprint, "Mend what this finding says, then run it again.")
        refuse_too_large(Hierarchy(blueprint))
        # No file beside a name that a program has sent is read.
        file = bindings_beside(blueprint.file) if self.own is not None else BindingsFile()
        return self._made(blueprint, asked.seed, file), blueprint

    def _made(self, blueprint: Blueprint, seed: int, file: BindingsFile) -> Host:
        if self._local:
            from smsl_studio.host.local import LocalHost

            return LocalHost(blueprint, self._world, seed, (), None, file)
        from smsl_studio.host.process import ChildTerms, ProcessHost

        only = self._loaded.locations(self._world) if self._loaded is not None else None
        terms = ChildTerms(only, bindings=file, robot=self._robot)
        return ProcessHost(blueprint, self._world, seed, (), terms)


def _sent(asked: OpenQuestion) -> Blueprint:
    """Return the blueprint that a program has sent. ReadError if it is none."""
    if not asked.files:
        raise RunRefused("no blueprint was sent", advice="Send it with open, or serve --file FILE.")
    documents = [form_named(one.form).parse(one.text, one.name) for one in asked.files]
    return read_gathered(documents)
