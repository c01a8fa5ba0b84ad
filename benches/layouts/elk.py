"""The picture that ELK's layered layout makes of an SB, with nodes and labels as large as ours.

ELK runs as elkjs in Node.js. ``npm`` puts it below ``build/`` when it is first needed. It is only
measured here and no part of the program.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from smsl_studio.picture.figure import Figure
from tests.picture.measured import NO_LABEL, Array, Drawing, Rect

VERSION = "0.12.1"
FOLDER = Path(__file__).parents[2] / "build" / "elkjs"
PATIENCE = 240.0
"""Seconds after which a picture is given up."""
PROGRAM = """
const ELK = require(process.argv[1]);
let text = '';
process.stdin.on('data', part => text += part);
process.stdin.on('end', () => new ELK().layout(JSON.parse(text)).then(
    found => process.stdout.write(JSON.stringify(found)),
    error => { console.error(String(error)); process.exit(1); }));
"""
OPTIONS = {
    "elk.algorithm": "layered",
    "elk.direction": "RIGHT",
    "elk.edgeRouting": "ORTHOGONAL",
    "elk.randomSeed": "1",
}


@cache
def is_here() -> bool:
    """Return whether ELK can be run. It is installed if Node.js and npm are there."""
    if not (shutil.which("node") and shutil.which("npm")):
        return False
    if not _library().exists():
        FOLDER.mkdir(parents=True, exist_ok=True)
        wanted = ["npm", "install", "--no-audit", "--no-fund", "--prefix", str(FOLDER)]
        subprocess.run([*wanted, f"elkjs@{VERSION}"], capture_output=True, check=False)
    return _library().exists()


def _library() -> Path:
    return FOLDER / "node_modules" / "elkjs" / "lib" / "elk.bundled.js"


def drawn_by_elk(figure: Figure, sizes: list[tuple[float, float]]) -> Drawing | None:
    """Return the drawing with a label of each size, or None if ELK does not end in time."""
    picture = figure.picture
    children = [
        {"id": f"n{number}", "width": 2 * w, "height": 2 * h}
        for number, (_, _, w, h) in enumerate(figure.boxes.tolist())
    ]
    edges = [edge for edge, target in enumerate(picture.target.tolist()) if target >= 0]
    lines = [
        {
            "id": f"e{edge}",
            "sources": [f"n{picture.source[edge]}"],
            "targets": [f"n{picture.target[edge]}"],
            "labels": [{"text": "-", "width": sizes[edge][0], "height": sizes[edge][1]}],
        }
        for edge in edges
    ]
    graph = {"id": "all", "layoutOptions": OPTIONS, "children": children, "edges": lines}
    try:
        done = subprocess.run(
            ["node", "-e", PROGRAM, str(_library())],
            input=json.dumps(graph),
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=True,
        )
    except (subprocess.TimeoutExpired, subprocess.CalledProcessError):
        return None
    found = json.loads(done.stdout)
    nodes = [_rect(one) for one in found["children"]]
    by_id = {one["id"]: one for one in found["edges"]}
    drawn = [by_id[f"e{edge}"] for edge in edges]
    labels: list[Rect | None] = [NO_LABEL] * len(drawn)
    for at, one in enumerate(drawn):
        labels[at] = _rect(one["labels"][0])
    ends = [(int(picture.source[e]), int(picture.target[e])) for e in edges]
    return Drawing(nodes, ends, [_line(one) for one in drawn], labels)


def _rect(one: dict[str, Any]) -> Rect:
    x, y = float(one["x"]), float(one["y"])
    return x, y, x + float(one["width"]), y + float(one["height"])


def _line(edge: dict[str, Any]) -> Array:
    """Return the points of a line."""
    (section,) = edge["sections"]
    points = [section["startPoint"], *section.get("bendPoints", ()), section["endPoint"]]
    return np.array([(one["x"], one["y"]) for one in points], dtype=np.float64)
