"""The world of a run, as the window reads it: shapes, poses, sensors, faults, process."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QObject

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.host.process import ProcessHost
from smsl_studio.host.protocol import SensorInfo
from smsl_studio.host.remote import WithRemote
from smsl_studio.monitor.reception import RemoteView
from smsl_studio.world.protocol import Shape


class RunWorld(QObject):
    """Reads of a dispatcher only what any thread may read."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._dispatcher: Dispatcher | None = None
        self.shapes: tuple[Shape, ...] = ()
        self.sensors: tuple[SensorInfo, ...] = ()
        self.faults: tuple[str, ...] = ()
        """The faults that can be injected into the world of the run."""

    @property
    def world_process(self) -> int | None:
        """The process id of the world; None if it runs in no process of its own."""
        host = self._dispatcher.host if self._dispatcher is not None else None
        world = host.inner if isinstance(host, WithRemote) else host
        return world.pid if isinstance(world, ProcessHost) else None

    def poses(self) -> tuple[float, ...]:
        """The newest poses from the world's shared memory."""
        return self._dispatcher.host.poses() if self._dispatcher is not None else ()

    def words(self) -> Mapping[str, str]:
        """Short words of the world for people, by name."""
        return self._dispatcher.host.status() if self._dispatcher is not None else {}

    def remote(self) -> RemoteView | None:
        """The state of the sensors that are elsewhere; None if there are none."""
        opened = self._dispatcher.opened if self._dispatcher is not None else None
        return opened.remote.view() if opened and opened.remote else None
