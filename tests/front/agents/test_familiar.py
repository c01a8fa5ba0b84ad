"""The supervisor ``familiar``: it asks about durations and measures that no recorded run has."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from smsl_studio import front
from smsl_studio.errors import UsageError
from smsl_studio.front.agents.known_edges import known_edges
from smsl_studio.front.runs import Run

PLUGIN = """
class Clamp:
    force = 0.5

def register(library):
    @library.world("clamp", engine="table", settle=0.1)
    def build(world, blueprint, seed): return Clamp()

    @library.sensor("force_{unit}", unit="N")
    def force(clamp, unit: str): return clamp.force

    @library.operation("Close")
    def close(clamp):
        for _ in range(%d):
            yield
        clamp.force = %s
        yield

    @library.operation("Pull")
    def pull(clamp):
        clamp.force = -5.0
        yield
"""
DRAWN = {
    "SB": {
        "_facts": {
            "0": {
                "sources": {"force_a": "N"},
                "predicate": {
                    "0": "force_a > -1 N and force_a < 1 N",
                    "1": "force_a > 2 N",
                    "2": "force_a < -2 N",
                },
            }
        },
        "State_0": {"Close": "State_1"},
        "State_1": {"Pull": "State_2"},
        "State_2": {},
    }
}
USUAL = (10, "4.0")


def run(folder: Path, waits: int, force: str, supervisor: str = "", log: str = "") -> Run:
    # A folder for each text: Python takes a file of the same length and second for unchanged.
    plugins = folder / f"{waits} {force}"
    plugin = plugins / "clamp"
    plugin.mkdir(parents=True, exist_ok=True)
    (plugin / "plugin.toml").write_text('name = "clamp"\n', encoding="utf-8")
    (plugin / "plugin.py").write_text(PLUGIN % (waits, force), encoding="utf-8")
    file = folder / "clamp.json"
    file.write_text(json.dumps(DRAWN), encoding="utf-8")
    (folder / "known").mkdir(exist_ok=True)
    return front.run(
        front.read(file),
        "clamp",
        plugin_paths=[plugins],
        host="local",
        log=folder / "known" / log if log else None,
        supervisor=supervisor or None,
    )


@pytest.mark.parametrize(
    ("waits", "force", "words"),
    [
        (*USUAL, ""),
        (11, "4.5", ""),
        (20, "4.0", "SB/State_0/Close took 1.1 s; in 1 recorded run it took 0.6 s"),
        (2, "4.0", "SB/State_0/Close took 0.2 s; in 1 recorded run it took 0.6 s"),
        (10, "6.5", "SB/0/force_a measures 6.5; in 1 recorded run it measured -5 to 4"),
    ],
)
def test_it_asks_about_what_no_recorded_run_has(
    tmp_path: Path, waits: int, force: str, words: str
) -> None:
    assert run(tmp_path, *USUAL, log="usual.jsonl").reason == "goal_reached"
    done = run(tmp_path, waits, force, f"familiar:folder={tmp_path / 'known'}")
    assert (done.reason == "held") is bool(words), done.sentence
    assert words in done.sentence


def test_the_slack_can_be_wider(tmp_path: Path) -> None:
    run(tmp_path, *USUAL, log="usual.jsonl")
    asked = f"familiar:folder={tmp_path / 'known'},slack=1"
    assert run(tmp_path, 19, "6.5", asked).reason == "goal_reached"
    with pytest.raises(UsageError, match="a slack of -1 is not from 0 to 100"):
        run(tmp_path, *USUAL, asked.replace("slack=1", "slack=-1"))


def test_two_runs_make_a_range(tmp_path: Path) -> None:
    run(tmp_path, *USUAL, log="usual.jsonl")
    run(tmp_path, 20, "8.0", log="slow.jsonl")
    known = known_edges(str(tmp_path / "known"))
    assert known.runs == 2
    assert str(known.durations["SB/State_0/Close"]) == "0.6 to 1.1"
    assert [str(one) for one in known.measures["SB/0/force_a"]] == ["-5 to 8"]
