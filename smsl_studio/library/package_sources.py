"""The content of an installed package that is a plugin: its digest, and its code.

The modules are those that Python would import, wherever they lie. A package that was installed
editable has its modules in another folder, and lists none of them.
"""

from __future__ import annotations

import hashlib
import sys
from importlib import invalidate_caches, metadata
from importlib.machinery import BYTECODE_SUFFIXES, EXTENSION_SUFFIXES, ModuleSpec
from pathlib import Path

from smsl_studio.errors import PluginError
from smsl_studio.library.digested_import import spec_on_disk
from smsl_studio.library.ownership import exposure_of
from smsl_studio.library.sources import (
    MOST_BYTES,
    PackageSources,
    add_line,
    content_at,
    read_sources,
)

MOST_NAMES = 100
"""The largest number of modules of the highest level in a package."""

_ENDS = (".py", *EXTENSION_SUFFIXES, *BYTECODE_SUFFIXES)
_ADVICE = "Install it as a usual package, or put the plugin into a folder of its own."


def read_package(point: metadata.EntryPoint) -> PackageSources:
    """Read the digest and the code of the installed package of an entry point.

    The digest covers all its modules, and every other file that the package lists. PluginError if
    the package lists no files, if its code cannot be read file by file (a namespace, an archive,
    bytecode alone), or if another user could change it.
    """
    files = (point.dist.files or []) if point.dist else []
    if point.dist is None or not files:
        raise PluginError(f"the package of the plugin {point.name!r} does not list its files")
    invalidate_caches()
    first = point.module.partition(".")[0]
    listed = {_top(file) for file in files if file.name.endswith(_ENDS)}
    told = (point.dist.read_text("top_level.txt") or "").split()
    names = {first, *(name for name in (*listed, *told) if _is_module(name))}
    if own := sorted(names & {"smsl_studio", *sys.stdlib_module_names}):
        raise PluginError(f"it has a module {own[0]!r}, which is a name of Python or of Studio")
    if len(names) > MOST_NAMES:
        raise PluginError(f"its package has more than {MOST_NAMES} modules of the highest level")
    whole = hashlib.sha256()
    parts = [part for name in sorted(names) if (part := _module(name, name == first))]
    folders = sorted({part.folder for part in parts})
    if len(folders) > 1:
        raise PluginError(f"its code lies in {folders[0]} and in {folders[1]}", advice=_ADVICE)
    modules: dict[str, bytes] = {}
    compiled: dict[str, str] = {}
    for part in parts:
        modules |= part.modules
        compiled |= part.compiled
        add_line(whole.update, "module", min(part.names), bytes.fromhex(part.digest))
    read, left = frozenset().union(*(part.names for part in parts)), MOST_BYTES
    for file in sorted(files, key=str):
        if _top(file) in read or "__pycache__" in file.parts:
            continue
        raw = content_at(Path(str(point.dist.locate_file(file))), str(file), left)
        left -= len(raw)
        add_line(whole.update, "file", str(file), hashlib.sha256(raw).digest())
    closed = first not in listed
    return PackageSources(
        folders[0], whole.hexdigest(), modules, compiled, frozenset(names), closed
    )


def _top(file: metadata.PackagePath) -> str:
    """Return the name of the highest level under which a listed file lies."""
    return file.parts[0] if len(file.parts) > 1 else file.name.partition(".")[0]


def _is_module(name: str) -> bool:
    """Whether a name can be that of a module. What makes a package editable is no part of it."""
    return name.isidentifier() and not name.startswith("__")


def _module(name: str, needed: bool) -> PackageSources | None:
    """Read one module of the highest level, with everything below it. None if Python finds no such
    module and it is not ``needed``."""
    spec = spec_on_disk(name)
    if spec is None:
        if needed:
            raise PluginError(f"Python finds no module {name!r}")
        return None
    place = Path(spec.origin or "")
    if spec.submodule_search_locations is not None:
        return _folder(name, place, spec)
    if spec.origin is None or not place.name.endswith((".py", *EXTENSION_SUFFIXES)):
        raise _unreadable(name)
    place = place.parent.resolve() / place.name
    try:
        exposed = exposure_of(place, place.lstat())
    except OSError as error:
        raise PluginError(f"{place} cannot be read: {error.strerror or error}") from None
    if exposed is not None:
        raise exposed.error(place)
    raw = content_at(place, place.name, MOST_BYTES)
    digest = hashlib.sha256(raw).hexdigest()
    is_text = place.name.endswith(".py")
    modules = {f"{name}.py": raw} if is_text and place.stem == name else {}
    compiled = {} if is_text else {place.name: digest}
    if not modules and not compiled:
        raise _unreadable(name)
    return PackageSources(place.parent, digest, modules, compiled, frozenset({name}), False)


def _folder(name: str, first: Path, spec: ModuleSpec) -> PackageSources:
    """Read a package that is a folder, with the file ``first``."""
    searched = [Path(place).resolve() for place in spec.submodule_search_locations or ()]
    folder = first.parent.resolve()
    if first.name != "__init__.py" or searched != [folder] or folder.name != name:
        raise _unreadable(name)
    found = read_sources(folder)
    modules = {f"{name}/{file}": raw for file, raw in found.modules.items()}
    compiled = {f"{name}/{file}": digest for file, digest in found.compiled.items()}
    names = frozenset({name})
    return PackageSources(folder.parent, found.digest, modules, compiled, names, False)


def _unreadable(name: str) -> PluginError:
    return PluginError(f"the code of {name!r} cannot be read file by file", advice=_ADVICE)
