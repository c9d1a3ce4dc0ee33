# SPDX-License-Identifier: Apache-2.0
"""The keys of a scenario that the bearing simulator reads."""

from __future__ import annotations

from dataclasses import dataclass

from radar_common.parameters import ParameterError, Parameters, parameter
from radar_sim.moving import MovingSection, PlacedSection

SILENCES = ("nothing", "noise")


@dataclass(frozen=True, kw_only=True)
class EmitterSection(MovingSection):
    """One entry of `emitters`: something that transmits."""

    z: float = parameter(0.0, "above the map's origin", unit="m", low=-1e4, high=1e5)
    speed: float = parameter(0.0, "speed when it appears", unit="m/s", low=0.0, high=3000.0)
    target: int = parameter(
        0,
        "number of the scenario's target that carries it, traffic counted after targets; 0 moves by itself",
        low=0,
        high=1_000_000,
    )
    begins: float = parameter(
        0.0, "time after the start at which it is switched on", unit="s", low=0.0, high=1e6
    )
    ends: float = parameter(
        1e6, "time after the start at which it is switched off", unit="s", low=0.0, high=1e6
    )
    on_time: float = parameter(
        0.0, "length of each transmission of one that pauses", unit="s", low=0.0, high=1e6
    )
    off_time: float = parameter(
        0.0, "pause between them; 0 transmits without pause", unit="s", low=0.0, high=1e6
    )

    def check(self) -> None:
        """Check that it is switched on before it is switched off.

        Raises:
            ParameterError: it is not, or pauses without ever transmitting.
        """
        if self.ends <= self.begins:
            raise ParameterError(f"ends {self.ends:g} s is not after begins {self.begins:g} s")
        if self.off_time > 0.0 and self.on_time == 0.0:
            raise ParameterError(f"off_time {self.off_time:g} s needs an on_time over 0")


@dataclass(frozen=True, kw_only=True)
class DirectionFinderSection(PlacedSection):
    """`direction_finder`: a platform, its way, and how well it hears."""

    y: float = parameter(0.0, "north of the map's origin", unit="m", low=-1e6, high=1e6)
    z: float = parameter(0.0, "above the map's origin", unit="m", low=-1e4, high=1e5)
    speed: float = parameter(0.0, "speed at the start", unit="m/s", low=0.0, high=3000.0)
    cycles: int = parameter(
        1, "how often the legs are gone through, one after the other", low=1, high=10_000
    )
    period: float = parameter(
        1.0, "time from one look to the next", unit="s", low=0.01, high=3600.0
    )
    spread: float = parameter(
        0.0,
        "bearings of a look are taken at random times within this from its beginning",
        unit="s",
        low=0.0,
        high=3600.0,
    )
    delay: float = parameter(
        0.0, "time from the end of a look to its message", unit="s", low=0.0, high=3600.0
    )
    azimuth_std_deg: float = parameter(
        1.0, "azimuth error that is independent from look to look", unit="deg", low=0.0, high=90.0
    )
    correlated_std_deg: float = parameter(
        0.0, "azimuth error that wanders, for each source apart", unit="deg", low=0.0, high=90.0
    )
    correlation_time: float = parameter(
        10.0, "in which its correlation falls to 1 / e", unit="s", low=0.0, high=1e5
    )
    detection: float = parameter(
        1.0, "probability that a look has a bearing of a source", low=0.0, high=1.0
    )
    outliers: float = parameter(
        0.0, "probability that a bearing points anywhere", low=0.0, high=1.0
    )
    identity: bool = parameter(True, "whether bearings tell which source they are of")
    elevation: bool = parameter(False, "whether elevation is measured")
    elevation_std_deg: float = parameter(1.0, "error of elevation", unit="deg", low=0.0, high=90.0)
    targets_emit: bool = parameter(
        False, "whether every target of the scenario transmits, as if each carried an emitter"
    )
    odometry_period: float = parameter(
        0.5, "time from one message on the platform to the next", unit="s", low=0.01, high=3600.0
    )

    def check(self) -> None:
        """Check that looks do not overlap and that there is an error.

        Raises:
            ParameterError: one of the two is not so.
        """
        if self.spread > self.period:
            raise ParameterError(
                f"spread {self.spread:g} s is longer than period {self.period:g} s"
            )
        if self.azimuth_std_deg == 0.0 and self.correlated_std_deg == 0.0:
            raise ParameterError("azimuth_std_deg and correlated_std_deg must not both be 0")


@dataclass(frozen=True, kw_only=True)
class BearingProcessSection(Parameters):
    """One entry of `bearing_processes`: a bearing without a place, a random process as Detkov 2022, (26), has it.

    Its autocorrelation is D exp(-|t| / correlation_time) cos(frequency t), D the square of deviation_deg.
    """

    azimuth_deg: float = parameter(
        0.0, "mean, clockwise from north", unit="deg", low=-360.0, high=360.0
    )
    deviation_deg: float = parameter(
        5.0, "standard deviation about it", unit="deg", low=1e-6, high=60.0
    )
    correlation_time: float = parameter(
        350.0, "one over the alpha of the model", unit="s", low=0.01, high=1e6
    )
    frequency: float = parameter(
        0.16, "at which it swings, mu of the model", unit="rad/s", low=1e-4, high=100.0
    )
    step: float = parameter(
        1.0, "time from one random step to the next, between which it runs on", unit="s", low=0.01
    )


@dataclass(frozen=True, kw_only=True)
class IntervalSection(Parameters):
    """One entry of `intervals`: a time in which the channel is violated."""

    begins: float = parameter(0.0, "time after the start", unit="s", low=0.0, high=1e6)
    ends: float = parameter(1e6, "time after the start", unit="s", low=0.0, high=1e6)

    def check(self) -> None:
        """Check that it ends after it begins.

        Raises:
            ParameterError: it does not.
        """
        if self.ends <= self.begins:
            raise ParameterError(f"ends {self.ends:g} s is not after begins {self.begins:g} s")


@dataclass(frozen=True, kw_only=True)
class ChannelSection(Parameters):
    """What both channels have in common: a Markov chain of violations beside the scripted `intervals`."""

    begin_probability: float = parameter(
        0.0, "probability from look to look that a violation begins", low=0.0, high=1.0
    )
    end_probability: float = parameter(
        0.2, "probability from look to look that one ends", low=0.0, high=1.0
    )


@dataclass(frozen=True, kw_only=True)
class ActiveChannelSection(ChannelSection):
    """`channels.active`: angles and ranges of the targets' echoes at the radar's place, worse while it is jammed."""

    period: float = parameter(
        1.0, "time from one look to the next", unit="s", low=0.01, high=3600.0
    )
    delay: float = parameter(0.0, "time from a look to its message", unit="s", low=0.0, high=3600.0)
    azimuth_std_deg: float = parameter(
        0.5, "azimuth error without jamming", unit="deg", low=1e-6, high=90.0
    )
    noise_ratio: float = parameter(
        100.0, "times that jamming increases the variance of the azimuth", low=1.0, high=1e8
    )
    range_std: float = parameter(50.0, "range error", unit="m", low=0.0, high=1e5)
    snr_db: float = parameter(
        15.0, "signal-to-noise ratio that the plots tell", unit="dB", low=-20.0, high=80.0
    )
    detection: float = parameter(
        1.0, "probability that a look has a plot of a target", low=0.0, high=1.0
    )


@dataclass(frozen=True, kw_only=True)
class PassiveChannelSection(ChannelSection):
    """`channels.passive`: the silence of what the direction finder hears."""

    silence: str = parameter(
        "nothing",
        "what it tells while sources are silent: nothing, as in the field; or noise about noise_azimuth_deg, about "
        "the mean of a bearing process",
        choices=SILENCES,
    )
    noise_azimuth_deg: float = parameter(
        0.0, "where that noise has its mean", unit="deg", low=-360.0, high=360.0
    )
