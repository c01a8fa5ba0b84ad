"""What the offer to recover counts."""

from __future__ import annotations

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.comparison import compare
from smsl_studio.studio.document.journal.restoration import tallied
from tests.stories.person import sample


def test_groups_and_notes_are_counted_under_their_names() -> None:
    before = sample("hfsm.json")
    grouped = editing.put_groups(before, "SB1", {"1": {"title": "G", "states": ["State000"]}})
    noted = editing.put_notes(
        grouped, "SB1", {str(at): {"text": "hi", "at": [at, 2]} for at in (1, 2)}
    )
    assert tallied(compare(before, grouped)) == "1 group added."
    assert tallied(compare(before, noted)) == "2 notes added, 1 group added."
    assert tallied(compare(noted, before)) == "2 notes removed, 1 group removed."
    other = editing.put_groups(grouped, "SB1", {"1": {"title": "H", "states": ["State000"]}})
    assert tallied(compare(grouped, other)) == "1 group changed."
