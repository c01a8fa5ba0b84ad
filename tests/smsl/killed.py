"""Kills a saving process with kill -9 many times, and prints what is read afterwards as JSON.

It is a program of its own, because it forks: ``python -m tests.smsl.killed FOLDER HOW SEED``. HOW
is a number of kills at random moments, ``steps`` for one kill at every step of a save, or ``grid``
for every step of finishing each of those as well.
"""

from __future__ import annotations

import json
import os
import random
import select
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

from smsl_studio.home import saving_folder
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.json_form import parse_json, write_json
from smsl_studio.smsl.together import save_together
from smsl_studio.smsl.unfinished import FRESH, finish_saves

TEXTS = {
    letter: write_json({"SB": {f"State{n}": {"o": letter * 40} for n in range(size)}})
    for letter, size in (("a", 300), ("b", 2000))
}


STEPS = {"open", "os.rename", "os.remove", "os.link", "os.chmod"}


def targets(folder: Path, count: int) -> list[Path]:
    """So many files, the last in a folder of its own."""
    (folder / "parts").mkdir(exist_ok=True)
    files = [folder / f"{n}.json" for n in range(count - 1)]
    return [*files, folder / "parts" / "last.json"]


def save(files: list[Path], letter: str) -> None:
    document = parse_json(TEXTS[letter], "x.json")
    save_together([(document, path) for path in files])


def letter_in(text: str) -> str:
    """Which of the texts this is; the empty text for anything else."""
    return next((letter for letter, whole in TEXTS.items() if whole == text), "")


def kill_after(seconds: float, files: list[Path]) -> None:
    """Save in a child again and again, and kill it after so many seconds."""
    child = os.fork()
    if child == 0:
        while True:
            for letter in "ba":
                save(files, letter)
    select.select([], [], [], seconds)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)


def killed_at(step: int, work: Callable[[], object]) -> bool:
    """Do ``work`` in a child that dies at this step (a call that changes the disk, or opens a
    file), so that every moment between two steps has its turn; False where it has ended before.
    """
    child = os.fork()
    if child == 0:
        left = [step]

        def count(event: str, _: object) -> None:
            if event in STEPS:
                left[0] -= 1
                if left[0] == 0:
                    os.kill(os.getpid(), signal.SIGKILL)

        sys.addaudithook(count)
        work()
        os._exit(0)
    return os.WIFSIGNALED(os.waitpid(child, 0)[1])


@dataclass
class Counts:
    """What came of the kills; everything but the first two has to be 0."""

    kills: int = 0
    unfinished: int = 0
    """So often some files held the new bytes already, others the old ones."""
    mixtures: int = 0
    changed_by_finishing: int = 0
    left: int = 0

    def look(self, files: list[Path], finish: bool) -> None:
        """Read the files as Studio does, perhaps bring their save to its end, and look again."""
        self.kills += 1
        read = {letter_in(read_document(path).text) for path in files}
        self.mixtures += len(read) != 1 or "" in read
        self.unfinished += len({path.read_bytes() for path in files}) > 1
        if finish:
            finish_all(files)
            stand = {letter_in(path.read_text("utf-8")) for path in files}
            self.changed_by_finishing += stand != read
            self.left += sum(len(left_in(path.parent)) for path in files)
            self.left += len(records_left())


def finish_all(files: list[Path]) -> None:
    for folder in {path.parent for path in files}:
        finish_saves(folder)


def left_in(folder: Path) -> list[str]:
    """What stands in a folder besides files; one that a save of one file has left may."""
    hidden = [path.name for path in folder.iterdir() if path.name.startswith(".")]
    return [name for name in hidden if "-" in name or not name.endswith(".part")]


def records_left() -> list[str]:
    """The records of saves that stand; one that was being written may stand for an hour."""
    return [one.name for one in saving_folder().iterdir() if one.suffix != FRESH]


def at_random(folder: Path, kills: int, seed: int) -> Counts:
    """Kill so many times, at one file and at three in turns, at moments drawn by chance."""
    chance, counts = random.Random(seed), Counts()
    for number in range(kills):
        files = targets(folder, 1 if number % 4 == 0 else 3)
        save(files, "a")
        begun = time.monotonic()
        save(files, "b")
        kill_after(chance.uniform(0, 2.2) * (time.monotonic() - begun), files)
        counts.look(files, chance.random() < 0.5)
    return counts


def at_every_step(folder: Path, every: bool) -> Counts:
    """Kill at each step of saving three files, then at a step of finishing it: one, or every."""
    counts, files = Counts(), targets(folder, 3)
    # What is loaded when it is first needed is loaded now: steps are counted by opened files.
    for letter in "ba":
        save(files, letter)
    saving = finishing = 1
    while killed_at(saving, partial(save, files, "b")):
        counts.look(files, finish=False)
        again = killed_at(finishing if every else saving % 9 + 1, partial(finish_all, files))
        counts.look(files, finish=True)
        save(files, "a")
        finishing = finishing + 1 if again and every else 1
        saving += finishing == 1
    return counts


if __name__ == "__main__":
    place, kind, seed = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
    if kind in ("steps", "grid"):
        counts = at_every_step(place, kind == "grid")
    else:
        counts = at_random(place, int(kind), seed)
    print(json.dumps(asdict(counts)))
