"""The trust policy, a TOML file. It says whose signatures a blueprint needs before it may run."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator

from smsl_studio.errors import PluginError, SealError
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.library.toml_text import read_toml, toml_values
from smsl_studio.seal.strict_json import from_base64

_REVOKED = re.compile(r"(record:)?sha256:[0-9a-f]{64}")
Many = Annotated[int, Field(ge=1, le=1000)]


class TrustPolicy(BaseModel):
    """The rules of a trust policy. The defaults also apply if there is no policy.

    ``roles`` says how many different persons of each role must sign. ``persons`` says how many must
    sign in all; None means the sum of the roles, and at least one. ``register`` is a path relative
    to the policy. ``register_key`` is the public key that must have signed the register, in base64.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    roles: dict[str, Many] = {}
    persons: Many | None = None
    valid_days: Annotated[float, Field(gt=0, le=1e6)] | None = None
    automatic: Literal["never", "may_sign"] = "never"
    rules_unchanged: bool = False
    supervisor: bool = False
    generated_edges: Literal["never", "confirmed"] = "never"
    revoked: list[str] = []
    register_file: str | None = Field(default=None, alias="register")
    register_key: str | None = None

    @field_validator("revoked")
    @classmethod
    def _digests(cls, revoked: list[str]) -> list[str]:
        for one in revoked:
            if not _REVOKED.fullmatch(one):
                raise ValueError(f"{one[:80]!r} is no sha256:... and no record:sha256:...")
        return revoked

    @model_validator(mode="after")
    def _both(self) -> TrustPolicy:
        if (self.register_file is None) != (self.register_key is None):
            raise ValueError("register and register_key belong together")
        if self.register_key is not None:
            try:
                fits = len(from_base64(self.register_key, "register_key")) == 32
            except SealError as error:
                raise ValueError(error.sentence) from None
            if not fits:
                raise ValueError("register_key is not the base64 of 32 bytes")
        return self

    @property
    def needed(self) -> int:
        """The number of different persons who must sign."""
        return max(1, sum(self.roles.values())) if self.persons is None else self.persons

    @property
    def key(self) -> bytes:
        """The public key that signs the register."""
        return from_base64(self.register_key or "", "register_key")


USUAL = TrustPolicy()
"""The policy that applies if no file gives another one."""


def read_policy(path: Path, raw: bytes | None = None) -> TrustPolicy | Refusal:
    """Return the policy in a file. If its content is wrong, return the refusal ``policy_invalid``.

    ``raw`` are the bytes of the file, if somebody has read them already. PluginError if the file
    does not exist or cannot be read.
    """
    try:
        values = read_toml(path)[1] if raw is None else toml_values(raw, str(path))
    except PluginError as error:
        if error.sentence.startswith("cannot be read"):
            raise
        return Refusal("policy_invalid", f"{error.place}: {error.sentence}")
    return policy_of(values, str(path))


def policy_of(values: Mapping[str, Any], file: str) -> TrustPolicy | Refusal:
    """Return the policy in the content of a file, or the refusal ``policy_invalid``."""
    try:
        return TrustPolicy.model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        where = ".".join(str(part) for part in fault["loc"])
        said = fault["msg"].removeprefix("Value error, ")
        words = f"{where}: {said}" if where else said
        return Refusal("policy_invalid", f"the policy {file} is not valid: {words}")
