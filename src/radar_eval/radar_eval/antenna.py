# SPDX-License-Identifier: Apache-2.0
"""How the antenna turned, estimated from the times and azimuths of what it saw."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, wrap_pi, wrap_two_pi
from radar_eval.errors import RotationError

FloatArray = npt.NDArray[np.float64]

_SHORTEST_PERIOD, _LONGEST_PERIOD = 0.5, 20.0
_FIRST_SPAN = 40.0
_STEPS_PER_PEAK = 8


@dataclass(frozen=True, slots=True)
class Rotation:
    """A steadily turning antenna, with its slow deviations from steadiness.

    Attributes:
        origin: seconds since the epoch to which the angles refer.
        period: seconds a turn.
        knots: seconds after `origin`, shape (k,), rising.
        deviations: radians by which the antenna is ahead of the steady rotation at the knots, shape (k,).
    """

    origin: float
    period: float
    knots: FloatArray
    deviations: FloatArray

    def angle(self, time: npt.ArrayLike) -> FloatArray:
        """Angle of the antenna, counted on over the turns.

        Args:
            time: seconds since the epoch, any shape.

        Returns:
            Radians clockwise from north, same shape; 2 pi more each turn.
        """
        elapsed = np.asarray(time, dtype=float) - self.origin
        return TWO_PI * elapsed / self.period + np.interp(elapsed, self.knots, self.deviations)

    def azimuth(self, time: npt.ArrayLike) -> FloatArray:
        """Azimuth of the antenna.

        Args:
            time: seconds since the epoch, any shape.

        Returns:
            Radians clockwise from north in [0, 2 pi), same shape.
        """
        return wrap_two_pi(self.angle(time))


def estimate_rotation(
    time: FloatArray, azimuth: FloatArray, *, period: float | None = None
) -> Rotation:
    """Estimate the rotation from plots, or whatever the antenna pointed at.

    The period is the one at which the azimuths minus the steady rotation agree best, found as the maximum of their
    mean resultant length (Mardia and Jupp 2000, section 2.3), first over a short span and then over longer ones, as
    the peak narrows. What remains, averaged over a few turns, is the deviation.

    Args:
        time: seconds since the epoch, shape (n,).
        azimuth: radians clockwise from north, shape (n,).
        period: seconds a turn where it is known; None estimates it between 0.5 and 20 s.

    Returns:
        The rotation.

    Raises:
        RotationError: fewer than ten samples or times that do not differ, or azimuths that follow no rotation.
    """
    if len(time) < 10 or np.ptp(time) <= 0.0:
        raise RotationError(f"{len(time)} plots are too few to tell how the antenna turned")
    order = np.argsort(time, kind="stable")
    origin = float(time[order[0]])
    elapsed, direction = time[order] - origin, azimuth[order]
    if period is None:
        period = _estimate_period(elapsed, direction)
    residual = np.exp(1j * (direction - TWO_PI * elapsed / period))
    if abs(residual.mean()) < 3.0 / np.sqrt(len(residual)):
        raise RotationError("the azimuths of the plots follow no rotation of an antenna")
    knots, deviations = _deviations(elapsed, residual, period)
    return Rotation(origin, period, knots, deviations)


def _estimate_period(elapsed: FloatArray, azimuth: FloatArray) -> float:
    duration = float(elapsed[-1])
    span = min(_FIRST_SPAN, duration)
    inside = elapsed <= span
    step = 1.0 / (_STEPS_PER_PEAK * span)
    rates = np.arange(1.0 / _LONGEST_PERIOD, 1.0 / _SHORTEST_PERIOD + step, step)
    rate = _best_rate(elapsed[inside], azimuth[inside], rates)
    while True:
        # The error left by the last span is within one of its steps to either side.
        finer = rate + step * np.linspace(-1.0, 1.0, 4 * _STEPS_PER_PEAK + 1)
        inside = elapsed <= span
        rate = _best_rate(elapsed[inside], azimuth[inside], finer)
        if span >= duration:
            return 1.0 / rate
        step = 1.0 / (_STEPS_PER_PEAK * span)
        span = min(2.0 * span, duration)


def _best_rate(elapsed: FloatArray, azimuth: FloatArray, rates: FloatArray) -> float:
    # Each rate is one pass over the samples: a matrix of all of them would not fit the memory of a long recording.
    resultant = [abs(np.mean(np.exp(1j * (azimuth - TWO_PI * rate * elapsed)))) for rate in rates]
    return float(rates[int(np.argmax(resultant))])


def _deviations(
    elapsed: FloatArray, residual: npt.NDArray[np.complex128], period: float
) -> tuple[FloatArray, FloatArray]:
    bins = max(1, int(elapsed[-1] / (4.0 * period)))
    edges = np.linspace(0.0, elapsed[-1], bins + 1)
    index = np.clip(np.searchsorted(edges, elapsed, side="right") - 1, 0, bins - 1)
    counts = np.bincount(index, minlength=bins)
    sums = np.bincount(index, residual.real, bins) + 1j * np.bincount(index, residual.imag, bins)
    filled = counts > 0
    centres = 0.5 * (edges[1:] + edges[:-1])
    whole = np.angle(residual.mean())
    return centres[filled], whole + wrap_pi(np.angle(sums[filled]) - whole)
