"""Reads a running window as a screen reader does, presses keys, and does what the tree offers.

Debian's Python runs it, because it has ``pyatspi``, from the folder of the checkout:

    /usr/bin/python3 -m tests.stories.screen_reader.reader VERB ...

    tree --below Canvas
    find State_aab
    do Press State_aab
    do "Go to target" Op_1b --inside State_aaa
    keys Ctrl+S F2 Return
    type State_aac

``desk.sh`` beside it opens a file on a virtual screen with a bus of its own, for this program.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import gi

gi.require_version("Atspi", "2.0")

import pyatspi  # noqa: E402
from gi.repository import Atspi, GLib  # noqa: E402

MODIFIERS = {"Ctrl": 37, "Shift": 50, "Alt": 64}
"""The key codes of the left modifiers on a usual keyboard."""
ROWS = {10: "1234567890-=", 24: "qwertyuiop[]", 38: "asdfghjkl;'`", 52: "zxcvbnm,./"}
"""The letters of a usual keyboard, by the key code of the first of each row."""
CODES = {
    "Esc": 9, "Backspace": 22, "Tab": 23, "Return": 36, "Enter": 36, "Space": 65, "Home": 110,
    "Up": 111, "PageUp": 112, "Left": 113, "Right": 114, "End": 115, "Down": 116,
    "PageDown": 117, "Del": 119, "Menu": 135, "F11": 95, "F12": 96, "+": 21,
    **{f"F{number}": 66 + number for number in range(1, 11)},
    **{letter: first + at for first, row in ROWS.items() for at, letter in enumerate(row)},
}  # fmt: skip
BEYOND = 0x01000000
"""Letters beyond Latin-1 are numbered from here."""
EVENTS = ("object:state-changed:focused", "object:announcement",
          "object:property-change:accessible-description", "object:active-descendant-changed",
          "object:property-change:accessible-name")  # fmt: skip
DEEPEST = 60


class Reader:
    """One window program on the bus; ``heard`` are the sentences that its events told, in order."""

    def __init__(self, process: int = 0, patience: float = 60.0) -> None:
        self.heard: list[str] = []
        self._patience, self._process = patience, process
        for event in EVENTS:
            pyatspi.Registry.registerEventListener(self._hear, event)
        self.top: Any = None
        self.until(self._look, "the program on the accessibility bus")

    def _look(self) -> bool:
        for one in pyatspi.Registry.getDesktop(0):
            wanted = self._process or "smsl" in (one.name or "").lower() if one else False
            same = one is not None and self._process in (0, one.get_process_id())
            if wanted and same and one.childCount:
                self.top = one
        return self.top is not None

    def activate(self) -> None:
        """Give the first window the keyboard, if none has it.

        A bare screen has no window manager that does, so this clicks on the status line.
        """
        frames = [self.top.getChildAtIndex(at) for at in range(self.top.childCount)]
        shown = [one for one in frames if one.getState().contains(pyatspi.STATE_VISIBLE)]
        if shown and not any(one.getState().contains(pyatspi.STATE_ACTIVE) for one in shown):
            place = shown[0].queryComponent().getExtents(pyatspi.DESKTOP_COORDS)
            Atspi.generate_mouse_event(place.x + 3, place.y + place.height - 3, "b1c")
            self.until(lambda: shown[0].getState().contains(pyatspi.STATE_ACTIVE), "the window")

    def _hear(self, event: Any) -> None:
        kind = str(event.type)
        if "state-changed" in kind and not event.detail1:
            return
        try:
            if "announcement" in kind:
                self.heard.append(f"announced: {event.any_data}")
            else:
                thing = event.any_data if "active-descendant" in kind else event.source
                self.heard.append(told(thing))
        except (GLib.GError, AttributeError):
            return

    def pump(self, seconds: float = 0.05) -> None:
        """Take the events that have come."""
        context = GLib.MainContext.default()
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if not context.iteration(False):
                time.sleep(0.005)

    def until(self, there: Callable[[], bool], what: str) -> None:
        """Wait until something is so; ends the program with what it has heard if it never is."""
        end = time.monotonic() + self._patience
        while time.monotonic() < end:
            self.pump()
            try:
                if there():
                    return
            except GLib.GError:
                continue
        sys.exit(f"never came: {what}\n" + "\n".join(self.heard[-20:]))

    # The tree

    def walk(self, thing: Any = None, depth: int = DEEPEST) -> Iterator[tuple[int, Any]]:
        """Everything below a thing (or the program) with its depth, hidden things left out."""
        yield from _walk(thing if thing is not None else self.top, 0, depth)

    def find(self, name: str, role: str = "", inside: str = "") -> list[Any]:
        """The things that are shown and whose name is this, or begins with it and a comma."""
        below = self.find(inside)[0] if inside else None
        return [
            thing
            for _, thing in self.walk(below)
            if _is_called(thing.name or "", name) and role in ("", thing.getRoleName())
        ]

    def act(self, action: str, name: str, role: str = "", inside: str = "") -> bool:
        """Do an action of the first thing of this name that has it."""
        for thing in self.find(name, role, inside):
            try:
                offered = thing.queryAction()
            except NotImplementedError:
                continue
            for at in range(offered.nActions):
                if offered.getName(at) == action:
                    return bool(offered.doAction(at))
        return False

    # The keyboard

    def press(self, keys: str) -> None:
        """Press a key with its modifiers, such as ``Ctrl+Shift+N``."""
        *held, key = keys.split("+") if keys != "+" else ["+"]
        codes = [MODIFIERS[name] for name in held]
        for modifier in codes:
            Atspi.generate_keyboard_event(modifier, None, Atspi.KeySynthType.PRESS)
        code = CODES[key if key in CODES else key.lower()]
        Atspi.generate_keyboard_event(code, None, Atspi.KeySynthType.PRESSRELEASE)
        for modifier in reversed(codes):
            Atspi.generate_keyboard_event(modifier, None, Atspi.KeySynthType.RELEASE)
        self.pump()

    def type(self, text: str) -> None:
        """Type a text, letter by letter."""
        for letter in text:
            Atspi.generate_keyboard_event(_symbol(letter), None, Atspi.KeySynthType.SYM)
            self.pump(0.02)


def _symbol(letter: str) -> int:
    return ord(letter) if ord(letter) < 0x100 else BEYOND + ord(letter)


def told(thing: Any) -> str:
    """A thing as it is read: role, name, description, states, and value or text."""
    states = thing.getState()
    words = [thing.getRoleName(), repr(thing.name or "")]
    words += [thing.description] if thing.description else []
    words += [word for word, state in STATES.items() if states.contains(state)]
    if states.contains(pyatspi.STATE_EXPANDABLE) and not states.contains(pyatspi.STATE_EXPANDED):
        words.append("(collapsed)")
    return " ".join(words)


def has_focus(thing: Any) -> bool:
    """Whether a thing says that it has the keyboard focus."""
    return bool(thing.getState().contains(pyatspi.STATE_FOCUSED))


STATES = {
    "(focused)": pyatspi.STATE_FOCUSED, "(selected)": pyatspi.STATE_SELECTED,
    "(checked)": pyatspi.STATE_CHECKED, "(expanded)": pyatspi.STATE_EXPANDED,
}  # fmt: skip


def details(thing: Any) -> Iterator[str]:
    """What a thing offers besides: its text, its relations and its actions."""
    try:
        text = thing.queryText().getText(0, -1)
        if text and text != thing.name:
            yield f"text: {text!r}"
    except NotImplementedError:
        pass
    for one in thing.getRelationSet():
        ends = [one.getTarget(at).name for at in range(one.getNTargets())]
        yield f"{one.getRelationType().value_nick.replace('-', ' ')}: {'; '.join(ends)}"
    try:
        offered = thing.queryAction()
        names = [offered.getName(at) for at in range(offered.nActions)]
        if names:
            yield f"actions: {', '.join(names)}"
    except NotImplementedError:
        pass


def _walk(thing: Any, deep: int, depth: int) -> Iterator[tuple[int, Any]]:
    try:
        states, count = thing.getState(), thing.childCount
        # Qt calls the cells of a table hidden that are scrolled out of view.
        cell = thing.getRoleName() == "table cell"
        if deep and not cell and not states.contains(pyatspi.STATE_VISIBLE):
            return
        yield deep, thing
        for at in range(count) if deep < depth else ():
            child = thing.getChildAtIndex(at)
            if child is not None:
                yield from _walk(child, deep + 1, depth)
    except GLib.GError:
        return


def _is_called(name: str, wanted: str) -> bool:
    return name == wanted or name.startswith(f"{wanted},")


def main() -> None:
    """The program: prints the tree, finds a thing, does an action, or presses keys."""
    parser = argparse.ArgumentParser(prog="reader", description=__doc__.split("\n")[0])
    parser.add_argument("--process", type=int, default=0, help="of several windows this one")
    verbs = parser.add_subparsers(dest="verb", required=True)
    tree = verbs.add_parser("tree", help="print everything that is shown")
    tree.add_argument("--below", default="", help="only what is below this name")
    tree.add_argument("--depth", type=int, default=DEEPEST)
    tree.add_argument("--brief", action="store_true", help="without texts, relations and actions")
    find = verbs.add_parser("find", help="print the things of a name")
    find.add_argument("name")
    do = verbs.add_parser("do", help="do an action of a thing")
    do.add_argument("action")
    do.add_argument("name")
    for one in (find, do):
        one.add_argument("--inside", default="", help="only below this name")
        one.add_argument("--role", default="")
    keys = verbs.add_parser("keys", help="press keys")
    keys.add_argument("keys", nargs="+")
    typed = verbs.add_parser("type", help="type a text")
    typed.add_argument("text")
    _serve(parser.parse_args())


def _serve(given: argparse.Namespace) -> None:
    reader = Reader(given.process)
    reader.heard.clear()
    if given.verb == "tree":
        below = reader.find(given.below)[0] if given.below else None
        for deep, thing in reader.walk(below, given.depth):
            print(f"{'  ' * deep}{told(thing)}")
            for line in () if given.brief else details(thing):
                print(f"{'  ' * deep}    {line}")
        return
    if given.verb == "find":
        for thing in reader.find(given.name, given.role, given.inside):
            print(told(thing), *(f"    {line}" for line in details(thing)), sep="\n")
        return
    reader.activate()
    if given.verb == "do":
        done = reader.act(given.action, given.name, given.role, given.inside)
        print("done" if done else "nothing of this name has this action")
    elif given.verb == "keys":
        for keys in given.keys:
            reader.press(keys)
    else:
        reader.type(given.text)
    reader.pump(0.6)
    print(*reader.heard, sep="\n")


if __name__ == "__main__":
    main()
