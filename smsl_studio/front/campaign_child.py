"""A campaign in a process of its own, for the window. The window never runs the code of plugins.

The process gets one line with what is asked, and tells one line for the rows, one for each run, and
one for the end. It works on copies of the files, so that what is drawn and not saved counts. The
window believes no line that does not fit.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path, PurePosixPath
from typing import Any

from smsl_studio.errors import StudioError, UsageError, WorldError
from smsl_studio.front.campaign_cluster import files_of
from smsl_studio.front.campaign_faults import CampaignRequest
from smsl_studio.front.campaign_foreseen import CampaignForesight
from smsl_studio.front.campaign_runs import (
    CampaignRun,
    Injection,
    RunVerdict,
    request_of,
    run_as_json,
    run_of_json,
    verdict_as_json,
    verdict_of,
    verdict_of_json,
)
from smsl_studio.front.campaigns import CampaignWatch, campaign
from smsl_studio.front.child_lines import told_lines
from smsl_studio.front.fault_foresight import HELD, REACHED, FaultEnd
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import run_request
from smsl_studio.host.started_child import environment_of_child
from smsl_studio.stop import Stopped, heeding

Json = Any
LONGEST = 100_000_000
"""The largest length of one line (bytes): that of the rows of a very large blueprint."""
AT_ONCE = 1_000_000
CODE = "from smsl_studio.front.campaign_child import serve; serve()"
"""The first code of the process."""
PATIENCE = 5.0
"""How long a process that is told to end may take (s)."""


@dataclass(frozen=True, slots=True)
class CampaignEnd:
    """How the process ended. ``paused`` is true before all runs were done; they are kept.

    ``digest`` is that of the whole campaign. ``left_out`` are faults that nobody could choose.
    """

    paused: bool
    digest: str = ""
    left_out: tuple[str, ...] = ()
    made: int = 0


class CampaignChild:
    """The process of one campaign, or of one run of it that is recorded.

    UsageError if the blueprint stands in no file.
    """

    def __init__(
        self, request: CampaignRequest, run: CampaignRun | None = None, log: Path | None = None
    ) -> None:
        files, main = files_of(request.blueprint)
        self._folder = tempfile.TemporaryDirectory(prefix="smsl-campaign-")
        for name, raw in files.items():
            place = Path(self._folder.name, *PurePosixPath(name).parts)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(raw)
        names = (one.name for one in fields(request) if one.name not in ("blueprint", "part"))
        asked = {name: getattr(request, name) for name in names}
        told = {
            "request": asked,
            "file": str(Path(self._folder.name, *PurePosixPath(main).parts)),
            "part": str(request.part) if request.part is not None else None,
            "run": run_as_json(run) if run is not None else None,
            "log": str(log) if log is not None else None,
        }
        code = f"import sys; sys.path[:] = {sys.path!r}; {CODE}"
        self._child = subprocess.Popen(
            [sys.executable, "-P", "-c", code],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment_of_child(),
            process_group=0,
        )
        assert self._child.stdin is not None
        try:
            self._child.stdin.write(json.dumps(told).encode() + b"\n")
            self._child.stdin.close()
        except OSError:
            raise _dead() from None

    def pause(self) -> None:
        """Let the run end that is carried out now, and then the process."""
        if self._child.poll() is None:
            self._child.send_signal(signal.SIGINT)

    def close(self) -> None:
        """End the process and its workers now. What is done is kept."""
        self._child.terminate()
        try:
            self._child.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._child.kill()
            self._child.wait()
        if self._child.stdout is not None:
            self._child.stdout.close()
        self._folder.cleanup()

    def follow(self, watch: CampaignWatch) -> CampaignEnd:
        """Tell ``watch`` what the process tells, until it ends.

        UsageError or WorldError if it was refused, or if the process died or says nonsense.
        """
        rows = 0
        for told in self._lines():
            if "rows" in told:
                injections = _injections(told["rows"])
                seeds = told.get("seeds")
                if injections is None or type(seeds) is not int or not 0 < seeds <= AT_ONCE:
                    raise _dead()
                rows = len(injections)
                watch.begin(injections, seeds)
            elif "row" in told:
                row, seed = told.pop("row"), told.pop("seed", None)
                verdict = verdict_of_json(told)
                if verdict is None or not _is_place(row, rows) or not _is_place(seed, AT_ONCE):
                    raise _dead()
                watch.hear(row, seed, verdict)
            elif "foreseen" in told:
                foreseen, row = _foreseen(told["foreseen"]), told.get("of")
                if foreseen is None or type(row) is not int or not _is_place(row, rows):
                    raise _dead()
                watch.foresee(row, foreseen)
            elif "refused" in told:
                words, advice = str(told["refused"])[:1000], str(told.get("advice") or "")[:1000]
                raise UsageError(words, advice=advice)
            elif "end" in told:
                end = _end(told["end"])
                if end is None:
                    raise _dead()
                return end
            else:
                raise _dead()
        raise _dead()

    def _lines(self) -> Iterator[dict[str, Json]]:
        pipe = self._child.stdout
        assert pipe is not None
        return told_lines(pipe, LONGEST, _dead)


def _is_place(number: object, most: int) -> bool:
    return type(number) is int and 0 <= number < most


def _injections(told: Json) -> list[Injection | None] | None:
    """Return the rows of a campaign. None if they are none."""
    if not isinstance(told, list) or not 0 < len(told) <= AT_ONCE:
        return None
    try:
        runs = [run_of_json({**_BARE, "injection": one}) for one in told]
    except (TypeError, ValueError, KeyError, AttributeError, StudioError):
        return None
    return [one.injection for one in runs]


def _foreseen(told: Json) -> FaultEnd | None:
    """Return how the runs of a row were foreseen to end. None if it is no such thing."""
    if not isinstance(told, list) or len(told) != 2 or told[0] not in (REACHED, HELD):
        return None
    return FaultEnd(told[0], told[1][:1000], ()) if isinstance(told[1], str) else None


_BARE = {"world": "", "seed": 0, "robot": "", "starts": (), "goals": (), "agents": ()}


def _end(told: Json) -> CampaignEnd | None:
    if not isinstance(told, dict):
        return None
    paused, digest = told.get("paused"), told.get("digest")
    made, left_out = told.get("made"), told.get("left_out")
    sound = type(paused) is bool and isinstance(digest, str) and len(digest) <= 64
    if not sound or type(made) is not int or not isinstance(left_out, list):
        return None
    return CampaignEnd(bool(paused), str(digest), tuple(str(n)[:100] for n in left_out[:100]), made)


def _dead() -> WorldError:
    return WorldError(
        "the process of the campaign died, or said what is no verdict",
        advice="What is done is kept. Resume goes on. A plugin may have crashed.",
    )


# -- in the process --------------------------------------------------------------------------------


class _Telling(CampaignWatch):
    """Writes what is heard, one line each, and ends a paused campaign between two runs."""

    def __init__(self) -> None:
        self.pausing = self.ending = False
        self.foresight: CampaignForesight | None = None
        self._rows: Sequence[Injection | None] = ()
        self._foreseen: set[int] = set()
        # What a plugin prints must not stand between the lines.
        self._out = os.fdopen(os.dup(1), "w", encoding="ascii")
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)

    def say(self, **told: Json) -> None:
        """Write one line."""
        self._out.write(json.dumps(told) + "\n")
        self._out.flush()

    def begin(self, rows: Sequence[Injection | None], seeds: int) -> None:
        """Tell the rows."""
        self._rows = rows
        asked = [run_as_json(CampaignRun("", 0, one))["injection"] for one in rows]
        self.say(rows=asked, seeds=seeds)

    def hear(self, row: int, seed: int, verdict: RunVerdict) -> None:
        """Tell a run, before the first one of a row what was foreseen. Stopped if somebody
        pauses."""
        if self.foresight is not None and row not in self._foreseen:
            self._foreseen.add(row)
            end = self.foresight.look(self._rows[row])
            if end is not None:
                self.say(foreseen=[end.end, end.why], of=row)
        self.say(row=row, seed=seed, **verdict_as_json(verdict))
        if self.pausing:
            raise Stopped

    def heed(self) -> None:
        """Raise Stopped if somebody ends the process."""
        if self.ending:
            raise Stopped


def serve() -> None:
    """Carry out what stands in the one line of the standard input."""
    telling = _Telling()

    def pause(*_: object) -> None:
        """Note that the campaign shall pause."""
        telling.pausing = True

    def end(*_: object) -> None:
        """Note that the campaign shall end."""
        telling.ending = True

    signal.signal(signal.SIGINT, pause)
    signal.signal(signal.SIGTERM, end)
    asked = json.loads(sys.stdin.buffer.readline())
    try:
        with heeding(telling.heed):
            _carry_out(asked, telling)
    except Stopped:
        telling.say(end={"paused": True, "digest": "", "left_out": [], "made": 0})
    except StudioError as error:
        place = f"{error.place}: " if error.place is not None else ""
        telling.say(refused=f"{place}{error.sentence}", advice=error.advice)


def _carry_out(asked: Json, telling: _Telling) -> None:
    blueprint = read(Path(asked["file"]))
    if asked["run"] is not None:
        wanted = request_of(blueprint, run_of_json(asked["run"]))
        done = run_request(replace(wanted, log=Path(asked["log"])))
        telling.say(rows=[None], seeds=1)
        telling.say(row=0, seed=0, **verdict_as_json(verdict_of(done)))
        telling.say(end={"paused": False, "digest": "", "left_out": [], "made": 0})
        return
    values: dict[str, Any] = {
        name: tuple(value) if isinstance(value, list) else value
        for name, value in asked["request"].items()
    }
    part = Path(asked["part"]) if asked["part"] is not None else None
    request = CampaignRequest(blueprint, **values, part=part)
    telling.foresight = CampaignForesight(request)
    done_all = campaign(request, watch=telling)
    end = {"paused": False, "digest": done_all.digest, "left_out": list(done_all.left_out)}
    telling.say(end={**end, "made": done_all.made})
