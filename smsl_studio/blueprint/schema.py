"""The JSON Schema of the JSON form, made from the model, so that any editor can complete and check
it.

The types in ``annotations`` describe the notes. The rest describes what ``reading`` accepts. A
schema cannot express the findings of inspection, such as targets that are no states.
"""

from __future__ import annotations

import json
from typing import Any

from smsl_studio.blueprint.annotations import (
    Binding,
    DrawnNote,
    FactNote,
    Group,
    Hazard,
    OperationNote,
    ProcedureBinding,
    StateNote,
)
from smsl_studio.blueprint.continuum import FORECAST_LEVELS, LEVELS
from smsl_studio.blueprint.edge_layout import IN_LAYOUT, MOST_BENDS
from smsl_studio.blueprint.pins import PINNED
from smsl_studio.smsl.document.limits import MAX_NAME

Json = Any

DIALECT = "https://json-schema.org/draft/2020-12/schema"
NOTES = (FactNote, StateNote, OperationNote, Binding, ProcedureBinding, Hazard, DrawnNote, Group)

WORDS: dict[str, dict[str, str]] = {
    "FactNote": {
        "": "What a fact is and where it comes from.",
        "name": "Its plain name, such as tool attached.",
        "values": "What each of its values means.",
        "on": "The value that counts as on, if a sub-SB expands the fact.",
        "failure": "Values that mean a failure.",
        "critical": "Whether the procedure depends on it.",
        "sensors": "The sensors it is read by.",
        "unit": "The unit of what the sensors read.",
        "sources": "What measures it: sources by name, each with its unit, such as N or mm.",
        "predicate": "For each value the condition on the sources, such as: force > 2 N for 0.5 s. "
        "A text is only for people.",
        "range": "The least and the largest number that a source can measure, in its unit.",
        "log_rate": "How many times a second the log of a run keeps what its sources measure.",
        "aggregation": "How several sensors become one fact.",
        "k": "How many sensors must agree, if the aggregation is k_of_n.",
        "max_age": "Seconds after which a reading counts as unknown.",
        "conflict_after": "Seconds for which its sensors may disagree before it is unknown.",
        "question": "The question to a person, if a person tells its value.",
        "roles": "Who must answer: one role for each person.",
        "answer_within": "Seconds after which an answer is too late.",
        "escalates_to": "The role that may answer as well from half that time on.",
    },
    "StateNote": {
        "": "What a state is called, and whether it is safe.",
        "title": "Its plain title.",
        "note": "Anything worth knowing about it.",
        "safe": "Whether the procedure may rest here.",
        "facts": "Its fact values, if its name does not give them.",
    },
    "OperationNote": {
        "": "How an operation is carried out, by name or by State/Operation.",
        "title": "Its plain title.",
        "cost": "Its cost on a route, 1 by default.",
        "risk": "How risky it is.",
        "actor": "Who carries it out.",
        "confirm": "Who must confirm it first.",
        "forecast": "What its forecast does if it differs: it is shown, a person is asked, or the "
        "run holds.",
        "duration": "How many seconds it takes.",
        "timeout": "Seconds after which it counts as failed.",
        "stop": "What a pause does to it: abort, hold or finish. A stop always cancels it.",
        "resumes": "Whether it goes on after a pause held it.",
        "touches": "Facts that are unknown after it was cancelled, besides those it changes.",
        "repeatable": "Whether it may be tried again after a failure.",
        "requires": 'Facts of any SB that must hold first: "SB/digit": value.',
        "subs": "drive: the sub-SBs move first. load: it brings their facts about itself.",
        "binding": "The library function it is bound to.",
        "question": "The text for a person who carries it out.",
        "roles": "The people who carry it out: one role for each person.",
        "answer_within": "Seconds after which an answer about it is too late.",
        "escalates_to": "The role that may answer as well from half that time on.",
    },
    "Binding": {
        "": "A function of the operation library, with its arguments.",
        "function": "The function's name, such as plugin.function.",
        "arguments": "What it is called with.",
    },
    "ProcedureBinding": {
        "": "A blueprint that the operation runs to one of its states.",
        "blueprint": "Its file, named from this one, or store:DIGEST.",
        "goal": "The state: SB/State.",
    },
    "Hazard": {
        "": "Facts that must never hold together.",
        "name": "What the hazard is called.",
        "facts": 'The facts: "SB/digit": value.',
    },
    "DrawnNote": {
        "": "A note on the drawing. It has no meaning.",
        "at": "Its upper left corner, from the centre of the state if it hangs on one.",
        "text": "What it says.",
        "author": "Who wrote it.",
        "date": "The day on which it was written, such as 2026-11-12.",
        "state": "The state that it hangs on; without one it is free.",
    },
    "Group": {
        "": "States with a frame around them. It has no meaning.",
        "title": "What stands above them.",
        "states": "The states in it; a state stands in one group.",
    },
}
"""The descriptions that an editor shows. The empty key is the note itself."""

CONDITION = {
    "type": "string",
    "minLength": 1,
    "description": 'A condition, such as: SB1/0 = a and not (SB2 in State_1 or "Clamp" != 1).',
}
TWO = {"type": "array", "items": CONDITION, "minItems": 2, "maxItems": 2}
NOT_BELOW_ZERO = {"type": "integer", "minimum": 0}
KINDS: dict[str, Json] = {
    "never": CONDITION,
    "before": {**TWO, "description": "The second never holds before the first has held."},
    "after": {**TWO, "description": "From the first on, every way to a goal passes the second."},
    "way_back": {
        "type": "object",
        "properties": {"from": CONDITION, "to": CONDITION, "within": NOT_BELOW_ZERO},
        "required": ["from", "to"],
        "additionalProperties": False,
        "description": "From the first condition the second can be reached, in so many steps.",
    },
    "reachable": CONDITION,
    "at_most": {
        "type": "object",
        "properties": {"operation": {"type": "string", "minLength": 1}, "times": NOT_BELOW_ZERO},
        "required": ["operation", "times"],
        "additionalProperties": False,
        "description": "How often the cheapest route may carry out an operation.",
    },
    "cost": {
        "type": "object",
        "properties": {
            "goal": {"type": "string", "minLength": 1},
            "limit": {"type": "number", "minimum": 0},
        },
        "required": ["goal", "limit"],
        "additionalProperties": False,
        "description": "The largest cost of the cheapest route to a state.",
    },
}
PROPERTY = {
    "type": "object",
    "description": "A sentence about the blueprint that inspection shows to hold or to fail.",
    "properties": {
        "name": {"type": "string", "minLength": 1, "description": "What it is called."},
        "severity": {
            "enum": ["E", "W"],
            "description": "How grave it is if it fails; E if absent.",
        },
        "why": {"type": "string", "description": "Why it matters, for people."},
        **KINDS,
    },
    "patternProperties": {"^_": True},
    "required": ["name"],
    "oneOf": [{"required": [kind]} for kind in KINDS],
    "additionalProperties": False,
}

HEADER = {
    "type": "object",
    "description": "Values for the whole State Branch.",
    "properties": {
        "INITIAL": {
            "type": ["string", "null"],
            "minLength": 1,
            "description": "The state in which it starts, the first listed by default.",
        },
        "ACTIVATING": {
            "type": ["string", "null"],
            "minLength": 1,
            "description": "The state in which it counts as done, the last listed by default.",
        },
        "NUM_FACTS": {
            "type": ["integer", "null"],
            "minimum": 1,
            "description": "How many facts a state's name carries; it divides the fact string.",
        },
        "NUM_STATES": {
            "type": ["integer", "null"],
            "minimum": 0,
            "description": "How many states there are; only checked.",
        },
        "SUB_SBS": {
            "description": "The sub-SBs, each with the digit it expands, counted from 0.",
            "anyOf": [
                {"$ref": "#/$defs/SubSBs"},
                {"type": "array", "items": {"$ref": "#/$defs/SubSBs"}},
                {"type": "null"},
            ],
        },
    },
}
NAME = {"minLength": 1, "maxLength": MAX_NAME}
SUB_SBS = {
    "type": "object",
    "patternProperties": {"^_": True},
    "additionalProperties": {"type": "integer", "minimum": 0},
}
STATE = {
    "type": "object",
    "description": "A state: its operations, each with the state it leads to.",
    "propertyNames": NAME,
    "patternProperties": {"^_": True},
    "additionalProperties": {"type": "string", "description": "The state it leads to."},
}
POINT = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
LINES = {
    "type": "object",
    "description": "How the lines of operations are drawn, by State/Operation.",
    "additionalProperties": {
        "type": "object",
        "properties": {
            "bends": {
                "type": "array",
                "items": POINT,
                "maxItems": MOST_BENDS,
                "description": "The points that the line leads through, from its source on.",
            },
            "label": {
                "type": "array",
                "items": {"type": "number"},
                "minItems": 3,
                "maxItems": 3,
                "description": "A share of the line's length, and from there x and y.",
            },
        },
        "additionalProperties": False,
    },
}


def schema() -> Json:
    """Return the schema as plain values."""
    return {
        "$schema": DIALECT,
        "title": "SMSL blueprint",
        "description": "State Branches by name; names that begin with _ are skipped by readers.",
        "type": "object",
        "propertyNames": NAME,
        "properties": {
            "_imports": {
                "type": "array",
                "items": {"type": "string", "minLength": 1},
                "description": "Files whose State Branches belong to this blueprint.",
            },
            "_hazards": {
                "type": "array",
                "items": {"$ref": "#/$defs/Hazard"},
                "description": "Combinations of facts that must never hold.",
            },
            "_properties": {
                "type": "array",
                "items": {"$ref": "#/$defs/Property"},
                "description": "What must hold, and is shown by inspection.",
            },
            "_levels": {
                "type": "object",
                "properties": {"forecast": {"enum": list(FORECAST_LEVELS)}},
                "additionalProperties": {"enum": list(LEVELS)},
                "description": "Who does, senses, inspects, supervises and generates: by "
                "inspection, supervision, generation, SB/digit, SB/Operation or "
                "SB/State/Operation. And the level of forecasts.",
            },
        },
        "patternProperties": {"^_": True},
        "additionalProperties": {"$ref": "#/$defs/StateBranch"},
        "$defs": {
            "StateBranch": _branch(),
            "Header": HEADER,
            "SubSBs": SUB_SBS,
            "State": STATE,
            "Property": PROPERTY,
            **_notes(),
        },
    }


def schema_text() -> str:
    """Return the schema as the text of its file."""
    return json.dumps(schema(), indent=2, ensure_ascii=False) + "\n"


def _branch() -> Json:
    return {
        "type": "object",
        "description": "A State Branch: its header and its states.",
        "propertyNames": NAME,
        "properties": {
            "HEADER": {"$ref": "#/$defs/Header"},
            "_facts": {
                **_table("FactNote", "What each fact is, by its digit, counted from 0."),
                "propertyNames": {"pattern": "^[0-9]+$"},
            },
            "_states": _table("StateNote", "What each state is, by its name."),
            "_operations": _table(
                "OperationNote", "How operations are carried out, by name or State/Operation."
            ),
            "_layout": {
                "type": "object",
                "description": "Where each state is drawn.",
                "properties": {
                    "_groups": _table("Group", "Groups of states, by any key."),
                    IN_LAYOUT: LINES,
                    PINNED: {
                        "type": "object",
                        "description": "States that a tidy drawing leaves at their places.",
                        "additionalProperties": {"const": True},
                    },
                },
                "patternProperties": {"^_": True},
                "additionalProperties": POINT,
            },
            "_notes": _table("DrawnNote", "Notes on the drawing, by any key."),
        },
        "patternProperties": {"^_": True},
        "additionalProperties": {"$ref": "#/$defs/State"},
    }


def _table(note: str, words: str) -> dict[str, Json]:
    return {
        "type": "object",
        "description": words,
        "additionalProperties": {"$ref": f"#/$defs/{note}"},
    }


def _notes() -> dict[str, Json]:
    """Return the schemas of the notes, from their types, with the descriptions in this file."""
    from pydantic import TypeAdapter

    adapters: list[Any] = [(note, "validation", TypeAdapter(note)) for note in NOTES]
    _, made = TypeAdapter.json_schemas(adapters, ref_template="#/$defs/{model}")
    return {name: _described(name, made["$defs"][name]) for name in WORDS}


def _described(name: str, made: dict[str, Json]) -> dict[str, Json]:
    words = WORDS[name]
    properties = {
        key: {"description": words[key], **{k: v for k, v in one.items() if k != "title"}}
        for key, one in made["properties"].items()
    }
    return {
        "type": "object",
        "description": words[""],
        "properties": properties,
        "required": made.get("required", []),
        "additionalProperties": False,
    }
