"""Any event of any kind there is, drawn from the types of its fields."""

from __future__ import annotations

from dataclasses import fields
from typing import get_type_hints

from hypothesis import strategies as st

from smsl_studio.runlog.decoding import EVENTS
from smsl_studio.runlog.events import Event

SECONDS = st.floats(0, 1e9).map(lambda t: round(t, 6))


@st.composite
def events(draw: st.DrawFn) -> Event:
    """Any event, of any kind there is."""
    kind = draw(st.sampled_from(sorted(EVENTS)))
    hints = get_type_hints(EVENTS[kind])
    given = {
        item.name: draw(SECONDS if hints[item.name] is float else st.from_type(hints[item.name]))
        for item in fields(EVENTS[kind])
    }
    return EVENTS[kind](**given)
