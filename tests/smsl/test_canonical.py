"""The canonical layout changes only the layout, and is the same when applied twice."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.smsl import json_form, native_form
from smsl_studio.smsl.files import read_document
from tests.counts import share_of
from tests.smsl.native_texts import native
from tests.smsl.texts import VALUES, texts

Json = Any
SAMPLES = Path(__file__).parents[2] / "samples"
_COMMENT = re.compile(r'"[^"\\\r\n]*+(?:\\[^\r\n][^"\\\r\n]*+)*+"|//[^\r\n]*')


def comments(text: str) -> list[str]:
    return sorted(found.rstrip() for found in _COMMENT.findall(text) if found[0] == "/")


@settings(max_examples=share_of(100), deadline=None)
@given(texts())
def test_a_tidied_json_text_says_the_same(text: str) -> None:
    tidied = json_form.tidy(json_form.parse(text, "f.json"))
    again = json_form.parse(tidied.text, "f.json")
    assert json.dumps(again.values) == json.dumps(json.loads(text.removeprefix("\ufeff")))
    assert json_form.tidy(again) is again


@settings(max_examples=share_of(100), deadline=None)
@given(VALUES, st.integers(0, 10**6))
def test_a_tidied_native_text_says_the_same_with_all_its_comments(values: Json, seed: int) -> None:
    document = native_form.parse(native(values, seed), "f.smsl")
    tidied = native_form.tidy(document)
    again = native_form.parse(tidied.text, "f.smsl")
    assert json.dumps(again.values) == json.dumps(document.values)
    assert comments(tidied.text) == comments(document.text)
    assert native_form.tidy(again) is again


@settings(max_examples=share_of(100), deadline=None)
@given(VALUES)
def test_what_is_written_anew_is_tidy(values: Json) -> None:
    for form in (json_form, native_form):
        document = form.parse(form.write(values), "f")
        assert form.tidy(document) is document


def test_doubled_keys_and_spellings_stay_as_they_are_written() -> None:
    text = '\ufeff{"\\u0041":{"S":{"a":"S"},"S":{}},\r\n"_n":[1.50,[],{"x":1e2}],"_e":[ ]}'
    assert json_form.tidy(json_form.parse(text, "f")).text == (
        '\ufeff{\r\n    "\\u0041": {\r\n        "S": {\r\n            "a": "S"\r\n        },\r\n'
        '        "S": {}\r\n    },\r\n    "_n": [\r\n        1.50,\r\n        [],\r\n        {\r\n'
        '            "x": 1e2\r\n        }\r\n    ],\r\n    "_e": []\r\n}\r\n'
    )


UGLY = """// a licence


{ #NAME:SB1 // the name
#INITIAL:   "State000"
# RIGHTS: (c) us, 2026
# SUB_SBS: ( SB2:1,,"SB 3" : 2 )
// about the layout
# _layout: {"a":[1,2.50],"b":{}}
State000:[Op->State100] // c1
State100: [ // opened
  a // inner
  -> b , c->d // cd


  // above e
  e->f,, // of e
  // last
]State000:[

]
S // x
:[ ]
// end
}, // after
{#NAME:B
S:[]}"""

TIDY = """// a licence

{
    # NAME: SB1 // the name
    # INITIAL: "State000"
    # RIGHTS: (c) us, 2026
    # SUB_SBS: (SB2: 1, "SB 3": 2)
    // about the layout
    # _layout: {"a": [1, 2.50], "b": {}}

    State000: [Op -> State100], // c1
    State100: [ // opened
        // inner
        a -> b,
        c -> d, // cd

        // above e
        e -> f // of e
        // last
    ],
    State000: [ ],
    // x
    S: [ ]
    // end
}, // after
{
    # NAME: B
    S: [ ]
}
"""


def test_the_canonical_layout_of_a_native_text() -> None:
    assert native_form.tidy(native_form.parse(UGLY, "f")).text == TIDY


@pytest.mark.parametrize("name", ["hanoi.json", "registration.json", "three-levels.json"])
def test_the_samples_are_tidy(name: str) -> None:
    document = read_document(SAMPLES / name)
    assert json_form.tidy(document) is document
