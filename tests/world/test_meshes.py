"""Triangles: closed, facing outwards, not too many."""

from __future__ import annotations

import math
import struct
from pathlib import Path

import numpy as np
import pytest

from plugins.hanoi.disks import HOLE, MARGIN, disks_for, peg_body
from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Body, Hulls
from smsl_studio.world.meshes import (
    PLAIN,
    Mesh,
    moved,
    read_mesh,
    read_obj,
    scaled,
    soup,
    thinned,
    turned,
)
from smsl_studio.world.planned_world import MODELS


def _volume(mesh: Mesh) -> float:
    """The volume a closed mesh encloses; negative where its triangles face inwards."""
    a, b, c = mesh.astype(np.float64).transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def _mesh(body: Body) -> Mesh:
    return np.array(body.mesh, dtype=np.float32).reshape(-1, 3, 3)


def test_a_turned_outline_is_closed_and_faces_outwards() -> None:
    cylinder = turned([(0.0, 0.0), (0.1, 0.0), (0.1, 0.3), (0.0, 0.3)], sides=64)
    assert _volume(cylinder) == pytest.approx(math.pi * 0.01 * 0.3, rel=0.01)
    edges: dict[tuple[tuple[float, ...], ...], int] = {}
    for triangle in np.round(cylinder.astype(np.float64), 6).tolist():
        for i in range(3):
            edge = (tuple(triangle[i]), tuple(triangle[(i + 1) % 3]))
            edges[edge] = edges.get(edge, 0) + 1
    assert all(edges.get((b, a)) == count for (a, b), count in edges.items())


def test_a_ring_as_drawn_and_as_felt() -> None:
    for disk in disks_for(3):
        body = disk.body((0.0, 0.0, 0.0))
        solid = math.pi * (disk.radius**2 - HOLE**2) * disk.thickness
        assert _volume(_mesh(body)) == pytest.approx(solid, rel=0.05)
        assert isinstance(body.collision, Hulls)
        points = np.array(
            [line.split()[1:] for line in body.collision.obj.splitlines() if line[0] == "v"],
            dtype=float,
        )
        assert body.collision.obj.count("o hull_") == 8
        assert np.hypot(*points[:, :2].T).max() == pytest.approx(disk.radius - MARGIN)
        assert points[:, 2].max() == pytest.approx(disk.thickness / 2 - MARGIN)


def test_a_peg_stands_on_the_table() -> None:
    peg = peg_body("b")
    heights = _mesh(peg)[:, :, 2] + peg.position[2]
    assert heights.min() == pytest.approx(0.0, abs=1e-6)
    assert heights.max() == pytest.approx(0.045, abs=1e-6)
    assert _volume(_mesh(peg)) > 0
    assert peg.label == "b"


def test_thinning_keeps_the_form() -> None:
    ball = [(0.1 * math.cos(a), 0.1 * math.sin(a)) for a in np.linspace(-1.5707963, 1.5707963, 60)]
    mesh = turned(ball, sides=120)
    thin = thinned(mesh, 800)
    assert 200 < len(thin) <= 800
    assert _volume(thin) == pytest.approx(_volume(mesh), rel=0.08)
    assert thinned(mesh, len(mesh)) is mesh


def test_a_robot_link_keeps_its_dark_and_light_parts() -> None:
    file = MODELS / "franka_panda" / "meshes" / "visual" / "finger.obj"
    parts = dict(read_obj(file))
    assert [max(colour) < 0.5 for colour in parts] == [False, True]
    assert sum(map(len, parts.values())) == 624


def test_faces_of_many_corners_and_counted_from_the_end(tmp_path: Path) -> None:
    file = tmp_path / "square.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1/1 2//2 3 4\nf -4 -3 -2\n", "utf-8")
    ((_, mesh),) = read_obj(file)
    assert mesh.tolist()[0] == mesh.tolist()[2]
    assert len(mesh) == 3


TRIANGLE = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]


def test_stl_files_are_read_in_both_forms_and_scaled(tmp_path: Path) -> None:
    text, binary = tmp_path / "text.stl", tmp_path / "binary.STL"
    rows = "".join("vertex {} {} {}\n".format(*corner) for corner in TRIANGLE)
    text.write_text(f"solid x\nfacet normal 0 0 1\nouter loop\n{rows}endloop\nendfacet\nendsolid\n")
    corners = struct.pack("<9f", *np.ravel(TRIANGLE))
    binary.write_bytes(
        b"solid, all the same".ljust(80) + struct.pack("<I3f", 1, 0, 0, 1) + corners + b"\0\0"
    )
    for file in (text, binary):
        ((colour, mesh),) = read_mesh(file)
        assert (colour, mesh.tolist()) == (PLAIN, [TRIANGLE])
    assert scaled(mesh, (2.0, 0.5, 1.0)).tolist() == [[[0, 0, 0], [2, 0, 0], [0, 1, 0]]]


@pytest.mark.parametrize(
    ("name", "raw", "why"),
    [
        ("a.obj", b"PK\x03\x04", "it is no OBJ or STL file"),
        ("a.obj", b"v 0 0 0\n", "has no triangles"),
        ("a.stl", b"", "has no triangles"),
        ("a.stl", b"vertex 1 2\n", "it is no OBJ or STL file"),
        ("a.obj", b"v 0 0 0\nf 7 8 9\n", "it is no OBJ or STL file"),
        ("a.obj", b"v x y z\nf 1 1 1\n", "it is no OBJ or STL file"),
    ],
)
def test_a_mesh_that_cannot_be_read_is_named(
    name: str, raw: bytes, why: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_bytes(raw)
    with pytest.raises(WorldError, match=f"{name}.*{why}"):
        read_mesh(tmp_path / name)
    with pytest.raises(WorldError, match=r"gone\.obj cannot be read: No such file"):
        read_mesh(tmp_path / "gone.obj")


def test_moved_and_flattened() -> None:
    mesh = np.array([[[1, 0, 0], [0, 1, 0], [0, 0, 1]]], dtype=np.float32)
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    assert soup(moved(mesh, quarter, (0, 0, 1))) == (0, 1, 1, -1, 0, 1, 0, 0, 2)
