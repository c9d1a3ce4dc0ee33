# SPDX-License-Identifier: Apache-2.0
"""What a user may set about locating emitters."""

from __future__ import annotations

from dataclasses import dataclass

from bearing_tracker.emitters.filters import DEFAULT_FILTER, FILTERS
from bearing_tracker.emitters.interface import CorrelatedError, FilterSettings
from bearing_tracker.platform_path import Limits
from bearing_tracker.sightings import LARGEST_AZIMUTH_STD
from radar_common.parameters import ParameterError, Parameters, parameter
from radar_common.tables import SITE_FRAME


@dataclass(frozen=True, kw_only=True)
class LocatorParameters(Parameters):
    """Parameters of the locator of emitters."""

    filter: str = parameter(
        DEFAULT_FILTER,
        "filter that finds emitters from bearings",
        choices=tuple(FILTERS),
        read_only=True,
    )
    range_bins: int = parameter(
        7,
        "filters over range that the range-parameterised filter is made of",
        low=2,
        high=31,
        read_only=True,
    )
    minimum_range: float = parameter(
        500.0, "no emitter is nearer to the platform", unit="m", low=1.0, high=1e6
    )
    maximum_range: float = parameter(
        150e3, "no emitter is farther from the platform", unit="m", low=10.0, high=5e6
    )
    speed_std: float = parameter(
        10.0,
        "speed of emitters, standard deviation of either component; small for emitters that stand still",
        unit="m/s",
        low=0.01,
        high=1000.0,
    )
    acceleration: float = parameter(
        0.01,
        "acceleration of emitters between manoeuvres, rms; it lasts from one bearing to the next",
        unit="m/s^2",
        low=0.0,
        high=100.0,
        read_only=True,
    )
    manoeuvre_acceleration: float = parameter(
        0.0,
        "the same in a manoeuvre; 0 for emitters that make none",
        unit="m/s^2",
        low=0.0,
        high=100.0,
        read_only=True,
    )
    quiet_time: float = parameter(
        300.0, "mean time between manoeuvres", unit="s", low=0.1, high=1e6, read_only=True
    )
    manoeuvre_time: float = parameter(
        30.0, "mean length of a manoeuvre", unit="s", low=0.1, high=1e6, read_only=True
    )
    correlated_std: float = parameter(
        0.0,
        "part of the bearing error that lasts, as the wander of an antenna's phase centre does",
        unit="rad",
        low=0.0,
        high=LARGEST_AZIMUTH_STD,
        read_only=True,
    )
    correlated_time: float = parameter(
        10.0, "time for which it lasts", unit="s", low=0.01, high=1e5, read_only=True
    )
    correlated_treatment: str = parameter(
        "inflate",
        "count a lasting error in full for every bearing, or estimate it beside the emitter",
        choices=("inflate", "augment"),
        read_only=True,
    )
    known_range_error: float = parameter(
        0.25,
        "largest relative error of range that counts as known: an ellipse, not a ray",
        low=0.01,
        high=1.0,
        read_only=True,
    )
    buffer: float = parameter(
        0.5,
        "time that bearings wait for earlier ones; what comes later than that is dropped",
        unit="s",
        low=0.0,
        high=60.0,
    )
    odometry_wait: float = parameter(
        2.0,
        "time that bearings wait for odometry at most",
        unit="s",
        low=0.0,
        high=60.0,
    )
    maximum_gap: float = parameter(
        3.0,
        "longest time between two fixes of the platform to interpolate in",
        unit="s",
        low=0.01,
        high=60.0,
    )
    maximum_extrapolation: float = parameter(
        0.5,
        "longest time after the last fix of the platform to extrapolate",
        unit="s",
        low=0.0,
        high=10.0,
    )
    maximum_platform_speed: float = parameter(
        600.0,
        "a fix that only a faster platform could reach is a jump",
        unit="m/s",
        low=0.1,
        high=10000.0,
    )
    look: float = parameter(
        0.05,
        "bearings so close in time are of one look, in which an emitter stands once",
        unit="s",
        low=0.0,
        high=10.0,
    )
    gate_sigmas: float = parameter(
        4.0,
        "half width of the gate in standard deviations of the predicted difference",
        unit="sigma",
        low=1.0,
        high=10.0,
    )
    confirm_hits: int = parameter(
        4, "bearings that an emitter needs to be confirmed", low=1, high=1000
    )
    restart_after: int = parameter(
        8,
        "bearings in a row of an emitter's identity that do not fit, after which it is located anew",
        low=2,
        high=1000,
    )
    end_after: float = parameter(
        120.0,
        "time without a bearing that fits, which ends an emitter",
        unit="s",
        low=0.1,
        high=86400.0,
    )
    tentative_end_after: float = parameter(
        15.0,
        "the same of an emitter that is not confirmed yet",
        unit="s",
        low=0.1,
        high=86400.0,
    )
    default_azimuth_std: float = parameter(
        0.0175,
        "azimuth error of bearings that tell none",
        unit="rad",
        low=1e-6,
        high=LARGEST_AZIMUTH_STD,
    )
    minimum_azimuth_std: float = parameter(
        0.0005, "smallest azimuth error believed", unit="rad", low=1e-6, high=LARGEST_AZIMUTH_STD
    )
    frame: str = parameter(
        SITE_FRAME, "frame that the platform's odometry must be in; emitters are in it too"
    )
    publish_poses: bool = parameter(
        False,
        "publish each confirmed emitter whose range is known on emitters/id_<id>/pose",
        read_only=True,
    )
    maximum_bearings: int = parameter(
        10000,
        "rows of one message that are looked at; more are dropped, which bounds time and memory",
        low=1,
        high=1_000_000,
    )
    maximum_look: int = parameter(
        500,
        "bearings of one look that are processed; more are dropped, which bounds time and memory",
        low=1,
        high=100_000,
    )
    maximum_emitters: int = parameter(
        500, "emitters that are followed at once, confirmed or not", low=1, high=100_000
    )

    def check(self) -> None:
        """Refuse what does not go together.

        Raises:
            ParameterError: ranges, times or errors are in the wrong order.
        """
        for low, high in (
            ("minimum_azimuth_std", "default_azimuth_std"),
            ("tentative_end_after", "end_after"),
            ("buffer", "odometry_wait"),
        ):
            if getattr(self, low) > getattr(self, high):
                raise ParameterError(f"{low} must not exceed {high}")
        if self.minimum_range >= self.maximum_range:
            raise ParameterError("minimum_range must be below maximum_range")
        if self.manoeuvre_acceleration and self.manoeuvre_acceleration <= self.acceleration:
            raise ParameterError("manoeuvre_acceleration must be 0 or above acceleration")

    @property
    def filter_settings(self) -> FilterSettings:
        """What the filter is made of."""
        return FilterSettings(
            acceleration_std=self.acceleration,
            manoeuvre_std=self.manoeuvre_acceleration,
            quiet_time=self.quiet_time,
            manoeuvre_time=self.manoeuvre_time,
            range_bins=self.range_bins,
            correlated=CorrelatedError(
                std=self.correlated_std,
                time=self.correlated_time,
                treatment=self.correlated_treatment,
            ),
            known_range_error=self.known_range_error,
        )

    @property
    def path_limits(self) -> Limits:
        """What is believed of the platform's path."""
        return Limits(
            gap=self.maximum_gap,
            ahead=self.maximum_extrapolation,
            speed=self.maximum_platform_speed,
            memory=2.0 * (self.odometry_wait + self.maximum_gap),
        )
