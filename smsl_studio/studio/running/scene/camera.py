"""An orbit camera for the world. Angles in radians, lengths in metres, z up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, pi, sin, tan

import numpy as np
from numpy.typing import NDArray

from smsl_studio.world.kinematics import rotation_of
from smsl_studio.world.protocol import Shape

Matrix = NDArray[np.float32]
Box3 = tuple[tuple[float, float, float], tuple[float, float, float]]
"""The least and the greatest corner of a box (m)."""

Corner = NDArray[np.float64]

NEAREST, FARTHEST = 0.15, 8.0
"""The least and the greatest distance (m) of a camera from its target."""

HAND, SMALL_HAND, FILLED = 0.2, 0.6, (0.86, 0.78)
"""The room (m) above what a view shows, for a hand that works there: at most this share of the
longer side of a small table. And the share of the width and of the height of a picture that a view
fills at most: below things stand their names."""

EIGHT = tuple((i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1))


@dataclass(frozen=True)
class WorldCamera:
    """Looks at ``target`` from ``distance`` away; ``azimuth`` 0 looks along -x."""

    target: tuple[float, float, float] = (0.48, 0.0, 0.095)
    distance: float = 0.62
    azimuth: float = 0.36
    elevation: float = 0.46
    field_of_view: float = 0.6

    @property
    def eye(self) -> NDArray[np.float64]:
        """The position of the eye in the world frame."""
        across = self.distance * cos(self.elevation)
        offset = (
            across * cos(self.azimuth),
            across * sin(self.azimuth),
            self.distance * sin(self.elevation),
        )
        return np.asarray(np.array(self.target) + np.array(offset), dtype=np.float64)

    def framing(self, box: Box3, aspect: float, foot: float = 0.0) -> WorldCamera:
        """The camera on the same side of a box of the world, as near as the box and the room above
        it, where a hand works, fit into a picture. ``aspect`` is its width over its height, and
        ``foot`` the share of the height at the bottom that shall stay free."""
        low, high = np.array(box[0]), np.array(box[1])
        high[2] += min(HAND, SMALL_HAND * float(max(high[:2] - low[:2])))
        x, y, z = ((low + high) / 2).tolist()
        near, far = NEAREST, FARTHEST
        down = foot * tan(self.field_of_view / 2)

        def at(distance: float) -> WorldCamera:
            """The camera so far away, with the box above the free foot."""
            return replace(self, target=(x, y, z), distance=distance).panned(0, -down * distance)

        for _ in range(24):
            middle = (near + far) / 2
            seen = at(middle).shows(low, high, aspect, foot)
            near, far = (near, middle) if seen else (middle, far)
        return at(far)

    def shows(self, low: Corner, high: Corner, aspect: float, foot: float = 0.0) -> bool:
        """Whether a box of the world (m) lies inside the picture, with a margin, and above the
        share ``foot`` of its height."""
        corners = [[(low, high)[part][axis] for axis, part in enumerate(one)] for one in EIGHT]
        points = np.hstack([np.array(corners), np.ones((8, 1))])
        clip = points @ self.view_projection(aspect).T.astype(np.float64)
        depth = clip[:, 3:]
        if (depth <= 0.02).any():
            return False
        # The middle of what is above the foot stands so much higher than that of the picture.
        flat = clip[:, :2] / depth - np.array((0.0, foot))
        return bool((np.abs(flat) < np.array(FILLED) * (1.0, 1.0 - foot)).all())

    def at(self, target: tuple[float, float, float]) -> WorldCamera:
        """The camera that looks at another point (m) from the same side and distance."""
        return replace(self, target=target)

    def orbited(self, right: float, up: float) -> WorldCamera:
        """The camera turned around its target.

        It stays above the table and does not pass the top.
        """
        elevation = min(max(self.elevation + up, 0.03), pi / 2 - 0.02)
        return replace(self, azimuth=self.azimuth - right, elevation=elevation)

    def zoomed(self, factor: float) -> WorldCamera:
        """The camera at ``factor`` times the distance, between the nearest and the farthest."""
        return replace(self, distance=min(max(self.distance * factor, NEAREST), FARTHEST))

    def panned(self, right: float, up: float) -> WorldCamera:
        """The camera with its target moved in the plane of the picture (metres)."""
        side = np.array((-sin(self.azimuth), cos(self.azimuth), 0.0))
        high = np.array(
            (
                -sin(self.elevation) * cos(self.azimuth),
                -sin(self.elevation) * sin(self.azimuth),
                cos(self.elevation),
            )
        )
        x, y, z = np.array(self.target) + side * right + high * up
        return replace(self, target=(float(x), float(y), float(z)))

    def view_projection(self, aspect: float) -> Matrix:
        """The row-major (4, 4) matrix from world to clip space; ``aspect`` is width over height."""
        forward = np.array(self.target) - self.eye
        forward /= np.linalg.norm(forward)
        side = np.cross(forward, (0.0, 0.0, 1.0))
        side /= np.linalg.norm(side)
        up = np.cross(side, forward)
        view = np.eye(4)
        view[0, :3], view[1, :3], view[2, :3] = side, up, -forward
        view[:3, 3] = -view[:3, :3] @ self.eye
        near, far = 0.02, 30.0
        scale = 1.0 / tan(self.field_of_view / 2)
        projection = np.zeros((4, 4))
        projection[0, 0], projection[1, 1] = scale / max(aspect, 0.01), scale
        projection[2, 2] = (far + near) / (near - far)
        projection[2, 3] = 2 * far * near / (near - far)
        projection[3, 2] = -1.0
        return np.asarray(projection @ view, dtype=np.float32)

    def pixels(self, points: Corner, width: float, height: float) -> Corner | None:
        """The pixels, (n, 2), of world points, (n, 3), in a picture of this size; None if one of
        them is behind the camera."""
        clip = np.hstack([points, np.ones((len(points), 1))])
        clip = clip @ self.view_projection(width / max(height, 1.0)).T.astype(np.float64)
        if (clip[:, 3] <= 0).any():
            return None
        flat = clip[:, :2] / clip[:, 3:]
        found: Corner = np.stack([(flat[:, 0] + 1) * width, (1 - flat[:, 1]) * height], axis=1) / 2
        return found


def own_corners(shape: Shape) -> Corner | None:
    """The corners (m), (8, 3), of the box around a shape in its own frame. None without a mesh."""
    mesh = np.array(shape.mesh, dtype=np.float64).reshape(-1, 3)
    if not len(mesh):
        return None
    ends = np.stack([mesh.min(axis=0), mesh.max(axis=0)])
    return np.array([[ends[i, 0], ends[j, 1], ends[k, 2]] for i, j, k in EIGHT])


def placed(corners: Corner, pose: Sequence[float]) -> Corner:
    """Points of a frame, (n, 3), in the world. ``pose`` has position (m) and quaternion."""
    x, y, z, w = pose[3:7]
    found: Corner = corners @ rotation_of((x, y, z, w)).T + np.array(pose[:3])
    return found


def box_of(shapes: Sequence[Shape], poses: Sequence[float]) -> Box3 | None:
    """The box around some shapes at their poses: its least and its greatest corner (m). None
    without shapes."""
    corners = []
    for number, shape in enumerate(shapes):
        own = own_corners(shape)
        if own is not None:
            corners.append(placed(own, poses[7 * number : 7 * number + 7]))
    if not corners:
        return None
    every = np.vstack(corners)
    (a, b, c), (d, e, f) = every.min(axis=0).tolist(), every.max(axis=0).tolist()
    return (a, b, c), (d, e, f)


WHOLE = "Whole arm"
"""The view that shows everything. The others show the things that have a label."""

VIEWS = {
    "Front right": WorldCamera(),
    "Front": WorldCamera(azimuth=0.0, elevation=0.3),
    "Side": WorldCamera(azimuth=pi / 2, elevation=0.3),
    "Top": WorldCamera(azimuth=0.0, elevation=pi / 2 - 0.02, distance=0.8),
    WHOLE: WorldCamera(target=(0.25, 0.0, 0.35), distance=1.9, azimuth=0.6, elevation=0.32),
}
