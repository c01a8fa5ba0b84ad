"""Who changed an element last: the versions of a file in git, compared by what they mean."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import Change, ChangeKind, compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError
from smsl_studio.front.inputs import read_bytes
from smsl_studio.front.revisions import MOST, Revision, bytes_of, is_shallow, revisions
from smsl_studio.stop import heed


@dataclass(frozen=True)
class LastChange:
    """The last change of one element.

    ``revision`` is the commit that made it; None if it was not found. ``uncommitted`` are the
    changes since the last commit, and ``changes`` those of the commit, in sentences. ``lines`` are
    the lines in which the element stood before the commit, empty if it was not there.
    ``reason`` says why nothing earlier is known, if that is so. ``unread`` versions were no
    blueprints.
    """

    revision: Revision | None
    changes: tuple[str, ...] = ()
    uncommitted: tuple[str, ...] = ()
    lines: tuple[str, ...] = ()
    reason: str = ""
    unread: int = 0


def last_change(blueprint: Blueprint, address: Address, file: Path) -> LastChange:
    """Return who changed an element last. ``blueprint`` is the present text of ``file``.

    A commit counts if the element is as today in it, and otherwise in each of its parents. So
    commits that moved lines, and merges that took it from one side, do not count. ReadError if git
    cannot tell. The search heeds a stop between the versions.
    """
    found = revisions(file)
    versions = _Versions(file)
    head = versions.at("HEAD", _name_now(file))
    if head is None:
        raise ReadError(
            f"the last commit has no version of {file.name} that can be read",
            advice="Commit a version that can be read first.",
        )
    uncommitted = _sentences(head, blueprint, address)
    if not _stands(head, address):
        return LastChange(None, uncommitted=uncommitted, reason="No commit has it yet")
    for at, one in enumerate(found):
        heed()
        version = versions.at(one.commit, one.name)
        if version is None or _sentences(version, head, address):
            continue
        former = found[at + 1].name if at + 1 < len(found) else one.name
        parents = [versions.of_parent(parent, one.name, former) for parent in one.parents]
        changes = [_sentences(parent, version, address) for parent in parents]
        if not all(changes):
            continue
        if at == len(found) - 1 and not one.parents and is_shallow(file):
            return LastChange(None, uncommitted=uncommitted, unread=versions.unread,
                              reason="Not changed since the oldest version here. The clone is "
                                     "shallow, so earlier commits are not known")  # fmt: skip
        told = changes[0] if changes else ("It came with the first version of the file.",)
        lines = _lines(parents[0], address) if parents else ()
        return LastChange(one, told, uncommitted, lines, unread=versions.unread)
    reason = "No commit that changed it was found"
    if len(found) == MOST:
        reason = f"Not changed in the latest {MOST} commits of the file"
    return LastChange(None, uncommitted=uncommitted, reason=reason, unread=versions.unread)


class _Versions:
    """The blueprints of a file in git, each read once."""

    def __init__(self, file: Path) -> None:
        self._file = file
        self._read: dict[tuple[str, str], Blueprint | None] = {}
        self._same: dict[bytes, Blueprint | None] = {}
        self.unread = 0

    def at(self, commit: str, name: str) -> Blueprint | None:
        """Return the blueprint in a commit; None if it has none that can be read."""
        key = commit, name
        if key not in self._read:
            try:
                raw = bytes_of(self._file, commit, name)
            except ReadError:
                self._read[key] = None
                return None
            self._read[key] = self._blueprint(raw, name)
        return self._read[key]

    def of_parent(self, commit: str, name: str, former: str) -> Blueprint:
        """Return the blueprint in a parent, in which the file may have its former name; an empty
        one if it is not there."""
        found = self.at(commit, name) or (self.at(commit, former) if former != name else None)
        return found or read_bytes(b"{}", "nothing.json")

    def _blueprint(self, raw: bytes, name: str) -> Blueprint | None:
        if raw not in self._same:
            try:
                place = self._file.with_name(Path(name).name)
                self._same[raw] = read_bytes(raw, str(place))
            except ReadError:
                self.unread += 1
                self._same[raw] = None
        return self._same[raw]


def _name_now(file: Path) -> str:
    """The name of a file below the folder in which git runs."""
    return f"./{file.name}"


def _sentences(before: Blueprint, after: Blueprint, address: Address) -> tuple[str, ...]:
    """The changes of an element, and of all in it, in sentences."""
    return tuple(one.words for one in compare(before, after).changes if _is_about(one, address))


def _is_about(change: Change, address: Address) -> bool:
    for at in (change.after, change.before):
        if at is None or at.branch != address.branch:
            continue
        if at.path[: len(address.path)] == address.path:
            return True
        # What was added or removed as a whole is one change, of the outermost element.
        whole = change.kind in (ChangeKind.ADDED, ChangeKind.REMOVED)
        outer = change.what in ("branch", "state")
        if whole and outer and address.path[: len(at.path)] == at.path:
            return True
    return False


def _stands(blueprint: Blueprint, address: Address) -> bool:
    branch = blueprint.branches.get(address.branch)
    if branch is None or not address.state:
        return branch is not None
    inside = branch.table.get(address.state)
    return inside is not None and (not address.operation or address.operation in inside)


def _lines(version: Blueprint, address: Address) -> tuple[str, ...]:
    document = version.document
    try:
        member = document.member(address.path)
    except KeyError:
        return ()
    start = document.place_at(min(member.key_start, member.value_start)).line
    end = document.place_at(max(member.value_end - 1, 0)).line
    return tuple(document.text.split("\n")[start - 1 : end])
