"""The file of the supervisor ``rules``: conditions on an operation, its risk and facts, in TOML.

::

    otherwise = "approve"

    [[rule]]
    operation = "SB1/*/Op_3*"      # all keys of a rule must fit
    declared = ["high", ""]        # one of these declared risks, "" for none
    risk_above = 0.5               # the estimated risk, from 0 to 1
    failed = 1                     # at least so often in this run
    age_above = 0.2                # of any fact, in seconds
    facts = { "SB1/0" = "a" }      # "?" is an unknown fact
    forecast = "differs"           # or agrees, or none
    answer = "veto"
    reason = "the largest disk stays"
"""

from __future__ import annotations

from collections.abc import Mapping
from fnmatch import fnmatchcase
from functools import lru_cache
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.errors import Place, ReadError
from smsl_studio.library.prediction import NONE
from smsl_studio.library.supervisor_view import SupervisorView
from smsl_studio.library.toml_text import read_toml

LARGEST = 1_000_000
"""The largest size of the file, in bytes."""
UNKNOWN = "?"
Answer = Literal["approve", "ask", "veto", "take_over"]
Text = Field(default="", max_length=2_000)


class AgentRule(BaseModel):
    """One rule. A condition that is left out always fits."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    operation: str = Field(default="*", max_length=2_000)
    declared: tuple[Literal["", "low", "medium", "high"], ...] | None = Field(None, strict=False)
    risk_above: float | None = Field(default=None, ge=0, le=1)
    failed: int = Field(default=0, ge=0)
    age_above: float | None = Field(default=None, ge=0)
    facts: Mapping[str, str] = Field(default_factory=dict)
    forecast: Literal["agrees", "differs", "none"] | None = None
    answer: Answer
    reason: str = Text

    def fits(self, view: SupervisorView) -> bool:
        """Return whether all conditions hold."""
        named = any(fnmatchcase(name, self.operation) for name in view.operations)
        if not named or (self.declared is not None and view.declared not in self.declared):
            return False
        if self.risk_above is not None and view.estimate.risk <= self.risk_above:
            return False
        if view.history.count((view.operation, "failed")) < self.failed:
            return False
        oldest = max((fact.age for fact in view.facts.values()), default=0.0)
        if self.age_above is not None and oldest <= self.age_above:
            return False
        told = NONE if view.forecast is None else view.forecast.verdict
        if self.forecast not in (None, told):
            return False
        return all(_value(view, name) == value for name, value in self.facts.items())


class RuleTable(BaseModel):
    """All rules of a file. The first one that fits decides, else ``otherwise``."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    otherwise: Answer = "approve"
    rule: tuple[AgentRule, ...] = Field(default=(), max_length=10_000)


@lru_cache(maxsize=4)
def read_rules(file: str) -> RuleTable:
    """Read a file of rules. ReadError or PluginError, with the place, if it does not fit."""
    text, values = read_toml(Path(file), LARGEST)
    try:
        return RuleTable.model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in fault["loc"])
        names = [str(part) for part in fault["loc"] if isinstance(part, str)]
        line = text.line_of(names[-1]) if names else 1
        raise ReadError(f"{key}: {fault['msg']}", Place(file, line, 1)) from None


def decision(table: RuleTable, view: SupervisorView) -> tuple[str, str]:
    """Return the answer of the first rule that fits, and its reason."""
    for number, rule in enumerate(table.rule, 1):
        if rule.fits(view):
            return rule.answer, rule.reason or f"rule {number} fits"
    return table.otherwise, "no rule fits"


def _value(view: SupervisorView, name: str) -> str:
    fact = view.facts.get(name)
    return UNKNOWN if fact is None or fact.value is None else fact.value
