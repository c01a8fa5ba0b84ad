"""Random events of every kind, drawn from the types of their fields."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, get_type_hints

from hypothesis import strategies as st

from smsl_studio.runlog.decoder import EVENTS
from smsl_studio.runlog.events import Event

SECONDS = st.floats(0, 1e9).map(lambda t: round(t, 6))
PRICES = st.dictionaries(st.text(), SECONDS)


@st.composite
def events(draw: st.DrawFn) -> Event:
    """Any event, of any kind there is."""
    kind = draw(st.sampled_from(sorted(EVENTS)))
    hints = get_type_hints(EVENTS[kind])
    given = {item.name: draw(_strategy(hints[item.name])) for item in fields(EVENTS[kind])}
    return EVENTS[kind](**given)


def _strategy(hint: Any) -> st.SearchStrategy[Any]:
    if hint is float:
        return SECONDS
    return PRICES if hint == Mapping[str, float] else st.from_type(hint)
