# SPDX-License-Identifier: Apache-2.0
"""The antenna's rotation, estimated from nothing but the times and azimuths of plots.

Every plot, true or false, satisfies azimuth = phase + rate * time (mod 2 pi), whatever the target does. The rate is
found as the maximum of the periodogram of exp(j azimuth) over the recent plots and then followed by regression.
"""

from __future__ import annotations

from math import copysign

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, wrap_pi, wrap_two_pi

FloatArray = npt.NDArray[np.float64]

SHORTEST_PERIOD = 0.3
LONGEST_PERIOD = 60.0
_WINDOW = 128
_FEWEST = 6
_TOLERANCE = 0.2  # rad
_LEAST_HEIGHT = 0.75
_SMALLEST_TURN = 1.0  # rad
_FINEST_GRID = 4096
_LONGEST_SILENCE = 20.0  # periods
_VERDICT_PLOTS = 12
_REFINED_PLOTS = 36
_SHORTEST_WINDOW = 0.25  # periods
_UNKNOWN = 4.0  # s
_LONGEST_DOUBT = 8.0  # periods


class Rotation:
    """Estimates period and sense of the rotation."""

    def __init__(self, hint: float = 0.0) -> None:
        """Start without plots.

        Args:
            hint: period in seconds, 0 if nobody knows.
        """
        self._hint = hint
        self._period = hint
        self._times: FloatArray = np.zeros(0)
        self._azimuths: FloatArray = np.zeros(0)
        self._good = np.ones(0, bool)
        self._rate = 0.0
        self._phase = 0.0
        self._origin = 0.0
        self._news = 0
        self._latest = -np.inf
        self._stride = 1
        self._gathered: list[tuple[FloatArray, FloatArray]] = []
        self._number_gathered = 0
        self._lost = -np.inf
        self.locked = False
        """Whether the plots at present fit the estimate."""
        self.locks = 0
        """How often it has been found."""

    @property
    def known(self) -> bool:
        """Whether there is a period, by hint or by estimate."""
        return self._period > 0.0

    @property
    def period(self) -> float:
        """Seconds a turn; a common value as long as nothing is known."""
        return self._period if self.known else _UNKNOWN

    @property
    def sense(self) -> float:
        """+1 where azimuths increase with time, -1 where they decrease, 0 while unknown."""
        return copysign(1.0, self._rate) if self._rate else 0.0

    def tells_passages(self, now: float) -> bool:
        """Whether it can be said that the beam has passed a place.

        Not while a change of the period is being measured; but doubt does not last, lest tracks live on for ever.

        Args:
            now: seconds.

        Returns:
            True if a track that should have been passed has been passed.
        """
        in_doubt = not self.locked and now - self._lost < _LONGEST_DOUBT * self.period
        return self.known and not in_doubt

    def last_passage(self, azimuths: FloatArray, before: float) -> FloatArray:
        """When the beam was at given azimuths last, by the present phase.

        Args:
            azimuths: radians, shape (n,).
            before: seconds.

        Returns:
            Seconds, at most `before`, shape (n,).
        """
        phase = self._phase + self._rate * (before - self._origin)
        return before - wrap_two_pi(self.sense * (phase - azimuths)) / abs(self._rate)

    def observe(self, times: FloatArray, azimuths: FloatArray) -> None:
        """Take plots into account.

        Args:
            times: seconds, ascending, shape (n,).
            azimuths: radians, shape (n,).
        """
        if not len(times):
            return
        if float(times[0]) - self._latest > _LONGEST_SILENCE * self.period:
            self._gathered.clear()
            self._number_gathered = 0
            self._restart(0)
        self._latest = float(times[-1])
        self._gathered.append((times, azimuths))
        self._number_gathered += len(times)
        # As long as it is known, a verdict on some plots at once is soon enough.
        if self.locked and self._number_gathered < _VERDICT_PLOTS:
            return
        times, azimuths = (np.concatenate(parts) for parts in zip(*self._gathered, strict=True))
        self._news += self._number_gathered
        self._gathered.clear()
        self._number_gathered = 0
        if self.locked:
            self._check(times[-_WINDOW:], azimuths[-_WINDOW:])
        self._remember(times, azimuths)
        if self.locked and self._news >= _REFINED_PLOTS:
            self._news = 0
            self._refine()
        elif not self.locked and self._news >= _FEWEST:
            self._news = 0
            self._acquire()

    def _remember(self, times: FloatArray, azimuths: FloatArray) -> None:
        self._times = np.concatenate([self._times, times[:: self._stride]])
        self._azimuths = np.concatenate([self._azimuths, azimuths[:: self._stride]])
        # So many plots in so small a part of a turn show no rotation; then some of them stand for all.
        shortest = _SHORTEST_WINDOW * (self.period if self.locked else LONGEST_PERIOD)
        while len(self._times) > _WINDOW and self._times[-1] - self._times[-_WINDOW] < shortest:
            self._stride *= 2
            self._times, self._azimuths = self._times[::2], self._azimuths[::2]
        self._times, self._azimuths = self._times[-_WINDOW:], self._azimuths[-_WINDOW:]

    def _check(self, times: FloatArray, azimuths: FloatArray) -> None:
        good = np.abs(self._residuals(times, azimuths)) < _TOLERANCE
        self._good = np.concatenate([self._good, good])[-_VERDICT_PLOTS:]
        if len(self._good) == _VERDICT_PLOTS and np.count_nonzero(self._good) < _VERDICT_PLOTS / 2:
            # What still fitted belongs to the rotation that is over.
            bad = int(np.count_nonzero(~self._good))
            self._restart(bad - int(np.count_nonzero(~good)))
            self._lost = float(times[-1])

    def _restart(self, keep: int) -> None:
        self.locked = False
        self._good = self._good[:0]
        self._stride = 1
        begin = max(0, len(self._times) - keep)
        self._times, self._azimuths = self._times[begin:], self._azimuths[begin:]

    def _residuals(self, times: FloatArray, azimuths: FloatArray) -> FloatArray:
        return wrap_pi(azimuths - self._phase - self._rate * (times - self._origin))

    def _refine(self) -> None:
        residuals = self._residuals(self._times, self._azimuths)
        good = np.abs(residuals) < _TOLERANCE
        if np.count_nonzero(good) < _FEWEST:
            return
        times, residuals = self._times[good], residuals[good]
        centre = times.mean()
        spread = times - centre
        correction = float(spread @ residuals / max(float(spread @ spread), 1e-12))
        self._phase += self._rate * (centre - self._origin) + float(residuals.mean())
        self._rate += correction
        self._origin = centre
        self._period = min(max(TWO_PI / abs(self._rate), SHORTEST_PERIOD), LONGEST_PERIOD)

    def _acquire(self) -> None:
        newest = self._times[-1]
        # Older plots would only narrow the peak beyond what the grid resolves.
        reach = _FINEST_GRID / 4.0 * SHORTEST_PERIOD / TWO_PI
        recent = self._times > newest - reach
        times, azimuths = self._times[recent] - newest, self._azimuths[recent]
        span = -float(times[0])
        if len(times) < _FEWEST or span <= 0.0:
            return
        highest = TWO_PI / SHORTEST_PERIOD
        count = int(np.clip(4.0 * highest * span / TWO_PI, 64, _FINEST_GRID))
        speeds = np.linspace(TWO_PI / LONGEST_PERIOD, highest, count)
        rates = np.concatenate([-speeds[::-1], speeds])
        height = np.abs(np.exp(1j * (azimuths - rates[:, None] * times)).mean(axis=1))
        peak = np.r_[False, (height[1:-1] >= height[:-2]) & (height[1:-1] >= height[2:]), False]
        peak &= (height > _LEAST_HEIGHT) & (height > height.max() - 0.1)
        if not peak.any():
            return
        fits = [self._fit(rate, times, azimuths) for rate in self._by_preference(rates[peak])[:8]]
        smallest = min(error for error, _, _ in fits)
        # Of rates that fit equally well, as for a single target, the preferred one.
        error, rate, phase = next(fit for fit in fits if fit[0] <= 1.5 * smallest + 1e-3)
        if error > _TOLERANCE / 4 or abs(rate) * span < _SMALLEST_TURN:
            return
        self._rate, self._phase, self._origin = rate, phase, newest
        self._period = float(np.clip(TWO_PI / abs(rate), SHORTEST_PERIOD, LONGEST_PERIOD))
        self.locked = True
        self.locks += 1

    def _by_preference(self, rates: FloatArray) -> FloatArray:
        if self._hint > 0.0:
            return rates[np.argsort(np.abs(np.log(np.abs(rates) * self._hint / TWO_PI)))]
        return rates[np.argsort(np.abs(rates), kind="stable")]

    @staticmethod
    def _fit(rate: float, times: FloatArray, azimuths: FloatArray) -> tuple[float, float, float]:
        phase = float(np.angle(np.exp(1j * (azimuths - rate * times)).mean()))
        good = np.ones(len(times), bool)
        residuals = wrap_pi(azimuths - rate * times - phase)
        for _ in range(5):
            spread = times[good] - times[good].mean()
            rate += float(spread @ residuals[good] / max(float(spread @ spread), 1e-12))
            phase = float(np.angle(np.exp(1j * (azimuths - rate * times))[good].mean()))
            residuals = wrap_pi(azimuths - rate * times - phase)
            near = np.abs(residuals) < _TOLERANCE
            if np.count_nonzero(near) >= max(_FEWEST, _LEAST_HEIGHT * len(times)):
                good = near
        return float(np.sqrt(np.mean(residuals[good] ** 2))), rate, phase
