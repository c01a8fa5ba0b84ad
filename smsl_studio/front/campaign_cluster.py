"""The runs of a campaign on the computers of a Dask cluster, which its user has started.

Each task carries the files of the blueprint and a few runs. The computer that takes it writes the
files into a folder of its own, compares the code of program and world with that of the campaign,
and hands the runs to a worker process (see ``campaign_workers``). Dask hands a task to another
computer if one is lost. Dask moves values as pickles, so a cluster must be as trusted as the
computer itself; the verdicts are checked all the same.
"""

from __future__ import annotations

import json
import logging
import os
import re
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from pathlib import Path, PurePosixPath
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError, UsageError, WorldError
from smsl_studio.front.campaign_runs import (
    CampaignRun,
    RunVerdict,
    run_as_json,
    run_of_json,
    verdict_as_json,
    verdict_of_json,
)
from smsl_studio.front.campaign_workers import CampaignWorkers
from smsl_studio.front.inputs import read
from smsl_studio.front.procedure_parts import runnable_procedures
from smsl_studio.front.version import version
from smsl_studio.front.world_codes import surveyed
from smsl_studio.library.bindings_file import bindings_beside
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.files import read_content
from smsl_studio.stop import heed
from smsl_studio.world.engines import TABLE

Json = Any
TABLE_RUNS, OTHER_RUNS = 50, 5
"""The number of runs of one task in the world table, whose runs are short, and in others."""
AHEAD = 200
"""The number of tasks that are handed out before their turn."""
CONNECT, HELP = 10.0, 60.0
"""The wall time (s) to wait for the scheduler, and for its first worker."""
ADDRESS = re.compile(
    r"(?:(?:tcp|tls)://)?(?:[\w.-]{1,253}|\[[0-9a-fA-F:.]{2,45}\]):\d{1,5}", re.ASCII
)
LOOK = 0.02
"""The wall time (s) between two looks for a stop."""


class CampaignCluster:
    """A Dask cluster at an address, such as ``tcp://127.0.0.1:8786``.

    UsageError if the extra is not installed, or if nobody answers at the address.
    """

    def __init__(self, address: str, blueprint: Blueprint, world: str) -> None:
        try:
            import distributed
        except ImportError:
            raise UsageError(
                "campaigns on a cluster need the extra dask",
                advice="Install it: pip install 'smsl-studio[dask]'.",
            ) from None
        if ADDRESS.fullmatch(address) is None:
            raise UsageError(
                f"{address[:100]!r} is no address of a Dask scheduler",
                advice="Write it as tcp://HOST:PORT, or tls://HOST:PORT.",
            )
        self._files, self._main = files_of(blueprint)
        self._code = code_of(blueprint, world)
        self._world = world
        # A lost worker gives its runs to another one. Dask would warn of it on the terminal.
        logging.getLogger("distributed.client").setLevel(logging.ERROR)
        try:
            make: Any = distributed.Client
            self._client = make(address, timeout=CONNECT, set_as_default=False)
        except (OSError, ValueError, TimeoutError) as error:
            raise UsageError(
                f"no Dask scheduler answers at {address}: {error}",
                advice="Start one: dask scheduler. It says its address.",
            ) from None

    def close(self) -> None:
        """Leave the cluster. Tasks that wait there are given up."""
        self._client.close(timeout=CONNECT)

    def verdicts(self, asked: Sequence[CampaignRun]) -> Iterator[RunVerdict]:
        """Yield the verdicts of some runs, in their order. WorldError if the cluster gives none."""
        size = TABLE_RUNS if self._world == TABLE else OTHER_RUNS
        parts = [asked[first : first + size] for first in range(0, len(asked), size)]
        waiting: list[Any] = []
        for number, part in enumerate(parts):
            while len(waiting) < min(AHEAD, len(parts) - number):
                waiting.append(self._handed(parts[number + len(waiting)]))
            yield from self._told(waiting.pop(0), len(part))

    def _handed(self, runs: Sequence[CampaignRun]) -> Any:
        lines = [json.dumps(run_as_json(one)) for one in runs]
        given = (self._files, self._main, self._world, self._code, lines)
        return self._client.submit(carried_out, *given, pure=False)

    def _told(self, future: Any, count: int) -> list[RunVerdict]:
        """Wait for a task, and check what it says."""
        until = time.monotonic() + HELP
        while not future.done():
            heed()
            time.sleep(LOOK)
            if self._has_help():
                until = time.monotonic() + HELP
            elif time.monotonic() > until:
                raise WorldError(
                    f"the scheduler has had no worker for {HELP:g} s",
                    advice="Start one: dask worker ADDRESS. --resume goes on.",
                )
        if future.status != "finished":
            raise _dead(str(future.exception(timeout=CONNECT)))
        said = future.result(timeout=CONNECT)
        if isinstance(said, str):
            raise WorldError(f"a worker of the cluster refuses: {said[:500]}")
        if not isinstance(said, list) or len(said) != count:
            raise _dead("it said what is no verdict")
        found = [_verdict(line) for line in said]
        if None in found:
            raise _dead("it said what is no verdict")
        return [one for one in found if one is not None]

    def _has_help(self) -> bool:
        return bool(self._client.scheduler_info(n_workers=1).get("workers"))


def carried_out(
    files: Mapping[str, bytes], main: str, world: str, code: str, lines: Sequence[str]
) -> list[str] | str:
    """Carry out some runs on a computer of the cluster. Return a line for each verdict, or why not
    in one sentence.
    """
    with tempfile.TemporaryDirectory(prefix="smsl-campaign-") as folder:
        for name, raw in files.items():
            place = Path(folder, *PurePosixPath(name).parts)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(raw)
        file = str(Path(folder, *PurePosixPath(main).parts))
        try:
            if code_of(read(file), world) != code:
                return f"its program or the code of the world {world} is another one"
            runs = [run_of_json(json.loads(line)) for line in lines]
            with closing(CampaignWorkers(file, 1)) as workers:
                return [json.dumps(verdict_as_json(one)) for one in workers.verdicts(runs)]
        except StudioError as error:
            return str(error)


def files_of(blueprint: Blueprint) -> tuple[dict[str, bytes], str]:
    """Return all files that a run of the blueprint reads, by names relative to one folder, and the
    name of its own file. UsageError if it stands in no file.
    """
    parts = (blueprint, *runnable_procedures(blueprint).parts)
    own = Path(blueprint.file).resolve()
    if not own.is_file():
        raise UsageError("workers need a blueprint in a file", advice="Save it first.")
    found = {Path(one.file).resolve(): one.encoded() for part in parts for one in part.documents}
    for beside in (bindings_beside(part.file).text.file for part in parts):
        if beside:
            found[Path(beside).resolve()] = read_content(beside).raw
    root = Path(os.path.commonpath([one.parent for one in found]))
    files = {one.relative_to(root).as_posix(): raw for one, raw in sorted(found.items())}
    # The mark of a project, so that an import of a folder above stays inside.
    files["smsl.toml"] = files.get("smsl.toml", b"")
    return files, own.relative_to(root).as_posix()


def code_of(blueprint: Blueprint, world: str) -> str:
    """Return the SHA-256 of the code that a run depends on: this program and that of the world."""
    package = Path(__file__).parents[1]
    program = [
        f"{one.relative_to(package).as_posix()} {sha256_hex(one.read_bytes())}"
        for one in sorted(package.rglob("*.py"))
    ]
    survey = surveyed(blueprint, world)
    bound = survey.code.model_dump_json() if survey.code is not None else survey.missing
    return sha256_hex("\n".join((version(), *program, bound)).encode())


def _verdict(line: object) -> RunVerdict | None:
    try:
        return verdict_of_json(json.loads(line)) if isinstance(line, str) else None
    except (ValueError, RecursionError):
        return None


def _dead(why: str) -> WorldError:
    return WorldError(
        f"the cluster gave no verdict: {why[:500]}",
        advice="What is done is kept; --resume goes on. A plugin may have crashed.",
    )
