"""One random sequence of acts at a window, with the disagreements found after each act."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from random import Random
from typing import Any

from PySide6.QtCore import QPoint

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.features.draw.canvas.template_drop import TEMPLATES
from tests.blueprint.histories import stand
from tests.sequences.agreement import Places, as_opened, disagreements, seen
from tests.sequences.any_file import any_file
from tests.sequences.seat import Seat

LENGTH = 10
"""Acts of a sequence."""
NAMES = ("State_", "State_9", "A", "é", "x y", "Op_0_up", "Op_new", "->", "a/b")
"""Besides what the window suggests: odd ones, and such as are often there already."""

Step = tuple[dict[str, str], dict[str, Places]]
"""The texts, and where the states were seen."""


@dataclass
class Sequence:
    """What is done at a seat, drawn from one number; ``acts`` are those that were done."""

    seat: Seat
    number: int
    length: int = LENGTH
    acts: list[str] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.chance = Random(self.number)
        self.session = self.seat.window.session

    def findings(self) -> Iterator[str]:
        """Do all of it; everything that does not agree, with the acts that led there."""
        name, text = any_file(self.chance)
        self.seat.open(name, text)
        self.acts.append(f"open {name}: {text!r}")
        self.steps = [self._stand()]
        yield from self._told(())
        for _ in range(self.length):
            yield from self._told(self._act())
        self.acts.append("undo all")
        yield from self._told(self._undo_all())

    def _told(self, own: Any) -> Iterator[str]:
        for finding in (*own, *disagreements(self.seat.window, self.seat.path)):
            yield f"sequence {self.number}: {finding}\n    " + "\n    ".join(self.acts)

    def _stand(self) -> Step:
        return dict(self.session.texts), seen(self.session)

    def _act(self) -> list[str]:
        verbs: list[tuple[int, Callable[[], list[str]]]] = [
            (4, self._select), (4, self._add_state), (4, self._add_operation), (3, self._rename),
            (4, self._move), (3, self._delete), (5, self._undo), (3, self._redo), (3, self._save),
            (2, self._reopen), (3, self._mode), (2, self._tab), (1, self._fact), (1, self._branch),
            (2, self._run), (1, self._stop), (2, self._sibling), (2, self._copy),
            (2, self._template), (2, self._draw_note), (1, self._draw_group),
            (3, self._set_value), (2, self._paste_table), (3, self._bend),
        ]  # fmt: skip
        weights = [weight for weight, _ in verbs]
        _, verb = self.chance.choices(verbs, weights)[0]
        self.acts.append(verb.__name__.removeprefix("_"))
        return verb()

    def _note(self, words: str) -> None:
        self.acts[-1] = words

    # What is drawn from chance.

    @property
    def _table(self) -> dict[str, Any]:
        branch = self.session.blueprint.branches.get(self.session.branch)
        return dict(branch.table) if branch is not None else {}

    def _state(self) -> str:
        return self.chance.choice(list(self._table))

    def _name(self) -> str:
        kind = self.chance.random()
        if kind < 0.3 and self._table:
            return self._state()
        return self.chance.choice(NAMES) + self.chance.choice(["", "0", "11", "2"])

    # Acts. Each answers with what is wrong about what it did.

    def _edit(self, do: Callable[[], None], *touched: str) -> list[str]:
        """Carry out what is one step at most; no state moves that was not touched."""
        before, at = self._stand(), self.session.history.index()
        self.seat.act("mode_draw")
        names = {one.name: list(one.table) for one in self.session.blueprint}
        do()
        after, now = self._stand(), self.session.history.index()
        wrong = []
        if before[0] == after[0]:
            if now != at:
                wrong.append("a step was made, and the text is the same")
            if before[1] != after[1]:
                wrong.append("the text is the same, and states are seen elsewhere")
            return wrong
        if now != at + 1:
            wrong.append(f"an edit made {now - at} steps")
        del self.steps[at + 1 :]
        self.steps.append(after)
        for branch, order in names.items():
            there = after[1].get(branch, {})
            wrong += [
                f"{state} of {branch} was seen at {before[1][branch][state]}, "
                f"now at {there[state]}"
                for state in order
                if state in there and state not in touched
                and there[state] != before[1][branch][state]
            ]  # fmt: skip
        return wrong

    def _select(self) -> list[str]:
        self.seat.act("mode_draw")
        if not self._table:
            return []
        state, kind = self._state(), self.chance.random()
        if kind < 0.5 or not self._table[state]:
            shift = self.chance.random() < 0.3
            former = self.session.extended
            self._note(f"click on {state}{' with Shift' if shift else ''}")
            self.seat.click(state, shift)
            wanted = {Address(self.session.branch, state)}
            wanted = set(former) | wanted if shift else wanted
            # What lies above takes the click, and so does a fact of a state that is selected.
            other = self.session.fact is not None or self._lies_on_another(state)
            if set(self.session.selection) != wanted and not other:
                return [f"{[*map(str, self.session.selection)]} is selected, not {wanted}"]
            return []
        operation = self.chance.choice(list(self._table[state]))
        self._note(f"find {state}/{operation}")
        self.session.jump(Address(self.session.branch, state, operation))
        return []

    def _lies_on_another(self, state: str) -> bool:
        places = self.seat.window.canvas.positions
        x, y = places[state]
        return any(abs(x - a) < 130 and abs(y - b) < 80 for n, (a, b) in places.items()
                   if n != state)  # fmt: skip

    def _add_state(self) -> list[str]:
        names = (self._name(),) if self.chance.random() < 0.5 else ()
        self._note(f"add a state {names}")
        before = set(self._table)

        def do() -> None:
            self.seat.act("add_state")
            self.seat.write(*names)

        wrong = self._edit(do)
        fresh = set(self._table) - before
        if fresh and self.session.selection != (Address(self.session.branch, *fresh),):
            wrong.append("the new state is not what is selected")
        return wrong

    def _add_operation(self) -> list[str]:
        if not self._table:
            return []
        states = [self._state() for _ in range(self.chance.choice([1, 2, 2]))]
        names = (self._name(), self._name()) if self.chance.random() < 0.6 else ()
        self._note(f"connect {states} {names}")

        def do() -> None:
            branch = self.session.branch
            self.session.select(Address(branch, state) for state in states)
            self.seat.act("add_operation")
            self.seat.write(*names)

        return self._edit(do)

    def _chosen(self) -> bool:
        """Select a state or an operation; False if there is none."""
        if not self._table:
            return False
        state = self._state()
        operation = self.chance.choice(["", *self._table[state]])
        self.session.select((Address(self.session.branch, state, operation),))
        return True

    def _sibling(self) -> list[str]:
        names = (self._name(), self._name()) if self.chance.random() < 0.6 else ()
        chosen = self._chosen()
        self._note(f"sibling of {[*map(str, self.session.selection)]} {names}")

        def do() -> None:
            self.seat.window.canvas.sibling_wanted.emit()
            self.seat.write(*names)

        return self._edit(do) if chosen else []

    def _copy(self) -> list[str]:
        if not self._table:
            return []
        state = self._state()
        names = (self._name(),) if self.chance.random() < 0.4 else ()
        self._note(f"copy {state} {names}")

        def do() -> None:
            self.session.select((Address(self.session.branch, state),))
            self.seat.act("duplicate")
            self.seat.write(*names)

        return self._edit(do)

    def _template(self) -> list[str]:
        name, chosen = self.chance.choice([*TEMPLATES]), self._chosen()
        self._note(f"template {name} at {[*map(str, self.session.selection)]}")
        return self._edit(lambda: self.seat.act(f"template_{name}")) if chosen else []

    def _draw_note(self) -> list[str]:
        """Put a note on a state or on the canvas, or delete the one that was added last."""
        hung = self.chance.random() < 0.5 and bool(self._table)
        state = self._state() if hung else ""
        words = self.chance.choice(["Look here", "é\u202e 漢", "x " * 200])
        self._note(f"note on {state or 'the canvas'}: {words[:9]!r}")

        def do() -> None:
            chosen = (Address(self.session.branch, state),) if state else ()
            self.session.select(chosen)
            self.seat.act("add_note")
            self.seat.draw(words)

        return self._edit(do)

    def _draw_group(self) -> list[str]:
        """Group some states, or dissolve the group of one."""
        if not self._table:
            return []
        states = [*dict.fromkeys(self._state() for _ in range(2))]
        verb, title = self.chance.choice(["group", "ungroup"]), self._name()
        self._note(f"{verb} {states} {title!r}")

        def do() -> None:
            self.session.select(Address(self.session.branch, state) for state in states)
            self.seat.act(verb)
            self.seat.draw(title)

        return self._edit(do)

    def _rename(self) -> list[str]:
        if not self._table:
            return []
        state, new = self._state(), self._name()
        operation = self.chance.choice(["", *self._table[state]])
        old = Address(self.session.branch, state, operation)
        self._note(f"rename {old} to {new!r}")
        place = seen(self.session)[self.session.branch][state]

        def do() -> None:
            self.session.select((old,))
            self.seat.act("rename")
            self.seat.choose_where(self.chance.choice([0, 1, 2]))
            self.seat.write(new)

        wrong = self._edit(do)
        chosen = self.session.selection
        if len(chosen) != 1:
            return [*wrong, f"{[*map(str, chosen)]} is selected after a rename"]
        if seen(self.session)[self.session.branch].get(chosen[0].state) != place:
            wrong.append("a state that was renamed is seen elsewhere")
        return wrong

    def _set_value(self) -> list[str]:
        branch = self.session.blueprint.branches.get(self.session.branch)
        if branch is None or not branch.table:
            return []
        states = [self._state() for _ in range(self.chance.choice([1, 1, 2]))]
        digit, at = self.chance.randrange(branch.num_facts), self.chance.randrange(3)
        self._note(f"give fact {digit} of {states} its value {at}")

        def do() -> None:
            self.session.select(Address(branch.name, state) for state in states)
            self.seat.choose_value(digit, at)

        return self._edit(do)

    def _paste_table(self) -> list[str]:
        rows = [
            [self._name(), self.chance.choice(["", "Op_0_up", "go"]), self._name()]
            for _ in range(self.chance.randrange(1, 4))
        ]
        self._note(f"paste {rows}")
        return self._edit(lambda: self.seat.paste("\n".join(map("\t".join, rows))))

    def _move(self) -> list[str]:
        self.seat.act("mode_draw")
        if not self._table:
            return []
        state = self._state()
        by = QPoint(self.chance.randrange(-200, 200), self.chance.randrange(-150, 150))
        self._note(f"drag {state} by {by.x()}, {by.y()}")
        if self._lies_on_another(state):
            return []
        # What is dragged goes along with what else is selected.
        self.session.select(())
        return self._edit(lambda: self.seat.drag(state, by), state)

    def _bend(self) -> list[str]:
        table = self._table
        edges = [(state, name) for state in table for name in table[state]]
        if not edges:
            return []
        edge = self.chance.choice(edges)
        verb = self.chance.choice(["add_bend", "add_bend", "next_bend", "clear_bends"])
        self._note(f"{verb} {'/'.join(edge)}")

        def do() -> None:
            self.session.select((Address(self.session.branch, *edge),))
            self.seat.act(verb)

        return self._edit(do)

    def _delete(self) -> list[str]:
        self._note(f"delete {[*map(str, self.session.selection)]}")
        chosen = self.session.selection
        wrong = self._edit(lambda: self.seat.act("delete"))
        if chosen and self.session.selection:
            wrong.append("what was deleted is selected")
        return wrong

    def _undo(self) -> list[str]:
        return self._go(-1)

    def _undo_all(self) -> list[str]:
        """Undo every step since the file was opened: its bytes are as they were then."""
        self.seat.act("mode_draw")
        wrong: list[str] = []
        while self.session.history.index() and not wrong:
            wrong = self._undo()
        same = dict(self.session.texts) == self.steps[0][0]
        return wrong if same else [*wrong, "all is undone, and the text is not as it was opened"]

    def _redo(self) -> list[str]:
        return self._go(1)

    def _go(self, step: int) -> list[str]:
        """Undo or redo: in Draw mode all is as it was there, and elsewhere nothing happens."""
        before, history = self._stand(), self.session.history
        at = history.index()
        self.seat.act("undo" if step < 0 else "redo")
        there = at + step if self.seat.window.mode == "draw" else at
        wanted = min(max(there, 0), len(self.steps) - 1)
        if history.index() != wanted:
            return [f"the history stands at {history.index()}, not at {wanted}"]
        after = self._stand()
        if wanted == at:
            return [] if after == before else ["nothing was undone, and it is not as it was"]
        wrong = [] if after[0] == self.steps[wanted][0] else ["the text is not as it was there"]
        return wrong + [
            f"{state} of {branch} stood at {at} there, now at {after[1][branch].get(state)}"
            for branch, places in self.steps[wanted][1].items()
            for state, at in places.items()
            if after[1].get(branch, {}).get(state) != at
        ]

    def _save(self) -> list[str]:
        if not self.seat.save():
            return ["it was not saved"]
        return self._as_saved()

    def _as_saved(self) -> list[str]:
        text = self.session.texts[self.session.blueprint.file]
        if self.seat.path.read_bytes().decode() != text:
            return ["another text was saved than is shown"]
        found = read_blueprint(read_document(self.seat.path))
        wrong = []
        if json.loads(stand(found))[1:] != json.loads(stand(self.session.blueprint))[1:]:
            wrong.append("what was saved means something else")
        there, here = as_opened(found), seen(self.session)
        if there != here:
            wrong.append(f"when it is opened states stand elsewhere: {here} become {there}")
        return wrong

    def _reopen(self) -> list[str]:
        answer = self.chance.choice(["save", "discard", "discard", "cancel"])
        self._note(f"reopen; unsaved changes: {answer}")
        edited, before = self.seat.window.files.edited, self._stand()
        if not self.seat.reopen(answer):
            stays = edited and answer == "cancel" and self._stand() == before
            return [] if stays else ["it was not opened"]
        self.steps = [self._stand()]
        wrong = self._as_saved()
        if self.session.selection or self.session.history.count():
            wrong.append("a selection or a history of before is there")
        return wrong

    def _mode(self) -> list[str]:
        mode = self.chance.choice(["draw", "run", "supervise"])
        self._note(f"{mode} mode")
        before = self._stand()
        self.seat.act(f"mode_{mode}")
        return [] if self._stand() == before else ["a mode changed the drawing"]

    def _tab(self) -> list[str]:
        tab = self.chance.choice(["source", "properties", "history"])
        self._note(f"show {tab}")
        self.seat.act("mode_draw")
        self.seat.act(f"show_{tab}")
        return []

    def _fact(self) -> list[str]:
        branch = self.session.blueprint.branches.get(self.session.branch)
        if branch is not None and branch.num_facts:
            digit = self.chance.randrange(branch.num_facts)
            self._note(f"show fact {digit}")
            self.seat.window.properties.show_fact(branch.name, digit)
        return []

    def _branch(self) -> list[str]:
        name = self.chance.choice(list(self.session.blueprint.branches))
        self._note(f"show {name}")
        self.session.show_branch(name)
        return []

    def _run(self) -> list[str]:
        before = self._stand()
        self.seat.act(f"mode_{self.chance.choice(['run', 'supervise'])}")
        self.seat.step()
        return [] if self._stand() == before else ["a run changed the drawing"]

    def _stop(self) -> list[str]:
        before = self._stand()
        self.seat.stop()
        return [] if self._stand() == before else ["a stop changed the drawing"]
