"""Imports a plugin folder as a package, and finds the line of an error in it."""

from __future__ import annotations

import hashlib
import sys
import traceback
from collections.abc import Collection
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from smsl_studio.errors import Place, PluginError
from smsl_studio.library.digested_import import DigestedFinder, PackageFinder
from smsl_studio.library.sources import PackageSources, Sources


def import_plugin(name: str, folder: Path, sources: Sources | None = None) -> ModuleType:
    """Run ``plugin.py`` of a folder as a private package, so that ``from . import x`` works.

    With ``sources`` the modules come from the digested bytes, even if the files on the disk have
    changed. ``sys.path`` does not change. Modules of an earlier load are removed first, so an
    edited plugin is read anew. Errors of the plugin's code are not caught.
    """
    file = folder / "plugin.py"
    if not (file.is_file() if sources is None else "plugin.py" in sources.modules):
        raise PluginError("it has no plugin.py", Place(str(folder / "plugin.toml"), 1, 1))
    digest = hashlib.sha256(str(folder).encode()).hexdigest()[:8]
    private = f"_smsl_plugin_{name}_{digest}"
    _forget(private)
    if sources is None:
        spec = spec_from_file_location(private, file, submodule_search_locations=[str(folder)])
    else:
        finder = DigestedFinder(private, sources)
        sys.meta_path.insert(0, finder)
        spec = finder.plugin()
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[private] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        _forget(private)
        raise
    return module


def take_package(sources: PackageSources) -> None:
    """Let the modules of an installed package be imported from the digested bytes from now on.

    Modules of it that were imported before are removed.
    """
    leave_package(sources.names)
    _remove_modules(sources.names)
    sys.meta_path.insert(0, PackageFinder(sources))


def leave_package(names: Collection[str]) -> None:
    """Let modules of the highest level be imported as Python finds them again.

    If they came from digested bytes, all modules of their package are removed.
    """
    for finder in [one for one in sys.meta_path if isinstance(one, PackageFinder)]:
        if not finder.names.isdisjoint(names):
            sys.meta_path.remove(finder)
            _remove_modules(finder.names)


def _remove_modules(names: Collection[str]) -> None:
    for name in [one for one in sys.modules if one.partition(".")[0] in names]:
        del sys.modules[name]


def place_of(error: BaseException, location: str) -> Place | None:
    """Return the innermost line of the plugin in ``location`` that led to an error, or None."""
    if isinstance(error, SyntaxError) and error.filename and error.lineno:
        return Place(error.filename, error.lineno, max(error.offset or 1, 1))
    place = None
    for frame, line in traceback.walk_tb(error.__traceback__):
        file = frame.f_code.co_filename
        if Path(file).is_relative_to(location):
            place = Place(file, line, 1)
    return place


def where(error: BaseException, location: str) -> str:
    """Return the place of an error as `` (hanoi/plugin.py:12)``, the same text on every machine.

    The text is empty if no line of the plugin led to the error.
    """
    place = place_of(error, location)
    if place is None or not Path(place.file).is_relative_to(location):
        return ""
    inner = Path(place.file).relative_to(Path(location).parent)
    return f" ({inner.as_posix()}:{place.line})"


def _forget(private: str) -> None:
    sys.meta_path[:] = [
        finder
        for finder in sys.meta_path
        if not (isinstance(finder, DigestedFinder) and finder.private == private)
    ]
    for name in [n for n in sys.modules if n == private or n.startswith(f"{private}.")]:
        del sys.modules[name]
