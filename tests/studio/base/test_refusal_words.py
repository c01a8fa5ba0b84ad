"""A refusal in words: a sentence and an advice, with one full stop each."""

from __future__ import annotations

import pytest

from smsl_studio.errors import EditRefused
from smsl_studio.studio.base.words import refusal_words


@pytest.mark.parametrize(
    ("sentence", "advice", "words"),
    [
        (
            "it needs 3 disks, this has 2",
            "Use another.",
            "It needs 3 disks, this has 2. Use another.",
        ),
        (
            "it needs 3 disks, this has 2.",
            "Use another.",
            "It needs 3 disks, this has 2. Use another.",
        ),
        ("is it there?", "", "Is it there?"),
    ],
)
def test_sentence_and_advice_have_one_full_stop_each(
    sentence: str, advice: str, words: str
) -> None:
    assert refusal_words(EditRefused(sentence, advice=advice)) == words
