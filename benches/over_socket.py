"""Generated C++ drives Hanoi in Studio's physics over a socket: ``serve`` and the built program.

Each seed is a run in a new world; its log is verified. Then the program is killed in the middle of
its first operation, and the served world must brake. Eight seeds, with ``--all`` twenty. It needs
``g++``.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import smsl_studio as smsl
from benches.row import Row
from smsl_studio.shipped import samples_dir

FILE, GOAL = samples_dir() / "hanoi-corrected.json", "SB1/State_ccc"
FEW, ALL = 8, 20
KILLED = 3


def rows() -> Iterator[Row]:
    """Drive eight seeds."""
    return _rows(FEW)


def all_rows() -> Iterator[Row]:
    """Drive twenty seeds."""
    return _rows(ALL)


def _rows(seeds: int) -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = _built(folder)
        words = ["serve", "--world", "hanoi", "--address", f"unix:{folder / 's'}"]
        command = [sys.executable, "-m", "smsl_studio", *words, "--file", str(FILE)]
        serving = subprocess.Popen(
            [*command, "--format", "json"], stdout=subprocess.PIPE, text=True
        )
        assert serving.stdout is not None
        serving.stdout.readline()
        try:
            blueprint, missed, doubted, times = smsl.read(FILE), 0, 0, 0.0
            start = time.perf_counter()
            for seed in range(seeds):
                log = folder / f"{seed}.jsonl"
                done = subprocess.run(
                    [*_words(program, folder, seed), "--log", str(log)],
                    capture_output=True,
                    text=True,
                    check=False,
                )
                last = json.loads(done.stdout.splitlines()[-1])
                missed += last["reason"] != "goal_reached" or done.returncode != 0
                doubted += smsl.verify(log, blueprint).doubt is not None
                times += last["t"]
            spent = time.perf_counter() - start
            what = f"generated C++ drives Hanoi in physics over a socket, {seeds} seeds"
            yield Row(f"{what}: runs that miss the goal", missed, "runs", bound="0")
            yield Row(f"{what}: logs that are doubted", doubted, "logs", bound="0")
            yield Row(f"{what}: simulated seconds a second of the wall", times / spent, "s")
            for _ in range(2 * seeds):
                serving.stdout.readline()  # each program came and left
            braked = sum(_brakes(program, folder, serving) for _ in range(KILLED))
            what = f"generated C++ is killed in an operation, {KILLED} times"
            yield Row(f"{what}: worlds that did not brake", KILLED - braked, "worlds", bound="0")
        finally:
            serving.terminate()
            serving.wait()


def _brakes(program: Path, folder: Path, serving: subprocess.Popen[str]) -> bool:
    """Kill the program in an operation. Return whether the world says that it is braked."""
    with subprocess.Popen(_words(program, folder, 0), stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        for line in running.stdout:
            if json.loads(line)["event"] == "operation_started":
                break
        running.kill()
    assert serving.stdout is not None
    came, left = (json.loads(serving.stdout.readline()) for _ in range(2))
    return came["event"] == "program_came" and left["braked"] is True


def _words(program: Path, folder: Path, seed: int) -> list[str]:
    where = ["--world", "remote", "--address", f"unix:{folder / 's'}"]
    return [str(program), "run", "--goal", GOAL, *where, "--seed", str(seed)]


def _built(folder: Path) -> Path:
    """Generate and compile the program of the blueprint."""
    compiler = shutil.which("g++")
    if compiler is None:
        raise SystemExit("this bench needs g++: apt-get install g++")
    smsl.generate_code(smsl.read(FILE), folder / "code", target="cpp", name="made")
    sources = sorted(map(str, (folder / "code" / "made").rglob("*.cpp")))
    flags = ["-std=c++17", "-O2", f"-I{folder / 'code' / 'made'}"]
    subprocess.run([compiler, *flags, *sources, "-o", str(folder / "program")], check=True)
    return folder / "program"
