"""A written line is on the disk, and a log that cannot be written is reported."""

from __future__ import annotations

import io
import json
import os
import resource
from pathlib import Path

import pytest

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import ReadError, SaveError, UsageError
from smsl_studio.runlog.events import Committed, FactChanged, Held, RunFinished
from smsl_studio.runlog.grammar.log_reader import read_log, verify
from smsl_studio.runlog.log import LONGEST, RunLog
from tests.runlog.logs import chained, is_verified

GONE = "The world \udcff is gone."
EVENTS = (
    FactChanged(t=0.1, branch="SB/é", digit=0, value="State_\udcff"),
    Held(t=1.0, reason=GONE),
    RunFinished(t=1.0, reason="failed", sentence=GONE, operations=0, configuration={}),
)
"""A run whose world died before it began."""
REFUSED = RunFinished(t=0.0, reason="refused", sentence="No.", operations=0, configuration={})
FIRST = b'{"log":"smsl-run","version":2}'


def test_what_is_written_is_read(tmp_path: Path) -> None:
    with RunLog(tmp_path / "run.jsonl", {"seed": 7}) as log:
        log.write(EVENTS[:1])
        log.write(EVENTS[1:])
        log.finish()
    found = read_log(tmp_path / "run.jsonl", COMMANDS)
    assert {k: v for k, v in found.header.items() if k != "chain"} == {
        "log": "smsl-run",
        "version": 3,
        "seed": 7,
    }
    assert found.events == EVENTS
    assert [one.line for one in found.records] == [2, 3, 4]
    assert [one.text for one in found.records] == [
        one.line().encode("utf-8", "backslashreplace").decode() for one in EVENTS
    ]
    assert found.doubt is None
    assert found.head is not None
    assert found.head.count == 3


def test_a_log_that_was_not_finished_says_so(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    with RunLog(path, {}) as log:
        log.write(EVENTS)
        found = read_log(path, COMMANDS)
    assert found == read_log(path, COMMANDS)
    assert (found.events, found.head) == (EVENTS, None)
    assert str(found.doubt).startswith(f"{path}:5:1: not verified: the log has no head")


def test_a_line_cut_short_is_dropped(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    with RunLog(path, {}) as log:
        log.write(EVENTS)
    path.write_bytes(path.read_bytes()[:-5])
    found = read_log(path, COMMANDS)
    assert found.events == EVENTS[:2]
    assert str(found.doubt).startswith(f"{path}:4:1: not verified: the last line is cut short")


def test_a_log_without_events_tells_of_no_run(tmp_path: Path) -> None:
    path = tmp_path / "log"
    with RunLog(path, {}) as log:
        log.finish()
    words = "the story is impossible: the log ends, and the run that it tells of does not"
    assert str(read_log(path, COMMANDS).doubt) == f"{path}:2:1: not verified: {words}"


def test_a_line_that_no_reader_would_take_is_not_written(tmp_path: Path) -> None:
    with RunLog(tmp_path / "log", {}) as log:
        with pytest.raises(SaveError, match="a line is longer than 16 MB"):
            log.write([Committed(t=0.0, operations=("x" * LONGEST,), configuration={})])
        assert (tmp_path / "log").read_bytes().count(b"\n") == 1


def test_the_disk_has_the_header_and_the_whole_log(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And is not waited for in between, where a stop would have to wait, too."""
    synced: list[int] = []
    monkeypatch.setattr("os.fsync", lambda handle: synced.append(os.fstat(handle).st_size))
    with RunLog(tmp_path / "log", {}) as log:
        assert len(synced) == 1
        log.write(EVENTS)
        assert len(synced) == 1
        log.finish()
    assert synced == [synced[0], (tmp_path / "log").stat().st_size]


def test_a_log_is_an_ordinary_file_and_no_link(tmp_path: Path) -> None:
    reader, writer = os.pipe()
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "to-null").symlink_to("/dev/null")
    (tmp_path / "to-nothing").symlink_to(tmp_path / "nothing")
    (tmp_path / "empty").touch()
    (tmp_path / "to-empty").symlink_to(tmp_path / "empty")
    for odd, words in (
        (f"/dev/fd/{writer}", "is (a link|no ordinary file)"),
        ("/dev/null", "is no ordinary file"),
        ("/dev/full", "is no ordinary file"),
        (".", "is no ordinary file"),
        ("pipe", "is no ordinary file"),
        ("to-null", "is a link"),
        ("to-nothing", "is a link"),
        ("to-empty", "is a link"),
    ):
        with pytest.raises(UsageError, match=f"{odd} {words}".lstrip(".")):
            RunLog(tmp_path / odd, {})
    os.close(writer)
    with os.fdopen(reader, "rb") as stream:
        assert stream.read() == b""
    assert not (tmp_path / "nothing").exists()
    assert (tmp_path / "empty").read_bytes() == b""
    with RunLog(tmp_path / "empty", {}) as log:
        log.write([REFUSED])
        log.finish()
    assert is_verified((tmp_path / "empty").read_bytes())


def test_a_log_that_cannot_be_opened_says_so(tmp_path: Path) -> None:
    with pytest.raises(SaveError, match="the run log cannot be written") as caught:
        RunLog(tmp_path / "nowhere" / "run.jsonl", {})
    assert caught.value.advice


def test_a_full_disk_is_seen_at_the_first_line(tmp_path: Path) -> None:
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (10, limits[1]))
        with pytest.raises(SaveError, match="File too large"):
            RunLog(tmp_path / "log", {})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def damaged(line: bytes) -> bytes:
    """A log whose only event is this, with a chain that holds."""
    return chained([FIRST, line])


HEAD = chained([FIRST]).splitlines(keepends=True)[-1]


@pytest.mark.parametrize(
    ("raw", "place", "words"),
    [
        (b"", "1:1", "no run log"),
        (b'{"a":1}\n', "1:1", "no run log"),
        (chained([b'{"a":1}']), "1:1", "no run log"),
        (b'{"log":"smsl-run","version":2}\n', "1:1", "does not end in a link"),
        (b'{"log":"smsl-run","version":2', "1:30", "cut short"),
        (chained([b'{"log":"smsl-run","version":1}']), "1:1", "another version"),
        (chained([b'{"log":"smsl-run","log":"x"}']), "1:1", "writes: 'log' stands in it twice"),
        (damaged(b'{"event":"paused","t":0,"t":1}'), "2:1", "writes: 't' stands in it twice"),
        (damaged(b'{"a":1}'), "2:1", "tells of no event"),
        (damaged(b'{"event":"paused","t":}'), "2:23", "no JSON object"),
        (damaged(b'["event"]'), "2:9", "no JSON object"),
        (damaged(b'{"\xc3\xa9\xff":1}'), "2:4", "not UTF-8"),
        (damaged(b'{"event":"paused","t":NaN}'), "2:1", "that no run writes"),
        (damaged(b'{"event":"paused","t":' + b"9" * 5000 + b"}"), "2:1", "no run writes"),
        (damaged(b'{"event":' + b"[" * 10**5 + b"}"), "2:1", "that no run writes"),
        (damaged(b'{"event":"paused","t":0}') + b"\n", "4:1", "behind the head"),
        (damaged(b'{"event":"paused","t":0}').replace(b'"count":1', b'"count":01'), "3:1", "head"),
        (damaged(b'{"event":"paused","t":0}')[:-3] + b"\n", "3:1", "head is not as it was"),
        (damaged(b'{"event":"paused","t":0}').replace(b't":0', b't":0' * 2**22), "2:1", "16 MB"),
    ],
)
def test_what_is_no_log_is_refused_with_its_place(
    tmp_path: Path, raw: bytes, place: str, words: str
) -> None:
    path = tmp_path / "x"
    path.write_bytes(raw)
    with pytest.raises(ReadError, match=words) as caught:
        read_log(path, COMMANDS)
    assert str(caught.value.place) == f"{path}:{place}"
    assert caught.value.advice
    assert not is_verified(raw)


@pytest.mark.parametrize(
    ("raw", "is_log"),
    [
        (b"", True),
        (b'{"log"', True),
        (b"x" + chained([FIRST]), True),
        (b"\n" * 50 + chained([FIRST]), True),
        (HEAD, True),
        (b"\n" * 500 + chained([FIRST]), False),
        (b"{}\n", False),
        (b"\x89PNG\r\n\x1a\n", False),
        (chained([FIRST]).decode().encode("utf-16"), False),
    ],
)
def test_a_log_that_was_changed_is_told_from_another_file(raw: bytes, is_log: bool) -> None:
    if is_log:
        assert verify(io.BytesIO(raw), "log", COMMANDS).doubt is not None
    else:
        with pytest.raises(ReadError, match="no run log"):
            verify(io.BytesIO(raw), "log", COMMANDS)


def test_what_has_no_lines_is_told_by_its_first() -> None:
    with (
        Path("/dev/zero").open("rb") as stream,
        pytest.raises(ReadError, match="longer than 16 MB") as caught,
    ):
        verify(stream, "zero", COMMANDS)
    assert str(caught.value.place) == "zero:1:1"


def test_a_head_that_lies_is_a_doubt() -> None:
    good = damaged(REFUSED.line().encode())
    assert is_verified(good)
    hash_ = json.loads(good.splitlines()[-1])["head"]["hash"]
    for wrong, words in (
        (good.replace(b'"count":1', b'"count":2'), "counts 2 events; there are 1"),
        (good.replace(hash_.encode(), hash_[::-1].encode()), "the head does not fit"),
    ):
        doubt = verify(io.BytesIO(wrong), "log", COMMANDS).doubt
        assert words in str(doubt)
        assert str(doubt).startswith("log:3:1: not verified: ")


def test_a_missing_log_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match="cannot be read"):
        read_log(tmp_path / "x", COMMANDS)
