"""The keys of a whole piece of work: draw, check, run, supervise, stop, save. No pointer is used.

``tests/stories/test_keyboard_alone.py`` presses them in its own process. ``by_keys.py`` presses
them in a window on a real bus, and there each step must be heard by assistive tools.
"""

from __future__ import annotations

from typing import NamedTuple


class Step(NamedTuple):
    """A key with its modifiers is pressed, ``heard`` is told then, and ``text`` is typed."""

    key: str
    heard: str = ""
    text: str = ""


def _operation(name: str, source: str, target: str) -> tuple[Step, ...]:
    """From the selected state, or the target of the selected operation, to a state."""
    return (
        Step("Tab", "text 'Operation'", name),
        Step("Tab", "text 'Target state'", target),
        Step("Return", f"list item '{name}, {source} to {target}"),
    )


CHAIN = (("clamp", "S100"), ("plan", "S110"), ("check", "S111"), ("open", "S011"), ("park", "S001"),
         ("home", "S000"))  # fmt: skip
"""Operations with the states to which they lead, from S000 on."""

FACTS = (Step("Ctrl+Shift+P"), Step("Tab"), Step("Tab"), Step("Tab", "'Facts'", "3"),
         Step("Return"), Step("Ctrl+Shift+P", "'Canvas'"))  # fmt: skip

STATES = (
    Step("Ctrl+Shift+N", "text 'State'", "S000"),
    Step("Return", "list item 'S000, selected"),
    *(step for name, state in CHAIN for step in (
        Step("Tab", "text 'Operation'", name), Step("Tab", "text 'Target state'", state),
    )),
    Step("Return", "list item 'home, S001 to S000"),
)  # fmt: skip

MENU = (Step("Menu", "popup menu 'Menu of home'"),)

BACK = (
    Step("G", "list item 'S000, selected"),
    Step("O", "list item 'clamp, S000 to S100"),
    Step("G", "list item 'S100, selected"),
    *_operation("unclamp", "S100", "S000"),
    Step("Shift+G", "list item 'S100, selected"),
    Step("O", "list item 'plan, S100 to S110"),
    Step("G", "list item 'S110, selected"),
    *_operation("replan", "S110", "S100"),
    Step("Shift+G", "list item 'S110, selected"),
    Step("O", "list item 'check, S110 to S111"),
    Step("G", "list item 'S111, selected"),
    *_operation("recheck", "S111", "S110"),
    Step("Esc"),
)

SUB = (
    Step("Ctrl+K", "'Find anything, or run a command'", "Attach a sub"),
    Step("Return"),
    Step("Down", "0  Fact 1"),
    Step("Down", "1  Fact 2"),
    Step("Right", "New State Branch"),
    Step("Return"),
    Step("Return", "SB2"),
    Step("Ctrl+Shift+N", "text 'State'", "Off0"),
    Step("Return", "list item 'Off0, selected"),
    *_operation("fix", "Off0", "On1"),
    *_operation("release", "On1", "Off0"),
    Step("Esc"),
    Step("Backspace", "SB1, 6 states"),
)

CHECK = (Step("F3", "announced: "),)
RUN = (Step("Ctrl+2"), Step("F10", "announced: The run: Paused."))
SUPERVISE = (Step("Ctrl+3", "Supervise"), Step("2", "unclamp"), Step("V", "Veto unclamp once"),
             Step("Return"))  # fmt: skip
STOP = (Step("F8", "announced: The run: Stopped."),)
LETTER = (Step("Ctrl+1", "'Canvas'"), Step("Alt+B", "menu item 'Add state'"))
SAVE = (Step("Ctrl+S"),)

DRAWN = {
    "SB1": {
        "S000": {"clamp": "S100"},
        "S100": {"plan": "S110", "unclamp": "S000"},
        "S110": {"check": "S111", "replan": "S100"},
        "S111": {"open": "S011", "recheck": "S110"},
        "S011": {"park": "S001"},
        "S001": {"home": "S000"},
    },
    "SB2": {"Off0": {"fix": "On1"}, "On1": {"release": "Off0"}},
}
"""The tables of what was drawn."""
