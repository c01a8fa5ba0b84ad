"""Two people answer on two machines: every answer is kept, by person and time."""

from __future__ import annotations

from collections import Counter
from random import Random

from smsl_studio.inspection.review.review import Review
from smsl_studio.inspection.review.review_file import read_review, written_review
from tests.inspection.review.answers import (
    LINES,
    plain_approvers,
    plain_merge,
    plain_name,
    plain_open,
    random_entries,
)

SOME = 60


def test_a_merge_keeps_all_answers_of_all_people_whoever_merges_first() -> None:
    met: Counter[str] = Counter()
    for number in range(SOME):
        chance = Random(number)
        entries = random_entries(chance, chance.randrange(1, 14))
        # What both had before, and what each machine adds.
        at = chance.randrange(len(entries) + 1)
        shared, rest = entries[:at], entries[at:]
        mine = shared + [one for one in rest if chance.random() < 0.6]
        theirs = shared + [one for one in rest if one not in mine or chance.random() < 0.2]
        one, two = Review.of(mine), Review.of(theirs)
        whole = one.merged(two)
        assert list(whole.entries) == plain_merge(mine, theirs)
        assert two.merged(one) == whole
        assert whole.merged(one, two, whole) == whole
        assert written_review(two.merged(one)) == written_review(whole)
        for line in LINES:
            said = {plain_name(entry.person) for entry in whole.approvals(line)}
            assert said == plain_approvers(list(whole.entries), line)
            met["approved"] += len(said)
        left = {comment.entry.id for comment in whole.open_comments}
        assert left == plain_open(list(whole.entries))
        met["open"] += len(left)
        met["closed"] += len(whole.comments) - len(left)
    assert min(met["approved"], met["open"], met["closed"]) > 10, met


def test_a_review_that_was_written_is_read_again_to_the_same_bytes() -> None:
    for number in range(20):
        entries = random_entries(Random(number), 9)
        review = Review.of(entries)
        raw = written_review(review)
        assert read_review(raw, "a.review.json") == review
        assert written_review(read_review(raw, "a.review.json")) == raw
