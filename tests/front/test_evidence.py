"""Evidence: true runs are believed, forged ones are not, by ``verify.py`` and by Studio alike."""

from __future__ import annotations

import ast
import io
import json
import re
import subprocess
import sys
import zipfile
from collections import Counter
from collections.abc import Iterable, Iterator
from copy import deepcopy
from itertools import product
from pathlib import Path
from random import Random
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.digests import digests
from smsl_studio.front.bundles import bundled
from smsl_studio.front.logs import verify_stream
from smsl_studio.front.verifier import content_texts, told_again, verifier_file
from smsl_studio.runlog.decoder import event_of
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.shipped import samples_dir
from tests.counts import share_of
from tests.front.forged_runs import FORGERIES, Forgery, forged
from tests.front.plain_judge import why_impossible
from tests.front.told_runs import ToldRun, told_runs
from tests.runlog.impossible import OPERATORS, Story, impossible

Json = Any
TRUE = range(48)
"""Of 10,000, which ``benches/forged.py`` has."""
EACH = 20
"""Of 10,000 of each kind."""
ENDS = {"goal_reached", "no_route", "held", "refused", "stopped"}
ORDER_ALONE = {"costs_that_nobody_set", "header_of_other_digits", "route_at_another_cost"}
"""Operators whose stories only the general rules always refuse: costs of routes, and what a header
says of the blueprint, from which the story is not told.
"""


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> list[ToldRun]:
    return told_runs(TRUE, tmp_path_factory.mktemp("told"))


def test_the_checks_are_short_and_need_no_other_package() -> None:
    text = verifier_file().read_text("utf-8")
    lines = text.splitlines()
    assert len(lines) <= 300
    assert max(map(len, lines)) <= 100
    assert len(text.encode()) <= 24_000
    names = {
        alias.name.partition(".")[0]
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Import)
        for alias in node.names
    }
    assert names <= sys.stdlib_module_names


def test_the_checks_can_be_read_aloud() -> None:
    """A function fits a screen. A statement that needs a second line begins its own."""
    text = verifier_file().read_text("utf-8")
    lines, tree = text.splitlines(), list(ast.walk(ast.parse(text)))
    functions = [node for node in tree if isinstance(node, ast.FunctionDef)]
    assert max(node.end_lineno - node.lineno for node in functions if node.end_lineno) < 24
    plain = [node for node in tree if isinstance(node, ast.Assign | ast.Expr | ast.Return)]
    long = [node for node in plain if node.end_lineno != node.lineno]
    assert [node.lineno for node in long if ";" in lines[node.lineno - 1][: node.col_offset]] == []
    dense = [node.lineno for node in plain if sum(1 for _ in ast.walk(node)) > 100]
    assert len(dense) <= 1, f"too much is said at once in lines {dense}"


def test_what_is_not_checked_is_said_and_is_little() -> None:
    tree = ast.parse(verifier_file().read_text("utf-8"))
    (said,) = [
        ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "NOT_CHECKED"
    ]
    assert said == ("reception over MQTT or from measures", "costs of routes")


def test_true_runs_of_every_end_are_believed(runs: list[ToldRun]) -> None:
    refused = [(n, told_again(*run)) for n, run in enumerate(runs) if told_again(*run)]
    assert refused == []
    assert {Story.of(run.raw).end["reason"] for run in runs} >= ENDS
    doubted = [why_impossible(Story.of(run.raw), run.blueprint) for run in runs]
    assert not any(doubted), "the plain judge believes them too"


@pytest.mark.parametrize("number", [4259, 8984])
def test_a_digit_is_read_again_where_its_crossing_commits(number: int, tmp_path: Path) -> None:
    """An edge with ``load`` takes two levels along, and a fault keeps the lowest back."""
    (run,) = told_runs(range(number, number + 1), tmp_path)
    assert b'"result":"false"' in run.raw
    assert verify_stream(io.BytesIO(run.raw), "log", run.blueprint).doubt is None
    assert told_again(*run) == ""


def test_an_edge_that_follows_its_subs_calls_no_function(tmp_path: Path) -> None:
    (run,) = told_runs(range(226, 227), tmp_path)
    story = Story.of(run.raw)
    assert told_again(*run) == ""
    silent = [e for e in story.events if e["event"] == "operation_started" and not e["function"]]
    silent[0]["function"] = "table.set_facts"
    assert "operation_started" in told_again(story.raw(), run.blueprint)


@pytest.mark.parametrize("forgery", FORGERIES, ids=lambda one: one.__name__)
def test_a_forged_run_that_is_impossible_is_refused(forgery: Forgery, runs: list[ToldRun]) -> None:
    seen = Counter[str]()
    for number, run in enumerate(runs):
        changed = forged(Story.of(run.raw), forgery, Random(f"{number} {forgery.__name__}"))
        if changed is None or seen.total() >= EACH:
            continue
        why = why_impossible(changed, run.blueprint)
        refusal = told_again(changed.raw(), run.blueprint)
        assert refusal or not why, (number, why)
        seen["refused" if refusal else "possible"] += 1
    assert seen["refused"]


@pytest.mark.parametrize(
    ("kind", "member"),
    [("route_planned", "operations"), ("mismatch", "facts"), ("committed", "operations")],
)
def test_a_list_that_is_no_list_is_refused_by_both(
    kind: str, member: str, runs: list[ToldRun]
) -> None:
    told = ((Story.of(run.raw), run) for run in runs)
    story, run = next((story, run) for story, run in told if story.at(kind))
    story.events[story.at(kind)[0]][member] = None
    raw = story.raw()
    assert told_again(raw, run.blueprint)
    assert verify_stream(io.BytesIO(raw), "log", run.blueprint).doubt is not None


ANYTHING: tuple[Json, ...] = (
    5, 0, 1.5, -1, None, True, False, "x", "", [], {}, [1], [None], ["x"], [[]], [{}], {"a": 1},
    {"a": "b"}, {"a": None}, 2**60, -(2**70), 1e300, 3.0,
)  # fmt: skip


def _places(value: Json, path: tuple[Json, ...] = ()) -> Iterator[tuple[Json, ...]]:
    """The places of all values inside of a value."""
    inside: Iterable[tuple[Json, Json]] = ()
    if isinstance(value, dict):
        inside = value.items()
    elif isinstance(value, list):
        inside = enumerate(value)
    for key, one in inside:
        yield (*path, key)
        yield from _places(one, (*path, key))


def _with_anything(told: Json, random: Random) -> Json:
    """An event or a header, in which one value is another one of any type."""
    changed = deepcopy(told)
    *way, last = random.choice(list(_places(changed)))
    around = changed
    for key in way:
        around = around[key]
    around[last] = deepcopy(random.choice(ANYTHING))
    return changed


def test_any_type_in_any_place_is_judged_alike_and_refused_where_it_is_wrong(
    runs: list[ToldRun],
) -> None:
    wrong, count = 0, share_of(240)
    for number in range(count):
        random, run = Random(f"any type {number}"), runs[number % len(runs)]
        story = Story.of(run.raw)
        at = random.randrange(-1, len(story.events)) if number % 4 == 0 else -2
        if at == -1:
            story.header = _with_anything(story.header, random)
        else:
            at = random.randrange(len(story.events))
            story.events[at] = _with_anything(story.events[at], random)
        raw = story.raw()
        why = told_again(raw, run.blueprint)
        verdict = verify_stream(io.BytesIO(raw), "log", run.blueprint)
        assert (verdict.doubt is None) == (not why), (number, why, verdict.doubt)
        if at >= 0 and not _is_event(story.events[at]):
            wrong += 1
            assert why.startswith(f"line {at + 2}: "), (number, why)
            assert verdict.doubt is not None
            assert verdict.doubt.place.line == at + 2, (number, verdict.doubt)
    assert wrong > count // 4


@pytest.mark.parametrize("version", [3.0, True, "3", [3], None, 4])
def test_only_one_version_is_believed(version: Json, runs: list[ToldRun]) -> None:
    """A version of another type is another version, for both."""
    story, run = Story.of(runs[0].raw), runs[0]
    story.header["version"] = version
    assert told_again(story.raw(), run.blueprint)
    assert verify_stream(io.BytesIO(story.raw()), "log", run.blueprint).doubt is not None


def _is_event(values: Json) -> bool:
    try:
        event_of(values)
    except ValueError:
        return False
    return True


@pytest.mark.parametrize("operator", OPERATORS, ids=lambda one: one.__name__)
def test_an_impossible_story_is_refused_here_too(operator: object, runs: list[ToldRun]) -> None:
    name = getattr(operator, "__name__", "")
    refused = 0
    for number, run in enumerate(runs):
        changed = impossible(Story.of(run.raw), operator, Random(f"{number} {name}"))  # type: ignore[arg-type]
        if changed is None or refused >= 3:
            continue
        if name not in ORDER_ALONE:
            assert told_again(changed.raw(), run.blueprint), (number, name)
        refused += 1


def test_a_command_without_a_value_says_none(runs: list[ToldRun]) -> None:
    tried = 0
    for story, run in ((Story.of(run.raw), run) for run in runs):
        for at in story.at("commanded")[:1]:
            word = story.events[at]["command"]
            story.events[at]["value"] += "x"
            if word not in ("full_map", "set_cost", "set_automatic"):
                assert told_again(story.raw(), run.blueprint), word
                tried += 1
    assert tried


@pytest.mark.parametrize("answer", ["go_on", "veto", "prune", "pause"])
def test_an_operation_begins_only_if_the_answer_lets_it(answer: str, tmp_path: Path) -> None:
    blueprint = smsl.read(samples_dir() / "hanoi-2.json")
    smsl.run(blueprint, log=tmp_path / "run.jsonl")
    story = Story.of((tmp_path / "run.jsonl").read_bytes())
    at = story.at("operation_started")[0]
    task = {"t": story.events[at]["t"], "task": "task-1"}
    who = {"by": "Ada", "role": "", "refused": ""}
    options = ["go_on", "veto", "prune", "pause"]
    asked = {"kind": "supervise", "address": story.events[at]["address"], "question": "?"}
    story.events[at:at] = [
        {"event": "task_opened", **task, **asked, "options": options, "role": "", "persons": 1,
         "deadline": task["t"] + 120.0},
        {"event": "commanded", "t": task["t"], "command": "answer", "by": "Ada", "address": "",
         "value": "task-1", "reason": "", "refused": ""},
        {"event": "task_answered", **task, **who},
        {"event": "task_closed", **task, "outcome": "answered", "answer": answer,
         "answers": {"Ada": answer}},
    ]  # fmt: skip
    assert bool(told_again(story.raw(), blueprint)) == (answer != "go_on")


def test_sub_sbs_that_many_share_do_not_make_it_endless(tmp_path: Path) -> None:
    """Each of 20 levels has two SBs below each of its two: 2^20 ways lead to the lowest."""
    values: dict[str, Json] = {}
    for level, name in product(range(20), "AB"):
        subs = {f"A{level + 1}": 0, f"B{level + 1}": 1} if level < 19 else {}
        header = {"INITIAL": "S00", "ACTIVATING": "S11", "NUM_FACTS": 2, "SUB_SBS": subs}
        values[f"{name}{level}"] = {"HEADER": header, "S00": {"go": "S11"}, "S11": {"back": "S00"}}
    (tmp_path / "deep.json").write_text(json.dumps(values))
    blueprint = smsl.read(tmp_path / "deep.json")
    smsl.run(blueprint, log=tmp_path / "run.jsonl")
    story, texts = Story.of((tmp_path / "run.jsonl").read_bytes()), content_texts(blueprint)
    whole = json.loads(texts["behaviour"]) + json.loads(texts["brought"])
    start = dict.fromkeys(values, "S00")
    goals = ["A0/S11", "B0/S11"]
    leaves = list(product(("A19", "B19"), (0, 1)))
    checked = {"address": "A0/S00", "result": "true", "misses": [], "unknown": []}
    digest = sha256_hex(json.dumps(whole, separators=(",", ":")).encode())
    story.events[:] = [
        {"event": "run_started", "t": 0.0, "world": "table", "seed": 0, "start": start,
         "goals": goals, "behaviour": digest, "sensed": [f"{b}/{n}" for b, n in leaves]},
        *({"event": "fact_changed", "t": 0.0, "branch": b, "digit": n, "value": "0", "reason": ""}
          for b, n in leaves),
        {"event": "state_checked", "t": 0.0, **checked},
    ]  # fmt: skip
    assert "state_checked" in told_again(story.raw(), blueprint)


def test_a_command_has_a_text_for_its_value(runs: list[ToldRun]) -> None:
    for story, run in ((Story.of(run.raw), run) for run in runs):
        for at in story.at("commanded", command="resume")[:1]:
            story.events[at]["value"] = None
            assert "commanded" in told_again(story.raw(), run.blueprint)
            return
    raise AssertionError("no run has this command")


def test_what_somebody_ends_is_over_at_that_time(runs: list[ToldRun]) -> None:
    """And nothing may go on later. An end in the last moment is possible."""
    tried = 0
    for story, run in ((Story.of(run.raw), run) for run in runs):
        late = [n for n, one in enumerate(story.events[:-1]) if one["t"] < story.end["t"]]
        for at in [n for n in story.at("committed") if n in late][:1]:
            silent = {"address": "", "value": "", "reason": "", "refused": ""}
            ends = {"event": "commanded", "t": story.events[at]["t"], "command": "end", "by": "Ada"}
            story.events.insert(at + 1, {**ends, **silent})
            assert told_again(story.raw(), run.blueprint)
            tried += 1
    assert tried


@pytest.mark.parametrize("named", ["State_0", "SB/999999", "", "nowhere/0", "/"])
def test_what_is_sensed_are_facts_of_the_blueprint(named: str, runs: list[ToldRun]) -> None:
    told = ((Story.of(run.raw), run.blueprint) for run in runs)
    story, blueprint = next(one for one in told if one[0].at("run_started"))
    story.events[story.at("run_started")[0]]["sensed"].append(named)
    assert told_again(story.raw(), blueprint)


@pytest.mark.parametrize("effect", ["disturbed", "fault_injected"])
def test_what_is_disturbed_is_what_was_commanded(effect: str, runs: list[ToldRun]) -> None:
    tried = 0
    for story, run in ((Story.of(run.raw), run) for run in runs):
        for at in story.at(effect)[:1]:
            story.events[at]["kind" if effect == "disturbed" else "fault"] += "x"
            assert told_again(story.raw(), run.blueprint)
            tried += 1
    assert tried


def test_content_is_what_the_digests_are_made_of() -> None:
    for file in sorted(samples_dir().glob("*.json")):
        blueprint = smsl.read(file)
        texts = content_texts(blueprint)
        known = digests(blueprint).as_json()
        assert {name: sha256_hex(texts[name]) for name in known} == known


def test_a_blueprint_with_imports_is_told_again(tmp_path: Path) -> None:
    base, sub = _imported(tmp_path)
    smsl.run(smsl.read(base), log=tmp_path / "run.jsonl")
    raw = (tmp_path / "run.jsonl").read_bytes()
    assert told_again(raw, smsl.read(base)) == ""
    assert told_again(raw, smsl.read(sub)) == "its blueprint is not here"
    folder = _unpacked(tmp_path, bundled(smsl.read(base), "out.zip", [str(tmp_path / "run.jsonl")]))
    assert _checked(folder)[0] == 0
    assert sorted(path.name for path in (folder / "content").glob("*")) == ["base.json", "sub.json"]


def test_equal_input_gives_equal_bytes(tmp_path: Path) -> None:
    blueprint = smsl.read(samples_dir() / "registration.json")
    smsl.run(blueprint, log=tmp_path / "run.jsonl")
    logs = [str(tmp_path / "run.jsonl")]
    assert bundled(blueprint, "one.zip", logs) == bundled(blueprint, "two.zip", logs)


def test_a_bundle_is_checked_by_a_bare_python(tmp_path: Path) -> None:
    file = samples_dir() / "registration.json"
    blueprint = smsl.read(file)
    smsl.run(blueprint, log=tmp_path / "run.jsonl")
    folder = _unpacked(tmp_path, bundled(blueprint, "out.zip", [str(tmp_path / "run.jsonl")]))
    assert (folder / "blueprint/registration.json").read_bytes() == file.read_bytes()
    assert (folder / "logs/run.jsonl").read_bytes() == (tmp_path / "run.jsonl").read_bytes()
    assert (folder / "verify.py").read_bytes() == verifier_file().read_bytes()
    assert "report.html   the blueprint in sentences" in (folder / "README.txt").read_text()
    page = (folder / "report.html").read_text("utf-8")
    day = json.loads((tmp_path / "run.jsonl").read_bytes().splitlines()[0])["wall_time"][:10]
    assert f"registration.json, read on {day}." in page
    _every_function_is_explained((folder / "README.txt").read_text())
    status, said = _checked(folder)
    assert status == 0
    assert "No record: nobody has approved this blueprint." in said
    (folder / "blueprint/registration.json").write_bytes(file.read_bytes() + b" ")
    status, said = _checked(folder)
    assert status == 1
    assert "logs/run.jsonl: its blueprint is not here" in said
    (folder / "blueprint/registration.json").write_bytes(file.read_bytes())
    assert _checked(folder)[0] == 0
    (folder / "report.html").write_text(page.replace("registration", "calibration"))
    assert "report.html: it does not follow" in _checked(folder)[1]


def test_the_report_of_a_bundle_has_no_day_that_nothing_in_the_bundle_tells(
    tmp_path: Path,
) -> None:
    (tmp_path / "odd.jsonl").write_bytes(b'{"wall_time": "<script>x"}\n')
    for logs in ([], [str(tmp_path / "odd.jsonl")]):
        raw = bundled(smsl.read(samples_dir() / "hanoi-2.json"), "out.zip", logs)
        page = (_unpacked(tmp_path / f"{len(logs)}", raw) / "report.html").read_text("utf-8")
        assert '<p class="about">hanoi-2.json. Not a medical device.</p>' in page
        assert "Made by SMSL Studio from hanoi-2.json. " in page
        assert "script" not in page


def _every_function_is_explained(readme: str) -> None:
    tree = ast.parse(verifier_file().read_text("utf-8"))
    names = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    told = {name for name in names if not name.startswith("on_")}
    assert {name for name in told if not re.search(rf"\b{name}\b", readme)} == set()


def test_a_bundle_without_a_log_says_so(tmp_path: Path) -> None:
    folder = _unpacked(tmp_path, bundled(smsl.read(samples_dir() / "hfsm.json"), "out.zip"))
    status, said = _checked(folder)
    assert status == 0
    assert "No log" in said
    assert "No policy: one signature counts." in said


HOSTILE = (
    b"", b"\0", b"{", b"[]", b"null", b"[" * 100_000, b'{"a":' * 50_000, b"1" * 9_999,
    b'{"log":"smsl-run","version":3,"digests":{}}', b'{"a":NaN}', b"\xff\xfe\n\n\n", b'"x"\n' * 9,
)  # fmt: skip


@pytest.mark.parametrize("content", HOSTILE, ids=range(len(HOSTILE)))
def test_no_file_makes_it_fail(content: bytes, tmp_path: Path) -> None:
    """It says why, in a line, whatever a file holds."""
    blueprint = smsl.read(samples_dir() / "hfsm.json")
    smsl.run(blueprint, log=tmp_path / "run.jsonl")
    raw = bundled(blueprint, "out.zip", [str(tmp_path / "run.jsonl")])
    parts = [f"content/hfsm.json/{name}.json" for name in ("behaviour", "meaning", "closure")]
    for number, name in enumerate(["logs/run.jsonl", *parts]):
        folder = _unpacked(tmp_path / str(number), raw)
        (folder / name).write_bytes(content)
        status, said = _checked(folder)
        assert status == 1, (name, said)
        assert "Traceback" not in said


def _imported(folder: Path) -> tuple[Path, Path]:
    base, sub = folder / "base.json", folder / "sub.json"
    base.write_text(
        '{"_imports": ["sub.json"], "BASE": {"HEADER": {"INITIAL": "State_00", "ACTIVATING": '
        '"State_11", "NUM_FACTS": 2, "SUB_SBS": {"SUB": 1}}, "State_00": {"up": "State_01"}, '
        '"State_01": {"go": "State_11"}, "State_11": {}}}'
    )
    sub.write_text('{"SUB": {"State_0": {"turn": "State_1"}, "State_1": {"back": "State_0"}}}')
    return base, sub


def _unpacked(folder: Path, raw: bytes) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "out.zip").write_bytes(raw)
    with zipfile.ZipFile(folder / "out.zip") as archive:
        archive.extractall(folder / "evidence")
    return folder / "evidence"


def _checked(folder: Path) -> tuple[int, str]:
    """Call it as people do: a bare Python in the folder, with no package of this environment."""
    done = subprocess.run(
        [sys.executable, "-S", "-I", "verify.py"], cwd=folder, capture_output=True, check=False
    )
    return done.returncode, (done.stdout + done.stderr).decode()
