"""The steps of the tour, and which one is next. What a person did is read from what is there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

COUNT = 5
"""So many numbered steps."""


@dataclass(frozen=True)
class TourState:
    """What the tour sees of the window.

    ``chosen``: the mislabelled operation is selected. ``mended``: it has its right name. ``gone``:
    it is neither there nor mended. ``finished``: a run of the tour has ended. ``moves``:
    the present run has begun an operation. ``stopped`` and ``decided``: the person has stopped a
    run, and has decided something as its supervisor.
    """

    mode: str
    chosen: bool = False
    mended: bool = False
    gone: bool = False
    exists: bool = False
    phase: str = ""
    moves: bool = False
    finished: bool = False
    stopped: bool = False
    decided: bool = False


@dataclass(frozen=True)
class TourStep:
    """One step: what to do, and the controls that do it, the first visible one counts.

    ``number`` is 0 for the end. ``spared`` are the parts that it speaks of: its callout leaves them
    free.
    """

    number: int
    title: str
    words: str
    controls: tuple[str, ...] = ()
    spared: tuple[str, ...] = ()


DRAW_AGAIN = TourStep(1, "Back to the drawing",
    "The next step is done in the drawing. Press Draw, or Ctrl+1.", ("mode_draw",))  # fmt: skip
FIND = TourStep(1, "Find the misprint",
    "This is a copy of the Tower of Hanoi with 78 operations. The label of one is wrong, and the "
    "check has found it. Click it in Findings, or press F3.",
    ("finding",), ("found",))  # fmt: skip
FIX = TourStep(2, "Correct it",
    "The drawing shows the operation: it does something else than its label says. Press the "
    "button on the card that renames it, or Ctrl+.", ("fix", "finding"))  # fmt: skip
LOST = TourStep(2, "Bring it back",
    "The mislabelled operation is gone. Ctrl+Z takes back the last step.")  # fmt: skip
RUN = TourStep(3, "Run it",
    "Nothing stands against a run now. Press Run, or F5: a robot arm moves the disks in a "
    "simulated world.", ("run_play",))  # fmt: skip
AGAIN = TourStep(3, "Run it once more",
    "The run is over. Press F5 to run it again, and stop it while the arm moves.",
    ("run_play",), ("world",))  # fmt: skip
OPEN = TourStep(3, "The world opens",
    "In a moment the arm takes the first disk. The drawing beside it shows the state and the "
    "operation.", ("world",), ("run_canvas",))  # fmt: skip
STOP = TourStep(4, "Stop it",
    "The arm moves a disk. A person can stop it at any time and in every mode: press Stop, "
    "or F8.", ("run_stop",), ("world", "run_canvas"))  # fmt: skip
LOOK = TourStep(5, "Supervise it",
    "It stands until a person lets it go on. Press Supervise, or Ctrl+3: there one watches a run "
    "and steps in.", ("mode_supervise",), ("run_canvas", "possible"))  # fmt: skip
RESET = TourStep(5, "Unlatch the stop",
    "Press Reset, or F5, then Enter. The run is paused then, and nothing moves yet.",
    ("confirm", "run_reset"), ("hold", "board"))  # fmt: skip
ANEW = TourStep(5, "A run to supervise",
    "The run has ended. Press F5 to begin another one here.", ("run_play",))  # fmt: skip
STEER = TourStep(5, "Step in",
    "Press V, or Veto once: the next operation is skipped once, and the route goes around it. "
    "Enter confirms, because each decision is asked once more.", ("confirm", "veto"),
    ("step_in", "board"))  # fmt: skip
TAKE = TourStep(5, "Step in",
    "Press T, or Take over: the automation is locked out. Enter confirms, because each decision "
    "is asked once more.", ("confirm", "take_over"), ("step_in", "board"))  # fmt: skip
END = TourStep(0, "That was the whole way",
    "You found a misprint, corrected it, ran the procedure, stopped it and decided as its "
    "supervisor. If the arm was stopped with a disk in the air, the run holds when it goes on, "
    "and says why. Stop and End run end it. F1 explains what has the focus.")  # fmt: skip

STEPS = (DRAW_AGAIN, FIND, FIX, LOST, RUN, AGAIN, OPEN, STOP, LOOK, RESET, ANEW, STEER, TAKE, END)

_Rule = tuple[Callable[[TourState], bool], TourStep]
_ORDER: tuple[_Rule, ...] = (
    (lambda seen: seen.decided, END),
    (lambda seen: not seen.mended and seen.mode != "draw", DRAW_AGAIN),
    (lambda seen: seen.gone, LOST),
    (lambda seen: not seen.mended, FIX),
    (lambda seen: not seen.stopped and seen.exists and seen.moves, STOP),
    (lambda seen: not seen.stopped and seen.exists, OPEN),
    (lambda seen: not seen.stopped and seen.finished, AGAIN),
    (lambda seen: not seen.stopped, RUN),
    (lambda seen: seen.mode != "supervise", LOOK),
    (lambda seen: not seen.exists, ANEW),
    (lambda seen: seen.phase == "stopped", RESET),
    (lambda seen: seen.phase in ("running", "opening"), TAKE),
)
"""The first rule that holds gives the step."""


def step_of(seen: TourState) -> TourStep:
    """The step that is next."""
    found = next((step for holds, step in _ORDER if holds(seen)), STEER)
    return FIND if found is FIX and not seen.chosen else found
