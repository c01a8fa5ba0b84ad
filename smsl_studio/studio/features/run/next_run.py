"""The next run: what a person has chosen for it in the transport."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.states import Choices, choices, short_name
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.run.supervisor_choice import NOBODY
from smsl_studio.studio.features.run.transport import Transport
from smsl_studio.studio.running.next_levels import NextLevels
from smsl_studio.studio.running.run_choice import RunChoice
from smsl_studio.studio.running.run_session import RunSession

Wanted = tuple[Blueprint, str, int, Loaded, str]
GIVEN = "given states"
"""The data of the entry for a start of several states. No address has this text."""

WITH = "\t"
"""What stands between a world and its robot in the data of an entry. No name has it."""


class NextRun:
    """Offers choices from the drawing in ``transport``, and reads what is chosen.

    While a run exists, or results of another version than the drawing are shown, the choices are
    those of that run and are locked. ``loaded`` are the plugins found last; None until they are
    known.
    """

    def __init__(
        self, session: Session, run: RunSession, transport: Transport, levels: NextLevels
    ) -> None:
        self._session, self._run, self._transport, self._levels = session, run, transport, levels
        self._offered = False
        self._given: tuple[str, ...] = ()
        self.loaded: Loaded | None = None
        self.step: tuple[tuple[str, ...], str] | None = None
        """Start states and goal of one step that somebody wants to see; None for a usual run."""
        self.supervisors = NOBODY
        """The automatic supervisors that a person chose."""

    @property
    def wanted(self) -> Wanted | None:
        """Blueprint, world, seed, plugins and robot of the run that Play would begin.

        None if there would be none.
        """
        world = self.world
        if self._run.exists or self.loaded is None or self._session.broken is not None or not world:
            return None
        if self.is_fixed:
            return None
        seed = int(self._transport.seed.text() or 0)
        return self._session.blueprint, world, seed, self.loaded, self.robot

    @property
    def choice(self) -> RunChoice:
        """The present choice for the next run."""
        transport = self._transport
        start = transport.start.currentData() or ""
        if self.step is not None:
            return self._of_step(*self.step)
        return RunChoice(
            world=self.world,
            start="" if start == GIVEN else start,
            starts=self._given if start == GIVEN else (),
            goal=transport.goal.currentData() or "",
            seed=int(transport.seed.text() or 0),
            by_hand=transport.by_hand.isChecked(),
            levels=self._levels.set,
            robot=self.robot,
            agents=self.supervisors.agents,
            forecast=self.supervisors.forecast,
        )

    @property
    def world(self) -> str:
        """The chosen world, empty if none is offered yet."""
        return (self._transport.world.currentData() or "").partition(WITH)[0]

    @property
    def robot(self) -> str:
        """The chosen robot, empty if it is the usual one."""
        return (self._transport.world.currentData() or "").partition(WITH)[2]

    def _of_step(self, starts: tuple[str, ...], goal: str) -> RunChoice:
        """The choice for one step, in the chosen world."""
        transport = self._transport
        seed = int(transport.seed.text() or 0)
        levels, robot = self._levels.set, self.robot
        return RunChoice(
            self.world, goal=goal, seed=seed, levels=levels, starts=starts, robot=robot
        )

    @property
    def is_fixed(self) -> bool:
        """Whether the choices are those of the run that is shown."""
        return self._run.exists or self._run.is_another(self._session.blueprint)

    def forget_offer(self) -> None:
        """Compute the offered choices again, because the drawing or the plugins changed."""
        self._offered = False

    def start_at(self, states: tuple[str, ...]) -> None:
        """Select a start that consists of several states (addresses)."""
        self._given, self._offered = states, False
        self.offer()
        self._transport.choose_start(GIVEN)

    def _given_start(self, blueprint: Blueprint) -> Choices:
        """Return the start of several states, as long as all of them exist in the drawing."""
        words = []
        for text in self._given:
            names = Address.split(text)
            branch = blueprint.branches.get(names[0])
            if branch is None or len(names) < 2 or names[1] not in branch.table:
                self._given = ()
                return []
            words.append(f"{names[0]} {short_name(branch, names[1])}")
        return [(", ".join(words), GIVEN)] if words else []

    def _worlds(self, blueprint: Blueprint) -> Iterator[tuple[str, str]]:
        """Yield the worlds that suit the drawing, each with its usual robot, then with every other
        one."""
        if self.loaded is None:
            return
        for world in front.worlds_for(blueprint, loaded=self.loaded):
            yield world, world
            for robot in self.loaded.robots(world)[1:]:
                yield f"{world}, {robot}", f"{world}{WITH}{robot}"

    def offer(self) -> None:
        """Offer the choices of the drawing, or show and lock those of the run."""
        if self.is_fixed:
            choice = self._run.choice
            if choice is not None:
                start = GIVEN if choice.starts else choice.start
                where = f"{choice.world}{WITH}{choice.robot}" if choice.robot else choice.world
                self._transport.show_choice(where, start, choice.goal, choice.seed)
        elif not self._offered:
            self._offered = True
            blueprint = self._session.blueprint
            starts, goals = choices(blueprint)
            starts = [*starts, *self._given_start(blueprint)]
            self._transport.offer(list(self._worlds(blueprint)), starts, goals)
        self._transport.lock(self.is_fixed)
