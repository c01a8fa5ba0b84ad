"""The import rule, checked on the source: what each file imports, and whether it may."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.house.survey import Asked, survey

PACKAGE = "smsl_studio"

FLOORS: dict[str, float] = {
    "errors": 0,
    "legible": 0,
    "shipped": 0,
    "stop": 0,
    "home": 0,
    "smsl": 1,
    "seal": 1,
    "blueprint": 2,
    "graph": 3,
    "channel": 3,
    "world": 3,
    "runlog": 3,
    "library": 4,
    "monitor": 4,
    "picture": 4,
    "host": 5,
    "inspection": 5,
    "dispatch": 6,
    "exchange": 6,
    "generate": 6,
    "front": 7,
    # The package itself hands the front door on; the doors may come in through it.
    "__init__": 7.5,
    "cli": 8,
    "studio": 8,
    "__main__": 9,
}

WHOLE = (PACKAGE, f"{PACKAGE}.studio", f"{PACKAGE}.studio.features")
"""The packages of which the next name says which room, floor or feature is asked for."""

FEATURE_TABLE = "shell/features.py"
"""The one file of the shell that knows features by their names."""

STUDIO_FLOORS: dict[str, int] = {"base": 1, "document": 2, "running": 3, "features": 4, "shell": 5}
"""The floors inside the window, which are folders of ``studio/``."""

BULLET = "world/bullet.py"
HOMES: dict[str, tuple[str, ...]] = {
    "PySide6": ("studio/",),
    "shiboken6": ("studio/",),
    "pyqtgraph": ("studio/",),
    "moderngl": ("studio/",),
    "PIL": ("studio/running/scene/clip_file.py",),
    "pybullet": (BULLET,),
    "pybullet_data": ("world/models.py",),
    "pybullet_utils": (BULLET,),
    "distributed": ("front/campaign_cluster.py",),
    "pyarrow": ("front/campaign_parquet.py",),
    "mujoco": ("world/mujoco_world.py",),
    "defusedxml": ("exchange/",),
    "jinja2": ("generate/code/templates.py",),
    "networkx": ("graph/exchange.py",),
    "scipy": ("graph/",),
    "bm25s": ("generate/text/passages.py",),
    "pypdf": ("generate/text/pdf_child.py",),
    "paho": ("monitor/mqtt.py",),
    "cryptography": ("seal/",),
    "pkcs11": ("seal/",),
    "numpy": ("graph/", "world/", "picture/", "studio/", "generate/rule_"),
    "pydantic": ("",),
    "annotated_types": ("blueprint/",),
    "orjson": ("smsl/",),
    "yaml": ("smsl/yaml_form/",),
    "typst": ("picture/",),
    "typing_extensions": ("",),
}


@dataclass(frozen=True)
class Import:
    """One import: the file (below the package), the line, and the dotted name it asks for."""

    file: str
    line: int
    name: str


def imports_of(package: Path) -> Iterator[Import]:
    """Every import below ``package``, those inside functions and of literal names included."""
    for one in survey(package):
        file = one.path.relative_to(package).as_posix()
        for asked in one.asked:
            for name in _names(asked):
                yield Import(file, asked.line, name)


def faults(package: Path) -> list[str]:
    """One sentence for each import that breaks the rule."""
    found = (f"{i.file}:{i.line}: {_fault(i)}" for i in imports_of(package) if _fault(i))
    return list(found)


def room_of(file: str) -> str:
    """The room a file belongs to: its folder, or its own name at the top."""
    return file.partition("/")[0].removesuffix(".py")


def _names(asked: Asked) -> Iterator[str]:
    if asked.names and asked.module in WHOLE:
        yield from (f"{asked.module}.{name}" for name in asked.names)
    else:
        yield asked.module


def _fault(item: Import) -> str:
    if item.name.startswith("."):
        return "a relative import; write it absolutely"
    top, _, rest = item.name.partition(".")
    return _own(item, rest) if top == PACKAGE else _foreign(item, top)


def _own(item: Import, rest: str) -> str:
    here = room_of(item.file)
    there = rest.partition(".")[0]
    there = there if there in FLOORS else "__init__"
    if here not in FLOORS:
        return f"{here} is no room of the house"
    if here == there == "studio":
        return _inside_the_studio(item, rest)
    if here == there or FLOORS[there] < FLOORS[here]:
        return ""
    words = "its neighbour" if FLOORS[there] == FLOORS[here] else "upstairs to"
    return f"{here} looks {words} {there}"


def _inside_the_studio(item: Import, rest: str) -> str:
    file, asked = item.file.partition("/")[2], rest.partition(".")[2]
    here, there = file.removesuffix(".py").split("/"), asked.split(".")
    if here[0] not in STUDIO_FLOORS:
        return f"{here[0]} is no floor of the window"
    if here[0] == "shell" and there[0] == "features" and file != FEATURE_TABLE:
        return f"{file} names a feature, {FEATURE_TABLE} alone does"
    above = STUDIO_FLOORS.get(there[0], 0) - STUDIO_FLOORS[here[0]]
    if above > 0:
        return f"{here[0]} looks upstairs to {asked}"
    if above == 0 and here[0] == "features" and here[1] != "".join(there[1:2]):
        return f"feature {here[1]} looks at its neighbour {asked}"
    return ""


def _foreign(item: Import, top: str) -> str:
    if top in sys.stdlib_module_names:
        return ""
    homes = HOMES.get(top)
    if homes is None:
        return f"{top} has no home in the house"
    if any(item.file.startswith(home) for home in homes):
        return ""
    return f"{top} lives in {' and '.join(homes)} alone"
