"""The result of loading plugins: what was loaded, what was not, and which worlds there are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from smsl_studio.errors import Place, UsageError, WorldError, did_you_mean
from smsl_studio.library.arm_table import arm_named
from smsl_studio.library.stations import reaches
from smsl_studio.world.engines import REMOTE, TABLE

if TYPE_CHECKING:
    from smsl_studio.library.entries import FaultEntry, WorldEntry
    from smsl_studio.library.operation_library import OperationLibrary
    from smsl_studio.library.survey import FoundPlugin
    from smsl_studio.world.bodies import Robot
    from smsl_studio.world.stations import RobotReach


@dataclass(frozen=True, slots=True)
class Plugin:
    """A loaded plugin: its description, its source, its location and its library."""

    name: str
    version: str
    description: str
    source: str
    location: str
    library: OperationLibrary


@dataclass(frozen=True, slots=True)
class PluginFault:
    """A plugin that did not load: its name, a sentence about the fault, and its place.

    ``operations`` are those that its generated functions would do (``SB/Operation``).
    """

    plugin: str
    sentence: str
    place: Place | None
    location: str
    operations: tuple[str, ...] = ()

    def __str__(self) -> str:
        where = f"{self.place}: " if self.place else f"{self.location}: "
        what = f"the plugin {self.plugin!r} did not load: " if self.plugin else ""
        return f"{where}{what}{self.sentence}"


@dataclass(frozen=True, slots=True)
class Loaded:
    """The result of loading: loaded plugins, faults, and plugins that may not be loaded.

    The plugins in ``waiting`` are new, changed or forbidden. None of their code has run.
    """

    plugins: tuple[Plugin, ...] = ()
    faults: tuple[PluginFault, ...] = ()
    waiting: tuple[FoundPlugin, ...] = ()

    @property
    def worlds(self) -> tuple[str, ...]:
        """The names of all worlds, the built-in ``table`` first."""
        return (TABLE, *(name for plugin in self.plugins for name in plugin.library.worlds))

    def world(self, name: str) -> tuple[Plugin, WorldEntry]:
        """Return the plugin that offers a world, and its entry. WorldError if no plugin offers it.
        The advice has a similar name if there is one."""
        if name == REMOTE:
            words = "the world 'remote' is a program elsewhere, which only a run reaches"
            raise WorldError(words, advice="Say: run FILE --world remote --address ADDRESS.")
        for plugin in self.plugins:
            if name in plugin.library.worlds:
                return plugin, plugin.library.worlds[name]
        for found in self.waiting:
            if found.manifest is not None and name in found.manifest.worlds:
                raise WorldError(
                    f"the world {name!r} is of the plugin {found.name!r} in {found.location}, "
                    f"which is not loaded: {found.reason}"
                )
        if not name:
            advice = f"Choose one: there are {', '.join(self.worlds)}."
            raise WorldError("no world is chosen", advice=advice)
        near = did_you_mean(name, self.worlds)
        # The worlds of a plugin that did not load are not known.
        faults = [fault for fault in self.faults if not near or name in fault.plugin]
        broken = "".join(f" {fault}." for fault in faults)
        for found in self.waiting:
            if (not near and not _says_worlds(found)) or name in found.name:
                broken += f" {found.location}: the plugin {found.name!r} is not loaded: "
                broken += f"{found.reason}."
        advice = near or f"There are {', '.join(self.worlds)}."
        raise WorldError(f"there is no world {name!r}.{broken}".removesuffix("."), advice=advice)

    def robots(self, world: str) -> tuple[str, ...]:
        """Return the names of the robots that a world can be built with, the usual one first. Empty
        for a world that has no choice."""
        if world == TABLE:
            return ()
        own = self.world(world)[1].robots
        more = (name for plugin in self.serving(world)[1:] for name in plugin.library.robots)
        return tuple(dict.fromkeys((*own, *more))) if own else ()

    def robot_name(self, world: str, asked: str) -> str:
        """Return the robot that was asked for, empty if it is the usual one of the world.
        UsageError if the world cannot be built with it."""
        known = self.robots(world)
        if asked and asked not in known:
            if not known:
                words = f"the world {world!r} has no choice of robots"
                raise UsageError(words, advice="Leave the robot out.")
            near = did_you_mean(asked, known)
            there = f"There are {', '.join(known)}."
            words = f"the world {world!r} has no robot {asked!r}"
            raise UsageError(words, advice=f"{near} {there}" if near else there)
        return "" if known[:1] == (asked,) else asked

    def robot(self, world: str, asked: str) -> Robot | None:
        """Return the robot to build a world with. None if the world has no choice of robots.
        UsageError if the world cannot be built with it, WorldError if nobody has registered it."""
        known = self.robots(world)
        name = self.robot_name(world, asked) or next(iter(known), "")
        if not name:
            return None
        for plugin in self.serving(world):
            if name in plugin.library.robots:
                return plugin.library.robots[name]
        return arm_named(name)

    def reach(self, world: str, asked: str) -> RobotReach | None:
        """Return the reach of a robot in a world, None if its plugin tells none. UsageError if the
        world cannot be built with the robot."""
        name = self.robot_name(world, asked) or next(iter(self.robots(world)), "")
        library = self.world(world)[0].library if world != TABLE else None
        entry = library.reaching.get(world) if library is not None else None
        if library is None or entry is None:
            return None
        known = entry.known if entry.known is not None else reaches(library, entry)
        return known.get(name) or known.get("")

    def serving(self, world: str) -> tuple[Plugin, ...]:
        """Return the plugins whose operations and sensors belong to a world: the world's own
        plugin first, then the plugins without worlds."""
        if world == TABLE:
            return ()
        own, _ = self.world(world)
        return (own, *(plugin for plugin in self.plugins if not plugin.library.worlds))

    def locations(self, world: str) -> tuple[str, ...]:
        """Return the locations of the plugins that a run in a world must load."""
        return tuple(plugin.location for plugin in self.serving(world) if plugin.library.serves)

    def faults_of(self, world: str) -> dict[str, FaultEntry]:
        """Return the faults of a plugin's world, by name."""
        plugin, _ = self.world(world)
        return {e.name: e for e in plugin.library.faults.values() if e.world == world}


def _says_worlds(found: FoundPlugin) -> bool:
    """Whether the manifest of a plugin names its worlds."""
    return found.manifest is not None and bool(found.manifest.worlds)
