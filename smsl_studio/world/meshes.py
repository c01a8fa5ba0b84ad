"""Triangle meshes: reads OBJ and STL files, turns outlines into solids, and thins meshes. It needs
neither an engine nor Qt.

A mesh is an array (n, 3, 3) of float32 in metres: n triangles with 3 corners each,
counter-clockwise when seen from outside.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from smsl_studio.errors import WorldError
from smsl_studio.world.protocol import Vector

Mesh = NDArray[np.float32]
PLAIN: Vector = (0.93, 0.93, 0.94)
MESHES = "A robot is drawn from meshes in OBJ or STL files, which its URDF file names."


def soup(mesh: Mesh) -> tuple[float, ...]:
    """Return a mesh as the flat tuple of floats (m) of a ``Shape``, rounded to 0.001 mm."""
    return tuple(np.round(mesh.astype(np.float64), 6).ravel().tolist())


def scaled(mesh: Mesh, scale: Vector) -> Mesh:
    """Return a mesh with each axis multiplied by a number."""
    if scale == (1.0, 1.0, 1.0):
        return mesh
    return mesh * np.array(scale, dtype=np.float32)


@lru_cache(maxsize=64)
def read_mesh(path: Path, limit: int = 3500) -> tuple[tuple[Vector, Mesh], ...]:
    """Read the meshes of an OBJ or STL file, one for each colour, with about ``limit`` triangles
    together.

    WorldError with the name of the file if it is neither, or has no triangles.
    """
    try:
        if path.suffix.lower() == ".stl":
            found: tuple[tuple[Vector, Mesh], ...] = ((PLAIN, thinned(_stl(path), limit)),)
        else:
            found = read_obj(path, limit)
    except (OSError, ValueError, IndexError) as error:
        reason = getattr(error, "strerror", None) or "it is no OBJ or STL file"
        raise WorldError(f"the mesh {path.name} cannot be read: {reason}", advice=MESHES) from None
    if not any(len(mesh) for _, mesh in found):
        raise WorldError(f"the mesh {path.name} has no triangles", advice=MESHES)
    return found


_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("_", "<u2")])


def _stl(path: Path) -> Mesh:
    """Read an STL file, in its binary form or as text."""
    raw = path.read_bytes()
    if len(raw) >= 84 and len(raw) == 84 + _FACET.itemsize * int.from_bytes(raw[80:84], "little"):
        return np.frombuffer(raw, _FACET, offset=84)["corners"].astype(np.float32)
    lines = (line.split() for line in raw.splitlines())
    corners = [line[1:4] for line in lines if line[:1] == [b"vertex"]]
    return np.array(corners, dtype=np.float32).reshape(-1, 3, 3)


@lru_cache(maxsize=64)
def read_obj(path: Path, limit: int = 3500) -> tuple[tuple[Vector, Mesh], ...]:
    """Read the meshes of an OBJ file, one for each colour of its materials, with about ``limit``
    triangles together.

    The colour is the material's ``Kd``. All pale and tinted colours become the plain white of a
    robot's shell; dark colours stay.
    """
    vertices: list[bytes] = []
    faces: dict[Vector, list[list[int]]] = {}
    palette: dict[bytes, Vector] = {}
    current = faces.setdefault(PLAIN, [])
    for line in path.read_bytes().splitlines():
        if line.startswith(b"v "):
            vertices.append(line[2:])
        elif line.startswith(b"f "):
            current.append([int(corner.split(b"/", 1)[0]) for corner in line[2:].split()])
        elif line.startswith(b"usemtl "):
            current = faces.setdefault(palette.get(line[7:].strip(), PLAIN), [])
        elif line.startswith(b"mtllib "):
            palette = _palette(path.parent / line[7:].strip().decode())
    points = np.array(b" ".join(vertices).split(), dtype=np.float64).reshape(len(vertices), -1)
    meshes = {colour: _triangles(points[:, :3], found) for colour, found in faces.items() if found}
    total = sum(len(mesh) for mesh in meshes.values())
    return tuple(
        (colour, thinned(mesh, max(60, limit * len(mesh) // total)))
        for colour, mesh in meshes.items()
    )


def _palette(path: Path) -> dict[bytes, Vector]:
    colours: dict[bytes, Vector] = {}
    name = b""
    for line in path.read_bytes().splitlines() if path.exists() else ():
        words = line.split()
        if words[:1] == [b"newmtl"]:
            name = words[1]
        elif words[:1] == [b"Kd"]:
            r, g, b = (float(word) for word in words[1:4])
            colours[name] = (r, g, b) if max(r, g, b) < 0.5 else PLAIN
    return colours


def _triangles(points: NDArray[np.float64], faces: list[list[int]]) -> Mesh:
    fans = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
    indices = np.array(fans)
    indices = np.where(indices < 0, indices + len(points), indices - 1)
    mesh: Mesh = points[indices].astype(np.float32)
    return mesh


def thinned(mesh: Mesh, limit: int) -> Mesh:
    """Return a mesh with at most ``limit`` triangles. Corners in one cell of a grid are joined, and
    the grid grows until the mesh fits."""
    thin = mesh
    if len(mesh) > limit:
        sides = np.cross(mesh[:, 1] - mesh[:, 0], mesh[:, 2] - mesh[:, 0])
        cell = float(np.sqrt(np.linalg.norm(sides, axis=1).sum() / limit))
        while len(thin) > limit:
            thin = _clustered(mesh, cell)
            cell *= 1.15
    return thin


def _clustered(mesh: Mesh, cell: float) -> Mesh:
    """Move every corner to the mean of the corners in its grid cell, and remove triangles that
    collapse or double. ``cell`` is in metres."""
    corners = mesh.reshape(-1, 3).astype(np.float64)
    where = _numbered(np.floor(corners / cell).astype(np.int64))[1]
    count = np.bincount(where)
    means = np.stack([np.bincount(where, corners[:, k]) / count for k in range(3)], axis=1)
    a, b, c = where.reshape(-1, 3).T
    kept = where.reshape(-1, 3)[(a != b) & (b != c) & (c != a)]
    first = _numbered(np.sort(kept, axis=1))[0]
    clustered: Mesh = means[kept[np.sort(first)]].astype(np.float32)
    return clustered


def _numbered(rows: NDArray[np.int64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Give equal numbers to equal rows. Return the first row of each number, and the number of each
    row."""
    low = rows.min(axis=0)
    _, width, depth = rows.max(axis=0) - low + 1
    x, y, z = (rows - low).T
    _, first, number = np.unique(
        (x * width + y) * depth + z, return_index=True, return_inverse=True
    )
    return first, number


def moved(mesh: Mesh, rotation: NDArray[np.float64], offset: Sequence[float]) -> Mesh:
    """Return the mesh turned by a rotation matrix (3, 3), then moved by ``offset`` (m)."""
    placed: Mesh = (mesh @ rotation.T + np.asarray(offset)).astype(np.float32)
    return placed


def turned(outline: Sequence[tuple[float, float]], sides: int = 48) -> Mesh:
    """Return the solid of an outline of (radius, height) in metres, turned about the z axis.

    With the radius to the right and the height upwards, the outside is on the right of the outline:
    it runs up the outer wall, then inwards. ``sides`` is the number of parts of the circle.
    """
    angles = np.arange(sides + 1) * (2 * math.pi / sides)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    triangles = []
    for (r0, z0), (r1, z1) in pairwise(outline):
        for here, there in pairwise(circle):
            a, b = (*(r0 * here), z0), (*(r0 * there), z0)
            c, d = (*(r1 * there), z1), (*(r1 * here), z1)
            triangles += ([(a, b, c)] if r0 > 0 else []) + ([(a, c, d)] if r1 > 0 else [])
    return np.array(triangles, dtype=np.float32)


def slab(half: Vector) -> Mesh:
    """Return the mesh of a box around the origin, (12, 3, 3). ``half`` has half of its length along
    x, y and z (m)."""
    x, y, z = half
    corners = [(sx * x, sy * y, sz * z) for sz in (-1, 1) for sy in (-1, 1) for sx in (-1, 1)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    found = [
        [corners[one], corners[two], corners[three]]
        for a, b, c, d in sides
        for one, two, three in ((a, b, c), (a, c, d))
    ]
    return np.array(found, dtype=np.float32)


def capsule(radius: float, length: float) -> Mesh:
    """Return the mesh of a round rod along z with round ends. ``length`` is that of its straight
    part (m)."""
    arc = np.linspace(0.0, math.pi / 2, 6)
    dome = [(radius * math.cos(a), length / 2 + radius * math.sin(a)) for a in arc.tolist()]
    upper = [*dome[:-1], (0.0, length / 2 + radius)]
    return turned([(r, -z) for r, z in upper[::-1]] + upper, 24)


def rounded_box(half: Vector, share: float = 0.25, steps: int = 3) -> Mesh:
    """Return the mesh of a box with round edges. Their radius is a ``share`` of the smallest of its
    half lengths (m)."""
    radius = share * min(half)
    quarter = np.linspace(0.0, math.pi / 2, steps)
    inner = np.array(half) - radius
    rows = []
    for lower in (-math.pi / 2, 0.0):
        for up in (lower + quarter).tolist():
            row = []
            for turn in range(4):
                for around in (turn * math.pi / 2 + quarter).tolist():
                    flat = math.cos(up)
                    way = (flat * math.cos(around), flat * math.sin(around), math.sin(up))
                    sx, sy = ((1, 1), (-1, 1), (-1, -1), (1, -1))[turn]
                    corner = inner * (sx, sy, 1 if lower == 0.0 else -1)
                    row.append(corner + radius * np.array(way))
            rows.append([*row, row[0]])
    found = []
    for one, other in pairwise(rows):
        for (a, b), (d, c) in zip(pairwise(one), pairwise(other), strict=True):
            found += [(a, b, c), (a, c, d)]
    low, high = rows[0], rows[-1]
    for i in range(1, len(low) - 2):
        found += [(low[0], low[i + 1], low[i]), (high[0], high[i], high[i + 1])]
    return np.array(found, dtype=np.float32)


def hulls_obj(hulls: Sequence[Sequence[Vector]], faces: Sequence[Sequence[int]]) -> str:
    """Return OBJ text with one group for each convex hull. All hulls have the same faces over their
    own corners (m)."""
    lines: list[str] = []
    for number, corners in enumerate(hulls):
        base = number * len(corners) + 1
        lines.append(f"o hull_{number}")
        lines += [f"v {x:.7f} {y:.7f} {z:.7f}" for x, y, z in corners]
        lines += ["f " + " ".join(str(base + corner) for corner in face) for face in faces]
    return "\n".join(lines) + "\n"


def hulls_of(obj: str) -> list[list[Vector]]:
    """Return the corners (m) of each hull of a text that ``hulls_obj`` made."""
    hulls: list[list[Vector]] = []
    for line in obj.splitlines():
        word, *rest = line.split()
        if word == "o":
            hulls.append([])
        elif word == "v":
            x, y, z = map(float, rest)
            hulls[-1].append((x, y, z))
    return hulls
