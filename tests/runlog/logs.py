"""Logs to read, and a hundred ways to change one."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from random import Random

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import ReadError
from smsl_studio.runlog.events import (
    Committed,
    Event,
    FactChanged,
    GoalReached,
    Held,
    Mismatch,
    OperationEnded,
    OperationRisky,
    OperationStarted,
    Relocalised,
    RoutePlanned,
    RunFinished,
    RunStarted,
    StateChecked,
)
from smsl_studio.runlog.grammar.log_reader import verify
from smsl_studio.runlog.log import RunLog
from smsl_studio.seal.chain import Chain, unlinked

SB, FIRST, SECOND = "SB/é", "SB~1é/State_0/Op", "SB~1é/State_1/Op"
_BEGUN: tuple[Event, ...] = (
    RunStarted(t=0.0, world="table", seed=3, start={SB: "State_0"}, goals=("SB~1é/State_2",)),
    FactChanged(t=0.0, branch=SB, digit=0, value="0"),
    StateChecked(t=0.0, address="SB~1é/State_0", result="true"),
    RoutePlanned(t=0.0, goal="SB~1é/State_2", operations=(FIRST, SECOND), cost=1.5),
    OperationStarted(t=0.0, address=FIRST, target="State_1", function="table.set"),
    FactChanged(t=0.05, branch=SB, digit=0, value=None, reason="stale"),
    FactChanged(t=0.1, branch=SB, digit=0, value="1"),
    OperationEnded(t=0.1, address=FIRST, outcome="returned"),
    StateChecked(t=0.1, address="SB~1é/State_1", result="true"),
    Committed(t=0.1, operations=(FIRST,), configuration={SB: "State_1"}),
    OperationStarted(t=0.1, address=SECOND, target="State_2", function="table.set"),
    OperationEnded(t=0.2, address=SECOND, outcome="failed", message="It slipped."),
    OperationRisky(t=0.2, address=SECOND, reason="It slipped."),
    Mismatch(t=0.2, facts=("a", "b"), candidates=({SB: "State_2"},)),
)
EVENTS: tuple[Event, ...] = (
    *_BEGUN,
    Relocalised(t=0.2, configuration={SB: "State_2"}),
    GoalReached(t=0.25, goal="SB~1é/State_2"),
    RunFinished(
        t=0.25,
        reason="goal_reached",
        sentence="SB~1é/State_2 holds.",
        operations=1,
        configuration={SB: "State_2"},
    ),
)
"""A run that reaches its goal, and not as it was planned."""
OTHER: tuple[Event, ...] = (
    *_BEGUN,
    Held(t=0.2, reason="It slipped."),
    RunFinished(
        t=0.2,
        reason="held",
        sentence="It slipped.",
        operations=1,
        configuration={SB: "State_1"},
    ),
)
"""The same run, where nobody lets it go on."""
HEADER = {"seed": 3, "world": "table", "wall_time": "2026-01-01T00:00:00.000+00:00", "node": "é"}


def write_log(path: Path, events: Sequence[Event] = EVENTS, seed: int = 3) -> bytes:
    """A finished log; its bytes."""
    events = [replace(e, seed=seed) if isinstance(e, RunStarted) else e for e in events]
    with RunLog(path, {**HEADER, "seed": seed}) as log:
        log.write(events)
        log.finish()
    return path.read_bytes()


def chained(texts: Sequence[bytes]) -> bytes:
    """A log with a good chain and a good head, whatever its first line and its events say."""
    chain = Chain()
    lines = [chain.linked(text) for text in texts]
    head = {"head": {"count": len(texts) - 1, "hash": chain.digest}}
    return b"".join([*lines, json.dumps(head, separators=(",", ":")).encode(), b"\n"])


def is_verified(raw: bytes) -> bool:
    """Whether these bytes verify; that they cannot be read is a no."""
    try:
        return verify(io.BytesIO(raw), "log", COMMANDS).doubt is None
    except ReadError:
        return False


Change = Callable[[bytes, bytes, Random], bytes]


def tampered(raw: bytes, other: bytes, random: Random) -> tuple[str, bytes]:
    """A log that was changed, and how; ``other`` is a good log of another run."""
    while True:
        change = random.choice(CHANGES)
        found = change(raw, other, random)
        if found not in (raw, other):
            return change.__name__, found


def flip_a_byte(raw: bytes, other: bytes, random: Random) -> bytes:
    at = random.randrange(len(raw))
    return raw[:at] + bytes([raw[at] ^ random.randrange(1, 256)]) + raw[at + 1 :]


def flip_a_bit_of_the_header(raw: bytes, other: bytes, random: Random) -> bytes:
    at = random.randrange(raw.index(b"\n") + 1)
    return raw[:at] + bytes([raw[at] ^ (1 << random.randrange(8))]) + raw[at + 1 :]


def flip_a_bit_of_the_head(raw: bytes, other: bytes, random: Random) -> bytes:
    at = random.randrange(raw.rindex(b'{"head"'), len(raw))
    return raw[:at] + bytes([raw[at] ^ (1 << random.randrange(8))]) + raw[at + 1 :]


def cut_anywhere(raw: bytes, other: bytes, random: Random) -> bytes:
    return raw[: random.randrange(len(raw))]


def cut_whole_lines(raw: bytes, other: bytes, random: Random) -> bytes:
    lines = raw.splitlines(keepends=True)
    return b"".join(lines[: random.randrange(len(lines))])


def cut_in_front(raw: bytes, other: bytes, random: Random) -> bytes:
    return raw[random.randrange(1, len(raw)) :]


def cut_in_the_middle(raw: bytes, other: bytes, random: Random) -> bytes:
    first, last = sorted(random.sample(range(len(raw)), 2))
    return raw[:first] + raw[last:]


def leave_a_line_out(raw: bytes, other: bytes, random: Random) -> bytes:
    lines = raw.splitlines(keepends=True)
    del lines[random.randrange(len(lines))]
    return b"".join(lines)


def reorder(raw: bytes, other: bytes, random: Random) -> bytes:
    lines = raw.splitlines(keepends=True)
    one, two = random.sample(range(len(lines)), 2)
    lines[one], lines[two] = lines[two], lines[one]
    return b"".join(lines)


def shuffle_all(raw: bytes, other: bytes, random: Random) -> bytes:
    lines = raw.splitlines(keepends=True)
    random.shuffle(lines)
    return b"".join(lines)


def double_a_line(raw: bytes, other: bytes, random: Random) -> bytes:
    lines = raw.splitlines(keepends=True)
    one = random.choice(lines)
    lines.insert(random.randrange(len(lines) + 1), one)
    return b"".join(lines)


def double_all(raw: bytes, other: bytes, random: Random) -> bytes:
    return raw + raw


def append(raw: bytes, other: bytes, random: Random) -> bytes:
    lines = raw.splitlines(keepends=True)
    tail = [b"\n", b" ", b"\0", b"{}\n", b"x", b"\xef\xbb\xbf", other, lines[1], lines[-1]]
    return raw + random.choice(tail)


def put_in_front(raw: bytes, other: bytes, random: Random) -> bytes:
    return random.choice([b"\n", b" ", b"\xef\xbb\xbf", b"{}\n", other]) + raw


def insert_bytes(raw: bytes, other: bytes, random: Random) -> bytes:
    at = random.randrange(len(raw) + 1)
    return (
        raw[:at] + random.choice([b" ", b"\n", b"\r", b"\0", b"0", random.randbytes(9)]) + raw[at:]
    )


def change_line_ends(raw: bytes, other: bytes, random: Random) -> bytes:
    count = random.choice([-1, 1])
    return raw.replace(b"\n", random.choice([b"\r\n", b"\r", b"\n\n", b" \n"]), count)


def encode_anew(raw: bytes, other: bytes, random: Random) -> bytes:
    code = random.choice(["utf-16", "utf-8-sig", "latin-1", "utf-32", "utf-7"])
    return raw.decode("utf-8").encode(code)


def dump_anew(raw: bytes, other: bytes, random: Random) -> bytes:
    """Some lines with spaces, in another order of members, or with escapes for letters."""
    ways: list[Callable[[object], str]] = [
        json.dumps,
        lambda one: json.dumps(one, sort_keys=True, separators=(",", ":"), ensure_ascii=False),
        lambda one: json.dumps(one, separators=(",", ":")),
    ]
    dump, share = random.choice(ways), random.random()
    lines = raw.splitlines()
    anew = [dump(json.loads(one)).encode() if random.random() < share else one for one in lines]
    return b"\n".join(anew) + b"\n"


def exchange_a_line(raw: bytes, other: bytes, random: Random) -> bytes:
    """A line of another run in its place, the header and the head too."""
    lines, foreign = raw.splitlines(keepends=True), other.splitlines(keepends=True)
    at = random.randrange(len(lines))
    lines[at] = foreign[min(at, len(foreign) - 1)]
    return b"".join(lines)


def cross(raw: bytes, other: bytes, random: Random) -> bytes:
    """The beginning of one log and the end of another."""
    lines, foreign = raw.splitlines(keepends=True), other.splitlines(keepends=True)
    at = random.randrange(1, min(len(lines), len(foreign)))
    return b"".join(lines[:at] + foreign[at:])


def link_one_line_anew(raw: bytes, other: bytes, random: Random) -> bytes:
    """A line that says another thing, with the link it should have; the lines behind stay."""
    lines = raw.splitlines(keepends=True)
    at = random.randrange(len(lines) - 1)
    split = unlinked(lines[at])
    assert split is not None
    chain = Chain()
    chain.add(b"".join(lines[:at]))
    lines[at] = chain.linked(split[0][:-1] + b',"reason":"no"}')
    return b"".join(lines)


def forge_half_a_head(raw: bytes, other: bytes, random: Random) -> bytes:
    """A cut log with a head of its own: its count or its hash is right, the other is the old."""
    *lines, head = raw.splitlines(keepends=True)
    kept = lines[: random.randrange(1, len(lines))]
    chain = Chain()
    chain.add(b"".join(kept))
    old = json.loads(head)["head"]
    if random.random() < 0.5:
        old["hash"] = chain.digest
    else:
        old["count"] = len(kept) - 1
    forged = json.dumps({"head": old}, separators=(",", ":")).encode()
    return b"".join(kept) + forged + b"\n"


CHANGES: tuple[Change, ...] = (
    flip_a_byte,
    flip_a_bit_of_the_header,
    flip_a_bit_of_the_head,
    cut_anywhere,
    cut_whole_lines,
    cut_in_front,
    cut_in_the_middle,
    leave_a_line_out,
    reorder,
    shuffle_all,
    double_a_line,
    double_all,
    append,
    put_in_front,
    insert_bytes,
    change_line_ends,
    encode_anew,
    dump_anew,
    exchange_a_line,
    cross,
    link_one_line_anew,
    forge_half_a_head,
)
