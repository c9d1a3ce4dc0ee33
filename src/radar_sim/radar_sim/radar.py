# SPDX-License-Identifier: Apache-2.0
"""The radar of a scenario: how it turns, transmits and receives."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.antenna_pattern import PATTERNS, Pattern
from radar_common.frames import TWO_PI, wrap_pi
from radar_common.parameters import ParameterError, Parameters, parameter
from radar_common.pulse_response import PULSE_RESPONSES, PulseResponse

SPEED_OF_LIGHT = 299_792_458.0

_MINIMUM_PULSES = 16


@dataclass(frozen=True, kw_only=True)
class Radar(Parameters):
    """A rotating two-coordinate pulse radar with a receiver matched to its pulse."""

    x: float = parameter(0.0, "antenna east of the map's origin", unit="m")
    y: float = parameter(0.0, "antenna north of the map's origin", unit="m")
    z: float = parameter(0.0, "antenna above the map's origin; for viewers only", unit="m")
    scan_period: float = parameter(4.0, "time of one turn", unit="s", low=0.1, high=120.0)
    pulse_rate: float = parameter(
        1024.0,
        "pulse repetition frequency; times scan_period it need not be whole",
        unit="Hz",
        low=10.0,
        high=1e5,
    )
    beamwidth_deg: float = parameter(
        1.4, "one-way half-power beamwidth, as data sheets give it", unit="deg", low=0.05, high=30.0
    )
    pattern: str = parameter("gaussian", "two-way amplitude pattern", choices=tuple(PATTERNS))
    range_start: float = parameter(
        0.0, "near edge of the first range cell", unit="m", low=0.0, high=1e6
    )
    range_step: float = parameter(
        108.0,
        "length of a range cell; the pulse, c / 2 times its duration, is samples_per_pulse times as long",
        unit="m",
        low=0.1,
        high=1e4,
    )
    cells: int = parameter(1024, "number of range cells", low=4, high=65536)
    samples_per_pulse: int = parameter(
        1,
        "range cells in a pulse length; from 2 on, noise and echoes of neighbouring cells are correlated",
        low=1,
        high=32,
    )
    pulse_shape: str = parameter(
        "rectangular",
        "pulse with its matched filter; of gaussian-book, noise changes 2.5 times as fast as it can",
        choices=tuple(PULSE_RESPONSES),
    )
    wavelength: float = parameter(
        0.107, "carrier wavelength; sets how echoes in one cell beat", unit="m", low=1e-3, high=10.0
    )
    noise_level: float = parameter(
        0.02, "rms of each quadrature of the noise in units of the float video", low=1e-9, high=1e9
    )
    full_scale: float = parameter(
        64.0, "envelope over noise_level at which integer video saturates", low=4.0, high=1e5
    )
    db_per_count: float = parameter(
        0.4, "step of logarithmic video", unit="dB", low=1e-3, high=10.0
    )
    log_floor_db: float = parameter(
        -20.0,
        "level over noise_level at which logarithmic video is zero",
        unit="dB",
        low=-60.0,
        high=20.0,
    )
    side_lobe_db: float = parameter(
        -30.0,
        "mean one-way level of the side lobes under the main lobe, through which interference comes in",
        unit="dB",
        low=-80.0,
        high=0.0,
    )
    gain_swing_db: float = parameter(
        0.0,
        "amplitude of a slow change of receiver gain along range",
        unit="dB",
        low=0.0,
        high=20.0,
    )
    gain_swing_length: float = parameter(
        40_000.0, "range over which that change repeats itself", unit="m", low=100.0, high=1e7
    )
    reference_range: float = parameter(
        50_000.0, "range at which a target has the snr_db given for it", unit="m", low=1.0, high=1e6
    )
    max_snr_db: float = parameter(
        40.0,
        "limit of the signal-to-noise ratio at short range (sensitivity time control)",
        unit="dB",
        low=0.0,
        high=60.0,
    )

    def check(self) -> None:
        """Check that there are enough pulses, in the turn and in the beam.

        Raises:
            ParameterError: the pulse rate is too low for this rotation.
        """
        if self.pulses_per_scan < _MINIMUM_PULSES:
            raise ParameterError(
                f"pulse_rate {self.pulse_rate:g} Hz gives {self.pulses_per_scan:g} pulses in scan_period, "
                f"at least {_MINIMUM_PULSES} are needed"
            )
        if self.pulses_in_beam < 1.0:
            raise ParameterError(
                f"beamwidth_deg {self.beamwidth_deg:g} holds {self.pulses_in_beam:.2g} pulses at this pulse_rate, "
                "at least one is needed"
            )
        if self.pulse_interval * SPEED_OF_LIGHT / 2.0 < self.range_end:
            raise ParameterError(
                f"pulse_rate {self.pulse_rate:g} Hz is ambiguous beyond "
                f"{self.pulse_interval * SPEED_OF_LIGHT / 2.0:.0f} m, the cells reach to {self.range_end:.0f} m"
            )

    @property
    def pulse_interval(self) -> float:
        """Time from one pulse to the next, s."""
        return 1.0 / self.pulse_rate

    @property
    def pulses_per_scan(self) -> float:
        """Pulses in one turn, not always a whole number."""
        return self.pulse_rate * self.scan_period

    @property
    def rotation_rate(self) -> float:
        """Angular speed of the antenna, rad/s."""
        return TWO_PI / self.scan_period

    @property
    def beam(self) -> Pattern:
        """The pattern that `pattern` names."""
        return PATTERNS[self.pattern]

    @property
    def response(self) -> PulseResponse:
        """Pulse and noise along range that `pulse_shape` names."""
        return PULSE_RESPONSES[self.pulse_shape]

    @property
    def independent_cells(self) -> bool:
        """Whether noise of neighbouring cells is independent: one cell in a rectangular pulse."""
        return self.samples_per_pulse == 1 and self.response.noise_extent <= 1.0

    @property
    def half_width(self) -> float:
        """phi, the half width that the pattern's argument is scaled by, rad."""
        return math.radians(self.beamwidth_deg) / 2.0 / self.beam.half_power

    @property
    def pulses_in_beam(self) -> float:
        """Number of pulses in a burst, N0 = 2 F phi / Omega (Kuzmin 1967, 1.27)."""
        return 2.0 * self.pulse_rate * self.half_width / self.rotation_rate

    @property
    def range_end(self) -> float:
        """Far edge of the last range cell, the instrumented range, m."""
        return self.range_start + self.cells * self.range_step

    def azimuth(self, pulse: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Direction of the beam's axis at a pulse; pulse 0 points north.

        Args:
            pulse: number of the pulse since the start, any shape.

        Returns:
            Radians clockwise from north in [0, 2 pi), same shape.
        """
        turns = np.asarray(pulse, dtype=float) / self.pulses_per_scan
        return TWO_PI * (turns - np.floor(turns))

    def one_way_gain(self, azimuth: npt.ArrayLike, source: float) -> npt.NDArray[np.float64]:
        """Power with which the antenna receives what arrives from a direction, main lobe or side lobes.

        Args:
            azimuth: of the beam's axis, rad, any shape.
            source: direction of arrival, rad.

        Returns:
            Power gain over that of the axis, same shape.
        """
        alpha = wrap_pi(np.asarray(azimuth, dtype=float) - source) / self.half_width
        return np.maximum(self.beam(alpha), 10.0 ** (self.side_lobe_db / 10.0))

    def gain(self) -> npt.NDArray[np.float64]:
        """Receiver gain of each range cell, which acts on noise and echoes alike.

        Returns:
            Amplitude factor, shape (cells,).
        """
        ranges = self.range_start + (np.arange(self.cells) + 0.5) * self.range_step
        decibels = self.gain_swing_db * np.sin(TWO_PI * ranges / self.gain_swing_length)
        return np.asarray(10.0 ** (decibels / 20.0))
