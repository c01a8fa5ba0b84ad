"""The smallest replacements that turn one text into another."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.studio.features.draw.source.patches import patches

TEXTS = st.text(st.sampled_from('ab\n{}"é𝛼'), max_size=60)


def patched(old: str, new: str) -> str:
    text = old
    for start, end, part in patches(old, new):
        text = text[:start] + part + text[end:]
    return text


@given(TEXTS, TEXTS)
def test_patches_turn_one_text_into_the_other(old: str, new: str) -> None:
    assert patched(old, new) == new


def test_only_the_lines_that_differ_are_patched() -> None:
    old = "\n".join(f"line {n}" for n in range(1000))
    new = old.replace("line 7\n", "other\n").replace("line 900\n", "another\n")
    assert sum(len(part) for _, _, part in patches(old, new)) < 20
    assert patched(old, new) == new
