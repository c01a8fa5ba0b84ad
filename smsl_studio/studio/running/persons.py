"""The people who work at this window, with the names and roles that the record of a run has.

The first person added commands, until another one is chosen; the choice is remembered. Nobody must
give a name. The record then says "a person".
"""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass, replace

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.person_names import same_name
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.running.pin import SHORTEST, hashed, matches

PERSONS, ME = "people/persons", "people/me"


@dataclass(frozen=True)
class Person:
    """One person. ``role`` may be empty. ``kept`` is the hash of a PIN, empty without one."""

    name: str
    role: str = ""
    kept: str = ""

    @property
    def has_pin(self) -> bool:
        """Whether the person must enter a PIN."""
        return bool(self.kept)

    def opens_with(self, pin: str) -> bool:
        """Whether this person may answer: the PIN is right, or none is needed."""
        return not self.kept or (len(pin) >= SHORTEST and matches(pin, self.kept))

    def with_pin(self, pin: str) -> Person:
        """The same person with this PIN; empty removes the PIN."""
        return replace(self, kept=hashed(pin) if pin else "")

    @property
    def words(self) -> str:
        """Name and role, such as ``L. Brandt, surgeon``."""
        return f"{self.name}, {self.role}" if self.role else self.name


SOMEBODY = Person("a person")


class Persons(QObject):
    """The people of this account, in the order they were added; no two have the same name."""

    changed = Signal()

    def __init__(self, settings: Settings) -> None:
        super().__init__()
        self._settings = settings
        self._all = _read(settings.text_of(PERSONS))

    @property
    def all(self) -> tuple[Person, ...]:
        """All people, in the order they were added."""
        return self._all

    @property
    def me(self) -> Person:
        """The person who commands a run from this window."""
        return self.named(self._settings.text_of(ME)) or next(iter(self._all), SOMEBODY)

    def author(self) -> str:
        """The name under which this person writes, or else that of the system's user."""
        return _user_name() if self.me == SOMEBODY else self.me.name

    def named(self, name: str) -> Person | None:
        """The person of this name, in any spelling (see ``same_name``); None if there is none."""
        wanted = same_name(name)
        return next((one for one in self._all if wanted and same_name(one.name) == wanted), None)

    def choose(self, person: Person) -> None:
        """Make this the person who commands."""
        self._settings.store_text(ME, person.name)
        self.changed.emit()

    def put(self, person: Person, instead: Person | None = None) -> None:
        """Add a person, or replace another one."""
        mine = instead is not None and instead == self.me
        if instead in self._all:
            self._all = tuple(person if one == instead else one for one in self._all)
        else:
            self._all = (*self._all, person)
        self._write()
        if mine:
            self._settings.store_text(ME, person.name)
        self.changed.emit()

    def remove(self, person: Person) -> None:
        """Remove a person, also from the settings."""
        self._all = tuple(one for one in self._all if one != person)
        self._write()
        self.changed.emit()

    def _write(self) -> None:
        self._settings.store_text(PERSONS, json.dumps([asdict(one) for one in self._all]))


def _user_name() -> str:
    """The name of the system's user, the full one if it is known; empty if there is none."""
    try:
        import pwd

        user = pwd.getpwuid(os.getuid())
    except (ImportError, KeyError):
        return os.environ.get("USERNAME", "")
    return user.pw_gecos.partition(",")[0].strip() or user.pw_name


def _read(text: str) -> tuple[Person, ...]:
    """The people in a stored text. Entries that do not fit are left out."""
    try:
        found = json.loads(text or "[]")
    except ValueError:
        return ()
    rows = [one for one in found if isinstance(one, dict)] if isinstance(found, list) else []
    persons = (
        Person(*(str(row.get(word, "")) for word in ("name", "role", "kept"))) for row in rows
    )
    return tuple(person for person in persons if person.name.strip())
