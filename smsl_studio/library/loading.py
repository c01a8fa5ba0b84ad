"""Loads plugins. To load a plugin means to run its code, so only plugins that ``survey`` allows are
loaded.

A plugin is a folder with ``plugin.toml`` and ``plugin.py``, or an installed package with an entry
point in the group ``smsl_studio.plugins``. Folders are searched in this order: the paths that were
asked for, ``SMSL_PLUGIN_PATH``, the user's folder, the shipped plugins. If two plugins have the
same name, the first is loaded and the other is reported. A broken plugin gives one named fault and
does not affect the others.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from smsl_studio.errors import Place, PluginError, RunRefused
from smsl_studio.library.generated_functions import register_generated
from smsl_studio.library.loaded import Loaded, Plugin, PluginFault
from smsl_studio.library.operation_library import OperationLibrary
from smsl_studio.library.plugin_code import CHANGED, sources_of
from smsl_studio.library.plugin_package import import_plugin, leave_package, place_of, take_package
from smsl_studio.library.sources import PackageSources
from smsl_studio.library.survey import SHIPPED, FoundPlugin, PluginState, survey

APART = "its functions are generated, so they run in a process of their own alone"
APART_ADVICE = "Run it with --host process, or host='process' in Python."


def discover(
    extra: Sequence[Path] = (),
    only: Collection[str] | None = None,
    begins: Callable[[str, str], None] | None = None,
    signed: Mapping[str, str] | None = None,
    *,
    apart: bool = False,
) -> Loaded:
    """Load every plugin that may be loaded.

    ``extra`` are plugin folders, or folders of plugins, that are searched first. If ``only`` is
    given, plugins at other locations are not loaded. ``begins`` is called with the name and the
    location of each plugin before its code runs. ``signed`` has the SHA-256 of signed code, by
    location; a plugin there is loaded only if its code has this SHA-256. The printed output of
    plugins goes to standard error, so that data on standard output stays intact. Generated
    functions are loaded only in a process that is ``apart`` from the program.
    """

    def load(found: FoundPlugin) -> Plugin | PluginFault:
        """Call ``begins``, then load one plugin."""
        if found.is_generated and not apart:
            return _kept_apart(found)
        if begins is not None:
            begins(found.name, found.location)
        if signed is not None and found.location in signed:
            return load_signed(found, signed[found.location])
        return load_plugin(found)

    every: Sequence[FoundPlugin] = survey(extra)
    if only is not None:
        allowed = PluginState.ALLOWED
        every = [one for one in every if one.state is not allowed or one.location in only]
    with contextlib.redirect_stdout(sys.stderr):
        return gathered(every, load)


def _kept_apart(found: FoundPlugin) -> PluginFault:
    """Return the fault of generated functions that are not loaded in this process."""
    assert found.manifest is not None
    operations = tuple(one.operation for one in found.manifest.generated)
    return replace(_fault_of(found, PluginError(APART, advice=APART_ADVICE)), operations=operations)


def refuse_hardware(loaded: Loaded, world: str, approved: bool) -> None:
    """Raise RunRefused if a world is hardware and no run is ``approved`` for it.

    The caller must not have built the world yet, because that may move something.
    """
    if approved or not any(world in one.library.worlds for one in loaded.plugins):
        return
    if loaded.world(world)[1].hardware:
        words = f"{world} is hardware, and no policy is named"
        advice = "Run it in a simulated world, or name a trust policy that is met."
        raise RunRefused(words, advice=advice, refusals=[("policy_unmet", words)])


def gathered(
    every: Iterable[FoundPlugin], load: Callable[[FoundPlugin], Plugin | PluginFault]
) -> Loaded:
    """Return the result of loading the plugins that were found. ``load`` is called for each
    allowed plugin."""
    plugins: list[Plugin] = []
    faults: list[PluginFault] = []
    waiting: list[FoundPlugin] = []
    for found in every:
        if found.state is PluginState.ALLOWED:
            _sort_in(found, load(found), plugins, faults)
        elif found.error is not None and found.state is PluginState.FAULTY:
            faults.append(_fault_of(found, found.error))
        else:
            waiting.append(found)
    return Loaded(tuple(plugins), tuple(faults), tuple(waiting))


def load_signed(found: FoundPlugin, code: str) -> Plugin | PluginFault:
    """Load one plugin if the SHA-256 of its code is ``code``. Return the plugin, or a fault.

    Its modules are imported from exactly the bytes that were hashed.
    """
    try:
        sources = sources_of(found)
        if sources.digest != code:
            raise PluginError(CHANGED, advice="Let it be looked at and signed again.")
    except PluginError as error:
        return _fault_of(found, error)
    return load_plugin(replace(found, sources=sources))


def load_from_bytes(found: FoundPlugin) -> Plugin | PluginFault:
    """Load one plugin from bytes that were read once, so that no bytecode beside them runs.

    A plugin whose code cannot be read in this way is loaded as Python finds it; no approval can
    sign its code. What ships with the program is as trusted as the program, and loads as it does.
    """
    if found.source == SHIPPED:
        return load_plugin(found)
    with contextlib.suppress(PluginError):
        sources = found.sources or sources_of(found)
        if isinstance(sources, PackageSources):
            sources = replace(sources, closed=False)  # nobody has signed it yet
        found = replace(found, sources=sources)
    return load_plugin(found)


def load_plugin(found: FoundPlugin) -> Plugin | PluginFault:
    """Run the code of one plugin. Return the plugin, or a fault if it did not load."""
    try:
        return _loaded(found)
    except PluginError as error:
        return _fault_of(found, error)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # SystemExit, and what compiled libraries raise
        place = place_of(error, found.location)
        return PluginFault(found.name, _words_of(error), place, found.location)


def _words_of(error: BaseException) -> str:
    """Write an error as ``ValueError: message``. The ``__str__`` of a plugin's error may raise."""
    try:
        said = str(error)
    except KeyboardInterrupt:
        raise
    except BaseException:
        said = "it cannot say what"
    return f"{type(error).__name__}: {said}".removesuffix(": ")


def _fault_of(found: FoundPlugin, error: PluginError) -> PluginFault:
    """Return the fault of a plugin for an error, with its place."""
    place = error.place or place_of(error, found.location)
    sentence = f"{error.sentence}. {error.advice}" if error.advice else error.sentence
    return PluginFault(found.name, sentence, place, found.location)


def _sort_in(
    found: FoundPlugin,
    loaded: Plugin | PluginFault,
    plugins: list[Plugin],
    faults: list[PluginFault],
) -> None:
    """Add a plugin to ``plugins`` or to ``faults``. A plugin whose names do not fit is a fault."""
    if isinstance(loaded, PluginFault):
        faults.append(loaded)
        return
    try:
        _check_words(loaded, found)
        _check_names(loaded, plugins)
    except PluginError as error:
        faults.append(_fault_of(found, error))
    else:
        plugins.append(loaded)


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


def _loaded(found: FoundPlugin) -> Plugin:
    """Run the code of a plugin, and let it register its entries."""
    assert found.manifest is not None
    library = OperationLibrary(found.manifest.name)
    if found.is_generated:
        assert found.sources is not None
        register_generated(library, found.manifest.generated, found.sources)
    elif found.point is not None:
        if isinstance(found.sources, PackageSources):
            take_package(found.sources)
        else:
            leave_package([found.point.module.partition(".")[0]])
        loaded = found.point.load()
        getattr(loaded, "register", loaded)(library)
    else:
        folder = Path(found.location)
        module = import_plugin(found.manifest.name, folder, found.sources)
        _register(module, library, folder / "plugin.py")
    version, words = found.manifest.version, found.manifest.description
    return Plugin(found.manifest.name, version, words, found.source, found.location, library)


def _register(module: object, library: OperationLibrary, file: Path) -> None:
    register = getattr(module, "register", None)
    if not callable(register):
        raise PluginError(
            "it has no function register(library)",
            Place(str(file), 1, 1),
            "Write def register(library): ... in it.",
        )
    register(library)


def _check_words(plugin: Plugin, found: FoundPlugin) -> None:
    """Raise PluginError if a plugin's name or entries differ from its manifest.

    People have decided by the manifest. Kinds of entries that the manifest leaves out are not
    compared.
    """
    manifest, library = found.manifest, plugin.library
    assert manifest is not None
    for name in (plugin.name, library.name):
        if name != manifest.name:
            raise PluginError(f"it calls itself {name!r} once it runs")
    registered = {
        "worlds": tuple(library.worlds),
        "operations": tuple(e.pattern.text if e.pattern else e.name for e in library.operations),
        "sensors": tuple(e.pattern.text for e in library.sensors),
        "faults": tuple(name for _, name in library.faults),
        "supervisors": tuple(library.supervisors),
    }
    for kind, said in manifest.registers.items():
        missing = [name for name in registered[kind] if name not in said]
        if said and missing:
            raise PluginError(
                f"it registers {missing[0]!r}, which is not among the {kind} of its plugin.toml",
                advice=f"Add it to {kind} there.",
            )
