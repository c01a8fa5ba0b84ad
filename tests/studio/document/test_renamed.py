"""The address of a selected element after an edit, found quickly for many elements."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import add_state, delete, rename
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.document.renamed import now_named
from tests.plugin_folder import LAMP, blueprint_of

STATE, OPERATION = Address("LAMP", "State_0"), Address("LAMP", "State_0", "Op_on")


def test_renamed_elements_are_found_and_deleted_ones_keep_their_address() -> None:
    before = blueprint_of(LAMP)
    after = rename(before, STATE, "State_2")
    assert now_named(before, after, STATE) == Address("LAMP", "State_2")
    assert now_named(before, after, OPERATION) == Address("LAMP", "State_2", "Op_on")
    after = rename(before, OPERATION, "Op_up")
    assert now_named(before, after, OPERATION) == Address("LAMP", "State_0", "Op_up")
    assert now_named(before, delete(before, [STATE]), STATE) == STATE


class Walked(dict[str, Mapping[str, str]]):
    """A table that counts how often somebody walks through all of it."""

    walks = 0

    def __iter__(self) -> Iterator[str]:
        self.walks += 1
        return super().__iter__()


def test_an_existing_element_is_found_without_searching_its_state_branch() -> None:
    before = blueprint_of(LAMP)
    after = add_state(before, "LAMP", "State_9")
    tables = []

    def walked(blueprint: Blueprint) -> Blueprint:
        branch = blueprint["LAMP"]
        tables.append(Walked({name: dict(row) for name, row in branch.table.items()}))
        return replace(blueprint, branches={"LAMP": replace(branch, table=tables[-1])})

    old, new = walked(before), walked(after)
    for table in tables:
        table.walks = 0
    assert now_named(old, new, STATE) == STATE
    assert [table.walks for table in tables] == [0, 0]
