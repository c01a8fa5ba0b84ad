"""A program that is lost, late or lying: the run holds with the reason, and nothing begins."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.channel.frames import Frame, frame_bytes
from smsl_studio.front import read
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.seal.strict_json import base64_text
from smsl_studio.shipped import samples_dir
from tests.approval import PASSPHRASE, make_keys_cheap, written_policy
from tests.channel.programs import Lie, driven, end_of, honest, program
from tests.counts import share_of

HANOI = samples_dir() / "hanoi-2.json"
GOAL = "SB1/State_cc"
Change = Callable[[Frame], object]


def at_third(verb: str, change: Change) -> Lie:
    """Lie from the third answer to a verb on. A change that returns bytes sends them as they are;
    None means that the changed frame is sent."""
    seen = []

    def lie(asked: str, answer: Frame) -> bytes | None:
        seen.extend([asked] if asked == verb else [])
        if asked != verb or len(seen) < 3:
            return honest(asked, answer)
        changed = copy.deepcopy(answer)
        said = change(changed)
        return said if isinstance(said, bytes) else frame_bytes(changed)

    return lie


def sample(**said: Any) -> Change:
    """Change the first sample."""

    def change(answer: Frame) -> None:
        answer["samples"][0].update(said)

    return change


LIES: dict[str, tuple[Change, str]] = {
    "a wrong time": (lambda a: a.update(time=9.0), "the time is 9.0 s, and it should be"),
    "no number": (lambda a: a.update(time="0.1"), "time is '0.1', not a number"),
    "nan": (
        lambda a: frame_bytes({**a, "time": 0.0}).replace(b'"time":0.0', b'"time":NaN'),
        "NaN is no number",
    ),
    "an unknown outcome": (lambda a: a.update(outcome="done"), "outcome is 'done', not one of"),
    "a sample from the future": (sample(time=99.0), "comes from the future"),
    "a value of another fact": (sample(value="z"), "reads 'z', which is no value of SB1/0"),
    "a sensor that there is not": (sample(sensor="eye"), "'eye' of 'SB1/0' was not offered"),
    "a fact that there is not": (sample(fact="SB9/0"), "of 'SB9/0' was not offered"),
    "a flag for a value": (sample(value=True), "value is True, not a text"),
    "half a surrogate": (sample(value="\ud800"), "not a text of at most"),
    "a negative sequence": (sample(sequence=-1), "sequence is -1, not a count"),
    "a number for the quality": (sample(quality=7), "quality is 7, not one of"),
    "samples that are no list": (lambda a: a.update(samples={}), "not a list of at most"),
    "a million samples": (lambda a: a.update(samples=[{}] * 20_001), "not a list of at most"),
    "the answer to another question": (lambda a: a.update(n=1), "it answered another question"),
    "another verb": (lambda a: a.update(answer="sense"), "it answered something else than tick"),
    "a refusal": (lambda a: a.update(answer="refused", sentence="no"), "it refused tick"),
    "a list": (lambda a: b"\0\0\0\2[]", "a frame that is no JSON object"),
    "depth": (lambda a: b"\0\0\x60\0" + b"[" * 0x6000, "a frame that is no JSON"),
    "no text": (lambda a: b"\0\0\0\2\xff\xff", "a frame that is no JSON"),
    "a key twice": (lambda a: b'\0\0\0\x0d{"n":1,"n":2}', "a key stands twice"),
    "an endless frame": (lambda a: b"\xff\xff\xff\xff", "a frame of 4,294,967,295 bytes"),
    "an empty frame": (lambda a: b"\0\0\0\0", "a frame of 0 bytes"),
    "half a frame, then the end": (lambda a: b"", "the connection was closed"),
}  # fmt: skip


@pytest.mark.parametrize("lie", LIES)
def test_what_cannot_be_true_ends_the_run(lie: str, tmp_path: Path) -> None:
    change, words = LIES[lie]
    blueprint = read(HANOI)
    with program(blueprint, tmp_path, at_third("tick", change)) as running:
        reason, held = end_of(driven(blueprint, tmp_path, GOAL, stop_limit=0.2, answer_limit=2.0))
    assert reason == "failed"
    assert words in held
    assert held.startswith("the program at unix:p is lost: ")
    # It was stopped first, and nothing else was said to it but goodbye.
    asked = running.heard[running.heard.index("tick") :]
    assert [verb for verb in asked if verb not in ("tick", "begin", "sense")] in (
        ["stop", "close"],
        ["stop"],
        ["close"],
        [],
    )
    assert "begin" not in asked[[i for i, verb in enumerate(asked) if verb == "tick"][2] :]


def test_an_operation_ends_that_has_not_begun(tmp_path: Path) -> None:
    blueprint = read(HANOI)

    def lie(verb: str, answer: Frame) -> bytes | None:
        if answer.get("outcome") == "idle":
            answer["outcome"] = "returned"
        return honest(verb, answer)

    with program(blueprint, tmp_path, lie):
        reason, held = end_of(driven(blueprint, tmp_path, GOAL))
    assert reason == "failed"
    assert "an operation is returned, and none has begun" in held
    assert held.endswith("It acknowledged a stop")


def test_an_operation_that_has_begun_does_nothing(tmp_path: Path) -> None:
    blueprint = read(HANOI)

    def lie(verb: str, answer: Frame) -> bytes | None:
        if "outcome" in answer:
            answer["outcome"] = "idle"
        return honest(verb, answer)

    with program(blueprint, tmp_path, lie):
        reason, held = end_of(driven(blueprint, tmp_path, GOAL))
    assert reason == "failed"
    assert "it does nothing, and an operation has begun" in held


def test_a_doubled_answer_ends_the_run(tmp_path: Path) -> None:
    blueprint = read(HANOI)

    def lie(verb: str, answer: Frame) -> bytes | None:
        said = honest(verb, answer)
        return said and said * (2 if verb == "begin" else 1)

    with program(blueprint, tmp_path, lie) as running:
        reason, held = end_of(driven(blueprint, tmp_path, GOAL))
    assert reason == "failed"
    assert "it said something that nobody asked" in held
    assert running.heard.count("begin") == 1


@pytest.mark.parametrize(
    ("stops", "words"),
    [(True, "It acknowledged a stop"), (False, "so it may still move")],
)
def test_a_program_that_hangs_is_stopped_and_told(stops: bool, words: str, tmp_path: Path) -> None:
    blueprint = read(HANOI)

    def lie(verb: str, answer: Frame) -> bytes | None:
        if verb == "tick" or (verb == "stop" and not stops):
            return None
        return honest(verb, answer)

    with program(blueprint, tmp_path, lie) as running:
        limits = {"answer_limit": 0.2, "stop_limit": 2.0 if stops else 0.1}
        reason, held = end_of(driven(blueprint, tmp_path, GOAL, **limits))
    assert reason == "failed"
    assert "it did not answer for 0.2 s" in held
    assert held.endswith(words)
    assert running.heard[-2:] == ["stop", "close"]


def test_a_program_that_drips_is_late(tmp_path: Path) -> None:
    blueprint = read(HANOI)

    def lie(verb: str, answer: Frame) -> bytes | None:
        said = honest(verb, answer)
        return said[:9] if said and verb == "tick" else said

    with program(blueprint, tmp_path, lie):
        limits = {"answer_limit": 0.2, "stop_limit": 0.1}
        reason, held = end_of(driven(blueprint, tmp_path, GOAL, **limits))
    assert (reason, "it did not answer for 0.2 s" in held) == ("failed", True)


@pytest.mark.parametrize(
    ("verb", "said", "words"),
    [
        ("hello", {"version": 2}, "version is 2, not 1"),
        ("hello", {"session": None}, "session is None, not a text"),
        ("hello", {"hardware": "no"}, "hardware is 'no', not true or false"),
        ("open", {"tick": 0}, "tick is 0, not a number from"),
        ("open", {"tick": -1.0}, "tick is -1.0, not a number from"),
        ("open", {"sensors": [{"name": "a\nb", "fact": "SB1/0"}]}, "not a name of one line"),
        ("open", {"operations": [{"function": "f", "stop": "never"}]}, "stop is 'never'"),
        ("open", {"operations": [3]}, "operations has 3, not an object"),
    ],
)
def test_a_wrong_offer_begins_nothing(verb: str, said: Frame, words: str, tmp_path: Path) -> None:
    blueprint = read(HANOI)

    def lie(asked: str, answer: Frame) -> bytes | None:
        return honest(asked, {**answer, **said} if asked == verb else answer)

    with program(blueprint, tmp_path, lie) as running:
        reason, held = end_of(driven(blueprint, tmp_path, GOAL))
    assert reason == "failed"
    assert words in held
    assert "begin" not in running.heard


def test_what_does_not_fit_the_blueprint_is_not_bound(tmp_path: Path) -> None:
    blueprint = read(HANOI)

    def lie(verb: str, answer: Frame) -> bytes | None:
        if verb == "open":
            answer["operations"].append({"function": "g", "serves": ["Op_9z", "SB1/x/y"]})
            answer["operations"][0]["touches"] = ["SB7/1"]
            answer["sensors"] += [{"name": "eye", "fact": "SB7/1"}]
            answer["sensors"] += [{"name": "scale", "fact": "SB1/0", "unit": "kg"}]
        if "samples" in answer:
            answer["samples"].append({**answer["samples"][0], "sensor": "eye", "fact": "SB7/1"})
        return honest(verb, answer)

    with program(blueprint, tmp_path, lie):
        assert end_of(driven(blueprint, tmp_path, GOAL))[0] == "goal_reached"


def written_register(folder: Path) -> str:
    """A register with Ada in it, and the lines of a policy that name it."""
    words = PASSPHRASE.encode()
    head = smsl.make_key("Head of quality", "quality", words, "head")
    (ada,) = (one for one in smsl.list_keys() if one.id == "ada")
    person = {"person": "Ada", "roles": ["engineer"], "keys": [base64_text(ada.public)]}
    listed = folder / "list.json"
    listed.write_text(json.dumps({"version": 1, "serial": 1, "persons": [person]}), "utf-8")
    smsl.sign_register(listed, "head", words, folder / "persons.json")
    return f'register = "persons.json"\nregister_key = "{base64_text(head.public)}"'


def hardware(verb: str, answer: Frame) -> bytes | None:
    return honest(verb, {**answer, "hardware": True} if verb == "hello" else answer)


def test_hardware_is_not_opened_without_a_policy(tmp_path: Path) -> None:
    blueprint = read(HANOI)
    with program(blueprint, tmp_path, hardware) as running:
        events = driven(blueprint, tmp_path, GOAL)
    (finished,) = events
    assert isinstance(finished, RunFinished)
    assert finished.reason == "refused"
    assert [one["code"] for one in finished.refusals] == ["policy_unmet"]
    assert running.heard == ["hello", "close"]


@pytest.mark.parametrize("registered", [False, True])
def test_hardware_runs_with_a_policy_that_names_a_register(
    registered: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_keys_cheap(monkeypatch)
    words = PASSPHRASE.encode()
    file = tmp_path / "hanoi.json"
    file.write_bytes(HANOI.read_bytes())
    smsl.make_key("Ada Lovelace", "engineer", words, "ada")
    blueprint = read(file)
    smsl.approve(smsl.ApprovalRequest(blueprint, "ada", words))
    more = written_register(tmp_path) if registered else ""
    policy = written_policy(tmp_path, f"roles = {{ engineer = 1 }}\n{more}")
    with program(blueprint, tmp_path, hardware) as running:
        done = smsl.run(blueprint, "remote", GOAL, address=f"unix:{tmp_path / 'p'}", policy=policy)
    assert done.reason == ("goal_reached" if registered else "refused"), done.sentence
    finished = done.events[-1]
    assert isinstance(finished, RunFinished)
    assert [one["code"] for one in finished.refusals] == (
        [] if registered else ["register_invalid"]
    )
    assert ("begin" in running.heard) == registered


def test_a_stop_goes_first_and_is_acknowledged(tmp_path: Path) -> None:
    blueprint = read(HANOI)
    events: list[Event] = []

    def lie(verb: str, answer: Frame) -> bytes | None:
        return None if verb == "tick" else honest(verb, answer)

    with program(blueprint, tmp_path, lie) as running:
        done = smsl.run(
            blueprint,
            "remote",
            GOAL,
            address=f"unix:{tmp_path / 'p'}",
            on_event=events.append,
            stop_when=lambda: "tick" in running.heard,
        )
    assert done.reason == "stopped"
    assert "it was stopped before it had answered. It acknowledged a stop" in done.sentence
    assert running.heard[-2:] == ["stop", "close"]


ODD: list[Any] = [None, True, -1, 0, 3, 1e308, -0.5, "", "idle", "returned", "a", "h", [], {}, [[]],
                  "\ud800", "\x1b[2J", 2**70, "x" * 3000]  # fmt: skip


def spoilt(chance: Random, answer: Frame) -> Frame:
    """An answer with odd values at some of its keys, also within its lists."""
    for _ in range(chance.randrange(1, 4)):
        place = answer
        inner = [one for key in answer if isinstance(answer[key], list) for one in answer[key]]
        if inner and chance.random() < 0.5:
            place = chance.choice(inner)
        if isinstance(place, dict) and place:
            key = chance.choice(sorted(place))
            if chance.random() < 0.2:
                del place[key]
            else:
                place[key] = copy.deepcopy(chance.choice(ODD))
    return answer


def test_random_answers_are_believed_or_end_the_run(tmp_path: Path) -> None:
    blueprint = read(HANOI)
    ends = set()
    for seed in range(share_of(300)):
        chance = Random(seed)

        def lie(verb: str, answer: Frame, chance: Random = chance) -> bytes | None:
            spoils = verb not in ("stop", "hello") and chance.random() < 0.2
            return frame_bytes(spoilt(chance, answer) if spoils else answer)

        with program(blueprint, tmp_path, lie):
            # An odd time limit or period may let a run end as any run may.
            ends.add(end_of(driven(blueprint, tmp_path, GOAL))[0])
    assert "failed" in ends
    assert ends <= {"failed", "goal_reached", "held", "refused", "no_route"}
