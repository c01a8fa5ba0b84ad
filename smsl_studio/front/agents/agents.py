"""Agents: several automatic supervisors as one. The most careful answer counts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from smsl_studio.dispatch.drive.supervisor import (
    ALLOW,
    ASK,
    TAKE_OVER,
    VETO,
    Proposal,
    Verdict,
)
from smsl_studio.front.agents.agent_process import AgentProcess
from smsl_studio.front.agents.asked_agent import asked_agents
from smsl_studio.library import supervisor_view

DECISIONS: Mapping[str, str] = MappingProxyType(
    {
        supervisor_view.APPROVE: ALLOW,
        supervisor_view.ASK: ASK,
        supervisor_view.VETO: VETO,
        supervisor_view.TAKE_OVER: TAKE_OVER,
    }
)


class Agents:
    """The supervisors of a run, by the texts that ask for them (see ``asked_agent``).

    UsageError if a text has another form. The names are looked up by ``open``.
    """

    def __init__(self, texts: Sequence[str], plugin_paths: Sequence[Path] = ()) -> None:
        self._asked = asked_agents(tuple(texts))
        self._process = AgentProcess(self._asked, plugin_paths)

    @property
    def name(self) -> str:
        """The names with their options, as they were asked for."""
        return " and ".join(one.text for one in self._asked)

    @property
    def estimates(self) -> bool:
        """They decide by the estimated risk, so it is told."""
        return True

    @property
    def forecasts(self) -> bool:
        """Whether one of them decides by forecasts; known after ``open``."""
        return self._process.forecasts

    def open(self) -> None:
        """Load the supervisors. UsageError if one does not exist, HostError if none can be
        loaded."""
        self._process.open()

    def review(self, proposal: Proposal) -> Verdict:
        """Ask all of them. The most careful answer counts, with its reason and who gave it."""
        view = proposal.view()
        worst = Verdict(ALLOW)
        rank = -1
        for number, one in enumerate(self._asked):
            answer, reason = self._process.ask(number, view)
            place = supervisor_view.ANSWERS.index(answer)
            if place > rank:
                who = f"{one.name}: " if len(self._asked) > 1 else ""
                rank, worst = place, Verdict(DECISIONS[answer], f"{who}{reason}" if reason else "")
        return worst

    def close(self) -> None:
        """End their process."""
        self._process.close()
