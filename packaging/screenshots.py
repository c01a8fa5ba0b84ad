"""Makes pictures of the window: Draw and Run modes, three samples, two themes, three sizes.

    ./dev pictures [--out FOLDER] [--sample NAME]
        [--mode start|draw|run|supervise|safe|people|monitor|replay|panels|dense|cycle]

They come into ``build/pictures``. The fourteen that the documentation shows are kept in
docs/images. A new one goes there by hand (``--out docs/images`` writes all of them).
Without a display it draws on Qt's offscreen platform. The run pictures are taken in the middle of a
real run: ``hanoi`` in its physical world, the others in ``table``. ``safe`` are the pictures of a
file that does not read, of the offer to recover, and of a file that another program has changed.
``supervise`` are an operation under way, every way cut, and the full map.
``people`` are those of a task that two persons must answer, and of the table of levels.
``cycle`` is the design cycle of a blueprint that was made of a text, and then of one whose text has
changed. ``panels`` are all panels beside the drawing, each brought to the front; ``--sample`` says
of which sample.
``replay`` is a recorded run at the moment in which an operation was shut out. ``dense`` is a
procedure of 129 operations whose drawing is collapsed, with a state selected; and a smaller one
with a group, a note, a bent line and a search.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
if sys.platform == "linux" and not os.environ.get("DISPLAY"):
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np  # noqa: E402
from PySide6.QtCore import Qt  # noqa: E402
from PySide6.QtGui import QImage, QPainter  # noqa: E402
from PySide6.QtWidgets import QApplication, QWidget  # noqa: E402

import smsl_studio as smsl  # noqa: E402
from benches.layouts.bedside import bedside  # noqa: E402
from benches.layouts.procedures import rotms  # noqa: E402
from smsl_studio.blueprint.address import Address  # noqa: E402
from smsl_studio.blueprint.editing import rename  # noqa: E402
from smsl_studio.dispatch.people.task import Task  # noqa: E402
from smsl_studio.front.design.generation import (  # noqa: E402
    GenerationRequest,
    generate_anew,
    keep_generation,
)
from smsl_studio.front.design.tries import keep_note, try_operations  # noqa: E402
from smsl_studio.studio.base.settings import Settings  # noqa: E402
from smsl_studio.studio.base.style import dress  # noqa: E402
from smsl_studio.studio.base.theme import LIGHT  # noqa: E402
from smsl_studio.studio.running.persons import Person  # noqa: E402
from smsl_studio.studio.shell.application import make_application, make_window, offer_recovery  # noqa: E402
from smsl_studio.studio.shell.window import Window  # noqa: E402
from smsl_studio.studio.shell.windows import Windows  # noqa: E402
from tests.monitor.broker import Broker, Node  # noqa: E402

SIZES = ((1280, 800), (1440, 900), (1920, 1080))
THEMES = ("light", "dark")
MODES = (
    "start",
    "draw",
    "run",
    "supervise",
    "safe",
    "people",
    "monitor",
    "replay",
    "panels",
    "dense",
    "cycle",
)
FRONT = (1440, 900)
UNDER_WAY = 1.2
"""Simulated seconds after which the operation of the picture is well under way."""
PATIENCE = 60.0
"""Seconds within which a run must have come to where its picture is taken."""


@dataclass(frozen=True)
class Scene:
    """A sample and what is selected in its picture; the world, and after how many operations."""

    sample: str
    select: str
    tab: str
    world: str
    after: int
    drawn: str = ""
    """Another file to draw (the printed Hanoi has findings to show)."""


SCENES = (
    Scene("hanoi-corrected", "SB1/State_cbb/Op_1c", "Source", "hanoi", 3, drawn="hanoi"),
    Scene("registration", "REGISTRATION/State_1100", "Properties", "table", 1),
    Scene("hfsm", "SB1/State100", "Properties", "table", 1),
)


def main() -> int:
    """Take the pictures that were asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "pictures")
    parser.add_argument("--mode", choices=MODES)
    parser.add_argument("--sample", choices=[scene.sample for scene in SCENES])
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    application = make_application(sys.argv)
    dress(application, LIGHT)
    with TemporaryDirectory() as folder:
        studio = Studio(application, Settings(Path(folder) / "home"), asked.out)
        for scene in SCENES:
            if asked.sample in (None, scene.sample) and asked.mode in (None, "draw", "run"):
                studio.take(scene, [asked.mode] if asked.mode else ["draw", "run"])
        if asked.mode in (None, "safe"):
            studio.take_safe(Path(folder))
        if asked.mode in (None, "supervise"):
            studio.take_supervise()
        if asked.mode in (None, "people"):
            studio.take_people()
        if asked.mode in (None, "monitor"):
            studio.take_monitor(Path(folder))
        if asked.mode in (None, "replay"):
            studio.take_replay(Path(folder))
        if asked.mode in (None, "panels"):
            studio.take_panels(asked.sample or "hanoi")
        if asked.mode in (None, "start"):
            studio.take_start()
        if asked.mode in (None, "dense"):
            studio.take_dense(Path(folder))
            studio.take_bedside(Path(folder))
        if asked.mode in (None, "cycle"):
            studio.take_cycle(Path(folder))
        studio.finish()
    return 0


class Studio:
    """Opens windows on scenes and photographs them."""

    def __init__(self, application: QApplication, settings: Settings, out: Path) -> None:
        self._application, self._out = application, out
        self._windows = Windows(application, settings)
        self._writer = ThreadPoolExecutor(1)
        self._writing: list[Future[None]] = []

    def take(self, scene: Scene, modes: list[str]) -> None:
        """Every picture of a scene."""
        for mode in modes:
            name = (scene.drawn or scene.sample) if mode == "draw" else scene.sample
            self._windows.set_theme("light")
            window = make_window(self._windows)
            window.files.open_copy(ROOT / "samples" / f"{name}.json")
            self._until(partial(self._knows, window))
            {"draw": self._draw, "run": self._run}[mode](window, scene)
            for theme, size in self._dressed(window):
                if mode == "run" and scene.world == "hanoi":
                    self._set_going(window)
                self._shoot(window, f"{mode}-{name}-{theme}-{size[0]}x{size[1]}")
                if size == FRONT and scene.world == "hanoi":
                    self._shoot(window, f"{mode}-{theme}")
                window.features.run.pane.pause()
            window.session.history.setClean()
            window.close()

    def take_safe(self, folder: Path) -> None:
        """The pictures of work that is in danger; the files of their own lie in ``folder``."""
        broken = folder / "hanoi.json"
        text = (ROOT / "samples" / "hanoi.json").read_text("utf-8")
        broken.write_text(text.replace('",\n', '"\n', 1).replace('"Op_2c": ', '"Op_2c" ', 1))
        window = make_window(self._windows, str(broken))
        self._until(lambda: window.inspector.current)
        self._take_dressed(window, "broken")
        window.close()

        changed = folder / "hfsm.json"
        shutil.copy(ROOT / "samples" / "hfsm.json", changed)
        window = make_window(self._windows, str(changed))
        window.session.edit("Rename", lambda bp: rename(bp, Address("SB1", "State110"), "State010"))
        fresh = folder / "fresh"
        fresh.write_text(changed.read_text("utf-8").replace("Operation000", "Operation001"))
        fresh.replace(changed)
        self._until(lambda: bool(window.safety.outside.asked))
        self._take_dressed(window, "changed")
        window.safety.journal.leave_behind()
        window.session.history.setClean()
        window.close()

        window = make_window(self._windows)
        offer = offer_recovery(self._windows, window)
        assert offer is not None
        for theme, size in self._dressed(window):
            self._lay_over(window, offer, f"recovery-{theme}-{size[0]}x{size[1]}")
        offer.reject()
        window.close()

    def take_panels(self, sample: str) -> None:
        """Every panel beside the drawing, in front. The printed Hanoi has findings to show."""
        window = make_window(self._windows)
        window.files.open_copy(ROOT / "samples" / f"{sample}.json")
        self._until(partial(self._knows, window))
        for panel in window.docks.panels:
            window.show_tab(panel.name)
            named = panel.name.lower() if sample == "hanoi" else f"{panel.name.lower()}-{sample}"
            self._take_dressed(window, f"panel-{named}")
        window.close()

    def take_dense(self, folder: Path) -> None:
        """A procedure with many more operations than states, of which one state is selected."""
        path = folder / "rotms.json"
        path.write_text(json.dumps({"ROTMS": {"HEADER": {"INITIAL": "State_00000"}, **rotms()}}))
        window = make_window(self._windows, str(path))
        self._until(lambda: window.inspector.current)
        window.docks.fold_bottom()
        window.session.select((Address("ROTMS", "State_11000"),))
        self._take_dressed(window, "dense")
        window.session.history.setClean()
        window.close()

    def take_cycle(self, folder: Path) -> None:
        """A blueprint that was just made of a text; then its text has changed, and a new one
        waits."""
        texts = ROOT / "samples" / "texts"
        text, listed = folder / "first-aid.md", folder / "first-aid-hardware.md"
        for place in (text, listed):
            shutil.copy(texts / place.name, place)
        file = folder / "first-aid" / "first-aid.json"
        request = GenerationRequest((text,), file, listed)
        keep_generation(generate_anew(request, folder / "new"), own=True)
        window = make_window(self._windows, str(file))
        feature = window.features.design
        feature.show()
        self._until(lambda: feature.part().cycle is not None)
        self._take_dressed(window, "cycle")

        cycle, blueprint = feature.part().cycle, window.session.blueprint
        assert cycle is not None
        smsl.generate_code(blueprint, file.with_name("first-aid-program"))
        keep_note(str(file), try_operations(blueprint, cycle, "table", ""))
        said = "6. Send somebody for the defibrillator."
        text.write_text(text.read_text("utf-8").replace(said, f"{said} Send another one home."))
        text.write_text(text.read_text("utf-8").replace("9. Go on", "9. Change places. Go on"))
        feature.texts.generate(request)
        self._until(lambda: feature.part().new is not None)
        self._until(lambda: (now := feature.part().cycle) is not None and now.stage(2).own == (1,))
        self._take_dressed(window, "cycle-changed")
        window.close()

    def take_start(self) -> None:
        """The start page, as it is seen before a file is opened."""
        window = make_window(self._windows)
        self._take_dressed(window, "start")
        window.close()

    def take_bedside(self, folder: Path) -> None:
        """A procedure with a group, a note and a bent line; a search has found its third state."""
        path = folder / "bedside.json"
        path.write_text(json.dumps(bedside(), indent=4))
        window = make_window(self._windows, str(path))
        self._until(lambda: window.inspector.current)
        window.show_tab("Facts")
        window.actions_table["find"].trigger()
        bar = window.features.draw.search.bar
        bar.field.setText("tool")
        self._until(lambda: bool(window.session.selection))
        window.canvas.fit()
        window.session.select((Address("BEDSIDE", "State_0110", "Op_LoadPreset"),))
        self._take_dressed(window, "bedside")
        window.session.history.setClean()
        window.close()

    def take_supervise(self) -> None:
        """Supervise, with a run of Hanoi: an operation under way, every way cut, the full map."""
        for name, world, come_to in (
            ("running", "hanoi", self._under_way),
            ("hold", "table", self._hold),
            ("map", "table", self._map),
        ):
            self._windows.set_theme("light")
            window = make_window(self._windows)
            window.files.open_copy(ROOT / "samples" / "hanoi-corrected.json")
            self._until(partial(self._knows, window))
            window.set_mode("run")
            transport = window.features.run.pane.transport
            transport.world.setCurrentIndex(transport.world.findData(world))
            window.set_mode("supervise")
            come_to(window)
            for theme, size in self._dressed(window):
                self._shoot(window, f"supervise-{name}-{theme}-{size[0]}x{size[1]}")
                if size == FRONT and name == "running":
                    self._shoot(window, f"supervise-{theme}")
            window.close()

    def _knows(self, window: Window) -> bool:
        return window.inspector.current and self._windows.plugins.known

    def _under_way(self, window: Window) -> None:
        pane = window.features.run.pane
        pane.transport.speed.setCurrentText("Max")
        pane.play()
        self._until(partial(self._has_done, window, 3))
        pane.transport.speed.setCurrentText("1×")
        self._until(lambda: self._well_under_way(window))
        pane.run.set_speed(0.01)

    def _hold(self, window: Window) -> None:
        run = window.features.run.pane.run
        window.features.run.pane.step()
        self._until(partial(self._has_done, window, 1))
        for item in run.status.possible if run.status else ():
            run.prune(item.address, "the grip slipped here")
        window.features.run.pane.play()
        self._until(lambda: run.phase == "no_route")

    def _map(self, window: Window) -> None:
        window.features.run.pane.step()
        self._until(partial(self._has_done, window, 1))
        window.features.supervise.pane.set_full_map(True)
        self._until(window.features.supervise.pane.is_mapped)

    def take_people(self) -> None:
        """A task of which one of two has answered, and the table of levels before the next run."""
        for name, role in (("L. Brandt", "nurse"), ("A. Okafor", "surgeon")):
            self._windows.persons.put(Person(name, role))
        window = make_window(self._windows)
        window.files.open_copy(ROOT / "samples" / "registration-people.json")
        self._until(lambda: window.inspector.current and self._windows.plugins.known)
        window.set_mode("supervise")
        pane, card = window.features.run.pane, window.features.people.people.card
        pane.play()
        said: list[str] = []
        while (task := self._task_after(window, said)).kind != "confirm" or task.persons == 1:
            said.append(task.name)
            # The head is free and nothing digitized at first, and then it is done.
            value = (
                ("0" if len(said) <= 2 else "1") if task.kind == "fact" else task.options[0].value
            )
            role = task.roles[0]
            person = "A. Okafor" if role == "surgeon" else "L. Brandt"
            pane.run.answer(task.name, value, role, by=person)
        pane.run.answer(task.name, task.options[0].value, "surgeon", by="A. Okafor")
        self._until(lambda: bool(card.tasks and card.tasks[0].answered))
        pane.run.set_speed(0.01)
        self._take_dressed(window, "task")
        pane.stop()
        self._until(lambda: pane.run.phase == "stopped")
        pane.run.end()
        self._until(lambda: not pane.run.exists)
        window.features.people.people.edit_levels()
        editor = window.features.people.people.editor
        assert editor is not None
        for row, level in ((0, "human"), (10, "human"), (12, "shared")):
            editor.table.selectRow(row)
            editor.choose(level)
        for theme, size in self._dressed(window):
            self._lay_over(window, editor, f"levels-{theme}-{size[0]}x{size[1]}")
        editor.reject()
        window.close()

    def take_monitor(self, folder: Path) -> None:
        """The monitor page: two nodes, one of them frozen, two pointers that disagree, noise."""
        path = folder / "three-levels.json"
        shutil.copy(ROOT / "samples" / path.name, path)
        broker = Broker(folder)
        text = f'[mqtt]\nbroker = "{broker.address}"\nsite = "lab"\n[mqtt.facts]\n'
        facts = (
            '"SURGERY/2" = "tool_tracker"\n"DIGITIZATION/0" = ["pointer_left", "pointer_right"]\n'
        )
        path.with_suffix(".toml").write_text(text + facts, "utf-8")
        pointers = Node(broker, "DIGITIZATION/0:pointer_left=0", "DIGITIZATION/0:pointer_right=0")
        tracker = Node(broker, "SURGERY/2:tool_tracker=0", name="tracker")
        window = make_window(self._windows, str(path))
        self._until(partial(self._knows, window))
        window.set_mode("run")
        pane = window.features.run.pane
        pane.transport.by_hand.setChecked(True)
        pane.play()
        self._until(lambda: pane.run.phase == "ready")
        pane.show_monitor()
        page = window.features.monitor.inside().sensors
        pane.run.disturb("table_REGISTRATION_2", "noise", rate=0.2)
        pointers.say("pointer_right 1")
        tracker.freeze()
        self._until(lambda: "1 in conflict" in page.words.text())
        page.table.selectRow(3)
        self._wait(2.0)
        for theme, size in self._dressed(window):
            self._wait(0.3)
            self._keep(window.grab().toImage(), f"monitor-{theme}-{size[0]}x{size[1]}")
        for node in (pointers, tracker):
            node.kill()
        window.close()
        broker.kill()

    def take_replay(self, folder: Path) -> None:
        """A recorded run of Hanoi, at the moment in which an operation was shut out."""
        blueprint, log = smsl.read(ROOT / "samples" / "hanoi-corrected.json"), folder / "run.jsonl"
        script = smsl.read_script(ROOT / "samples" / "scripts" / "hanoi-pruned.jsonl", blueprint)
        smsl.run(blueprint, "hanoi", script=script, avoid=["State_aaa/Op_1c"], log=log)
        window = make_window(self._windows, str(log))
        self._until(lambda: window.features.replay.verbs.is_open)
        replay = window.features.replay.verbs.replay
        assert replay.recording is not None
        events = replay.recording.run.events
        shut = next(at for at, event in enumerate(events, 1) if event.event == "operation_pruned")
        replay.to_index(shut)
        for theme, size in self._dressed(window):
            self._shoot(window, f"replay-{theme}-{size[0]}x{size[1]}")
        window.close()

    def _task_after(self, window: Window, said: list[str]) -> Task:
        """The first open task that nobody was told of yet."""
        found: list[Task] = []

        def there() -> bool:
            found[:] = [
                task for task in window.features.people.people.card.tasks if task.name not in said
            ]
            return bool(found)

        self._until(there)
        return found[0]

    def _lay_over(self, window: Window, dialog: QWidget, name: str) -> None:
        """A window with a dialog in its middle, as one picture."""
        dialog.move(window.rect().center() - dialog.rect().center())
        picture = window.grab().toImage()
        painter = QPainter(picture)
        painter.drawPixmap(dialog.pos(), dialog.grab())
        painter.setPen(window.tokens.line2)
        painter.drawRect(dialog.geometry())
        painter.end()
        self._keep(picture, name)

    def _take_dressed(self, window: Window, name: str) -> None:
        for theme, size in self._dressed(window):
            window.canvas.fit(smooth=False)
            self._shoot(window, f"{name}-{theme}-{size[0]}x{size[1]}")

    def _draw(self, window: Window, scene: Scene) -> None:
        window.show_tab(scene.tab)
        window.session.select([window.session.blueprint.resolve(scene.select)])
        window.canvas.fit(smooth=False)

    def _run(self, window: Window, scene: Scene) -> None:
        window.set_mode("run")
        pane, transport = window.features.run.pane, window.features.run.pane.transport
        transport.world.setCurrentIndex(transport.world.findData(scene.world))
        transport.speed.setCurrentText("Max")
        pane.world.patient = True
        if scene.world == "table":
            for done in range(1, scene.after + 1):
                pane.step()
                self._until(partial(self._has_done, window, done))
            return
        pane.play()
        self._until(partial(self._has_done, window, scene.after))
        transport.speed.setCurrentText("1×")
        self._until(lambda: self._well_under_way(window))
        pane.pause()

    def _has_done(self, window: Window, operations: int) -> bool:
        status = window.features.run.pane.run.status
        return status is not None and status.operations >= operations

    def _well_under_way(self, window: Window) -> bool:
        status = window.features.run.pane.run.status
        return (
            status is not None
            and status.running is not None
            and status.running_since is not None
            and status.time - status.running_since > UNDER_WAY
        )

    def _set_going(self, window: Window) -> None:
        """Between two pictures the run is paused, so that all of them show the same operation."""
        pane = window.features.run.pane
        pane.play()
        self._until(lambda: pane.run.phase == "running")
        self._wait(0.12)

    def _dressed(self, window: Window) -> Iterator[tuple[str, tuple[int, int]]]:
        for theme in THEMES:
            self._windows.set_theme(theme)
            for size in SIZES:
                window.resize(*size)
                self._wait(0.1)
                if window.mode == "draw":
                    window.docks.set_first_sizes()
                self._wait(0.3)
                yield theme, size

    def _shoot(self, window: Window, name: str) -> None:
        self._keep(window.grab().toImage(), name)

    def _keep(self, picture: QImage, name: str) -> None:
        """Written beside: the next picture need not wait for this one."""
        self._writing.append(self._writer.submit(self._write, picture, name))

    def _write(self, picture: QImage, name: str) -> None:
        small(picture).save(str(self._out / f"{name}.png"))
        print(f"{name}.png")

    def finish(self) -> None:
        """Wait until every picture is written."""
        for one in self._writing:
            one.result()

    def _until(self, condition: Callable[[], bool]) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end:
                raise SystemExit("the window did not come to where its picture is taken")
            self._wait(0.02)

    def _wait(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._application.processEvents()
            time.sleep(0.005)


def small(picture: QImage) -> QImage:
    """The picture in 256 colours: the most frequent ones, then one for each group of the rest."""
    picture = picture.convertToFormat(QImage.Format.Format_RGB32)
    pixels = np.frombuffer(picture.constBits(), np.uint32)
    colours, counts = np.unique(pixels, return_counts=True)
    order = np.argsort(-counts)
    often, rest, weight = colours[order[:128]], colours[order[128:]], counts[order[128:]]
    group = ((rest >> 20) & 15) << 8 | ((rest >> 12) & 15) << 4 | ((rest >> 4) & 15)
    total = np.bincount(group, weight, 4096)
    best = [int(g) for g in np.argsort(-total)[:128] if total[g]]
    table = [int(colour) for colour in often]
    table += [int(rest[np.argmax(np.where(group == g, weight, 0))]) for g in best]
    flags = Qt.ImageConversionFlag
    exact = flags.ThresholdDither | flags.AvoidDither
    return picture.convertToFormat(QImage.Format.Format_Indexed8, table, exact)


if __name__ == "__main__":
    sys.exit(main())
