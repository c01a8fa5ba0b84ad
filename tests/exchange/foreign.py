"""Texts as other programs write them, made for these tests."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

Json = Any

SCXML = """<?xml version="1.0" encoding="UTF-8"?>
<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="Drill" initial="idle">
  <datamodel><data id="count" expr="0"/></datamodel>
  <script>run()</script>
  <state id="idle">
    <onentry><log expr="'idle'"/></onentry>
    <transition event="start" target="work"/>
  </state>
  <state id="work" initial="turn">
    <transition event="stop fault" target="idle"/>
    <transition event="done.state.work" target="end"/>
    <state id="turn">
      <transition event="deeper" cond="count &lt; 3" target="deep"/>
      <transition event="deeper" target="out"/>
      <transition event="stop" target="deep"/>
    </state>
    <state id="deep"><transition target="out"/></state>
    <final id="out"/>
    <history id="again"><transition target="turn"/></history>
  </state>
  <final id="end"/>
</scxml>
"""
SCXML_VALUES: Json = {
    "Drill": {
        "HEADER": {},
        "idle": {"start": "turn"},
        "turn": {"deeper": "deep", "deeper2": "out", "stop": "deep", "fault": "idle"},
        "deep": {"always": "out", "stop": "idle", "fault": "idle"},
        "out": {"stop": "idle", "fault": "idle", "done.state.work": "end"},
        "end": {},
    }
}

XSTATE: Json = {
    "id": "light",
    "initial": "red",
    "context": {"count": 0},
    "states": {
        "red": {
            "on": {"NEXT": "green", "BREAK": {"target": "off", "actions": ["tell"]}},
            "after": {"1000": "green"},
        },
        "green": {
            "initial": "walk",
            "on": {"NEXT": [{"target": "red", "guard": "late"}, {"target": "#dark"}]},
            "states": {"walk": {"on": {"NEXT": "wait"}}, "wait": {"always": "stop"},
                       "stop": {"type": "final"}},
            "onDone": "red",
        },
        "off": {"id": "dark", "type": "final", "entry": ["log"]},
    },
}  # fmt: skip
XSTATE_VALUES: Json = {
    "light": {
        "HEADER": {"INITIAL": "red"},
        "red": {"NEXT": "walk", "BREAK": "off", "after 1000": "walk"},
        "walk": {"NEXT": "wait"},
        "wait": {"always": "stop", "NEXT": "red", "NEXT2": "off"},
        "stop": {"NEXT": "red", "NEXT2": "off", "done.state.green": "red"},
        "off": {},
    }
}

GRAPHML = """<?xml version="1.0" encoding="UTF-8"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns" xmlns:y="http://www.yworks.com/xml/graphml">
  <key id="d0" for="node" yfiles.type="nodegraphics"/>
  <key id="d1" for="edge" attr.name="label" attr.type="string"/>
  <graph id="G" edgedefault="undirected">
    <node id="a"><data key="d0"><y:ShapeNode><y:NodeLabel>Idle</y:NodeLabel></y:ShapeNode></data>
    </node>
    <node id="b"><data key="d9">odd</data>
      <graph id="inner" edgedefault="directed"><node id="c"/></graph></node>
    <edge source="a" target="b"><data key="d1">start</data></edge>
    <edge id="e1" source="b" target="c"/>
    <edge source="c" target="a"/>
    <hyperedge/>
  </graph>
</graphml>
"""
GRAPHML_VALUES: Json = {
    "SB1": {"Idle": {"start": "b"}, "b": {"e1": "c"}, "c": {"to Idle": "Idle"}},
}

FLEXBE = '''#!/usr/bin/env python
raise SystemExit("this must never be run")
from flexbe_core import Autonomy, Behavior, ConcurrencyContainer, OperatableStateMachine


class BoneDrillSM(Behavior):
    """Drills."""

    def __init__(self, node):
        super().__init__()
        self.name = 'Bone Drill'
        self.add_behavior(HomeSM, 'Home')

    def create(self):
        _state_machine = OperatableStateMachine(outcomes=['finished', 'failed'])
        _state_machine.userdata.depth = 0

        _sm_work_0 = OperatableStateMachine(outcomes=['ok', 'bad'], input_keys=['depth'])
        with _sm_work_0:
            # x:30 y:40
            OperatableStateMachine.add('Turn',
                                       TurnState(speed=3),
                                       transitions={'done': 'Look', 'failed': 'bad'},
                                       autonomy={'done': Autonomy.Off, 'failed': Autonomy.High})
            OperatableStateMachine.add('Look', LookState(fn=lambda x: x),
                                       transitions={'deep': 'ok', 'again': 'Turn', 'lost': nowhere},
                                       remapping={'depth': 'depth'})

        _sm_both_1 = ConcurrencyContainer(outcomes=['done'], conditions=[('done', [('A', 'done')])])
        with _sm_both_1:
            OperatableStateMachine.add('A', WaitState(), transitions={'done': 'done'})
            OperatableStateMachine.add('B', _sm_work_0, transitions={'ok': 'done', 'bad': 'done'})

        with _state_machine:
            OperatableStateMachine.add('Home', self.use_behavior(HomeSM, 'Home'),
                                       transitions={'finished': 'Work', 'failed': 'failed'})
            OperatableStateMachine.add('Work', _sm_work_0,
                                       transitions={'ok': 'Both', 'bad': 'failed'})
            OperatableStateMachine.add('Both', _sm_both_1, transitions={'done': 'finished'})
        return _state_machine
'''
FLEXBE_VALUES: Json = {
    "Bone Drill": {
        "HEADER": {},
        "Home": {"Home.finished": "Turn", "Home.failed": "failed"},
        "Turn": {"Turn.done": "Look", "Turn.failed": "failed"},
        "Look": {"Look.deep": "Both", "Look.again": "Turn"},
        "Both": {"Both.done": "finished"},
        "failed": {},
        "finished": {},
    },
    "B": {
        "HEADER": {},
        "Turn": {"Turn.done": "Look", "Turn.failed": "bad"},
        "Look": {"Look.deep": "ok", "Look.again": "Turn"},
        "bad": {},
        "ok": {},
    },
}
MANIFEST = """<?xml version="1.0" encoding="UTF-8"?>
<behavior name="Bone Drill">
  <executable package_path="bone_behaviors.bone_drill_sm" class="BoneDrillSM"/>
  <params><param type="numeric" name="depth" default="3" label="d" hint="h"/></params>
</behavior>
"""


def write_rafcon(folder: Path) -> None:
    """Write a machine as RAFCON keeps it: an inner machine, a library, two that run together."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "statemachine.json").write_text('{"used_rafcon_version": "2.1.4"}', "utf-8")
    inner = folder / "Work_INNER"
    write_state(folder, "ROOT", "Drill", "HierarchyState", ["the end"], [
        _way(None, None, "HOME", None), _way("HOME", 0, "INNER", None),
        _way("INNER", 0, "BOTH", None), _way("INNER", 1, "HOME", None),
        _way("BOTH", 0, "ROOT", 0)])  # fmt: skip
    write_state(folder / "Home_HOME", "HOME", "Home", "LibraryState", ["done"], [],
                library_path="generic", library_name="home")  # fmt: skip
    write_state(inner, "INNER", "Work", "HierarchyState", ["good", "bad"], [
        _way(None, None, "TURN", None), _way("TURN", 0, "LOOK", None),
        _way("LOOK", 0, "INNER", 0), _way("LOOK", 1, "INNER", 1),
        _way("TURN", -1, "INNER", 1)])  # fmt: skip
    write_state(inner / "Turn_TURN", "TURN", "Turn", "ExecutionState", ["done"], [])
    (inner / "Turn_TURN" / "script.py").write_text("raise SystemExit('never')", "utf-8")
    write_state(inner / "Look_LOOK", "LOOK", "Look", "ExecutionState", ["deep", "lost", "odd"], [])
    write_state(folder / "Both_BOTH", "BOTH", "Both", "BarrierConcurrencyState", ["done"], [])
    write_state(folder / "Both_BOTH" / "A_A", "A", "A", "ExecutionState", ["done"], [])


RAFCON_VALUES: Json = {
    "Drill": {
        "HEADER": {"INITIAL": "Home"},
        "Both": {"Both.done": "the end"},
        "Home": {"Home.done": "Turn"},
        "Look": {"Look.deep": "Both", "Look.lost": "Home"},
        "Turn": {"Turn.aborted": "Home", "Turn.done": "Look"},
        "the end": {},
    }
}


def _way(source: Json, outcome: Json, target: Json, end: Json) -> Json:
    return {"from_state": source, "from_outcome": outcome, "to_state": target, "to_outcome": end}


def write_state(folder: Path, known: str, name: str, kind: str, *told: Json, **more: Json) -> None:
    """Write one state of RAFCON into its folder. ``told`` are its outcomes and transitions."""
    outcomes, ways = told
    folder.mkdir(parents=True, exist_ok=True)
    ends = {"-2": "preempted", "-1": "aborted", **{str(n): one for n, one in enumerate(outcomes)}}
    values = {
        "__jsonqualname__": f"rafcon.core.states.some.{kind}",
        "state_id": known,
        "name": name,
        "outcomes": {k: {"outcome_id": int(k), "name": one} for k, one in ends.items()},
        "transitions": {str(n): one for n, one in enumerate(ways)},
        "data_flows": {"1": {"from_key": 1}},
        **more,
    }
    (folder / "core_data.json").write_text(json.dumps(values, indent=4), "utf-8")
