# SPDX-License-Identifier: Apache-2.0
"""Everything that has a bearing, seen from somewhere: targets, emitters and bearing processes."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
import numpy.typing as npt

from radar_common.frames import polar_from_enu, wrap_two_pi
from radar_sim.bearings.process import BearingProcesses
from radar_sim.bearings.scene import BearingScene
from radar_sim.bearings.sections import EmitterSection
from radar_sim.motion import Fleet, State
from radar_sim.motion.sections import draw_paths
from radar_sim.targets import Targets

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

_NEAREST = 1e-3


@dataclass(frozen=True, slots=True)
class Sight:
    """Sources seen from a place, one column each, every array of shape (looks, sources).

    Attributes:
        present: whether the source is there.
        azimuth: rad clockwise from north, [0, 2 pi).
        rate: of the azimuth, rad/s.
        elevation: rad over the horizon; NaN of a process.
        distance: m over ground; NaN of a process.
        x: m east in the map; NaN of a process.
        y: m north.
        z: m up.
        vx: m/s east.
        vy: m/s north.
    """

    present: BoolArray
    azimuth: FloatArray
    rate: FloatArray
    elevation: FloatArray
    distance: FloatArray
    x: FloatArray
    y: FloatArray
    z: FloatArray
    vx: FloatArray
    vy: FloatArray

    def take(self, columns: npt.NDArray[np.intp]) -> Sight:
        """Select sources.

        Args:
            columns: which.

        Returns:
            Their columns.
        """
        return Sight(*(getattr(self, field.name)[:, columns] for field in fields(self)))


class Sources:
    """All sources of a scene in order of their ids: targets, emitters of their own, processes.

    Attributes:
        ids: of each; that of a target is the radar simulator's.
        echoing: columns that the active channel sees.
        transmitting: columns that the direction finder may hear.
        mean_azimuth: of each process, NaN for sources with a place, rad.
    """

    def __init__(
        self,
        scene: BearingScene,
        targets: Targets,
        rng: np.random.Generator,
    ) -> None:
        """Draw emitters and processes.

        Args:
            scene: which there are.
            targets: of the scenario, drawn.
            rng: source of randomness of emitters and processes.
        """
        moving, running = rng.spawn(2)
        own = [emitter for emitter in scene.emitters if not emitter.section.target]
        streams = moving.spawn(len(own))
        ways = [
            draw_paths([emitter.path], emitter.motion, emitter.wander, stream)[0]
            for emitter, stream in zip(own, streams, strict=True)
        ]
        self._processes = BearingProcesses(scene.processes, running)
        placed = len(targets) + len(own)
        self._fleet = Fleet([*targets.paths, *ways])
        self._z = np.array([0.0] * len(targets) + [e.section.z for e in own], dtype=float)
        number = placed + len(self._processes)
        self.ids = np.arange(1, number + 1)
        self.mean_azimuth = np.concatenate([np.full(placed, np.nan), self._processes.mean])
        self._schedules: dict[int, list[EmitterSection]] = {
            len(targets) + column: [emitter.section] for column, emitter in enumerate(own)
        }
        for emitter in scene.emitters:
            if emitter.section.target:
                column = emitter.section.target - 1
                self._schedules.setdefault(column, []).append(emitter.section)
                self._z[column] = emitter.section.z
        if scene.platform is not None and scene.platform.section.targets_emit:
            for column in range(len(targets)):
                self._schedules[column] = [EmitterSection()]
        processes = np.arange(placed, number)
        self.echoing = np.concatenate([np.arange(len(targets)), processes])
        self.transmitting = np.concatenate(
            [np.array(sorted(self._schedules), dtype=np.intp), processes]
        )

    def __len__(self) -> int:
        """Count them."""
        return len(self.ids)

    def seen(self, time: FloatArray, observer: State, height: float) -> Sight:
        """See all sources.

        Args:
            time: s after the start, shape (looks, sources).
            observer: where from, at the same times, same shape.
            height: of the observer, m.

        Returns:
            How they are seen.
        """
        placed = len(self._fleet)
        target = np.broadcast_to(np.arange(placed), (len(time), placed))
        at = time[:, :placed]
        state = self._fleet.state(target, at)
        east, north = state.x - observer.x[:, :placed], state.y - observer.y[:, :placed]
        distance, azimuth = polar_from_enu(east, north)
        across = (state.vx - observer.vx[:, :placed]) * north
        across -= (state.vy - observer.vy[:, :placed]) * east
        rate = across / np.maximum(np.square(distance), _NEAREST**2)
        elevation = np.arctan2(self._z - height, np.maximum(distance, _NEAREST))
        swinging, swing = self._processes.state(time[:, placed:])
        nowhere = np.full(swinging.shape, np.nan)
        columns = (
            (self._fleet.present(target, at), np.ones(swinging.shape, dtype=bool)),
            (azimuth, wrap_two_pi(swinging)),
            (rate, swing),
            (elevation, nowhere),
            (distance, nowhere),
            (state.x, nowhere),
            (state.y, nowhere),
            (np.broadcast_to(self._z, at.shape), nowhere),
            (state.vx, nowhere),
            (state.vy, nowhere),
        )
        return Sight(*(np.concatenate(pair, axis=1) for pair in columns))

    def switched_on(self, time: FloatArray) -> BoolArray:
        """Tell which sources transmit; processes always do.

        Args:
            time: s after the start, shape (looks, sources).

        Returns:
            Boolean, same shape.
        """
        on = np.zeros(time.shape, dtype=bool)
        on[:, len(self._fleet) :] = True
        for column, sections in self._schedules.items():
            for section in sections:
                at = time[:, column]
                sends = (section.begins <= at) & (at < section.ends)
                if section.off_time:
                    since = np.mod(at - section.begins, section.on_time + section.off_time)
                    sends &= since < section.on_time
                on[:, column] |= sends
        return on
