"""The site: the arm with its pointer, the phantom, the tracker, and what the navigation knows."""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import TYPE_CHECKING

import numpy as np

from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Body, Floor, Robot
from smsl_studio.world.kinematics import rotation_of_rpy
from smsl_studio.world.known_values import refuse_others
from smsl_studio.world.meshes import soup, turned

from .navigation import GOOD, Array, Fit, Navigation, fit
from .phantom import (
    CENTRE,
    COUNT,
    LANDMARK,
    NAME,
    TARGETS,
    landmark_bodies,
    landmarks,
    phantom_body,
)
from .tracker import MOVED, Stand, Tracker, apart, camera_body, reference_body

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.world.bullet import BulletWorld

POINTER = 0.15
"""The length (m) of the pointer, from the flange to its tip."""

PLANNED, DIGITIZED, POSED, REGISTERED = "planned", "digitized", "posed", "registered"
MEANINGS = {4: (PLANNED, DIGITIZED, POSED, REGISTERED), 3: (PLANNED, DIGITIZED, REGISTERED)}
"""What the facts of the root mean, by their number."""

ARM = Robot(
    "iiwa",
    "kuka_iiwa/model.urdf",
    tool="lbr_iiwa_link_7",
    rest=(0.0, 0.55, 0.0, -1.45, 0.0, 1.14, 0.0),
    point=(0.0, 0.0, POINTER),
    mesh=soup(turned([(0, 0), (0.02, 0), (0.02, 0.05), (0.004, 0.06), (0.0015, 0.149), (0, 0.15)])),
    colour=(0.75, 0.77, 0.8),
)


class Site:
    """One patient's site. ``navigation`` is replaced as a whole by each operation.

    ``bend`` is how far (m) the tip of the pointer really is from where its calibration has it, in
    the frame of the tool.
    """

    def __init__(self, world: BulletWorld, blueprint: Blueprint, seed: int) -> None:
        roots = [blueprint[name] for name in blueprint.roots]
        if len(roots) != 1 or roots[0].num_facts not in MEANINGS:
            raise WorldError(
                "the registration world needs one root with 3 or 4 facts:"
                " landmarks planned and digitized, with 4 facts the tool pose, and registered",
                advice="Use the world table, which runs any blueprint.",
            )
        refuse_others(roots[0], MEANINGS[roots[0].num_facts], ("0", "1"))
        self.world, self.seed = world, seed
        self.root, self._meanings = roots[0].name, MEANINGS[roots[0].num_facts]
        self.tracker = Tracker(world, seed)
        self._shown = 0
        self._begin()

    def furnish(self) -> None:
        """Put all bodies into the empty world."""
        self.world.add(Body("floor", Floor(), (0.0, 0.0, 0.0)))
        for body in (phantom_body(), reference_body(), camera_body(), *landmark_bodies()):
            self.world.add(body)
        self.world.add(ARM)
        self.world.settle()

    def arrange(self, facts: Mapping[tuple[str, int], str]) -> None:
        """Begin again where these facts hold. Equal facts and an equal seed give an equal site."""
        self.world.rebuild()
        self.tracker.restart()
        self._begin()
        true = {self.meaning(*key) for key, value in facts.items() if value == "1"}
        if REGISTERED in true and not {PLANNED, DIGITIZED} <= true:
            raise WorldError("a registration needs planned and digitized landmarks")
        self._make(true)
        self.navigation = self.navigation.saving(None)

    def save_one(self) -> None:
        """Save a registration as somebody may have made it before, where the reference stands."""
        kept, self.navigation = self.navigation, Navigation()
        self._make({PLANNED, DIGITIZED, REGISTERED})
        self.navigation = kept.saving(self.navigation.saving(None))

    def _make(self, true: Container[str]) -> None:
        """Let these facts hold, as if the operations for them had been carried out."""
        if PLANNED in true:
            self.navigation = self.navigation.with_plan(self.plan())
        if DIGITIZED in true:
            stand = self.tracker.stand
            for number, point in enumerate(self.tracker.averaged(list(self.marks()))):
                self.navigation = self.navigation.with_measure(number, point, stand)
        if POSED in true:
            self.plan_pose()
        if REGISTERED in true:
            self.register()

    @property
    def navigation(self) -> Navigation:
        """What is known of the patient."""
        return self._navigation

    @navigation.setter
    def navigation(self, now: Navigation) -> None:
        self._navigation = now
        plan = now.plans if len(now.planned) else 0
        if plan != self._shown:
            self._shown = plan
            places = self.marks() if plan else np.tile(CENTRE, (COUNT, 1))
            for number, (x, y, z) in enumerate(places.tolist()):
                self.world.place(f"{LANDMARK} {number + 1}", (x, y, z))

    def _begin(self) -> None:
        """Begin in a world that was just built, where no landmark is shown."""
        self._shown = 0
        self.navigation = Navigation()
        self.bend: Array = np.zeros(3)
        draw = np.random.default_rng([self.seed, 104729])
        roll, pitch, yaw = draw.uniform(-0.6, 0.6, 3).tolist()
        self._turn = rotation_of_rpy((roll, pitch, yaw))
        self._shift = draw.uniform(-0.1, 0.1, 3)

    # -- facts ---------------------------------------------------------------------------------

    def meaning(self, branch: str, digit: int) -> str:
        """Return what a fact means; ``digit`` counts from 0."""
        return self._meanings[digit] if branch == self.root else DIGITIZED

    def reading(self, meaning: str) -> str | None:
        """Return the value of a fact, None if the tracker does not see what it needs to see."""
        now = self.navigation
        if meaning == PLANNED:
            return "1" if len(now.planned) else "0"
        if meaning == POSED:
            return "1" if now.pose is not None else "0"
        if self.tracker.occluded:
            return None
        if meaning == DIGITIZED:
            return "1" if now.complete and self.is_where(now.stand) else "0"
        found = now.fit
        return "1" if found and found.error <= GOOD and self.is_where(found.stand) else "0"

    def is_where(self, stand: Stand | None) -> bool:
        """Whether reference and phantom stand to each other as they did then."""
        return stand is not None and apart(stand, self.tracker.stand) < MOVED

    def no_previous(self) -> str:
        """Return why no earlier registration can be used now, or the empty text."""
        saved = self.navigation.saved
        if saved is None or saved.fit is None:
            return "no registration was saved"
        if self.tracker.occluded:
            return "the tracker does not see the reference"
        moved = apart(saved.fit.stand, self.tracker.stand)
        if moved >= MOVED:
            return f"the reference has moved by {1000 * moved:.1f} mm since it was saved"
        return ""

    # -- planning and registering --------------------------------------------------------------

    def marks(self) -> Array:
        """Return the landmarks as they are in the room where the phantom should stand, (n, 3)."""
        return CENTRE + landmarks(self.seed, max(self.navigation.plans - 1, 0))

    def plan(self) -> Array:
        """Return the landmarks of the next plan, in the image."""
        return self.in_image(CENTRE + landmarks(self.seed, self.navigation.plans))

    def plan_pose(self) -> None:
        """Plan the pose of the tool: an entry on the surface, and the direction inwards."""
        entry, inwards = np.add(CENTRE, (0.0, 0.03, 0.07)), np.array([0.0, -0.4, -0.9])
        direction = inwards / np.linalg.norm(inwards) @ self._turn
        self.navigation = self.navigation.with_pose(self.in_image(entry[None])[0], direction)

    def in_image(self, points: Array) -> Array:
        """Return points of the room, (n, 3), in the image: that of the phantom, where it should
        stand."""
        return (points - CENTRE - self._shift) @ self._turn

    def register(self) -> Fit:
        """Fit the planned landmarks to the measured ones, and save the registration."""
        now = self.navigation
        stand = now.stand or self.tracker.stand
        measured = np.array([now.measured[number] for number in sorted(now.measured)])
        found = fit(now.planned, measured, stand)
        self.navigation = now.registered(found)
        return found

    def told(self, found: Fit) -> str:
        """Return how good a registration is: FRE, the greatest TRE, and the pose of the tool."""
        targets = CENTRE + TARGETS
        off = found.to_reference(self.in_image(targets)) - self._exactly(targets)
        words = [
            f"FRE {1000 * found.error:.3f} mm",
            f"TRE {1000 * float(np.linalg.norm(off, axis=1).max()):.3f} mm",
        ]
        pose = self.navigation.pose
        if pose is not None:
            entry, inwards = pose
            there = found.to_reference(np.array([entry, entry + 0.1 * inwards]))
            room = (np.array([entry, entry + 0.1 * inwards]) @ self._turn.T) + CENTRE + self._shift
            real = self._exactly(room)
            one, other = there[1] - there[0], real[1] - real[0]
            cosine = one @ other / np.linalg.norm(one) / np.linalg.norm(other)
            angle = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
            words.append(
                f"tool pose {1000 * float(np.linalg.norm(there[0] - real[0])):.3f} mm,"
                f" {float(angle):.3f} deg"
            )
        return ", ".join(words)

    def _exactly(self, points: Array) -> Array:
        return np.array([self.tracker.exactly(point) for point in points])

    def centre(self) -> Array:
        """Return where the middle of the phantom really is (m)."""
        return np.array(self.world.pose(NAME)[0])
