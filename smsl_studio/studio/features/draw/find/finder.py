"""Ranks everything that can be found: places, findings, files and commands."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path, PurePath
from typing import NamedTuple, Protocol

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.actions import Action, Actions, key_words
from smsl_studio.studio.base.rows import ListRow
from smsl_studio.studio.base.words import whole_sentence
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.find.haystack import Haystack, Hit
from smsl_studio.studio.features.draw.find.places import PlaceIndex, Target
from smsl_studio.studio.features.draw.panels.findings import Findings

MOST, EACH, KEPT = 40, 10, 6
"""The most rows of places and commands, of findings and files each, and of remembered choices."""
ICONS = {"State Branch": "layers", "State": "dot", "Operation": "arrow", "Fact": "eye",
         "Hazard": "shield"}  # fmt: skip


class FinderWindow(Protocol):
    """The functions of the window that the search needs."""

    def show_fact(self, branch: str, digit: int) -> None:
        """Show a fact of an SB in the properties panel."""

    def show_hazard(self, name: str) -> None:
        """Show a hazard on the page that answers it."""

    def open_file(self, path: Path) -> None:
        """Open a file in this window."""

    @property
    def recent_files(self) -> tuple[Path, ...]:
        """The files that were opened last, the newest first."""


class Choice(NamedTuple):
    """What a row does when it is chosen; ``key`` identifies it among the recent choices."""

    key: str
    go: Callable[[], object]


class Finder:
    """The rows for a typed text, in sections; the section with the best match stands first."""

    def __init__(
        self, session: Session, actions: Actions, findings: Findings, shown: FinderWindow
    ) -> None:
        self._session, self._actions = session, actions
        self._findings, self._shown = findings, shown
        self._places = PlaceIndex()
        self._recent: list[ListRow] = []
        self._told: tuple[Finding, ...] = ()
        self._told_stack = Haystack(())

    def refresh(self) -> None:
        """Take the current blueprint and actions, because the palette opens."""
        self._actions.refresh()
        self._places.show(self._session.blueprint)

    def choose(self, row: ListRow) -> None:
        """Do what the row stands for, and remember it as recent."""
        choice: Choice = row.payload
        kept = [one for one in self._recent if one.payload.key != choice.key]
        self._recent = [row, *kept][:KEPT]
        choice.go()

    def rows(self, typed: str) -> list[ListRow]:
        """The rows that match, in sections.

        For an empty text: the recent choices and all commands.
        """
        if not typed.strip():
            recent = [row for row in self._recent if self._still(row.payload)]
            commands = [_command(action, self._go(action)) for action in self._in_menus()]
            return [*_section("Recent", recent), *_section("Commands", commands, bool(recent))]
        sections = [
            (tier, order, title, rows)
            for order, (title, tier, rows) in enumerate(self._sections(typed))
            if rows
        ]
        sections.sort(key=lambda one: one[:2])
        alone = len(sections) == 1 and sections[0][2] == "Commands"
        return [row for _, _, title, rows in sections for row in _section(title, rows, not alone)]

    def _sections(self, typed: str) -> Iterator[tuple[str, int, list[ListRow]]]:
        places = self._places.find(typed, MOST)
        yield (
            "In this blueprint",
            _tier([hit for hit, _ in places]),
            [self._place(target) for _, target in places],
        )
        actions = [a for a in self._actions if self._actions[a.id].isEnabled() and a.id not in OWN]
        lines = [f"{a.words.rstrip('…')}\t{a.menu}\t{a.also}" for a in actions]
        hits = Haystack(lines).find(typed, MOST)
        yield (
            "Commands",
            _tier(hits),
            [_command(actions[hit.line], self._go(actions[hit.line])) for hit in hits],
        )
        yield self._found_findings(typed)
        yield self._found_files(typed)

    def _found_findings(self, typed: str) -> tuple[str, int, list[ListRow]]:
        findings = self._findings.findings
        if findings is not self._told:
            lines = [f"{one.rule}\t{one.address}\t{one.message}" for one in findings]
            self._told, self._told_stack = findings, Haystack(lines)
        hits = self._told_stack.find(typed, EACH)
        rows = []
        for hit in hits:
            one = findings[hit.line]
            choice = Choice(f"finding {one.rule} {one.address}",
                            partial(self._session.jump, one.address))  # fmt: skip
            rows.append(ListRow(whole_sentence(one), choice, right=one.rule, tip=str(one),
                            severity=one.severity.value, beside=str(one.address)))  # fmt: skip
        return "Findings", _tier(hits), rows

    def _found_files(self, typed: str) -> tuple[str, int, list[ListRow]]:
        """The files of this blueprint, which show their SBs, and the files opened before."""
        session = self._session
        homes: dict[str, str] = {}
        for branch in session.blueprint.branches:
            homes.setdefault(session.blueprint.home(branch).file, branch)
        rows = [
            ListRow(
                PurePath(file).name, Choice(f"file {file}", partial(session.show_branch, branch)),
                "file", right="of this blueprint", tip=file)
            for file, branch in homes.items() if len(homes) > 1
        ]  # fmt: skip
        rows += [
            ListRow(path.name, Choice(f"file {path}", partial(self._shown.open_file, path)), "file",
                right=_near(path), tip=f"Open {path}")
            for path in self._shown.recent_files
        ]  # fmt: skip
        hits = Haystack([f"{row.text}\t{row.tip}" for row in rows]).find(typed, EACH)
        return "Files", _tier(hits), [rows[hit.line] for hit in hits]

    def _place(self, target: Target) -> ListRow:
        there = target.there
        go: Callable[[], object]
        if isinstance(there, Address):
            go, key = partial(self._session.jump, there), f"place {there}"
        elif isinstance(there, tuple):
            go, key = partial(self._shown.show_fact, *there), f"fact {there[0]}/{there[1]}"
        else:
            go, key = partial(self._shown.show_hazard, there), f"hazard {there}"
        return ListRow(target.text, Choice(key, go), ICONS[target.kind], target.title, target.where,
                   tip=f"{target.kind} {key.partition(' ')[2]}")  # fmt: skip

    def _in_menus(self) -> list[Action]:
        return [
            action for action in self._actions
            if action.menu and action.id not in OWN and self._actions[action.id].isEnabled()
        ]  # fmt: skip

    def _go(self, action: Action) -> Callable[[], object]:
        return self._actions[action.id].trigger

    def _still(self, choice: Choice) -> bool:
        """Whether a remembered choice is still possible."""
        kind, _, key = choice.key.partition(" ")
        blueprint = self._session.blueprint
        if kind == "action":
            return self._actions[key].isEnabled()
        if kind == "fact":
            fact = split_fact(key)
            return fact is not None and fact[0] in blueprint.branches
        if kind == "hazard":
            return any(hazard.name == key for hazard in blueprint.hazards)
        if kind == "place":
            return str(_resolved(blueprint, key)) == key
        return kind == "file"


OWN = ("palette",)
"""The action that opens the palette itself; it is not listed."""


def _resolved(blueprint: Blueprint, address: str) -> Address | None:
    try:
        return blueprint.resolve(address)
    except StudioError:
        return None


def _section(title: str, rows: list[ListRow], titled: bool = True) -> list[ListRow]:
    return [*([ListRow(title, kind="section")] if titled and rows else []), *rows]


def _tier(hits: list[Hit]) -> int:
    return min((hit.tier for hit in hits), default=99)


def _command(action: Action, go: Callable[[], object]) -> ListRow:
    keys = key_words(action.keys[0]) if action.keys else ""
    choice = Choice(f"action {action.id}", go)
    return ListRow(action.words.rstrip("…"), choice, action.icon, right=keys, tip=action.hint)


def _near(path: Path) -> str:
    """The end of a file's folder, short enough for one line."""
    parts = path.parent.parts[-2:]
    return "/".join(parts)[-28:]
