"""Generated functions that wait beside a blueprint: what a person reads before it is allowed.

They lie in a folder that is never loaded. To allow them copies exactly what was read into the
user's folder of plugins, and only this copy is loaded.
"""

from __future__ import annotations

import difflib
import hashlib
import secrets
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import PluginError, SaveError, UsageError
from smsl_studio.home import user_folder
from smsl_studio.library.generated_functions import is_skeleton, read_code
from smsl_studio.library.generated_reach import parsed
from smsl_studio.library.manifest import MANIFEST, Manifest, read_manifest
from smsl_studio.library.ownership import exposure_on_the_way
from smsl_studio.library.sources import add_line, content_at, read_sources
from smsl_studio.library.survey import FoundPlugin, PluginState, found_at
from smsl_studio.smsl.disk import write_new

LARGEST = 400_000
SHORTEST_DIGEST = 8
"""So many characters of a digest say which code was read."""


@dataclass(frozen=True)
class GeneratedProposal:
    """Generated functions that wait for a person. ``files`` are the manifest and the code at
    one moment, by name."""

    folder: Path
    manifest: Manifest
    files: Mapping[str, bytes]

    @property
    def name(self) -> str:
        """The name of the plugin that they become."""
        return self.manifest.name

    @property
    def digest(self) -> str:
        """The SHA-256 of what is read."""
        whole = hashlib.sha256()
        for name, raw in sorted(self.files.items()):
            add_line(whole.update, "file", name, raw)
        return whole.hexdigest()

    @property
    def target(self) -> Path:
        """Where an allowed copy lies."""
        return user_folder() / "plugins" / self.name

    def written(self) -> Iterator[str]:
        """Yield the operations that have more than a skeleton. PluginError, with its place, for
        code that reaches out of its world."""
        for one in self.manifest.generated:
            file = str(self.folder / one.file)
            raw = self.files.get(one.file)
            if raw is None:
                raise PluginError(f"the file {one.file} is missing in {self.folder}")
            if not is_skeleton(parsed(read_code(raw, file), file, one.function)):
                yield one.operation

    def difference(self) -> str:
        """Return what differs from the copy that was allowed before, as a unified difference. Each
        file is compared with nothing where there is none."""
        before = _texts(self.target)
        after = {name: _plain(raw) for name, raw in self.files.items()}
        parts = []
        for name in sorted({*before, *after}):
            old, new = before.get(name, ""), after.get(name, "")
            if old != new:
                lines = difflib.unified_diff(
                    old.splitlines(), new.splitlines(),
                    f"allowed/{name}", f"{self.folder.name}/{name}", lineterm="",
                )  # fmt: skip
                parts.append("\n".join(lines))
        return "\n".join(parts)

    def install(self, read: str) -> FoundPlugin:
        """Copy what was read to the user's folder, and return it as found there. ``read`` is the
        digest, or its beginning, of what was read. UsageError if that is something else now,
        SaveError if it cannot be written."""
        if len(read) < SHORTEST_DIGEST or not self.digest.startswith(read.lower()):
            words = f"{self.folder} is not what was read: its SHA-256 is {self.digest}"
            raise UsageError(words, advice="Read the difference again.")
        list(self.written())
        part = self.target.with_name(f".{self.name}.{secrets.token_hex(8)}.part")
        old = part.with_suffix(".old")
        try:
            part.mkdir(mode=0o700, parents=True)
            for name, raw in self.files.items():
                write_new(part / name, raw, 0o600)
            if self.target.exists() or self.target.is_symlink():
                self.target.rename(old)
            part.rename(self.target)
        except OSError as error:
            words = f"{self.target} cannot be written: {error.strerror or error}"
            raise SaveError(words) from None
        finally:
            shutil.rmtree(part, ignore_errors=True)
            shutil.rmtree(old, ignore_errors=True)
        return found_at(self.target)


def proposal_at(folder: Path) -> GeneratedProposal | None:
    """Return the generated functions in a folder, None if there are none. PluginError if another
    user could change them, or if they do not fit."""
    whole = folder.resolve()
    file = whole / MANIFEST
    if not file.is_file():
        return None
    exposed = exposure_on_the_way(file)
    if exposed is not None:
        raise exposed.error(whole)
    manifest = read_manifest(file)
    if not manifest.generated:
        return None
    sources = read_sources(whole)
    odd = next((name for name in sources.modules if "/" in name or name == "plugin.py"), None)
    if odd is not None or sources.compiled:
        name = odd or next(iter(sources.compiled))
        raise PluginError(f"{name} is no generated function", advice=f"Take it out of {whole}.")
    files = {**sources.modules, MANIFEST: content_at(file, MANIFEST, LARGEST)}
    return GeneratedProposal(whole, manifest, files)


def is_allowed(proposal: GeneratedProposal) -> bool:
    """Return whether just this code was allowed."""
    if not proposal.target.is_dir():
        return False
    found = found_at(proposal.target)
    return found.state is PluginState.ALLOWED and not proposal.difference()


def _texts(folder: Path) -> Mapping[str, str]:
    found = {}
    if folder.is_dir():
        for path in sorted(folder.iterdir()):
            if path.suffix == ".py" or path.name == MANIFEST:
                found[path.name] = _plain(content_at(path, path.name, LARGEST))
    return found


def _plain(raw: bytes) -> str:
    return raw.decode("utf-8", "replace")
