"""The survey of plugins: it finds all plugins and decides which may be loaded. None of their code
runs.

The survey reads a plugin's own description (``plugin.toml``, or the metadata of a package), checks
whether another user could change its folder, and reads the user's decisions. A plugin in the user's
folder is loaded after the user has allowed it, as long as its files do not change. All other
plugins are loaded unless they are forbidden: they ship with the program, are installed packages, or
were named at the start of the program.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path

from smsl_studio.errors import Place, PluginError
from smsl_studio.home import user_folder
from smsl_studio.library.decisions import PluginDecision, decisions_file, read_decisions
from smsl_studio.library.folders import plugin_path
from smsl_studio.library.manifest import MANIFEST, Manifest, read_manifest
from smsl_studio.library.ownership import exposure_on_the_way
from smsl_studio.library.sources import Sources, check_sources, read_sources
from smsl_studio.shipped import plugins_dir

GROUP = "smsl_studio.plugins"
ASKED, PATH, USER, INSTALLED, SHIPPED = (
    "asked for",
    "SMSL_PLUGIN_PATH",
    "user",
    "installed",
    "shipped",
)
"""The possible sources of a plugin."""


class PluginState(enum.Enum):
    """The state of a plugin before any of its code runs. Only an allowed plugin is loaded."""

    ALLOWED = "allowed"
    NEW = "new"
    CHANGED = "changed"
    FORBIDDEN = "forbidden"
    FAULTY = "fault"


@dataclass(frozen=True, slots=True)
class FoundPlugin:
    """A plugin that was found. None of its code has run.

    ``manifest`` is its own description. ``sources`` are its files if they decide whether it may be
    loaded. ``point`` is the entry point of an installed package. ``error`` says why it cannot be
    loaded, whether it is allowed or not.
    """

    name: str
    source: str
    location: str
    state: PluginState = PluginState.ALLOWED
    manifest: Manifest | None = None
    sources: Sources | None = field(default=None, repr=False)
    point: metadata.EntryPoint | None = None
    error: PluginError | None = None

    @property
    def digest(self) -> str:
        """The digest of its files. It is empty if the files do not decide whether it is loaded."""
        return self.sources.digest if self.sources else ""

    @property
    def is_forbidden(self) -> bool:
        """Whether somebody forbade it."""
        return self.state is PluginState.FORBIDDEN

    @property
    def is_generated(self) -> bool:
        """Whether nobody has written its functions by hand."""
        return self.manifest is not None and bool(self.manifest.generated)

    @property
    def is_changed(self) -> bool:
        """Whether its files are others than those that were allowed."""
        return self.state is PluginState.CHANGED

    @property
    def reason(self) -> str:
        """The reason why it is not loaded, with an advice. It is empty for an allowed plugin."""
        allow = f"smsl-studio plugins allow {'FOLDER' if self.is_generated else self.name}"
        return {
            PluginState.ALLOWED: "",
            PluginState.FAULTY: str(self.error),
            PluginState.NEW: f"it is new, and its code has not run; {allow} loads it from now on",
            PluginState.CHANGED: "its files have changed since it was allowed, and the new code "
            f"has not run; {allow} loads it from now on",
            PluginState.FORBIDDEN: f"it is forbidden; {allow} loads it again",
        }[self.state]


def survey(extra: Sequence[Path] = ()) -> tuple[FoundPlugin, ...]:
    """Find all plugins, in the order of loading, each location once. ``extra`` are further folders
    of plugins."""
    decisions: Mapping[str, PluginDecision] | None
    try:
        decisions = read_decisions()
        found: list[FoundPlugin] = []
    except PluginError as error:
        decisions = None
        found = [_fault("", USER, decisions_file(), error)]
    for folder in extra:
        found += _in_folder(folder, ASKED, decisions, must_exist=True)
    for folder in plugin_path():
        found += _in_folder(folder, PATH, decisions, must_exist=True)
    found += _in_folder(user_folder() / "plugins", USER, decisions, must_exist=False)
    found += _packages(decisions)
    found += _in_folder(plugins_dir(), SHIPPED, decisions, must_exist=False)
    first: dict[str, FoundPlugin] = {}
    for one in found:
        first.setdefault(one.location, one)
    return tuple(first.values())


def found_at(folder: Path) -> FoundPlugin:
    """Return the plugin in one folder of the user's, with its state. PluginError if the decisions
    are not believed."""
    return _plugin_in(folder, USER, read_decisions())


def _in_folder(
    folder: Path, source: str, decisions: Mapping[str, PluginDecision] | None, *, must_exist: bool
) -> Iterator[FoundPlugin]:
    """Yield the plugin in a folder, or the plugins in its subfolders."""
    try:
        exposed = None if source == SHIPPED else exposure_on_the_way(folder)
        alone = (folder / MANIFEST).is_file()
        inner = [] if alone else sorted(path for path in folder.iterdir() if _is_plugin(path))
    except OSError as error:
        if must_exist:
            words = PluginError(error.strerror or str(error))
            yield _fault(folder.name, source, folder, words)
        return
    if exposed is not None and (alone or inner):
        yield _fault(folder.name, source, folder, exposed.error(folder))
        return
    for path in [folder] if alone else inner:
        yield _plugin_in(path, source, decisions)


def _fault(name: str, source: str, place: Path, error: PluginError) -> FoundPlugin:
    return FoundPlugin(name, source, str(place), PluginState.FAULTY, error=error)


def _is_plugin(path: Path) -> bool:
    """Whether a folder has the files of a plugin. A folder that cannot be read has none."""
    try:
        return (path / MANIFEST).is_file() or (path / "plugin.py").is_file()
    except OSError:
        return False


def _plugin_in(
    folder: Path, source: str, decisions: Mapping[str, PluginDecision] | None
) -> FoundPlugin:
    """Return the plugin in a folder, with its own description and its state."""
    whole = folder.resolve()
    name, location = whole.name, str(whole)
    manifest = sources = error = None
    try:
        if not _is_text(location):
            raise PluginError("its path is no valid text", advice="Rename the folder.")
        if source != SHIPPED and (exposed := exposure_on_the_way(folder)):
            raise exposed.error(whole)
        if not (whole / MANIFEST).is_file():
            raise PluginError(f"it has no {MANIFEST}", Place(str(whole / "plugin.py"), 1, 1))
        manifest = read_manifest(whole / MANIFEST)
        if manifest.generated and source != USER:
            raise PluginError(
                "its functions are generated, and such functions are loaded from the user's folder",
                advice=f"Read and allow them: smsl-studio plugins allow {whole}",
            )
        if source == USER:
            sources = read_sources(whole)
        elif source != SHIPPED:
            check_sources(whole)
    except PluginError as fault:
        error = fault
    digest = sources.digest if sources else ""
    state = _state(location, source, digest, decisions)
    if error is not None and state is not PluginState.FORBIDDEN:
        state = PluginState.FAULTY
    name = manifest.name if manifest else name
    return FoundPlugin(name, source, location, state, manifest, sources, error=error)


def _is_text(path: str) -> bool:
    """Whether a path can be written to a file. Not every file name is valid UTF-8."""
    try:
        path.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def _state(
    location: str, source: str, digest: str, decisions: Mapping[str, PluginDecision] | None
) -> PluginState:
    if decisions is None:
        # The decisions cannot be read, so any plugin may be forbidden.
        return PluginState.ALLOWED if source in (ASKED, SHIPPED) else PluginState.NEW
    decided = decisions.get(location)
    if decided is not None and decided.decision == "forbidden":
        return PluginState.FORBIDDEN
    if source != USER or (decided is not None and decided.digest == digest):
        return PluginState.ALLOWED
    return PluginState.NEW if decided is None else PluginState.CHANGED


def _packages(decisions: Mapping[str, PluginDecision] | None) -> Iterator[FoundPlugin]:
    """Yield the plugins of installed packages. Only their metadata is read, not their code."""
    for point in sorted(metadata.entry_points(group=GROUP), key=lambda point: point.name):
        state = _state(point.value, INSTALLED, "", decisions)
        dist = point.dist
        version = dist.version if dist else "0"
        summary = (dist.metadata["Summary"] or "") if dist else ""
        words = Manifest.model_construct(
            name=point.name, version=version[:100], description=summary[:2000]
        )
        yield FoundPlugin(point.name, INSTALLED, point.value, state, words, point=point)
