"""Finding and loading plugins. Loading a plugin runs its code: install only what you trust.

A plugin is a folder with ``plugin.toml`` and ``plugin.py``, or an installed package with an entry
point in the group ``smsl_studio.plugins``. Folders are looked for, in this order, in the paths
that were asked for, in ``SMSL_PLUGIN_PATH``, in the user's folder and among the shipped plugins;
where two have one name, the first is taken and the other is reported. A plugin that is broken is
one named fault and stops nobody else.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import metadata
from pathlib import Path

from smsl_studio.errors import Place, PluginError, WorldError, did_you_mean
from smsl_studio.library.folders import plugin_path, user_folder
from smsl_studio.library.importing import import_plugin, place_of
from smsl_studio.library.manifest import read_manifest
from smsl_studio.library.operation_library import (
    TABLE,
    FaultEntry,
    OperationLibrary,
    WorldEntry,
)
from smsl_studio.shipped import plugins_dir

GROUP = "smsl_studio.plugins"
MANIFEST = "plugin.toml"


@dataclass(frozen=True, slots=True)
class Plugin:
    """A plugin that loaded: what it registered, and where it came from."""

    name: str
    version: str
    description: str
    source: str
    location: str
    library: OperationLibrary


@dataclass(frozen=True, slots=True)
class PluginFault:
    """A plugin that did not load: its name, what is wrong, where."""

    plugin: str
    sentence: str
    place: Place | None
    location: str

    def __str__(self) -> str:
        where = f"{self.place}: " if self.place else f"{self.location}: "
        return f"{where}the plugin {self.plugin!r} did not load: {self.sentence}"


@dataclass(frozen=True, slots=True)
class Loaded:
    """Every plugin that was found, and every one that did not load."""

    plugins: tuple[Plugin, ...] = ()
    faults: tuple[PluginFault, ...] = ()

    @property
    def worlds(self) -> tuple[str, ...]:
        """The names of all worlds, the built-in ``table`` first."""
        return (TABLE, *(name for plugin in self.plugins for name in plugin.library.worlds))

    def world(self, name: str) -> tuple[Plugin, WorldEntry]:
        """The plugin that offers a world; WorldError with a near name where none does."""
        for plugin in self.plugins:
            if name in plugin.library.worlds:
                return plugin, plugin.library.worlds[name]
        near = did_you_mean(name, self.worlds)
        # A plugin that did not load cannot say which worlds it would have had.
        faults = [fault for fault in self.faults if not near or name in fault.plugin]
        broken = "".join(f" {fault}." for fault in faults)
        advice = near or f"There are {', '.join(self.worlds)}."
        raise WorldError(f"there is no world {name!r}.{broken}".removesuffix("."), advice=advice)

    def serving(self, world: str) -> tuple[Plugin, ...]:
        """The plugins whose operations and sensors belong to a world: its own, then the general."""
        if world == TABLE:
            return ()
        own, _ = self.world(world)
        return (own, *(plugin for plugin in self.plugins if not plugin.library.worlds))

    def faults_of(self, world: str) -> dict[str, FaultEntry]:
        """What can be made to go wrong in a plugin's world, by name."""
        plugin, _ = self.world(world)
        return {e.name: e for e in plugin.library.faults.values() if e.world == world}


@dataclass(frozen=True, slots=True)
class _Found:
    """A plugin that can be loaded: what to call it, and how to."""

    name: str
    source: str
    location: str
    load: Callable[[], Plugin]


def discover(
    extra: Sequence[Path] = (),
    skip: Collection[str] = (),
    begins: Callable[[str, str], None] | None = None,
) -> Loaded:
    """Load every plugin there is; ``extra`` are folders of plugins (or one) to look at first.

    What stands in a location of ``skip`` is left out. ``begins`` is told name and location of each
    plugin before its code runs. What plugins print goes to standard error, so that data on
    standard output stays whole.
    """
    plugins: list[Plugin] = []
    faults: list[PluginFault] = []
    seen: set[str] = set()
    with contextlib.redirect_stdout(sys.stderr):
        for found in _find(extra):
            if isinstance(found, PluginFault):
                faults.append(found)
            elif found.location not in seen and found.location not in skip:
                seen.add(found.location)
                if begins is not None:
                    begins(found.name, found.location)
                _load(found, plugins, faults)
    return Loaded(tuple(plugins), tuple(faults))


def _load(found: _Found, plugins: list[Plugin], faults: list[PluginFault]) -> None:
    try:
        plugin = found.load()
        _check_names(plugin, plugins)
    except PluginError as error:
        place = error.place or place_of(error, found.location)
        sentence = f"{error.sentence}. {error.advice}" if error.advice else error.sentence
        faults.append(PluginFault(found.name, sentence, place, found.location))
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # SystemExit, and what compiled libraries raise
        words = f"{type(error).__name__}: {error}".removesuffix(": ")
        place = place_of(error, found.location)
        faults.append(PluginFault(found.name, words, place, found.location))
    else:
        plugins.append(plugin)


def _check_names(plugin: Plugin, others: Sequence[Plugin]) -> None:
    for other in others:
        if plugin.name == other.name:
            raise PluginError(f"the name is taken by the plugin in {other.location}")
        for world in plugin.library.worlds.keys() & other.library.worlds.keys():
            raise PluginError(f"the world {world!r} is taken by the plugin {other.name!r}")
    for world in plugin.library.arrangers.keys() - plugin.library.worlds.keys():
        raise PluginError(f"it arranges the world {world!r}, which it does not register")
    for world, name in plugin.library.faults:
        if world not in plugin.library.worlds:
            raise PluginError(
                f"it has the fault {name!r} for the world {world!r}, which it does not register"
            )


def _find(extra: Sequence[Path]) -> Iterator[_Found | PluginFault]:
    for folder in extra:
        yield from _in_folder(folder, "asked for", must_exist=True)
    for folder in plugin_path():
        yield from _in_folder(folder, "SMSL_PLUGIN_PATH", must_exist=True)
    yield from _in_folder(user_folder() / "plugins", "user", must_exist=False)
    yield from _entry_points()
    yield from _in_folder(plugins_dir(), "shipped", must_exist=False)


def _in_folder(folder: Path, source: str, must_exist: bool) -> Iterator[_Found | PluginFault]:
    if _is_file(folder / MANIFEST):
        yield _folder_plugin(folder, source)
        return
    try:
        inner = sorted(path for path in folder.iterdir() if _is_plugin(path))
    except OSError as error:
        if must_exist:
            yield PluginFault(folder.name, error.strerror or str(error), None, str(folder))
        return
    for path in inner:
        if _is_file(path / MANIFEST):
            yield _folder_plugin(path, source)
        else:
            place = Place(str(path / "plugin.py"), 1, 1)
            yield PluginFault(path.name, f"it has no {MANIFEST}", place, str(path))


def _is_plugin(path: Path) -> bool:
    """Whether a folder is a plugin, or means to be one."""
    return _is_file(path / MANIFEST) or _is_file(path / "plugin.py")


def _is_file(path: Path) -> bool:
    """Whether a file is there; what may not be looked at, or has no possible name, is not."""
    try:
        return path.is_file()
    except OSError:
        return False


def _folder_plugin(folder: Path, source: str) -> _Found:
    whole = folder.resolve()
    return _Found(whole.name, source, str(whole), partial(_load_folder, whole, source))


def _load_folder(folder: Path, source: str) -> Plugin:
    manifest = read_manifest(folder / MANIFEST)
    library = OperationLibrary(manifest.name)
    module = import_plugin(manifest.name, folder)
    _register(module, library, folder / "plugin.py")
    return Plugin(
        manifest.name, manifest.version, manifest.description, source, str(folder), library
    )


def _register(module: object, library: OperationLibrary, file: Path) -> None:
    register = getattr(module, "register", None)
    if not callable(register):
        raise PluginError(
            "it has no function register(library)",
            Place(str(file), 1, 1),
            "Write def register(library): ... in it.",
        )
    register(library)


def _entry_points() -> Iterator[_Found]:
    for point in sorted(metadata.entry_points(group=GROUP), key=lambda point: point.name):
        yield _Found(point.name, "installed", point.value, partial(_load_entry_point, point))


def _load_entry_point(point: metadata.EntryPoint) -> Plugin:
    library = OperationLibrary(point.name)
    loaded = point.load()
    getattr(loaded, "register", loaded)(library)
    dist = point.dist
    version = dist.version if dist else "0"
    summary = (dist.metadata["Summary"] or "") if dist else ""
    return Plugin(point.name, version, summary, "installed", point.value, library)
