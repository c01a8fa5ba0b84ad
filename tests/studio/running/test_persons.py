"""The persons at the window: names, roles and PINs, stored and read again."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.running.persons import SOMEBODY, Person, Persons
from smsl_studio.studio.running.pin import hashed, matches


def test_nobody_has_to_say_who_they_are(tmp_path: Path) -> None:
    persons = Persons(Settings(tmp_path))
    assert persons.all == ()
    assert persons.me == SOMEBODY
    assert persons.me.opens_with("")


def test_persons_are_remembered_and_the_one_who_was_chosen(tmp_path: Path) -> None:
    settings = Settings(tmp_path)
    persons = Persons(settings)
    persons.put(Person("A. Okafor", "surgeon"))
    persons.put(Person("L. Brandt", "supervisor").with_pin("2468"))
    assert persons.me.name == "A. Okafor"
    persons.choose(persons.all[1])
    settings.sync()
    again = Persons(Settings(tmp_path))
    assert [one.words for one in again.all] == ["A. Okafor, surgeon", "L. Brandt, supervisor"]
    assert again.me.name == "L. Brandt"
    assert again.me.opens_with("2468")
    assert not again.me.opens_with("2469")
    assert not again.me.opens_with("")


def test_whoever_is_renamed_stays_the_one_who_commands(tmp_path: Path) -> None:
    persons = Persons(Settings(tmp_path))
    for name in ("A. Okafor", "L. Brandt"):
        persons.put(Person(name))
    persons.choose(persons.all[1])
    persons.put(Person("Lena Brandt", "supervisor"), instead=persons.all[1])
    assert persons.me.words == "Lena Brandt, supervisor"
    persons.remove(persons.me)
    assert persons.me.name == "A. Okafor"


def test_a_pin_is_not_kept_as_it_is_typed() -> None:
    kept = hashed("2468")
    assert "2468" not in kept
    assert matches("2468", kept)
    assert hashed("2468") != kept
    assert not matches("", kept)


def test_a_damaged_hash_opens_nothing() -> None:
    for kept in ("scrypt$00$", "scrypt$zz$00", "plain$00$00", "nothing"):
        assert not Person("A", kept=kept).opens_with("")


def test_damaged_settings_name_no_persons(tmp_path: Path) -> None:
    for text in ("{", "3", '[1, {"role": "x"}]'):
        settings = Settings(tmp_path)
        settings.store_text("people/persons", text)
        assert Persons(settings).all == ()
