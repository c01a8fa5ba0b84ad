"""From poses to a picture: moderngl draws the world off screen, and Qt shows the image.

Each shape has one buffer, sent once. A frame sends one matrix for each shape. Without OpenGL
``open_renderer`` returns the reason, and the pane shows no picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage

from smsl_studio.studio.running.scene.camera import WorldCamera
from smsl_studio.world.protocol import Shape

CREASE = 0.75
"""Two faces are shaded smoothly across their edge if the cosine between their normals is above
this."""

_VERTEX = """
#version 330
uniform mat4 view; uniform mat4 model;
in vec3 at; in vec3 normal;
out vec3 n; out vec3 p;
void main() {
    vec4 world = model * vec4(at, 1.0);
    p = world.xyz; n = mat3(model) * normal;
    gl_Position = view * world;
}
"""
_FRAGMENT = """
#version 330
uniform vec3 colour; uniform vec3 eye; uniform float dark; uniform float alpha;
in vec3 n; in vec3 p; out vec4 f;
void main() {
    vec3 N = normalize(n), V = normalize(eye - p), L = normalize(vec3(0.45, 0.35, 1.0));
    if (dot(N, V) < 0.0) N = -N;
    float sky = 0.5 + 0.5 * N.z;
    float sun = max(dot(N, L), 0.0);
    float shine = pow(max(dot(N, normalize(L + V)), 0.0), 40.0) * 0.22;
    vec3 ambient = mix(vec3(0.62, 0.63, 0.66), vec3(0.30, 0.32, 0.36), dark);
    vec3 lit = colour * (ambient * (0.55 + 0.55 * sky) + sun * mix(0.52, 0.58, dark)) + shine;
    f = vec4(lit * alpha, alpha);
}
"""
_GROUND_VERTEX = """
#version 330
uniform mat4 view; uniform mat4 model; uniform float shadow;
in vec3 at; out vec3 p;
void main() {
    vec4 world = model * vec4(at, 1.0);
    if (shadow > 0.5) {
        vec3 L = normalize(vec3(0.45, 0.35, 1.0));
        world.xyz -= L * (max(world.z, 0.0) / L.z);
        world.z = 0.0006;
    }
    p = world.xyz;
    gl_Position = view * world;
}
"""
_GROUND_FRAGMENT = """
#version 330
uniform vec3 ground; uniform vec3 line; uniform float shadow;
in vec3 p; out vec4 f;
void main() {
    float reach = 1.0 - smoothstep(0.35, 1.25, length(p.xy - vec2(0.45, 0.0)));
    vec2 cell = abs(fract(p.xy * 10.0 + 0.5) - 0.5) / max(fwidth(p.xy * 10.0), vec2(1e-5));
    float grid = (1.0 - min(min(cell.x, cell.y), 1.0)) * 0.55;
    vec3 c = mix(ground, line, grid);
    if (shadow > 0.5) c *= 0.80;
    f = vec4(c * reach, reach);
}
"""


CLEAR = 0.58
"""How much of what is behind a ghost it covers, from 0 to 1."""
MOVED = 1e-3
"""A shape has a ghost if a part of its pose differs by more than this (m, or of a quaternion)."""


@dataclass(frozen=True)
class GhostPoses:
    """Poses of the same shapes at another time, drawn as a ghost in one ``colour`` (0 to 1 each).

    Only shapes that stand elsewhere have a ghost. If it is ``alone`` they are not drawn where they
    are now.
    """

    poses: Sequence[float]
    colour: tuple[float, float, float]
    alone: bool = False


@dataclass(frozen=True)
class RenderStyle:
    """Size in physical pixels, theme, and whether edges are antialiased (``fine``).

    Antialiasing makes software rendering three times as slow. A ``ghost`` is drawn over the rest.
    """

    width: int
    height: int
    dark: bool
    fine: bool = True
    ghost: GhostPoses | None = None


class _Program:
    """A shader program whose uniforms take plain values or bytes."""

    def __init__(self, context: moderngl.Context, vertex: str, fragment: str) -> None:
        self.program = context.program(vertex_shader=vertex, fragment_shader=fragment)

    def put(self, name: str, value: float | tuple[float, ...] | bytes) -> None:
        """Set a uniform by its name."""
        uniform = self.program[name]
        assert isinstance(uniform, moderngl.Uniform)
        if isinstance(value, bytes):
            uniform.write(value)
        else:
            uniform.value = value


class Renderer:
    """Draws shapes at poses into images of any size. Use it from one thread only.

    Each window has its own OpenGL context. OpenGL draws into the current context, so each method
    first makes its own context current.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._solid = _Program(context, _VERTEX, _FRAGMENT)
        self._flat = _Program(context, _GROUND_VERTEX, _GROUND_FRAGMENT)
        square = np.array([-4, -4, 0, 4, -4, 0, 4, 4, 0, -4, -4, 0, 4, 4, 0, -4, 4, 0], "f4")
        self._ground = context.vertex_array(
            self._flat.program, context.buffer(square.tobytes()), "at"
        )
        self._shapes: list[tuple[Shape, moderngl.VertexArray, moderngl.VertexArray]] = []
        self._held: list[moderngl.VertexArray | moderngl.Buffer] = []
        """The buffers and arrays of the shapes in graphics memory."""
        self._size = (0, 0)
        self._smooth: moderngl.Framebuffer | None = None
        self._plain: moderngl.Framebuffer | None = None

    def load(self, shapes: Sequence[Shape]) -> None:
        """Send the meshes of these shapes, in place of the former ones."""
        with self._gl:
            for old in self._held:
                old.release()
            self._held.clear()
            self._shapes = [self._sent(shape) for shape in shapes]

    def draw(self, poses: Sequence[float], camera: WorldCamera, look: RenderStyle) -> QImage:
        """The picture with premultiplied alpha on a transparent background.

        ``poses`` has 7 floats for each shape.
        """
        with self._gl:
            return self._draw(poses, camera, look)

    def _draw(self, poses: Sequence[float], camera: WorldCamera, look: RenderStyle) -> QImage:
        width, height = max(look.width, 1), max(look.height, 1)
        self._prepare(width, height)
        assert self._smooth is not None
        assert self._plain is not None
        gl = self._gl
        target = self._smooth if look.fine else self._plain
        target.use()
        target.clear(0.0, 0.0, 0.0, 0.0)
        gl.enable(moderngl.DEPTH_TEST)
        view = camera.view_projection(width / height).T.tobytes()
        ghost = look.ghost
        elsewhere = moved_shapes(poses, ghost.poses) if ghost is not None else frozenset()
        gone = elsewhere if ghost is not None and ghost.alone else frozenset()
        self._draw_ground(poses, view, look.dark, gone)
        self._draw_solids(poses, view, camera, look.dark, gone)
        if ghost is not None and elsewhere:
            self._draw_ghost(ghost, view, elsewhere, target)
        if look.fine:
            gl.copy_framebuffer(self._plain, self._smooth)
        data = self._plain.read(components=4)
        image = QImage(data, width, height, width * 4, QImage.Format.Format_RGBA8888_Premultiplied)
        return image.flipped(Qt.Orientation.Vertical)

    def close(self) -> None:
        """Release the OpenGL context. Nothing can be drawn after that."""
        self._gl.release()

    def _draw_ground(
        self, poses: Sequence[float], view: bytes, dark: bool, gone: AbstractSet[int]
    ) -> None:
        flat = self._flat
        flat.put("view", view)
        flat.put("ground", (0.155, 0.185, 0.235) if dark else (0.915, 0.93, 0.95))
        flat.put("line", (0.23, 0.27, 0.33) if dark else (0.82, 0.845, 0.88))
        flat.put("shadow", 0.0)
        flat.put("model", np.eye(4, dtype="f4").tobytes())
        self._gl.enable(moderngl.BLEND)
        self._gl.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._ground.render()
        flat.put("shadow", 1.0)
        self._gl.blend_func = moderngl.ONE, moderngl.ZERO
        for at, ((_, _, array), matrix) in enumerate(
            zip(self._shapes, matrices(poses), strict=False)
        ):
            if at not in gone:
                flat.put("model", matrix.T.tobytes())
                array.render()
        self._gl.disable(moderngl.BLEND)

    def _draw_solids(
        self,
        poses: Sequence[float],
        view: bytes,
        camera: WorldCamera,
        dark: bool,
        gone: AbstractSet[int],
    ) -> None:
        solid = self._solid
        solid.put("view", view)
        solid.put("eye", tuple(float(v) for v in camera.eye))
        solid.put("dark", 1.0 if dark else 0.0)
        solid.put("alpha", 1.0)
        for at, ((shape, array, _), matrix) in enumerate(
            zip(self._shapes, matrices(poses), strict=False)
        ):
            if at not in gone:
                solid.put("colour", shape.colour)
                solid.put("model", matrix.T.tobytes())
                array.render()

    def _draw_ghost(
        self,
        ghost: GhostPoses,
        view: bytes,
        elsewhere: AbstractSet[int],
        target: moderngl.Framebuffer,
    ) -> None:
        """Draw the shapes that stand elsewhere in one colour. What is nearest of them is found
        first, so that nothing of their inside is seen."""
        solid, gl = self._solid, self._gl
        solid.put("view", view)
        solid.put("colour", ghost.colour)
        solid.put("alpha", CLEAR)
        whole = matrices(ghost.poses)
        gl.enable(moderngl.BLEND)
        gl.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        gl.depth_func = "<"
        for seen in (False, True):
            target.color_mask = (seen, seen, seen, seen)
            target.use()
            # The first pass lies a little behind the second, in which each point is drawn once.
            gl.polygon_offset = (0.0, 0.0) if seen else (1.0, 2.0)
            for at in sorted(elsewhere):
                solid.put("model", whole[at].T.tobytes())
                self._shapes[at][1].render()
        gl.depth_func = "<="
        gl.disable(moderngl.BLEND)

    def _sent(self, shape: Shape) -> tuple[Shape, moderngl.VertexArray, moderngl.VertexArray]:
        points = np.asarray(shape.mesh, dtype=np.float32).reshape(-1, 3)
        both = np.hstack([points, normals(points)]).astype("f4")
        solid = self._gl.buffer(both.tobytes() or bytes(24))
        flat = self._gl.buffer(points.tobytes() or bytes(12))
        near = self._gl.vertex_array(self._solid.program, [(solid, "3f 3f", "at", "normal")])
        shadow = self._gl.vertex_array(self._flat.program, [(flat, "3f", "at")])
        self._held += [near, shadow, solid, flat]
        return shape, near, shadow

    def _prepare(self, width: int, height: int) -> None:
        if self._size == (width, height):
            return
        for old in (self._smooth, self._plain):
            if old is not None:
                old.release()
        samples = min(4, self._gl.max_samples)
        self._smooth = self._gl.framebuffer(
            self._gl.renderbuffer((width, height), 4, samples=samples),
            self._gl.depth_renderbuffer((width, height), samples=samples),
        )
        self._plain = self._gl.simple_framebuffer((width, height), 4)
        self._size = (width, height)


def matrices(poses: Sequence[float]) -> NDArray[np.float32]:
    """Row-major (n, 4, 4) matrices, one for each 7 floats (position in metres, quaternion x, y,
    z, w)."""
    rows = np.asarray(poses, dtype=np.float64).reshape(-1, 7)
    x, y, z, w = rows[:, 3], rows[:, 4], rows[:, 5], rows[:, 6]
    out = np.zeros((len(rows), 4, 4))
    out[:, 0, :3] = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], 1)
    out[:, 1, :3] = np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], 1)
    out[:, 2, :3] = np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], 1)
    out[:, :3, 3] = rows[:, :3]
    out[:, 3, 3] = 1.0
    return out.astype(np.float32)


def moved_shapes(poses: Sequence[float], others: Sequence[float]) -> frozenset[int]:
    """Return the numbers of the shapes that stand elsewhere in other poses."""
    if len(poses) != len(others):
        return frozenset()
    now, then = (np.asarray(one, dtype=np.float64).reshape(-1, 7) for one in (poses, others))
    # A quaternion and its negative are the same rotation.
    turned = 1.0 - np.abs((now[:, 3:] * then[:, 3:]).sum(axis=1))
    apart = np.abs(now[:, :3] - then[:, :3]).max(axis=1, initial=0.0)
    return frozenset(np.flatnonzero((apart > MOVED) | (turned > MOVED)).tolist())


def normals(points: NDArray[np.float32]) -> NDArray[np.float32]:
    """A normal for each corner of a list of triangles, (3 n, 3).

    Edges between similar faces are smooth.
    """
    if not len(points):
        return points
    corners = points.reshape(-1, 3, 3)
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(face, axis=1, keepdims=True)
    unit = np.repeat(face / np.maximum(length, 1e-12), 3, axis=0)
    _, same = np.unique(np.round(points, 5), axis=0, return_inverse=True)
    total = np.zeros((int(same.max()) + 1, 3))
    np.add.at(total, same.reshape(-1), np.repeat(face, 3, axis=0))
    smooth = total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-12)
    smooth = smooth[same.reshape(-1)]
    gentle = np.sum(smooth * unit, axis=1, keepdims=True) > CREASE
    return np.asarray(np.where(gentle, smooth, unit), dtype=np.float32)


def open_renderer() -> Renderer | str:
    """A renderer, or the reason why there is none."""
    reasons: list[str] = []
    choices: tuple[dict[str, Any], ...] = ({"backend": "egl"}, {})
    for options in choices:
        try:
            return Renderer(moderngl.create_standalone_context(require=330, **options))
        except Exception as error:  # a driver may raise anything, and all of it means no OpenGL
            reasons.append(str(error) or type(error).__name__)
    return "; ".join(dict.fromkeys(reasons))
