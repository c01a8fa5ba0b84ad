"""Imports the modules of a plugin from the digested bytes, not from the disk."""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import (
    EXTENSION_SUFFIXES,
    ExtensionFileLoader,
    ModuleSpec,
    SourceFileLoader,
)
from importlib.util import spec_from_file_location
from pathlib import Path
from types import ModuleType

from smsl_studio.library.sources import PackageSources, Sources


class DigestedFinder(MetaPathFinder):
    """Finds only the modules of one plugin, whose package has the name ``private``."""

    def __init__(self, private: str, sources: Sources) -> None:
        self.private = private
        self._sources = sources

    def plugin(self) -> ModuleSpec:
        """Return the spec of the package: ``plugin.py``, with the other files as submodules."""
        return self._source(self.private, "plugin.py", self._sources.folder)

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the spec of a module of the plugin. ModuleNotFoundError for a module that was not
        digested. None for a module of another package."""
        if not fullname.startswith(f"{self.private}."):
            return None
        return self._digested(fullname, fullname.removeprefix(f"{self.private}."))

    def _digested(self, fullname: str, inner: str) -> ModuleSpec:
        """Return the spec of a module that is called ``inner`` below the folder.
        ModuleNotFoundError for a module that was not digested."""
        name = inner.replace(".", "/")
        modules, compiled = self._sources.modules, self._sources.compiled
        if f"{name}/__init__.py" in modules:
            return self._source(fullname, f"{name}/__init__.py", self._sources.folder / name)
        for file in (f"{name}{suffix}" for suffix in EXTENSION_SUFFIXES):
            if file in compiled:
                return self._extension(fullname, file)
        if f"{name}.py" in modules:
            return self._source(fullname, f"{name}.py", None)
        if any(file.startswith(f"{name}/") for file in modules):
            spec = ModuleSpec(fullname, None, is_package=True)
            spec.submodule_search_locations = [str(self._sources.folder / name)]
            return spec
        raise ModuleNotFoundError(f"No module named {fullname!r}", name=fullname)

    def _source(self, fullname: str, name: str, package: Path | None) -> ModuleSpec:
        file = str(self._sources.folder / name)
        spec = spec_from_file_location(
            fullname,
            file,
            loader=_DigestedLoader(fullname, file, self._sources.modules[name]),
            submodule_search_locations=None if package is None else [str(package)],
        )
        assert spec is not None
        return spec

    def _extension(self, fullname: str, name: str) -> ModuleSpec:
        """Return the spec of a compiled module. It can only be loaded from the disk, so its digest
        is compared again. ImportError if the digest differs."""
        file = self._sources.folder / name
        if hashlib.sha256(file.read_bytes()).hexdigest() != self._sources.compiled[name]:
            raise ImportError(f"{name} has changed since the plugin was allowed", name=fullname)
        spec = spec_from_file_location(
            fullname, file, loader=ExtensionFileLoader(fullname, str(file))
        )
        assert spec is not None
        return spec


class PackageFinder(DigestedFinder):
    """Finds only the modules of one installed package, under their own names."""

    def __init__(self, sources: PackageSources) -> None:
        super().__init__("", sources)
        self.names = sources.names
        self._closed = sources.closed

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the spec of a module of the package. ModuleNotFoundError for one that was not
        digested. None for a module of another package."""
        top = fullname.partition(".")[0]
        if top in self.names:
            return self._digested(fullname, fullname)
        if self._closed and top == fullname and self._lies_beside(top):
            words = f"{fullname} lies beside the code of a plugin and does not belong to it"
            raise ModuleNotFoundError(words, name=fullname)
        return None

    def _lies_beside(self, top: str) -> bool:
        """Whether Python would take a module from the folder in which the package lies."""
        spec = spec_on_disk(top)
        if spec is None:
            return False
        places = spec.submodule_search_locations or [spec.origin or ""]
        return any(Path(place).resolve().parent == self._sources.folder for place in places)


def spec_on_disk(top: str) -> ModuleSpec | None:
    """Return where Python finds a module of the highest level, without any digested bytes. None of
    its code runs."""
    for finder in sys.meta_path:
        if isinstance(finder, PackageFinder) or not hasattr(finder, "find_spec"):
            continue
        spec = finder.find_spec(top, None)
        if spec is not None:
            return spec
    return None


class _DigestedLoader(SourceFileLoader):
    """Compiles the digested bytes. It does not use a compiled copy beside the file."""

    def __init__(self, fullname: str, file: str, raw: bytes) -> None:
        super().__init__(fullname, file)
        self._file, self._raw = file, raw

    def get_data(self, path: str) -> bytes:
        """Return the digested bytes of the module. Other files are read from the disk."""
        return self._raw if path == self._file else super().get_data(path)

    def path_stats(self, path: str) -> dict[str, float]:
        """Raise OSError: without time and size Python neither reads nor writes a compiled copy."""
        raise OSError(f"{path} is not read from the disk")
