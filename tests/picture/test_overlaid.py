"""The picture of a merge: everything that one version has, with the marks of who changed it."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.merge import merge
from smsl_studio.blueprint.merge.choice import Side
from smsl_studio.blueprint.merge.columns import aligned_lines, lines_of
from smsl_studio.blueprint.merge.sides import MergeSides, merged_groups, sides_of_entries
from smsl_studio.picture.overlaid import overlaid
from tests.blueprint.merge.test_merge import BASE, changed
from tests.blueprint.values import read

ALL: tuple[Side, ...] = ("ours", "theirs", "base")
OURS = changed(("A|S0|go", "S2"), ("A|S3", {"home": "S0"}), ("A|S2|back", "S0"))
THEIRS = changed(("A|S0|go", None), ("A|_states|S2|title", "last"), ("A|S2|back", "S0"))


def sides() -> MergeSides:
    return MergeSides(read(OURS), read(THEIRS), read(BASE))


def test_an_operation_that_leads_elsewhere_has_a_line_for_each_version() -> None:
    done = merge(read(BASE), read(OURS), read(THEIRS))
    picture = overlaid(done.blueprint, sides(), "A", ALL)
    go = Address("A", "S0", "go")
    mine, base = Address("A", "S0", "go to S2"), Address("A", "S0", "go to S1")
    assert picture.shown(go) == (mine, base)
    assert picture.true_address(base) == go
    assert picture.signs[mine] == "M~"
    assert picture.signs[base] == "T-"
    assert picture.signs[Address("A", "S3")] == "M+"
    assert picture.signs[Address("A", "S2")] == "T~"
    assert picture.signs[Address("A", "S2", "back to S0")] == "MT~"
    assert Address("A", "S1") not in picture.signs
    assert set(picture.places) == {"S0", "S1", "S2", "S3"}


def test_the_result_alone_has_no_marks() -> None:
    done = merge(read(BASE), read(OURS), read(THEIRS))
    picture = overlaid(done.blueprint, sides(), "A", ())
    assert picture.signs == {}
    assert picture.blueprint["A"].table["S0"] == {"go": "S2", "wait": "S0"}


def test_entries_alone_tell_the_conflicts_and_nothing_else() -> None:
    done = merge(read(BASE), read(OURS), read(THEIRS))
    told = sides_of_entries(done.blueprint)
    assert not told.known
    assert "go" not in told.theirs["A"].table["S0"]
    assert told.base is not None
    assert told.base["A"].table["S0"]["go"] == "S1"
    assert "S3" in told.theirs["A"].table, "it is no conflict, so nobody knows who added it"
    assert merged_groups(told, done.conflicts) == ()


def test_what_merged_by_itself_is_grouped_by_side_and_kind() -> None:
    done = merge(read(BASE), read(OURS), read(THEIRS))
    groups = merged_groups(sides(), done.conflicts)
    told = [(one.side, one.sign, [str(c.address) for c in one.changes]) for one in groups]
    assert ("M", "+", ["A/S3"]) in told
    assert ("MT", "~", ["A/S2/back"]) in told
    assert ("T", "~", ["A/S2"]) in told
    assert not any("A/S0/go" in addresses for _, _, addresses in told)


def test_lines_stand_beside_their_like_and_missing_ones_are_none() -> None:
    path = ("A", "S0", "go")
    columns = [lines_of(one, path, True) for one in (read(OURS), read(THEIRS), read(BASE))]
    rows = aligned_lines(columns)
    texts = [[line.text.strip() if line else None for line in row] for row in rows]
    assert ['"go": "S2",', None, '"go": "S1",'] in texts
    assert ['"wait": "S0"'] * 3 in texts
    assert rows[0][0] is not None
    assert rows[0][0].number > 1
    assert lines_of(read(BASE), ("A", "Nowhere", "go"), True) == ()
    anew = lines_of(read(OURS), path, False)
    assert [(one.number, one.text.strip()) for one in anew][1] == (0, '"go": "S2",')
