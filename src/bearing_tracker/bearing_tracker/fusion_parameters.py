# SPDX-License-Identifier: Apache-2.0
"""What a user may set about the fusion of angle channels."""

from __future__ import annotations

from dataclasses import dataclass

from bearing_tracker.fusion import FILTERS
from bearing_tracker.sightings import LARGEST_AZIMUTH_STD
from radar_common.parameters import ParameterError, Parameters, parameter

ACTIVE_INPUTS = ("tracks", "track_plots", "plots")
CAUSAL_FILTERS = tuple(name for name in FILTERS if name != "oracle")


@dataclass(frozen=True, kw_only=True)
class FusionParameters(Parameters):
    """Parameters of the fusion of angle channels."""

    active_input: str = parameter(
        "tracks",
        "what the active channel measures: smoothed position of each confirmed track, the plot that it has just "
        "taken, or plots without regard to tracks, each of which may be a target",
        choices=ACTIVE_INPUTS,
        read_only=True,
    )
    filter: str = parameter("dcmp", "filter of the two channels", choices=CAUSAL_FILTERS)
    output: str = parameter(
        "mmse",
        "estimate: mean over the states of the channels, or that of the most probable ones",
        choices=("mmse", "map"),
    )
    buffer: float = parameter(
        1.0,
        "time that the fusion waits for the slower channel; what comes later than that is dropped",
        unit="s",
        low=0.0,
        high=60.0,
    )
    look: float = parameter(
        0.05,
        "bearings of one channel so close in time are of one look, in which a target stands once",
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
    fastest: float = parameter(
        600.0,
        "fastest change of a target's range; a radar's bearing whose range says more than that is another target's",
        unit="m/s",
        low=1.0,
        high=1e6,
    )
    confirm_hits: int = parameter(
        3, "bearings that a target without a radar track needs to be published", low=1, high=50
    )
    end_after: float = parameter(
        30.0,
        "time without a bearing that ends a target; a channel silent for so long has lost its target",
        unit="s",
        low=0.1,
        high=3600.0,
    )
    tentative_end_after: float = parameter(
        6.0,
        "the same of a target that is not published yet",
        unit="s",
        low=0.1,
        high=3600.0,
    )
    release_after: int = parameter(
        6,
        "bearings in a row outside the gate, all to the same side, that part an identity of a sensor from its target",
        low=2,
        high=1000,
    )
    join_after: int = parameter(
        10,
        "bearings in a row after which a target of the radar alone and one of the passive channel alone that are in "
        "one place are one",
        low=2,
        high=1000,
    )
    model: str = parameter(
        "surveillance",
        "motion of the azimuth: a nearly constant rate, or a line of sight that swings about an axis while the target "
        "comes nearer",
        choices=("surveillance", "guidance"),
    )
    acceleration: float = parameter(
        3.0, "lateral acceleration of targets, rms", unit="m/s^2", low=0.0, high=100.0
    )
    acceleration_time: float = parameter(
        5.0, "time that an acceleration lasts", unit="s", low=0.01, high=1000.0
    )
    speed: float = parameter(
        200.0,
        "speed of straight flights whose bent azimuth the filter is to follow",
        unit="m/s",
        low=0.0,
        high=10000.0,
    )
    unknown_range: float = parameter(
        30e3, "range assumed of targets that the radar does not see", unit="m", low=1.0, high=1e7
    )
    minimum_range: float = parameter(
        1000.0, "smallest range believed; nearer targets turn too fast", unit="m", low=1.0, high=1e6
    )
    swing_frequency: float = parameter(
        0.16,
        "frequency at which the line of sight swings (model guidance)",
        unit="rad/s",
        low=1e-4,
        high=100.0,
    )
    swing_std: float = parameter(
        0.05,
        "rms angle of the line of sight from its axis (model guidance)",
        unit="rad",
        low=1e-6,
        high=1.0,
    )
    unknown_decay: float = parameter(
        0.003,
        "decay of the swing of targets whose range and closing speed are not known or that do not come nearer, else it "
        "is twice the closing speed over the range (model guidance)",
        unit="1/s",
        low=0.0,
        high=100.0,
    )
    axis_time: float = parameter(
        300.0,
        "time over which the axis is averaged (model guidance)",
        unit="s",
        low=1.0,
        high=1e6,
    )
    rate_std: float = parameter(
        0.01,
        "rate of the azimuth of a new target, standard deviation (model surveillance)",
        unit="rad/s",
        low=1e-6,
        high=10.0,
    )
    jammed_factor: float = parameter(
        10.0,
        "times that the error of the active channel grows while it is jammed",
        low=1.01,
        high=1000.0,
    )
    silent_factor: float = parameter(
        30.0,
        "spread of bearings that do not come from the target, in errors of those that do",
        low=1.01,
        high=1000.0,
    )
    clear_time: float = parameter(
        120.0, "mean time between jams of the active channel", unit="s", low=0.01, high=1e6
    )
    jammed_time: float = parameter(
        30.0, "mean length of a jam of the active channel", unit="s", low=0.01, high=1e6
    )
    heard_time: float = parameter(
        120.0, "mean time between silences of the passive channel", unit="s", low=0.01, high=1e6
    )
    silent_time: float = parameter(
        30.0, "mean length of a silence of the passive channel", unit="s", low=0.01, high=1e6
    )
    default_active_std: float = parameter(
        0.003,
        "azimuth error of the active channel where it tells none; plots of tracks never do",
        unit="rad",
        low=1e-6,
        high=LARGEST_AZIMUTH_STD,
    )
    default_passive_std: float = parameter(
        0.02,
        "azimuth error of passive bearings that tell none",
        unit="rad",
        low=1e-6,
        high=LARGEST_AZIMUTH_STD,
    )
    minimum_std: float = parameter(
        0.0002,
        "smallest azimuth error believed",
        unit="rad",
        low=1e-6,
        high=LARGEST_AZIMUTH_STD,
    )
    track_inflation: float = parameter(
        1.5,
        "times that the error of a smoothed track counts, because it lasts over several scans (input tracks)",
        low=1.0,
        high=100.0,
    )
    radar_x: float = parameter(
        0.0, "place of radar and direction finder, east", unit="m", low=-1e7, high=1e7
    )
    radar_y: float = parameter(
        0.0, "place of radar and direction finder, north", unit="m", low=-1e7, high=1e7
    )
    maximum_bearings: int = parameter(
        10000,
        "rows of one message that are looked at; more are dropped, which bounds time and memory",
        low=1,
        high=1_000_000,
    )
    maximum_look: int = parameter(
        1000,
        "bearings of one look that are processed; more are dropped, which bounds time and memory",
        low=1,
        high=100_000,
    )
    maximum_targets: int = parameter(
        2000, "targets that are followed at once, published or not", low=1, high=100_000
    )

    def check(self) -> None:
        """Refuse what does not go together.

        Raises:
            ParameterError: a tentative target would outlive a confirmed one, or a default error is below the smallest.
        """
        if self.tentative_end_after > self.end_after:
            raise ParameterError("tentative_end_after must not exceed end_after")
        if min(self.default_active_std, self.default_passive_std) < self.minimum_std:
            raise ParameterError(
                "default_active_std and default_passive_std must be at least minimum_std"
            )
