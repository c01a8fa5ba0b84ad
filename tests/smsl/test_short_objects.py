"""A short object of the notes is written as a whole, with the same text as member by member."""

from __future__ import annotations

import json
from random import Random
from typing import Any

import pytest

from smsl_studio.smsl.json_form import parse_json
from smsl_studio.smsl.json_form.containers import Splicer
from smsl_studio.smsl.splice import reconcile
from tests.counts import share_of

LAYOUTS: list[dict[str, Any]] = [{}, {"separators": (",", ":")}, {"indent": 1}, {"indent": 4}]


def _facts(random: Random) -> dict[str, str]:
    names = random.sample(["A/0", "A/1", "B/0", "B/1", "C", "plain name"], random.randrange(5))
    return {name: random.choice("01x") for name in names}


def _hazard(random: Random, number: int) -> dict[str, Any]:
    found: dict[str, Any] = {"name": f"h{number}", "facts": _facts(random)}
    if random.random() < 0.3:
        found["why"] = random.choice(["", "é “x”", "a\nb"])
    return dict(random.sample(list(found.items()), len(found)))


def _changed(random: Random, old: list[dict[str, Any]]) -> list[dict[str, Any]]:
    new = [json.loads(json.dumps(one)) for one in old]
    for one in new:
        if random.random() < 0.7:
            one["facts"] = _facts(random)
        if random.random() < 0.2:
            one["name"] += "b"
        if random.random() < 0.1:
            one["weight"] = random.choice([1, 1.5, True, None, [], [1, {"a": {}}], {}])
    if random.random() < 0.3:
        del new[random.randrange(len(new))]
    return new


@pytest.mark.parametrize("seed", range(share_of(60)))
def test_the_text_is_that_of_one_member_after_the_other(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    random = Random(seed)
    old = [_hazard(random, number) for number in range(random.randrange(1, 6))]
    values = {"_hazards": old, "B": {"S0": {"go": "S1"}, "S1": {}}}
    text = json.dumps(values, ensure_ascii=False, **random.choice(LAYOUTS))
    if random.random() < 0.4:
        text = text.replace(": ", " :  ", random.randrange(4))
    document = parse_json(text, "f.json")
    wanted = {**document.values, "_hazards": _changed(random, old)}
    whole = reconcile(document, wanted)
    monkeypatch.setattr("smsl_studio.smsl.json_form.containers.SHORT", 0)
    one_by_one = reconcile(document, wanted)
    assert whole.text == one_by_one.text
    assert whole.values == wanted
    assert json.loads(whole.text) == wanted


def test_many_hazards_are_not_taken_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    taken: list[int] = []
    before = Splicer.container

    def container(self: Splicer, *given: Any) -> Any:
        """Count, then do it."""
        taken.append(1)
        return before(self, *given)

    monkeypatch.setattr(Splicer, "container", container)
    old = [{"name": f"h{n}", "facts": {"A/0": "1"}} for n in range(500)]
    document = parse_json(json.dumps({"_hazards": old}), "f.json")
    reconcile(document, {"_hazards": [{**one, "facts": {"A/1": "1"}} for one in old]})
    assert len(taken) < 10
