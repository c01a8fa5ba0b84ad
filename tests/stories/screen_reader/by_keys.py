"""Does a whole piece of work in a running window by keys alone, and hears every step.

Debian's Python runs it: ``python3 -m tests.stories.screen_reader.by_keys PROCESS FILE``. It saves
as FILE and prints as JSON what the tree says at the end. It ends with 1, and tells what was heard,
if a step was not heard as it should be.
"""

from __future__ import annotations

import json
import sys
from functools import partial

from tests.stories.screen_reader import steps
from tests.stories.screen_reader.reader import Reader, has_focus, told


def take(reader: Reader, *group: steps.Step) -> None:
    """Press the key of each step, wait until it is heard, and type its text."""
    for step in group:
        reader.heard.clear()
        reader.press(step.key)
        if step.heard:
            hears = partial(_has_heard, reader, step.heard)
            reader.until(hears, f"{step.heard!r} after {step.key}")
        else:
            reader.pump(0.3)
        print(f"{step.key:14} {' | '.join(reader.heard[:3])}", flush=True)
        if step.text:
            reader.type(step.text)
            reader.pump(0.2)


def _has_heard(reader: Reader, wanted: str) -> bool:
    return any(wanted in one for one in reader.heard)


def main() -> None:
    """The whole work; a new drawing begins on the start page."""
    process, file = int(sys.argv[1]), sys.argv[2]
    reader = Reader(process)
    reader.activate()
    take(reader, steps.Step("Ctrl+N", "'Canvas'"), *steps.FACTS, *steps.STATES, *steps.MENU)
    # A menu that is open is found by walking, too.
    menu = [thing.name for _, thing in reader.walk() if thing.getRoleName() == "popup menu"]
    take(reader, steps.Step("Esc"), *steps.BACK)
    focused = [told(thing) for _, thing in reader.walk() if has_focus(thing)]
    take(reader, *steps.SUB, *steps.CHECK, *steps.RUN, *steps.SUPERVISE, *steps.STOP)
    take(reader, *steps.LETTER)
    for _ in range(2):
        # The first closes the menu, the second leaves the menu bar.
        reader.press("Esc")
        reader.pump(0.3)
    take(reader, *steps.SAVE)
    reader.type(file)
    reader.press("Return")
    reader.until(lambda: bool(reader.find("drawn.json", "filler")), "the name of the saved file")
    canvas = reader.find("Canvas")[0]
    states = [thing.name.split(",")[0] for deep, thing in reader.walk(canvas, 1) if deep == 1]
    run = [thing.name for _, thing in reader.walk() if (thing.name or "").startswith("The run: ")]
    combos = [thing.name for _, thing in reader.walk() if thing.getRoleName() == "combo box"]
    print(json.dumps({"states": states, "run": run[0] if run else "", "menu": menu,
                      "focused": focused, "combos": combos}))  # fmt: skip


main()
