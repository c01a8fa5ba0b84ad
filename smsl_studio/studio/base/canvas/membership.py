"""Membership: which groups gain or lose states while these are dragged."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.drawn_parts import Members
from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.canvas.sheet import Sheet

Flags = NDArray[np.bool_]


class Membership:
    """Compares dragged states with the frames of the groups as they lay when the drag began.

    A state gets into a group when its centre comes into the frame. It leaves its own group when no
    part of its node is in the frame any more. A group whose states are all dragged goes with them.
    """

    def __init__(self, sheet: Sheet, states: list[int]) -> None:
        """``states`` has the numbers of the dragged states."""
        drawn = sheet.drawn
        self._sheet, self._keys = sheet, drawn.parts.group_keys
        self._titles = [group.title for group in drawn.parts.groups]
        self._before: Members = drawn.parts.members
        self._frames: Floats = drawn.group_rects.copy()
        dragged = np.array(states, dtype=np.intp)
        self._open = np.array([not np.isin(own, dragged).all() for own in self._before], dtype=bool)
        """Whether a group can gain and lose states."""
        own = np.full(len(sheet.at), -1, dtype=np.intp)
        for number, members in enumerate(self._before):
            own[members] = number
        stuck = np.isin(own, np.flatnonzero(~self._open))
        self._free = dragged[~stuck[dragged]] if self._open.any() else dragged[:0]
        """The dragged states that can get into a group, or leave theirs."""
        self._own = own[self._free]

    def now(self) -> Members:
        """The states of each group, where the dragged states stand now."""
        free, own = self._free, self._own
        if not len(free):
            return self._before
        at, half = self._sheet.at[free][:, None], self._sheet.halves()[free][:, None]
        low, high = self._frames[:, :2], self._frames[:, 2:]
        inside: Flags = np.all((at >= low) & (at <= high), axis=2) & self._open
        touched: Flags = np.all((at + half >= low) & (at - half <= high), axis=2)
        rows, any_ = np.arange(len(free)), inside.any(axis=1)
        stays = (own >= 0) & (inside[rows, own] | (touched[rows, own] & ~any_))
        topmost = inside.shape[1] - 1 - inside[:, ::-1].argmax(axis=1)
        goal = np.where(stays, own, np.where(any_, topmost, -1))
        moved = np.flatnonzero(goal != own)
        goes, goal = free[moved], goal[moved]
        return tuple(
            np.concatenate([members[~np.isin(members, goes)], goes[goal == number]])
            for number, members in enumerate(self._before)
        )

    def changes(self, now: Members) -> dict[str, tuple[str, ...]]:
        """The names of the states in the groups that gain or lose some, by the key of the group.

        Groups that only lose states come first. A state that gets into a group leaves its other
        groups by that edit.
        """
        names = self._sheet.picture.names
        found = [
            (bool(len(np.setdiff1d(after, before))), key, tuple(names[state] for state in after))
            for key, before, after in zip(self._keys, self._before, now, strict=True)
            if len(np.setxor1d(before, after))
        ]
        return {key: states for _, key, states in sorted(found)}

    def words(self, now: Members) -> str:
        """The words about a drop, such as "State110 out of One fact missing". They are empty if the
        drop changes no group.
        """
        said: list[str] = []
        for title, before, after in zip(self._titles, self._before, now, strict=True):
            come, gone = np.setdiff1d(after, before), np.setdiff1d(before, after)
            said += [f"{self._named(come)} into {title}"] if len(come) else []
            said += [f"{self._named(gone)} out of {title}"] if len(gone) else []
        return ", ".join(said)

    def _named(self, states: NDArray[np.intp]) -> str:
        names = self._sheet.picture.names
        return names[states[0]] if len(states) == 1 else f"{len(states)} states"
