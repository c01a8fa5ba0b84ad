"""A recording is a foreign file: a false one is shown as not verified, and does no harm."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QMainWindow

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.inputs import read
from smsl_studio.picture.account import account
from smsl_studio.runlog.events import (
    Commanded,
    Committed,
    Event,
    FactChanged,
    Held,
    Mismatch,
    OperationPruned,
    OperationRisky,
    OperationStarted,
    Relocalised,
    RoutePlanned,
    RunFinished,
    RunStarted,
    StateChecked,
    TaskOpened,
)
from smsl_studio.shipped import samples_dir
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.replay.playback import ReplayVerbs
from tests.runlog.logs import chained

START = RunStarted(t=0.0, world="table", seed=0, start={"SB1": "State_aa"}, goals=("a/b/c/d", ""))
ODD = ("", "/", "a/b/c/d", "~~", "SB1/State_aa/Op_1b/more", "\u202e\x1b[2J", "x" * 5000)
STORIES: tuple[tuple[Event, ...], ...] = (
    tuple(OperationStarted(t=0.1, address=one, target=one, function=one) for one in ODD),
    (Committed(t=0.1, operations=ODD, configuration=dict.fromkeys(ODD, "y")),),
    tuple(OperationRisky(t=0.1, address=one, reason=one) for one in ODD),
    tuple(OperationPruned(t=0.1, address=one, reason=one) for one in ODD),
    tuple(StateChecked(t=0.1, address=one, result=one) for one in ODD),
    (RoutePlanned(t=0.1, goal="a/b/c/d", operations=ODD, cost=-9e15),),
    tuple(FactChanged(t=0.1, branch=one, digit=-7, value=one) for one in ODD),
    (FactChanged(t=0.1, branch="SB1", digit=10**15, value=None, reason="x" * 5000),),
    tuple(FactChanged(t=9e15 * n / 9, branch="SB1", digit=0, value=str(n)) for n in range(9)),
    tuple(FactChanged(t=-9e15 + n, branch="SB1", digit=0, value=str(n)) for n in range(9)),
    (Relocalised(t=0.1, configuration={"SB1": "Elsewhere", "": ""}),),
    (Mismatch(t=0.1, facts=ODD, candidates=({}, {"": ""}, {"SB1": "x" * 5000})),),
    tuple(Commanded(t=0.1, command=one, by=one, address=one, value=one) for one in ODD),
    (TaskOpened(t=0.1, task="", kind="fact", address="a/b/c/d", question="", options=(), role="",
                persons=-3, deadline=-9e15),),
    (Held(t=0.1, reason="", kind="bored"), RunFinished(t=0.1, reason="bored", sentence="",
     operations=-(10**15), configuration={"": ""})),
    (START, START, RunFinished(t=0.0, reason="held", sentence="", operations=0, configuration={})),
)  # fmt: skip


def _written(path: Path, events: Sequence[Event]) -> None:
    lines = [one.line().encode("utf-8", "backslashreplace") for one in events]
    path.write_bytes(chained([b'{"log":"smsl-run","version":2}', *lines]))


@pytest.fixture(scope="module")
def replaying(
    qapp: QApplication, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[ReplayVerbs]:
    drawn = read(samples_dir() / "hanoi-2.json")
    window = QMainWindow()
    made = ReplayVerbs(lambda: drawn, tmp_path_factory.mktemp("recordings"), LIGHT, window)
    window.setCentralWidget(made.pane)
    window.resize(1000, 700)
    window.show()
    yield made
    made.stop()
    window.close()


@pytest.mark.parametrize("story", STORIES)
def test_an_impossible_recording_is_shown_and_not_verified(
    story: tuple[Event, ...], replaying: ReplayVerbs, qapp: QApplication, tmp_path: Path
) -> None:
    path = tmp_path / "run.jsonl"
    _written(path, (START, *story))
    replaying.open(path)
    recording = replaying.replay.recording
    assert recording is not None
    assert recording.path == path
    assert recording.doubt.startswith("the story is impossible: ")
    for index in range(len(story) + 2):
        replaying.replay.to_index(index)
    qapp.processEvents()
    replaying.pane.grab()
    assert "Not verified" in account(recording.run, COMMANDS)
