"""The answer to the question whether a run may start. The request of the run carries it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.errors import RunRefused
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.library.bindings_file import BindingsFile
from smsl_studio.library.loaded import Loaded
from smsl_studio.monitor.bus import SourceKey

Json = Any


@dataclass(frozen=True)
class RunTrust:
    """Whether a run may start, and what was verified for this.

    ``met`` has the typed conditions that are met. ``code`` has the SHA-256 of the signed code, by
    location. ``header`` is the part for the log. ``words`` say in one line who approved the
    blueprint, and whose keys count. ``loaded`` has the plugins as they were verified. ``bindings``
    is the bindings file that was signed, and ``speakers`` the nodes that its room lets speak for a
    source. ``hardware`` says that the world counts as hardware.
    ``badge`` has the words of the approval badge. ``generated_edges`` is what the policy says about
    edges that are generated in a run: never or confirmed.
    """

    refusals: tuple[Refusal, ...] = ()
    met: tuple[str, ...] = ()
    code: Mapping[str, str] = field(default_factory=dict)
    header: Mapping[str, Json] = field(default_factory=dict)
    words: str = ""
    loaded: Loaded | None = None
    bindings: BindingsFile | None = None
    hardware: bool = False
    badge: str = ""
    speakers: Mapping[SourceKey, str] | None = None
    generated_edges: str = "never"

    @property
    def barred(self) -> str:
        """The code for which a world is refused that says only when it is reached that it is
        hardware. Empty if a policy is met that names a register."""
        if self.refusals or not self.header.get("policy"):
            return "policy_unmet"
        return "" if self.header.get("register") else "register_invalid"

    def must_hold(self) -> None:
        """Raise RunRefused if there are refusals."""
        if self.refusals:
            words = "; ".join(one.sentence for one in self.refusals)
            advice = "smsl-studio verify tells what is missing."
            told = [(one.code, one.sentence) for one in self.refusals]
            raise RunRefused(f"it is not approved: {words}", advice=advice, refusals=told)
