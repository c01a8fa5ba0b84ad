"""What a campaign has done so far, kept in a file beside its result.

Each line has the key of a run and its verdict. The key is a digest of everything that the run
depends on, so that a line of another blueprint, plugin or version is never taken over.
"""

from __future__ import annotations

import json
from pathlib import Path
from types import TracebackType
from typing import IO, Any

from smsl_studio.blueprint.digests import digests
from smsl_studio.errors import SaveError
from smsl_studio.front.campaign_runs import RunVerdict
from smsl_studio.front.request import RunRequest
from smsl_studio.front.version import version
from smsl_studio.front.world_codes import surveyed
from smsl_studio.seal.digest import sha256_hex

Json = Any
_KINDS = {"reached": bool, "recovered": bool, "reason": str, "sha256": str}


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
            code = surveyed(request.blueprint, request.world).code
            self._base = f"{version()} {said.closure} {said.meaning} {request.world} {code}"
        acts = [
            (act.trigger.kind, act.trigger.address, act.do, sorted(act.given.items()))
            for act in (request.script.acts if request.script else ())
        ]
        starts = [str(one) for one in request.starts]
        asked = json.dumps([self._base, request.seed, starts, acts], default=str)
        return sha256_hex(asked.encode("utf-8", "surrogatepass"))

    def keep(self, key: str, verdict: RunVerdict) -> RunVerdict:
        """Keep a verdict, and return it."""
        self.known[key] = verdict
        if self._path is not None:
            try:
                if self._file is None:
                    self._file = self._path.open("a", encoding="ascii")
                values = {"key": key, **{name: getattr(verdict, name) for name in _KINDS}}
                self._file.write(json.dumps(values) + "\n")
                self._file.flush()
            except OSError as error:
                words = error.strerror or str(error)
                raise SaveError(f"{self._path} was not written: {words}") from None
        return verdict

    def drop(self) -> None:
        """Delete the file, because the result is written."""
        self.__exit__(None, None, None)
        if self._path is not None:
            self._path.unlink(missing_ok=True)

    def _read(self, path: Path) -> None:
        """Read the lines of an earlier campaign. A line that is cut or odd is left out."""
        try:
            lines = path.read_bytes().splitlines()
        except OSError:
            return
        for line in lines:
            try:
                values = json.loads(line)
            except ValueError:
                continue
            if isinstance(values, dict) and set(values) == {"key", *_KINDS}:
                told = {name: values[name] for name in _KINDS}
                if all(type(told[name]) is kind for name, kind in _KINDS.items()):
                    self.known[str(values["key"])] = RunVerdict(**told)

    def __enter__(self) -> CampaignPart:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._file is not None:
            self._file.close()
            self._file = None
