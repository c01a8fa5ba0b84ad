"""What a campaign has done so far, kept in a file beside its result.

Each line has the key of a run and its verdict. The key is a digest of everything that the run
depends on, so that a line of another blueprint, plugin or version is never taken over.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import IO, Any

from smsl_studio.blueprint.digests import digests
from smsl_studio.errors import SaveError
from smsl_studio.front.campaign_runs import RunVerdict, verdict_as_json, verdict_of_json
from smsl_studio.front.request import RunRequest
from smsl_studio.front.run_header import procedure_digests
from smsl_studio.front.version import version
from smsl_studio.front.world_codes import surveyed
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.files import read_content

Json = Any


class CampaignPart:
    """The verdicts that are known. ``path`` None keeps nothing."""

    def __init__(self, path: Path | None, resume: bool) -> None:
        self.known: dict[str, RunVerdict] = {}
        self._path, self._base = path, ""
        self._file: IO[str] | None = None
        if path is not None and resume:
            self._read(path)

    def key(self, request: RunRequest) -> str:
        """Return the key of a run."""
        if not self._base:
            said = digests(request.blueprint)
            below = procedure_digests(request.blueprint)
            survey = surveyed(request.blueprint, request.world)
            parts = (version(), said.closure, said.meaning, request.world, survey.code, below)
            robot = (request.robot,) if request.robot else ()
            self._base = repr((*parts, survey.bindings, *robot))
        acts = [
            (act.trigger.kind, act.trigger.address, act.do, sorted(act.given.items()))
            for act in (request.script.acts if request.script else ())
        ]
        starts = [str(one) for one in request.starts]
        more = [[str(one) for one in request.goals], list(request.agents)]
        if request.agents or request.goals:
            acts.append(("", "", repr(more), []))
        asked = json.dumps([self._base, request.seed, starts, acts], default=str)
        return sha256_hex(asked.encode("utf-8", "surrogatepass"))

    def keep(self, key: str, verdict: RunVerdict) -> RunVerdict:
        """Keep a verdict, and return it."""
        self.known[key] = verdict
        if self._path is not None:
            try:
                if self._file is None:
                    self._file = self._path.open("a", encoding="ascii")
                values = {"key": key, **verdict_as_json(verdict)}
                self._file.write(json.dumps(values) + "\n")
                self._file.flush()
            except OSError as error:
                words = error.strerror or str(error)
                raise SaveError(f"{self._path} was not written: {words}") from None
        return verdict

    def _read(self, path: Path) -> None:
        """Read the lines of an earlier campaign. A line that is cut or odd is left out."""
        if not path.exists():
            return
        for line in read_content(path).raw.splitlines():
            try:
                values = json.loads(line)
            except (ValueError, RecursionError):
                continue
            if isinstance(values, dict) and isinstance(key := values.pop("key", None), str):
                verdict = verdict_of_json(values)
                if verdict is not None:
                    self.known[key] = verdict

    def close(self) -> None:
        """Close the file. What is kept stays there."""
        if self._file is not None:
            self._file.close()
            self._file = None
