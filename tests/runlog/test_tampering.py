"""A log that was changed, cut, reordered, doubled, continued or encoded anew is not verified."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

import smsl_studio as smsl
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import ReadError
from smsl_studio.runlog.grammar.log_reader import Doubt, read_log, read_records
from smsl_studio.shipped import samples_dir
from tests.runlog.logs import CHANGES, EVENTS, OTHER, is_verified, tampered, write_log


@pytest.fixture
def logs(tmp_path: Path) -> tuple[bytes, bytes]:
    return write_log(tmp_path / "one"), write_log(tmp_path / "two", OTHER, seed=4)


def test_good_logs_verify(logs: tuple[bytes, bytes]) -> None:
    assert all(map(is_verified, logs))


def test_two_hundred_changed_logs_do_not_verify(logs: tuple[bytes, bytes]) -> None:
    random = Random(5)
    changed = [tampered(*logs, random) for _ in range(200)]
    assert [how for how, raw in changed if is_verified(raw)] == []
    assert len({how for how, _ in changed}) == len(CHANGES)


def test_a_log_of_people_and_faults_is_as_safe(tmp_path: Path) -> None:
    """What people commanded and answered, and what was injected, is in the chain like the rest."""
    blueprint = smsl.read(samples_dir() / "hanoi-corrected.json")
    pair = []
    for name in ("hanoi-taken-over", "hanoi-faults"):
        script = smsl.read_script(samples_dir() / "scripts" / f"{name}.jsonl", blueprint)
        smsl.run(blueprint, script=script, log=tmp_path / name)
        pair.append((tmp_path / name).read_bytes())
    assert b'"commanded"' in pair[0]
    assert all(map(is_verified, pair))
    random = Random(6)
    changed = [tampered(pair[0], pair[1], random) for _ in range(100)]
    assert [how for how, raw in changed if is_verified(raw)] == []


def answer(path: Path) -> Doubt | ReadError | None:
    """Why a log is not verified, or does not read."""
    try:
        return read_log(path, COMMANDS).doubt
    except ReadError as error:
        return error


@pytest.mark.parametrize("change", CHANGES, ids=lambda one: one.__name__)
def test_what_was_changed_reads_or_says_where_it_does_not(
    logs: tuple[bytes, bytes], change: object, tmp_path: Path
) -> None:
    assert callable(change)
    for seed in range(5):
        path = tmp_path / "changed"
        changed = change(*logs, Random(seed))
        path.write_bytes(changed if changed not in logs else b"")
        assert str(answer(path)).startswith(f"{path}:")


def test_every_cut_at_the_end_is_seen(logs: tuple[bytes, bytes]) -> None:
    assert not any(is_verified(logs[0][:end]) for end in range(len(logs[0])))


def test_a_cut_log_reads_up_to_its_last_whole_line(
    logs: tuple[bytes, bytes], tmp_path: Path
) -> None:
    raw = logs[0]
    first = raw.index(b"\n") + 1
    for end in range(first, len(raw), 7):
        (tmp_path / "cut").write_bytes(raw[:end])
        found = read_log(tmp_path / "cut", COMMANDS)
        assert len(found.records) == min(raw[first:end].count(b"\n"), len(EVENTS))
        assert found.doubt is not None
        assert found.head is None


def test_a_stream_that_breaks_is_unreadable() -> None:
    class Broken:
        def readline(self, size: int) -> bytes:
            raise OSError(5, "Input/output error")

    with pytest.raises(ReadError, match="Input/output error") as caught:
        read_records(Broken(), "log", COMMANDS)  # type: ignore[arg-type]
    assert str(caught.value.place) == "log:1:1"
