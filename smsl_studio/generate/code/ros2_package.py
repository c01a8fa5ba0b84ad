"""The ROS 2 package of a blueprint: a lifecycle node around the C++ package, which is not changed.

Nothing of it was ever run on a robot, and its README says so.
"""

from __future__ import annotations

import json
from typing import Any
from xml.sax.saxutils import escape as escape_xml

from smsl_studio.blueprint.address import Address, fact_text
from smsl_studio.blueprint.continuum import GENERATION
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.generate.code.blueprint_parts import CodeRequest, sensed_digits
from smsl_studio.generate.code.cpp_package import CppPackage
from smsl_studio.generate.code.templates import BY, remark, rendered
from smsl_studio.library.bindings_file import BindingsFile

Json = Any
TARGET = "ros2"
UNSTATED = "Not stated"
"""The licence of a package without a licence text."""
_LACKS = "the ROS 2 node asks nobody"
_ADVICE = "Generate Python or C++, or leave people out of the blueprint."


def refuse_what_ros2_lacks(blueprint: Blueprint) -> None:
    """Raise RunRefused, with the place, for all that asks people or an agent: the node has nobody
    to ask.
    """
    for key, level in blueprint.levels.items():
        if key == GENERATION:
            continue  # generated code makes no edges
        if level != ("shared" if key == "supervision" else "automatic"):
            raise RunRefused(f"_levels makes {key} {level}, and {_LACKS}", advice=_ADVICE)
    for branch in blueprint:
        place = blueprint.place(Address(branch.name))
        for key, note in branch.notes.operations.items():
            if note.actor in ("human", "shared") or note.confirm:
                what = "must be confirmed by people" if note.confirm else f"has actor {note.actor}"
                words = f"{Address(branch.name)}/{key} {what}, and {_LACKS}"
                raise RunRefused(words, place, _ADVICE)
        for digit in sensed_digits(branch):
            fact = branch.fact_note(digit)
            if fact is not None and fact.aggregation == "human":
                words = f"{fact_text(branch.name, digit)} is told by people, and {_LACKS}"
                raise RunRefused(words, place, _ADVICE)


class Ros2Package(CppPackage):
    """Makes the files of one package. Its name is that of the C++ package in small letters."""

    def __init__(self, request: CodeRequest, file: BindingsFile | None = None) -> None:
        refuse_what_ros2_lacks(request.blueprint)
        super().__init__(request, file)

    @property
    def files(self) -> dict[str, str]:
        """Every file as text."""
        core = self.core
        sources = self._sources(core)
        return {
            **core,
            "ros/channels.hpp": self._node("channels.hpp"),
            "ros/robot_world.hpp": self._node("robot_world.hpp"),
            "ros/robot_world.cpp": self._node("robot_world.cpp"),
            "ros/run_node.hpp": self._node("run_node.hpp"),
            "ros/run_node.cpp": self._node("run_node.cpp"),
            "ros/main.cpp": self._node("main.cpp"),
            "action/CarryOut.action": self._marked("CarryOut.action"),
            "msg/FactValue.msg": self._marked("FactValue.msg"),
            "launch/run.launch.py": self._marked("run.launch.py"),
            "config/run.yaml": self._marked("run.yaml"),
            "config/dvrk.yaml": self._marked("dvrk.yaml"),
            "CMakeLists.txt": self._marked("CMakeLists.txt", sources=sources),
            "package.xml": self._ros("package.xml"),
            "README.md": f"<!-- {BY}. -->\n\n{self._ros('README.md')}",
        }

    def _ros(self, template: str, **values: Json) -> str:
        request, blueprint = self._request, self._blueprint
        root = blueprint[self._hierarchy.roots[0]]
        edge = next((one.address for branch in blueprint for one in branch.edges()), "")
        licence = next((line for line in request.licence.splitlines() if line.strip()), UNSTATED)
        said = {
            "package": request.name,
            "ros_name": request.name.lower(),
            "file_name": remark(request.file_name),
            "file_cell": escape_xml(remark(request.file_name)),
            "licence_cell": escape_xml(remark(licence.strip())),
            "by": BY,
            "goal_text": json.dumps(str(Address(root.name, root.activating)), ensure_ascii=False),
            "edge": remark(str(edge)),
            "functions": self._functions(),
            "sensors": self._sensors(),
        }
        return rendered(TARGET, template, **said, **values)

    def _node(self, template: str) -> str:
        return self._headed(self._ros(template))

    def _marked(self, template: str, **values: Json) -> str:
        return f"# {BY}.\n{self._ros(template, **values)}"
