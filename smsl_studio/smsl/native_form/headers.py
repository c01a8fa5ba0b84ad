"""Gives a header line another key or value."""

from __future__ import annotations

from typing import Any

from smsl_studio.smsl.document.arrangement import permuted, survivors
from smsl_studio.smsl.document.likeness import same
from smsl_studio.smsl.json_form.splice import spliced_value
from smsl_studio.smsl.native_form.lines import entries
from smsl_studio.smsl.native_form.rows import Slot
from smsl_studio.smsl.native_form.spellings import header_key, header_value
from smsl_studio.smsl.native_form.tokens import spelled

Json = Any


def respelled_header(slot: Slot, text: str, branch: str, key: str, old: Json, new: Json) -> None:
    """Give the header line in a slot the key ``key`` and the value ``new``. It had the value
    ``old``.
    """
    line = slot.element
    assert line is not None
    renamed = key != slot.key
    if not renamed and same(old, new):
        return
    start = text[line.start : line.key_start] + header_key(key) if renamed else ""
    start += text[line.key_end if renamed else line.start : line.value_start]
    written = text[line.value_start : line.value_end]
    fresh = header_value(branch, key, new)
    if not renamed and written[:1] == fresh[:1] == "(":
        fresh = _spliced_map(written, old, new) or fresh
    elif not renamed and written[:1] == fresh[:1] and fresh[:1] in ("{", "["):
        fresh = spliced_value(written, old, new)
    slot.text = start + fresh
    slot.commas = ""  # After a text without quotes a comma would be a part of the text.
    if slot.comment and not slot.comment[0].isspace():
        slot.comment = f" {slot.comment}"


def _spliced_map(written: str, old: dict[str, int], new: dict[str, int]) -> str | None:
    """Return a map in round brackets with only the differences changed.

    None if entries are removed, reordered or doubled, or if new ones are not at the end.
    """
    members = list(entries(written, 0))
    kept = survivors(old, new)
    keys = [kept[member.key] for member in members if member.key in kept]
    if len(members) != len(old) or len(keys) != len(old) or keys != list(new)[: len(keys)]:
        return None
    if permuted(keys, new) != list(range(len(keys))):
        return None
    pieces: list[str] = []
    at = 0
    for member, key in zip(members, keys, strict=True):
        name = written[member.key_start : member.key_end] if key == member.key else spelled(key)
        pieces += (written[at : member.key_start], name)
        pieces += (written[member.key_end : member.value_start], str(new[key]))
        at = member.value_end
    for key in list(new)[len(keys) :]:
        pieces.append(f"{', ' if keys else ''}{spelled(key)}: {new[key]}")
        keys.append(key)
    behind = written[at:] if members else ")"
    return "".join(["" if members else "(", *pieces, behind])
