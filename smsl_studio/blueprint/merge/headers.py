"""The merge of headers: by what they say, also where they leave it to the default.

INITIAL is the first state by default, and ACTIVATING the last one. A state that one side adds at
the end can so become the goal. The merged header says INITIAL or ACTIVATING where the default would
be another state than the merge gives.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping
from typing import Any

from smsl_studio.blueprint.merge.conflict import ABSENT, Conflict, Path
from smsl_studio.blueprint.merge.trees import Trees
from smsl_studio.blueprint.merge.values import Merger
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import HEADER, sub_entries

Json = Any
ENDS = ("INITIAL", "ACTIVATING")
SUBS, COUNT = "SUB_SBS", "NUM_STATES"


def take_out(trees: Trees, branch: str) -> tuple[dict[str, Json], dict[str, Json], dict[str, Json]]:
    """Remove the keys from the headers of an SB that are merged by what they say, and return them
    for each version. SUB_SBS becomes a map if no sub-SB is named twice."""
    taken: tuple[dict[str, Json], dict[str, Json], dict[str, Json]] = {}, {}, {}
    for at, own in enumerate(taken):
        for key in (*ENDS, COUNT):
            value = trees.get(at, (branch, HEADER, key))
            if value is not ABSENT:
                own[key] = value
                trees.put(at, (branch, HEADER, key), ABSENT)
        subs = trees.now(at, (branch, HEADER, SUBS))
        entries = (
            [(sub, digit) for _, sub, digit in sub_entries(subs)]
            if isinstance(subs, dict | list)
            else []
        )
        if isinstance(subs, list) and len(dict(entries)) == len(entries):
            trees.put(at, (branch, HEADER, SUBS), dict(entries))
    return taken


class HeaderMerger:
    """Merges INITIAL, ACTIVATING, NUM_STATES and the digits of SUB_SBS of merged SBs.

    ``versions`` are the three blueprints. ``clashing`` has the paths of the elements that one side
    deleted and the other one changed.
    """

    def __init__(
        self, versions: Iterable[Blueprint], merger: Merger, clashing: frozenset[Path]
    ) -> None:
        self._versions = tuple(versions)
        self._merger, self._clashing = merger, clashing

    def finish(
        self, branch: str, values: dict[str, Json], taken: tuple[Mapping[str, Json], ...]
    ) -> None:
        """Complete the header of a merged SB (``values``) with what was taken out of it."""
        states = [key for key in values if key != HEADER and not key.startswith("_")]
        header = values.get(HEADER)
        found: dict[str, Json] = {}
        for key, default in zip(ENDS, (states[:1], states[-1:]), strict=True):
            written = [version[key] for version in taken[1:] if key in version]
            wanted = self._end(branch, key)
            # A name that is no state was written by hand, and stays for the check to report.
            if written or [wanted] != default:
                found[key] = wanted
        if any(COUNT in version for version in taken[1:]):
            found[COUNT] = self._count(branch, taken, len(states))
        found = {key: value for key, value in found.items() if value not in (ABSENT, "")}
        self._keep_digits_single(branch, header)
        if not found:
            return
        if not isinstance(header, dict):
            rest = dict(values)
            values.clear()
            values[HEADER] = header = {}
            values.update({key: value for key, value in rest.items() if key != HEADER})
        rest = {key: value for key, value in header.items() if key not in found}
        header.clear()
        header.update({**found, **rest})

    def _end(self, branch: str, key: str) -> Json:
        """Return the merged INITIAL or ACTIVATING."""
        path = (branch, HEADER, key)
        said = []
        for version in self._versions:
            own = version.branches.get(branch)
            said.append(ABSENT if own is None else getattr(own, key.lower()))
        base, ours, theirs = said
        if (branch,) in self._clashing:
            return ours  # the whole SB is one conflict, and is kept as ours has it
        conflicts = len(self._merger.conflicts)
        wanted = self._merger.merged(path, base, ours, theirs)
        is_new = len(self._merger.conflicts) == conflicts and wanted != base
        if is_new and (branch, str(wanted)) in self._clashing:
            # One side deleted the state that the other side made an end.
            self._merger.conflicts.append(Conflict(path, base, ours, theirs))
            wanted = ours
        return wanted

    def _count(self, branch: str, taken: tuple[Mapping[str, Json], ...], states: int) -> Json:
        """Return the merged NUM_STATES: the number of states, unless one side counted wrongly."""
        for version, own in zip(self._versions, taken, strict=True):
            found = version.branches.get(branch)
            if COUNT in own and found is not None and own[COUNT] != len(found.table):
                said = [one.get(COUNT, ABSENT) for one in taken]
                return self._merger.merged((branch, HEADER, COUNT), *said)
        return states

    def _keep_digits_single(self, branch: str, header: Json) -> None:
        """Take back a sub-SB of theirs on a digit on which ours has another one."""
        subs = header.get(SUBS) if isinstance(header, dict) else None
        if not isinstance(subs, dict):
            return
        mine, other = (self._digits(version, branch) for version in self._versions[1:])
        before = self._digits(self._versions[0], branch)
        on_digit: dict[Hashable, dict[str, None]] = {}
        for sub, digit in subs.items():
            on_digit.setdefault(_key(digit), {})[sub] = None
        theirs = Counter(_key(digit) for sub, digit in subs.items() if sub in other)
        for sub, digit in list(subs.items()):
            key = _key(digit)
            if sub in mine or len(on_digit[key]) == 1 or theirs[key] > (sub in other):
                continue
            rivals = [one for one in on_digit[key] if one != sub]
            path = (branch, HEADER, SUBS, sub)
            self._merger.conflicts.append(
                Conflict(path, before.get(sub, ABSENT), ABSENT, other.get(sub, ABSENT))
            )
            for rival in rivals:
                self._merger.conflicts.append(
                    Conflict((*path[:-1], rival), before.get(rival, ABSENT), digit, ABSENT)
                )
            del subs[sub], on_digit[key][sub]
            theirs[key] -= sub in other

    @staticmethod
    def _digits(version: Blueprint, branch: str) -> dict[str, int]:
        found = version.branches.get(branch)
        return dict(found.header.sub_sbs) if found else {}


def _key(digit: Json) -> Hashable:
    """Return a digit as it can be looked up. What was written there may be any value."""
    return digit if isinstance(digit, Hashable) else repr(digit)
