"""What a person may choose for a campaign, and what a person has chosen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from smsl_studio import front
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.front.agents.asked_agent import asked_agents
from smsl_studio.front.agents.shipped import shipped
from smsl_studio.front.campaign_faults import ALL, ROUTE, CampaignRequest
from smsl_studio.front.views.states import Choices, choices
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.table_faults import table_faults
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.world.engines import TABLE

MOST_SEEDS = 1_000_000
Words = tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class CampaignChoice:
    """What was chosen. ``faults`` are names, ``agents`` texts as ``--supervisor`` has them.

    ``start`` and ``goal`` are addresses, empty for the usual ones. ``until`` is the width of the
    intervals at which the campaign ends, None for all seeds.
    """

    world: str = TABLE
    robot: str = ""
    start: str = ""
    goal: str = ""
    seeds: int = 20
    faults: tuple[str, ...] = ()
    edges: str = ROUTE
    agents: tuple[str, ...] = ()
    workers: int = 1
    dask: str = ""
    until: float | None = None

    def request(self, blueprint: Blueprint, folder: Path) -> CampaignRequest:
        """Return the request. Its results are kept in a file of ``folder``, which is made.

        Campaigns of one version in one world share the file: a run is found there by all that it
        depends on.
        """
        folder.mkdir(parents=True, exist_ok=True)
        kept = sha256_hex(f"{digests(blueprint).closure} {self.world} {self.robot}".encode())
        return CampaignRequest(
            blueprint,
            self.world,
            seeds=self.seeds,
            faults=self.faults,
            edges=self.edges,
            workers=self.workers if not self.dask else 1,
            until=self.until,
            part=folder / f"{kept[:16]}.jsonl",
            robot=self.robot,
            dask=self.dask,
            starts=(self.start,) if self.start else (),
            goals=(self.goal,) if self.goal else (),
            agents=self.agents,
        )

    def fault(self, known: Mapping[str, object]) -> str:
        """Return what is wrong with it in one sentence, empty if nothing is. ``known`` are the
        supervisors."""
        if not 1 <= self.seeds <= MOST_SEEDS:
            return f"Seeds are a number from 1 to {MOST_SEEDS:,}."
        try:
            for one in asked_agents(self.agents):
                if one.name not in known:
                    near = did_you_mean(one.name, known) or f"There are {', '.join(known)}."
                    return f"There is no supervisor {one.name}. {near}"
        except UsageError as error:
            return f"{error.sentence[:1].upper()}{error.sentence[1:]}. {error.advice}"
        if self.dask and ":" not in self.dask:
            return "The address of a Dask scheduler is written as tcp://HOST:PORT."
        return ""


@dataclass(frozen=True)
class CampaignOffer:
    """What may be chosen for a blueprint: worlds with robots, starts and goals, each with words."""

    blueprint: Blueprint
    loaded: Loaded | None

    @property
    def worlds(self) -> tuple[tuple[str, str, str], ...]:
        """Words, world and robot of each entry."""
        if self.loaded is None:
            return ((TABLE, TABLE, ""),)
        found = []
        for world in front.worlds_for(self.blueprint, loaded=self.loaded):
            found.append((world, world, ""))
            found += [(f"{world}, {one}", world, one) for one in self.loaded.robots(world)[1:]]
        return tuple(found)

    @property
    def starts(self) -> Words:
        """Words and address of each start, the usual one first and without its address."""
        return _usual(choices(self.blueprint)[0])

    @property
    def goals(self) -> Words:
        """Words and address of each goal, the usual one first and without its address."""
        return _usual(choices(self.blueprint)[1])

    def faults(self, world: str) -> tuple[str, ...]:
        """The names of the faults of a world."""
        if world == TABLE or self.loaded is None:
            return tuple(table_faults(self.blueprint))
        return tuple(self.loaded.faults_of(world))

    @property
    def supervisors(self) -> dict[str, object]:
        """All supervisors by name."""
        found: dict[str, object] = dict(shipped().supervisors)
        for plugin in self.loaded.plugins if self.loaded is not None else ():
            found.update(plugin.library.supervisors)
        return found

    def fitted(self, choice: CampaignChoice) -> CampaignChoice:
        """Return a choice without what this blueprint does not have."""
        if (choice.world, choice.robot) not in [one[1:] for one in self.worlds]:
            choice = replace(choice, world=self.worlds[0][1], robot="")
        starts, goals = ([one[1] for one in pairs] for pairs in (self.starts, self.goals))
        known = (*self.faults(choice.world), ALL)
        return replace(
            choice,
            start=choice.start if choice.start in starts else "",
            goal=choice.goal if choice.goal in goals else "",
            faults=tuple(one for one in choice.faults if one in known),
        )


def _usual(pairs: Choices) -> Words:
    return tuple((words, address if at else "") for at, (words, address) in enumerate(pairs))
