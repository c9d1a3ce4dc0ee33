# SPDX-License-Identifier: Apache-2.0
"""Groups of targets drawn at random: the generalised motion hypothesis with a fence around the coverage.

Every leg is uniform or a manoeuvre; a manoeuvre in course has a normal centripetal acceleration, one in speed a
normal acceleration, and both may happen together (Kuzmin 1967, § 4.2.1, version A). The book leaves durations open:
here they are exponential, cut to between a fifth and three times their mean. A target that would leave its ring
outwards turns back instead.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, wrap_pi
from radar_common.parameters import ParameterError, Parameters, parameter
from radar_sim.motion import Leg, Path, displacement
from radar_sim.motion.correlated import WanderSection
from radar_sim.motion.model import MotionModel
from radar_sim.motion.sections import draw_paths
from radar_sim.moving import read_motion
from radar_sim.radar import Radar
from radar_sim.targets import Target
from radar_sim.yaml_sections import read_keys, read_section

FloatArray = npt.NDArray[np.float64]

_HOMEWARD_SPREAD = math.radians(45.0)
_SLOWEST_TURN_BACK = math.radians(0.5)


@dataclass(frozen=True, kw_only=True)
class TrafficSection(Parameters):
    """One entry of a scenario's `traffic`: many targets alike."""

    number: int = parameter(10, "how many targets", low=0, high=100_000)
    range_min: float = parameter(5_000.0, "nearest first position", unit="m", low=0.0, high=1e6)
    range_max: float = parameter(
        50_000.0,
        "farthest first position, and where targets turn back",
        unit="m",
        low=1.0,
        high=1e6,
    )
    speed_min: float = parameter(100.0, "lowest speed", unit="m/s", low=0.0, high=3000.0)
    speed_max: float = parameter(250.0, "highest speed", unit="m/s", low=0.0, high=3000.0)
    manoeuvre: float = parameter(
        0.3,
        "probability that a leg is a turn, and likewise that it changes speed",
        low=0.0,
        high=1.0,
    )
    centripetal_std: float = parameter(
        2.0, "rms centripetal acceleration in a turn", unit="m/s²", low=0.0, high=100.0
    )
    turn_rate_max_deg: float = parameter(
        3.0, "no turn is faster than this", unit="deg/s", low=0.01, high=45.0
    )
    acceleration_std: float = parameter(
        0.5, "rms acceleration in a change of speed", unit="m/s²", low=0.0, high=50.0
    )
    leg_duration: float = parameter(60.0, "mean time on a leg", unit="s", low=1.0, high=1e5)
    duration: float = parameter(
        3600.0, "time after which there are no more manoeuvres", unit="s", low=0.0, high=1e6
    )
    snr_db: float = parameter(
        15.0,
        "mean over the targets of their snr_db at the reference range",
        unit="dB",
        low=-60.0,
        high=80.0,
    )
    snr_spread_db: float = parameter(
        3.0, "standard deviation of it over the targets", unit="dB", low=0.0, high=20.0
    )
    steady: float = parameter(0.0, "fraction of targets that do not fluctuate", low=0.0, high=1.0)
    fast: float = parameter(0.0, "fraction that fluctuates fast", low=0.0, high=1.0)
    slow_dominant: float = parameter(
        0.0, "fraction that fluctuates slowly with a dominant scatterer", low=0.0, high=1.0
    )
    fast_dominant: float = parameter(
        0.0,
        "fraction that fluctuates fast with one; the rest fluctuates slowly",
        low=0.0,
        high=1.0,
    )
    appear_within: float = parameter(
        0.0,
        "times of appearance are uniform in this time from the start",
        unit="s",
        low=0.0,
        high=1e6,
    )
    lifetime: float = parameter(
        0.0, "mean of exponential lifetimes; 0 lets all stay for ever", unit="s", low=0.0, high=1e6
    )

    def check(self) -> None:
        """Check that intervals are not reversed and fractions add up.

        Raises:
            ParameterError: one of them is.
        """
        for low, high in (("range_min", "range_max"), ("speed_min", "speed_max")):
            if getattr(self, low) > getattr(self, high):
                raise ParameterError(
                    f"{low} {getattr(self, low):g} is greater than {high} {getattr(self, high):g}"
                )
        total = sum(self.shares.values())
        # A sum of fractions may round to a little more than one.
        if total > 1.0 + 1e-9:
            raise ParameterError(
                f"steady, fast, slow_dominant and fast_dominant add up to {total:g}, above 1"
            )

    @property
    def shares(self) -> dict[str, float]:
        """Fraction of each kind of fluctuation but the slow one, which has the rest."""
        return {
            "none": self.steady,
            "fast": self.fast,
            "slow-dominant": self.slow_dominant,
            "fast-dominant": self.fast_dominant,
        }


@dataclass(frozen=True, slots=True)
class TrafficGroup:
    """Many targets alike, not yet drawn.

    Attributes:
        section: what they have in common.
        motion: moves them; None for the legs that the section describes.
        wander: about their paths; None for none.
    """

    section: TrafficSection
    motion: MotionModel | None = None
    wander: WanderSection | None = None

    def draw(self, radar: Radar, rng: np.random.Generator) -> list[Target]:
        """Draw the targets.

        Args:
            radar: centre of the group's ring.
            rng: source of randomness.

        Returns:
            The targets.
        """
        targets = draw_traffic(self.section, radar, rng, legs=self.motion is None)
        if self.motion is None and self.wander is None:
            return targets
        # A stream aside, so that the next group does not depend on how this one moves.
        (stream,) = rng.spawn(1)
        paths = draw_paths([target.path for target in targets], self.motion, self.wander, stream)
        return [replace(target, path=path) for target, path in zip(targets, paths, strict=True)]


def read_group(entry: Any, where: str) -> TrafficGroup:
    """Read one entry of `traffic`.

    Args:
        entry: keys and values.
        where: it stands.

    Returns:
        The group.

    Raises:
        ParameterError: a key is unknown or a value impossible.
    """
    keys = read_keys(entry, where)
    motion, wander = read_motion(keys, where)
    return TrafficGroup(read_section(TrafficSection, keys, where), motion, wander)


def draw_traffic(
    group: TrafficSection, radar: Radar, rng: np.random.Generator, *, legs: bool = True
) -> list[Target]:
    """Draw the targets of a group around the radar.

    Args:
        group: what they have in common.
        radar: centre of the group's ring.
        rng: source of randomness.
        legs: whether they manoeuvre; without legs they fly straight on.

    Returns:
        The targets; positions are uniform over range and azimuth.
    """
    size = group.number
    distance = rng.uniform(group.range_min, group.range_max, size)
    position = distance * np.exp(1j * rng.uniform(0.0, TWO_PI, size))
    speed = rng.uniform(group.speed_min, group.speed_max, size)
    course = rng.uniform(0.0, TWO_PI, size)
    appears = rng.uniform(0.0, group.appear_within, size)
    lifetime = rng.exponential(group.lifetime, size) if group.lifetime else np.full(size, np.inf)
    snr_db = rng.normal(group.snr_db, group.snr_spread_db, size)
    kind = rng.uniform(size=size)
    names = np.array([*group.shares, "slow"])
    kinds = names[np.searchsorted(np.cumsum(list(group.shares.values())), kind, side="right")]
    flown = _draw_legs(group, position, speed, course, rng) if legs else [[]] * size
    return [
        Target(
            Path(
                x=radar.x + float(position[i].imag),
                y=radar.y + float(position[i].real),
                speed=float(speed[i]),
                course=float(course[i]),
                legs=tuple(flown[i]),
                appears=float(appears[i]),
                disappears=float(appears[i] + lifetime[i]),
            ),
            float(snr_db[i]),
            str(kinds[i]),
        )
        for i in range(size)
    ]


def _draw_legs(
    group: TrafficSection,
    position: npt.NDArray[np.complex128],
    speed: FloatArray,
    course: FloatArray,
    rng: np.random.Generator,
) -> list[list[Leg]]:
    legs: list[list[Leg]] = [[] for _ in speed]
    clock = np.zeros(len(speed))
    while len(clock) and clock.min() < group.duration:
        duration, turn_rate, acceleration = _draw_leg(group, speed, rng)
        way = displacement(speed, course, turn_rate, acceleration, duration)
        turning_back, back_rate, back_duration = _way_back(
            group, position, position + way, speed, course, rng
        )
        duration = np.where(turning_back, back_duration, duration)
        turn_rate = np.where(turning_back, back_rate, turn_rate)
        acceleration = np.where(turning_back, 0.0, acceleration)
        position = position + displacement(speed, course, turn_rate, acceleration, duration)
        speed = speed + acceleration * duration
        course = course + turn_rate * duration
        for row, leg in enumerate(zip(duration, turn_rate, acceleration, strict=True)):
            if clock[row] < group.duration:
                legs[row].append(Leg(*map(float, leg)))
        clock += duration
    return legs


def _draw_leg(
    group: TrafficSection, speed: FloatArray, rng: np.random.Generator
) -> tuple[FloatArray, FloatArray, FloatArray]:
    size = len(speed)
    mean, fastest = group.leg_duration, math.radians(group.turn_rate_max_deg)
    duration = np.clip(rng.exponential(mean, size), mean / 5.0, 3.0 * mean)
    turns, changes = rng.random((2, size)) < group.manoeuvre
    centripetal = rng.normal(0.0, group.centripetal_std, size)
    turn_rate = turns * np.clip(centripetal / np.maximum(speed, 1.0), -fastest, fastest)
    wanted = speed + changes * rng.normal(0.0, group.acceleration_std, size) * duration
    acceleration = (np.clip(wanted, group.speed_min, group.speed_max) - speed) / duration
    # Nobody flies circles: a turn ends after half of one.
    duration = np.minimum(duration, np.pi / np.maximum(np.abs(turn_rate), 1e-9))
    return duration, turn_rate, acceleration


def _way_back(
    group: TrafficSection,
    position: npt.NDArray[np.complex128],
    ahead: npt.NDArray[np.complex128],
    speed: FloatArray,
    course: FloatArray,
    rng: np.random.Generator,
) -> tuple[npt.NDArray[np.bool_], FloatArray, FloatArray]:
    home = np.angle(-position) + rng.uniform(-_HOMEWARD_SPREAD, _HOMEWARD_SPREAD, len(speed))
    change = wrap_pi(home - course)
    leaving = (np.abs(ahead) > group.range_max) & (np.abs(change) > np.pi / 2)
    rate = np.clip(
        2.0 * group.centripetal_std / np.maximum(speed, 1.0),
        min(_SLOWEST_TURN_BACK, math.radians(group.turn_rate_max_deg)),
        math.radians(group.turn_rate_max_deg),
    )
    return leaving, np.sign(change) * rate, np.abs(change) / rate
