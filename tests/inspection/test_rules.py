"""Each rule finds its planted fault at the right key, and finds nothing in a sound blueprint.

In the texts a ``^`` stands before the key the finding must point at; it is taken out before
reading.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused, UsageError, nearest
from smsl_studio.inspection.inspect import ALL, PROVED, RULES, WITH_MORE, inspect
from smsl_studio.inspection.rules.finding import LISTED, Finding, Fix, Severity
from smsl_studio.inspection.rules.words import NearNames
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.json_form import parse_json

SAMPLES = Path(__file__).parents[2] / "samples"

PLANTED = [
    # rule, severity, address, words of the message, text
    ("R01", "E", "SB/State_0/a", "twice, first at line 2, column 15", """{"SB": {
  "State_0": {"a": "State_0", ^"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R01", "E", "SB", "INITIAL is written twice", """{"SB": {
  "HEADER": {"INITIAL": "State_0",
    ^"INITIAL": "State_0"},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R01", "E", "SB/State_1", "State_1 is written twice", """{"SB": {
  "State_1": {}, "State_0": {"a": "State_1"}, ^"State_1": {"b": "State_0"}}}"""),
    ("R02", "E", "SB/State_1/b", "leads to State_O, which is no state", """{"SB": {
  "State_0": {"a": "State_1"}, "State_1": {"c": "State_0", ^"b": "State_O"}}}"""),
    ("R03", "E", "SB", "INITIAL is State_2, which is no state", """{"SB": {
  "HEADER": {^"INITIAL": "State_2"},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R03", "E", "SB", "ACTIVATING is Elsewhere", """{"SB": {"HEADER": {"INITIAL": "State_0",
  ^"ACTIVATING": "Elsewhere"},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R03", "E", "SB", "has no states", """{^"SB": {"HEADER": {}}}"""),
    ("R03", "E", "SB", "NUM_STATES is 3, but there are 2", """{"SB": {
  "HEADER": {^"NUM_STATES": 3}, "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R03", "E", "SB", "INITIAL is a number, not the name of a state", """{"SB": {
  "HEADER": {"NUM_FACTS": 1, ^"INITIAL": 5},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R05", "E", "SB", "NUM_FACTS is a text, not a whole number", """{"SB": {
  "HEADER": {^"NUM_FACTS": "1"},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R05", "I", "SB/Idle", "the name is read as 4 facts of one letter each", """{"SB": {
  ^"Idle": {"a": "Done"}, "Done": {"b": "Idle"}}}"""),
    ("R05", "W", "SB/Patient ready", "the name is read as the facts a, d and y", """{"SB": {
  "HEADER": {"NUM_FACTS": 3}, "State_000": {"a": "State_010"},
  "State_010": {"b": "Patient ready"}, ^"Patient ready": {"c": "State_000"}}}"""),
    ("R07", "E", "SB", "SUB_SBS is a text, not a map", """{"SB": {
  "HEADER": {^"SUB_SBS": "B"},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R07", "E", "SB", "the digit of B is a text, not a whole number", """{"SB": {
  "HEADER": {"SUB_SBS": {^"B": "x"}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R04", "I", "SB", "INITIAL and NUM_FACTS are left to the default", """{"SB": {
  ^"HEADER": {"ACTIVATING": "State_1"},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R04", "I", "SB", "INITAL is no header key", """{"SB": {"HEADER": {^"INITAL": "State_0",
  "INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R05", "E", "SB/State_0", "carries 1 character of facts, where the others carry 2", """{"SB": {
  "HEADER": {"NUM_FACTS": 2},
  ^"State_0": {"a": "State_10"}, "State_10": {"b": "State_11"}, "State_11": {"c": "State_0"}}}"""),
    ("R05", "E", "SB", "NUM_FACTS is 2, which does not divide", """{"SB": {
  "HEADER": {^"NUM_FACTS": 2},
  "State_000": {"a": "State_100"}, "State_100": {"b": "State_000"}}}"""),
    ("R05", "E", "SB", "NUM_FACTS is 0", """{"SB": {
  "HEADER": {^"NUM_FACTS": 0}, "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R05", "W", "SB", "each state has one fact, its own name", """{^"SB": {
  "Open": {"a": "Closed"}, "Closed": {"b": "Open"}}}"""),
    ("R06", "E", "SB/State1", "has the same facts as State_1 (1)", """{"SB": {
  "State_1": {"a": "State_0"}, ^"State1": {"b": "State_1"}, "State_0": {"c": "State1"}}}"""),
    ("R07", "E", "SB", "the sub-SB Sup is no SB", """{"SB": {"HEADER": {"SUB_SBS": {^"Sup": 0}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R07", "E", "SB", "Sub expands digit 17, but SB has only digit 0", """{"SB": {
  "HEADER": {"SUB_SBS": {^"Sub": 17}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R07", "E", "SB", "More expands digit 0, which Sub expands already", """{"SB": {
  "HEADER": {"SUB_SBS": {"Sub": 0, ^"More": 0}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "More": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R07", "E", "SB", "Sub is written twice in SUB_SBS, for digit 0 and digit 1", """{"SB": {
  "HEADER": {"SUB_SBS": [{"Sub": 0},
    {^"Sub": 1}]},
  "State_00": {"a": "State_11"}, "State_11": {"b": "State_00"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R07", "E", "SB", "More expands digit 0, which Sub expands already", """{"SB": {
  "HEADER": {"SUB_SBS": [{"Sub": 0}, {"_note": 1},
    {^"More": 0}]},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "More": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R07", "E", "SB", "digit 0 takes 3 values (a, b and c)", """{"SB": {
  "HEADER": {"SUB_SBS": {^"Sub": 0}},
  "State_a": {"x": "State_b"}, "State_b": {"y": "State_c"}, "State_c": {"z": "State_a"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R07", "I", "Second", "Sub also expands a fact of First", """{
  "First": {"HEADER": {"SUB_SBS": {"Sub": 0}},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Second": {"HEADER": {"SUB_SBS": {^"Sub": 0}},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R08", "E", "Sub", "SB > Sub > SB is a cycle", """{
  "SB": {"HEADER": {"SUB_SBS": {"Sub": 0}},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"HEADER": {"SUB_SBS": {^"SB": 0}},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R09", "W", "SB/State_1/Go", "the operation Go differs from go only by case", """{"SB": {
  "State_0": {"go": "State_1"}, "State_1": {^"Go": "State_0"}}}"""),
    ("R09", "W", "SB/State_O", "only by characters that look alike", """{"SB": {
  "State_0": {"go": "State_O"}, ^"State_O": {"back": "State_0"}}}"""),
    ("R09", "W", "SB/Statе_1", "the state Statе_1 differs from State_1 only by char", """{"SB": {
  "State_1": {"go": "Statе_1"}, ^"Statе_1": {"back": "State_1"}}}"""),
    ("R10", "E", "SB/State_2", "no operations lead here from INITIAL, State_0", """{"SB": {
  "State_0": {"a": "State_1"}, ^"State_2": {"b": "State_0"}, "State_1": {"c": "State_0"}}}"""),
    ("R10", "W", "SB/State_x", "it holds a failure value", """{"SB": {
  "_facts": {"0": {"failure": ["x"]}},
  "State_0": {"a": "State_1"}, ^"State_x": {"b": "State_0"}, "State_1": {"c": "State_0"}}}"""),
    ("R11", "E", "SB/State_2", "nothing leads from here to ACTIVATING, State_1", """{"SB": {
  "State_0": {"a": "State_1", "b": "State_2"}, ^"State_2": {"c": "State_2"}, "State_1": {}}}"""),
    ("R12", "E", "SB/State_2", "no operation leads out of here", """{"SB": {
  "State_0": {"a": "State_1", "b": "State_2"}, ^"State_2": {}, "State_1": {}}}"""),
    ("R13", "E", "Sub", "INITIAL and ACTIVATING are both State_0", """{
  "SB": {"HEADER": {"SUB_SBS": {"Sub": 0}},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"HEADER": {^"ACTIVATING": "State_0"},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R13", "E", "Sub", "no operations lead from State_0 to State_1", """{
  "SB": {"HEADER": {"SUB_SBS": {"Sub": 0}},
    "State_0": {"a": "State_1"}, "State_1": {}},
  ^"Sub": {"State_0": {"a": "State_0"}, "State_1": {"b": "State_0"}}}"""),
    ("R13", "E", "Sub", "SB/State_1/b lets the fact fall", """{
  "SB": {"HEADER": {"SUB_SBS": {"Sub": 0}},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"HEADER": {^"INITIAL": "State_0"}, "State_0": {"a": "State_1"}, "State_1": {}}}"""),
    ("R14", "W", "SB/State_00/a", "changes fact 1 together with other facts", """{
  "SB": {"HEADER": {"SUB_SBS": {"Sub": 0}},
    "State_00": {^"a": "State_11"}, "State_11": {}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R14", "W", "SB", "2 operations change Clamp together with other facts", """{
  "SB": {"HEADER": {"SUB_SBS": {^"Sub": 0}}, "_facts": {"0": {"name": "Clamp"}},
    "State_00": {"a": "State_11"}, "State_11": {"b": "State_00"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R14", "W", "Second", "Second starts with fact 1 on, while First starts with Sub off", """{
  "First": {"HEADER": {"SUB_SBS": {"Sub": 0}},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Second": {"HEADER": {"SUB_SBS": {^"Sub": 0}, "INITIAL": "State_1"},
    "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R16", "I", "SB/State_00/go", "what go does to fact 2 (to 1 or to 0) depends", """{"SB": {
  "State_00": {^"go": "State_11", "x": "State_01"}, "State_01": {"up": "State_00"},
  "State_10": {"y": "State_00"}, "State_11": {"z": "State_10", "go": "State_10"}}}"""),
    ("R17", "I", "SB/State_0/b", "is not marked as repeatable", """{"SB": {
  "State_0": {"a": "State_1", ^"b": "State_0"}, "State_1": {"b": "State_1", "c": "State_0"}}}"""),
    ("R18", "I", "SB/State_0/a", "a and b lead to State_1 in parallel", """{"SB": {
  "State_0": {^"a": "State_1", "b": "State_1"}, "State_1": {"c": "State_0"}}}"""),
    ("R18", "I", "SB/State_0/a", "count for nothing: both only move Sub", """{"SB": {
  "HEADER": {"SUB_SBS": {"Sub": 0}}, "_operations": {"a": {"cost": 1}, "b": {"cost": 3}},
  "State_0": {^"a": "State_1", "b": "State_1"}, "State_1": {"c": "State_0"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R18", "I", "SB/State_0/a", "in parallel, with no cost at b to choose by", """{"SB": {
  "_operations": {"a": {"cost": 1}},
  "State_0": {^"a": "State_1", "b": "State_1"}, "State_1": {"c": "State_0"}}}"""),
    ("R20", "W", "SB/State_1", "to a state that is declared safe", """{"SB": {
  "_states": {"State_0": {"safe": true}},
  "State_0": {"a": "State_1"}, ^"State_1": {"b": "State_2"}, "State_2": {"c": "State_1"}}}"""),
    ("R20", "W", "SB/State_x", "to a state that is without failure", """{"SB": {
  "_facts": {"0": {"failure": ["x"]}}, "HEADER": {"ACTIVATING": "State_1"},
  "State_0": {"a": "State_1", "b": "State_x"}, "State_1": {}, ^"State_x": {"c": "State_x"}}}"""),
    ("R21", "E", "SB/State_x1", "fact 1 has the failure value x here", """{"SB": {
  "_facts": {"0": {"failure": ["x", "y"]}}, "HEADER": {"ACTIVATING": "State_01"},
  "State_00": {"a": "State_01"}, "State_01": {}, ^"State_x1": {"b": "State_x0"},
  "State_x0": {}, "State_y0": {"c": "State_00"}}}"""),
    ("R21", "E", "SB", "no state has y, a failure value of Clamp", """{"SB": {
  "_facts": {"0": {"name": "Clamp", ^"failure": ["x", "y"]}}, "HEADER": {"ACTIVATING": "State_1"},
  "State_0": {"a": "State_1"}, "State_1": {}, "State_x": {"b": "State_0"}}}"""),
    ("R22", "W", "SB/State_0/a", "its risk is high, and every way", """{"SB": {
  "_operations": {"a": {"risk": "high"}},
  "State_0": {^"a": "State_1"}, "State_1": {"b": "State_2"}, "State_2": {}}}"""),
    ("R22", "I", "SB/State_2/c", "1 operation (c in State_2) and 1 state (", """{"SB": {
  "State_0": {"a": "State_1", "b": "State_2"}, "State_1": {"b": "State_2"},
  "State_2": {^"c": "State_3"}, "State_3": {}}}"""),
    ("R23", "I", "SB/State_x/b", "leads back to State_0, where the f", """{"SB": {
  "_facts": {"0": {"failure": ["x"]}}, "HEADER": {"ACTIVATING": "State_1"},
  "State_0": {"a": "State_1"}, "State_1": {}, "State_x": {^"b": "State_0"}}}"""),
    ("R23", "W", "SB/State_x/b", "with an operation of high risk or", """{"SB": {
  "_facts": {"0": {"failure": ["x"], "critical": true}}, "HEADER": {"ACTIVATING": "State_1"},
  "State_0": {"a": "State_1"}, "State_1": {}, "State_x": {^"b": "State_0"}}}"""),
    ("R28", "W", "SB/State_01/b", "nothing leads back from State_11, although all 4 other", """{
  "SB": {"State_00": {"a": "State_10", "c": "State_01"}, "State_01": {^"b": "State_11"},
  "State_10": {"d": "State_00", "a2": "State_20"}, "State_20": {"d2": "State_10"},
  "State_11": {"e": "State_10"}}}"""),
    ("R28", "W", "SB/State_01/b", "nothing leads back from State_11, although all", """{
  "SB": {"State_00": {"a": "State_10", "c": "State_01", "f": "State_20"},
  "State_01": {^"b": "State_11"}, "State_10": {"d": "State_00", "a2": "State_20"},
  "State_20": {"d": "State_00", "d2": "State_10"}, "State_11": {"d": "State_00"}}}"""),
    ("R29", "W", "SB", "Input should be greater than or equal to 0", """{"SB": {
  "_operations": {^"a": {"cost": -1}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "E", "SB", "a in _operations is not understood: confirm", """{"SB": {
  "_operations": {^"a": {"confirm": "surgeon"}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "W", "SB/State_0/a", "who acts has no effect here: it only moves Sub", """{"SB": {
  "HEADER": {"SUB_SBS": {"Sub": 0}}, "_operations": {"a": {"actor": "human"}},
  "State_0": {^"a": "State_1"}, "State_1": {"c": "State_0"}},
  "Sub": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "W", "SB", "_operations speaks of c, which is no operation", """{"SB": {
  "_operations": {^"c": {"cost": 1}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "W", "SB", "a requires SB/4, which is no fact", """{"SB": {
  "_operations": {"a": {"requires": {^"SB/4": "1"}}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "E", "_hazards/Overlap", "it names SB/x, which is no fact", """{
  "_hazards": [{"name": "Overlap", "facts": {^"SB/x": "1"}}],
  "SB": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "W", "_levels", "SB/a is not understood: a level is one of human, shared, aut", """{
  "_levels": {^"SB/a": "robot"},
  "SB": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "W", "_levels", "'SB/c' has no level: it is no operation and no fact", """{
  "_levels": {"SB/a": "human", "SB/0": "shared", "SB/State_1/b": "automatic", ^"SB/c": "human"},
  "SB": {"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "E", "SB", "character 9: 2 mm is compared with a measure in N", """{"SB": {
  "_facts": {"0": {"sources": {"force": "N"},
    "predicate": {"0": "force < 1 N", ^"1": "force > 2 mm"}}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "E", "SB", "'forse' is no source of this fact", """{"SB": {
  "_facts": {"0": {"sources": {"force": "N"},
    "predicate": {"0": "force < 1 N", ^"1": "forse > 2 N"}}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "E", "SB", "the unit of force: 'Newton' is no unit", """{"SB": {
  "_facts": {"0": {"sources": {^"force": "Newton"},
    "predicate": {"0": "force < 1 N", "1": "force > 2 N"}}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "E", "SB", "the range of force is no pair of numbers, the lower first", """{"SB": {
  "_facts": {"0": {"sources": {"force": "N"}, "range": {^"force": [50, 0]},
    "predicate": {"0": "force < 1 N", "1": "force > 2 N"}}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "E", "SB", "fact 1: no predicate says which value they mean", """{"SB": {
  "_facts": {"0": {^"sources": {"force": "N"}, "predicate": "more than 2 N"}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "W", "SB", "no predicate uses the source gap", """{"SB": {
  "_facts": {"0": {"sources": {"force": "N", ^"gap": "mm"},
    "predicate": {"0": "force < 1 N", "1": "force > 2 N"}}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "W", "SB", "no state has the value 2, for which there is a predicate", """{"SB": {
  "_facts": {"0": {"sources": {"force": "N"},
    "predicate": {"0": "force < 1 N", "1": "force > 2 N", ^"2": "force > 3 N"}}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R29", "W", "SB", "no predicate says when it is 0, so it is never sensed", """{"SB": {
  "_facts": {"0": {"sources": {"force": "N"}, ^"predicate": {"1": "force > 2 N"}}},
  "State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}}}"""),
    ("R32", "W", "SB/State_1", "2 elements (State_1 and b) have no source", """{"SB": {
  "_sources": {"State_0": [{"file": "a.md", "line": 1, "words": "off"}],
    "a": [{"file": "a.md", "line": 2, "words": "switch on"}]},
  "State_0": {"a": "State_1"}, ^"State_1": {"b": "State_0"}}}"""),
    ("R31", "I", "SB/State_1/b", "2 operations (b and c) have no title", """{"SB": {
  "_operations": {"a": {"title": "Wash the hands"}},
  "_facts": {"0": {"name": "Hands washed"}}, "State_0": {"a": "State_1"},
  "State_1": {^"b": "State_0", "a": "State_1", "c": "State_0"}}}"""),
    ("R31", "I", "SB", "1 fact (2) has no name", """{^"SB": {
  "_states": {"State_00": {"title": "Nothing is done"}},
  "_operations": {"a": {"title": "Wash the hands"}, "b": {"title": "Begin"}},
  "_facts": {"0": {"name": "Hands washed"}},
  "State_00": {"a": "State_11"}, "State_11": {"b": "State_00"}}}"""),
    ("R31", "I", "SB/ready", "1 state (ready) has no title", """{"SB": {
  "_states": {"at work": {"title": "At work"}},
  "_operations": {"a": {"title": "Wash the hands"}, "b": {"title": "Begin"}},
  ^"ready": {"a": "at work"}, "at work": {"b": "ready"}}}"""),
]  # fmt: skip


def read(text: str, file: str = "planted.json") -> Blueprint:
    return read_blueprint(parse_json(text, file))


def sample(name: str) -> Blueprint:
    return read((SAMPLES / name).read_text("utf-8"), f"samples/{name}")


def planted(text: str) -> tuple[Blueprint, int, int]:
    """The blueprint, and line and column of the marked key."""
    before, _, after = text.partition("^")
    return read(before + after), before.count("\n") + 1, len(before.rpartition("\n")[2]) + 1


def errors(blueprint: Blueprint) -> set[tuple[str, str]]:
    found = inspect(blueprint)
    return {(f.rule, str(f.address)) for f in found if f.severity is Severity.ERROR}


@pytest.mark.parametrize(("rule", "severity", "address", "words", "text"), PLANTED)
def test_a_planted_fault_is_found_where_it_stands(
    rule: str, severity: str, address: str, words: str, text: str
) -> None:
    blueprint, line, column = planted(text)
    found = [f for f in inspect(blueprint, [rule]) if words in f.message]
    assert len(found) == 1, [str(f) for f in inspect(blueprint)]
    (finding,) = found
    assert (finding.rule, finding.severity.value, str(finding.address)) == (rule, severity, address)
    assert (finding.place.line, finding.place.column) == (line, column)
    assert finding.advice


def fixable() -> Iterator[tuple[Blueprint, Finding, Fix]]:
    """The planted faults that have a fix."""
    for rule, _, _, words, text in PLANTED:
        blueprint, _, _ = planted(text)
        (finding,) = [f for f in inspect(blueprint, [rule]) if words in f.message]
        if finding.fix is not None:
            yield blueprint, finding, finding.fix


def test_a_fix_takes_the_finding_away_and_brings_no_new_error() -> None:
    fixed_rules = set()
    for blueprint, finding, fix in fixable():
        fixed = fix.apply(blueprint)
        assert read(fixed.document.text).meaning == fixed.meaning
        left = {(f.rule, f.address, f.message) for f in inspect(fixed)}
        assert (finding.rule, finding.address, finding.message) not in left
        assert errors(fixed) <= errors(blueprint), fix.words
        fixed_rules.add(finding.rule)
    expected = "R01 R02 R03 R04 R05 R07 R08 R10 R17 R20 R21 R23 R28"
    assert fixed_rules == set(expected.split())


def test_titles_are_missed_only_where_somebody_has_begun_to_write_them() -> None:
    edges = '"State_0": {"a": "State_1"}, "State_1": {"b": "State_0"}'
    named = '"_facts": {"0": {"name": "Hands washed"}}'
    assert not inspect(read(f'{{"SB": {{{edges}}}}}'), ["R31"])
    assert not inspect(read(f'{{"SB": {{{named}, {edges}}}}}'), ["R31"])
    titles = '"_operations": {"a": {"title": "Wash"}, "State_1/b": {"title": "Begin"}}'
    assert not inspect(read(f'{{"SB": {{{named}, {titles}, {edges}}}}}'), ["R31"])
    other = f'"Other": {{{edges}}}'
    found = inspect(read(f'{{"SB": {{{named}, {titles}, {edges}}}, {other}}}'), ["R31"])
    assert [str(one.address) for one in found] == ["Other", "Other/State_0/a"]
    assert [[str(spot.address) for spot in one.others] for one in found] == [
        [],
        ["Other/State_1/b"],
    ]


def test_a_reverse_that_leads_astray_is_led_back_and_not_doubled() -> None:
    text = next(text for rule, *_, text in PLANTED if rule == "R28" and '{"d": "State_00"}' in text)
    blueprint, _, _ = planted(text)
    (finding,) = inspect(blueprint, ["R28"])
    assert finding.advice.endswith("and leads to State_00 here; did you mean State_01?")
    assert finding.fix is not None
    mended = finding.fix.apply(blueprint)
    assert mended["SB"].table["State_11"] == {"d": "State_01"}
    assert not list(inspect(mended, ["R28"]))


def test_every_rule_has_a_planted_fault() -> None:
    assert {rule.id for rule in ALL} - {rule for rule, *_ in PLANTED} == {"R15"}
    assert list(RULES) == sorted({*(rule.id for rule in ALL), *PROVED, *WITH_MORE})


# The samples


def test_the_papers_hanoi_has_exactly_its_two_misprints() -> None:
    found = [f for f in inspect(sample("hanoi.json")) if f.severity is Severity.ERROR]
    assert [str(f) for f in found] == [
        "samples/hanoi.json:73:13 R15 SB1/State_cbb/Op_1c: moves fact 1 to b; did you mean Op_1b?",
        "samples/hanoi.json:100:13 R15 SB1/State_cbc/Op_2b: moves fact 2 to a; did you mean Op_2a?",
    ]
    assert [f.fix.words for f in found if f.fix] == ["Rename to Op_1b", "Rename to Op_2a"]


def test_both_fixes_give_the_corrected_hanoi() -> None:
    blueprint = sample("hanoi.json")
    for finding in inspect(blueprint, ["R15"]):
        assert finding.fix is not None
        blueprint = finding.fix.apply(blueprint)
    assert blueprint == sample("hanoi-corrected.json")


@pytest.mark.parametrize(
    "name", ["hanoi-corrected.json", "hanoi-2.json", "registration.json", "hfsm.json"]
)
def test_the_other_samples_have_no_errors(name: str) -> None:
    assert not errors(sample(name))


def test_hfsm_has_a_warning_for_its_mixed_edge() -> None:
    found = [f for f in inspect(sample("hfsm.json")) if f.severity is Severity.WARNING]
    assert [(f.rule, str(f.address)) for f in found] == [("R14", "SB1/State100/Operation100B")]


# What needs more than a line


def test_no_majority_no_alarm() -> None:
    """R15 needs a majority: an operation of two equal halves has none."""
    table = {
        "State_00": {"x": "State_10", "y": "State_01"},
        "State_10": {"x": "State_11"},
        "State_01": {"x": "State_11"},
        "State_11": {"x": "State_10"},
    }
    blueprint = read(json.dumps({"SB": table}))
    assert not inspect(blueprint, ["R15"])


def test_an_operation_that_is_there_already_was_not_meant() -> None:
    """R15 needs an operation absent from the source state."""
    blueprint = sample("hanoi.json")
    text = blueprint.document.text.replace(
        '"Op_1c": "State_bbb",', '"Op_1c": "State_bbb", "Op_1b": "State_bbb",', 1
    )
    assert [str(f.address) for f in inspect(read(text), ["R15"])] == ["SB1/State_cbc/Op_2b"]


def test_a_fact_is_called_by_its_name() -> None:
    text = sample("hanoi.json").document.text.replace(
        '"HEADER": {},', '"HEADER": {}, "_facts": {"0": {"name": "disk 1"}},', 1
    )
    first = inspect(read(text), ["R15"])[0]
    assert first.message == "moves disk 1 to b"


def test_load_marked_operations_are_not_mixed_and_need_no_way_back() -> None:
    blueprint = sample("hfsm.json")
    text = blueprint.document.text.replace(
        '"State000": {', '"_operations": {"Operation100B": {"subs": "load"}}, "State000": {', 1
    )
    assert not inspect(read(text), ["R14"])


def test_a_fall_that_is_loaded_asks_nothing_of_the_sub_sb() -> None:
    text = (
        '{"SB": {"HEADER": {"SUB_SBS": {"Sub": 0}}, "State_0": {"a": "State_1"},'
        ' "State_1": {"b": "State_0"}}, "Sub": {"State_0": {"a": "State_1"}, "State_1": {}}}'
    )
    assert [f.rule for f in inspect(read(text), ["R13"])] == ["R13"]
    loaded = text.replace('"State_0"', '"_operations": {"b": {"subs": "load"}}, "State_0"', 1)
    assert not inspect(read(loaded), ["R13"])


def test_a_dead_end_is_no_trap_but_what_leads_only_there_is() -> None:
    table = {
        "State_0": {"a": "State_1", "b": "State_2"},
        "State_2": {"c": "State_3"},
        "State_3": {},
        "State_1": {},
    }
    found = inspect(read(json.dumps({"SB": table})), ["R11", "R12"])
    assert [(f.rule, f.address.state) for f in found] == [("R11", "State_2"), ("R12", "State_3")]


def test_costs_and_repeatable_marks_answer_their_notes() -> None:
    notes = {"a": {"cost": 1}, "State_0/b": {"cost": 2}, "loop": {"repeatable": True}}
    table = {"State_0": {"a": "State_1", "b": "State_1", "loop": "State_0"}, "State_1": {}}
    assert not inspect(read(json.dumps({"SB": {"_operations": notes, **table}})), ["R17", "R18"])


def test_unreachable_states_that_hang_together_are_one_finding() -> None:
    blueprint = read(
        '{"SB": {"State_0": {"a": "State_1"}, "State_2": {"b": "State_3"},'
        ' "State_3": {"c": "State_0"}, "State_1": {"d": "State_0"}}}'
    )
    (found,) = inspect(blueprint, ["R10"])
    assert [str(address) for address in found.addresses] == ["SB/State_2", "SB/State_3"]
    assert found.fix is not None
    assert found.fix.words == "Delete 2 states"
    assert list(found.fix.apply(blueprint)["SB"].table) == ["State_0", "State_1"]


def test_a_rule_reports_a_hundred_places_and_how_many_more() -> None:
    table = {"State_000": {f"go{i:03}": f"State_{i:03}" for i in range(1, 251)}}
    blueprint = read(json.dumps({"SB": table}))
    found = inspect(blueprint, ["R02"])
    assert len(found) == LISTED
    assert found[-1].message.endswith("(150 more places in SB are not listed)")
    assert sum("not listed" in f.message for f in found) == 1


def test_near_names_are_sought_for_what_is_listed_and_for_names_that_somebody_typed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[str] = []

    def near(_: NearNames, name: str) -> str:
        asked.append(name)
        return ""

    monkeypatch.setattr(NearNames, "near", near)
    table = {"State_000": {f"go{i:03}": f"State_{i:03}" for i in range(1, 251)}}
    assert len(inspect(read(json.dumps({"SB": table})), ["R02"])) == LISTED
    assert len(asked) == LISTED
    assert nearest("State_001", ["State_000"]) == "State_000"
    assert nearest("State_001" * 1000, ["State_000" * 1000]) == ""


def test_findings_stand_in_the_order_of_the_text() -> None:
    found = inspect(sample("registration.json"))
    places = [(f.place.line, f.place.column) for f in found]
    assert places == sorted(places)


def test_an_unknown_rule_is_told() -> None:
    with pytest.raises(UsageError, match="R99"):
        inspect(sample("hfsm.json"), ["R99"])


def test_an_empty_file_has_nothing_to_report() -> None:
    assert inspect(read("{}")) == ()


def fixes_of(found: tuple[Finding, ...]) -> Iterator[Finding]:
    yield from (f for f in found if f.fix is not None)


def test_the_fixes_of_the_samples_bring_no_new_errors() -> None:
    for name in ("hanoi.json", "registration.json", "hfsm.json"):
        blueprint = sample(name)
        for finding in fixes_of(inspect(blueprint)):
            assert finding.fix is not None
            try:
                fixed = finding.fix.apply(blueprint)
            except EditRefused as refusal:
                pytest.fail(f"{finding}: {refusal}")
            assert finding.message not in {f.message for f in inspect(fixed, [finding.rule])}
            assert errors(fixed) <= errors(blueprint)


def test_imported_files_are_inspected_too_and_named(tmp_path: Path) -> None:
    low = tmp_path / "low.json"
    low.write_text(
        '{"LOW": {"_facts": {"9": {}},\n'
        ' "State_0": {"up": "State_1", "up": "State_1"},\n'
        ' "State_1": {}}}'
    )
    (tmp_path / "top.json").write_text(
        '{"_imports": ["low.json"],\n\n\n "TOP": {"State_0": {"go": "State_x"}}}'
    )
    blueprint = read_blueprint(read_document(tmp_path / "top.json"))
    found = inspect(blueprint, ("R01", "R02", "R29"))
    assert [(f.rule, Path(f.place.file).name, f.place.line) for f in found] == [
        ("R02", "top.json", 4),
        ("R29", "low.json", 1),
        ("R01", "low.json", 2),
    ]
    fix = found[-1].fix
    assert fix is not None
    assert inspect(fix.apply(blueprint), ("R01",)) == ()
