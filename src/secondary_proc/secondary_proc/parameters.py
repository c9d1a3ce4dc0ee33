# SPDX-License-Identifier: Apache-2.0
"""What a user may set about tracking."""

from __future__ import annotations

from dataclasses import dataclass

from radar_common.parameters import ParameterError, parameter
from secondary_proc.association import ASSOCIATIONS, SOFT
from secondary_proc.association.soft import WEIGHING_SMOOTHERS
from secondary_proc.gating import GATE_SHAPES
from secondary_proc.initiation import DROP_RULES, INITIATIONS
from secondary_proc.smoothing import SMOOTHERS, SmoothingParameters


@dataclass(frozen=True, kw_only=True)
class TrackerParameters(SmoothingParameters):
    """Parameters of the tracker."""

    scan_period: float = parameter(
        0.0,
        "hint for the antenna's period of rotation, 0 for unknown; the period itself is estimated from the plots",
        unit="s",
        low=0.0,
        high=60.0,
    )
    initiation: str = parameter(
        "likelihood_ratio",
        "rule that confirms tracks: a likelihood ratio set by false_tracks_per_hour, l plots in m scans, or Wald's "
        "test on hits and misses alone",
        choices=tuple(INITIATIONS),
    )
    confirm_hits: int = parameter(
        3, "plots that a track needs before it can be confirmed (l of the l/m rule)", low=2, high=8
    )
    confirm_window: int = parameter(
        4, "scans in which they must fall (m of the l/m rule)", low=2, high=8
    )
    false_tracks_per_hour: float = parameter(
        0.1,
        "confirmed false tracks to be expected; smaller means surer and later confirmation",
        unit="1/h",
        low=1e-9,
        high=1e6,
    )
    detection_probability: float = parameter(
        0.85,
        "probability of a plot per scan and target, as the score assumes it",
        low=0.05,
        high=0.99,
    )
    learn_detection: bool = parameter(
        False,
        "whether the probability of a plot is learned by range from confirmed tracks, beginning with "
        "detection_probability",
    )
    false_plot_map: bool = parameter(
        False,
        "whether the density of false plots may differ within a ring of range, as over towns or rain, and not only "
        "from ring to ring",
    )
    minimum_speed: float = parameter(
        0.0,
        "slower pairs of plots open no track; the inner radius of the annulus is this times the time between them",
        unit="m/s",
        low=0.0,
        high=2000.0,
    )
    maximum_speed: float = parameter(
        350.0,
        "faster pairs of plots open no track; the outer radius of the annulus is this times the time between them",
        unit="m/s",
        low=0.1,
        high=10000.0,
    )
    tentative_misses: int = parameter(
        2,
        "scans in a row without a plot that end a tentative track where drop_rule counts them; its first two plots are "
        "at most so many scans apart",
        low=1,
        high=20,
    )
    amplitude_likelihood: bool = parameter(
        False,
        "whether a plot's strength tells targets from false plots; how much is learned from the plots themselves",
    )
    drop_rule: str = parameter(
        "rule",
        "what ends a tentative track: its rule (for the tests of likelihood a score that has become too low), "
        "tentative_misses, or the score",
        choices=DROP_RULES,
    )
    missed_targets: float = parameter(
        0.05,
        "share of targets' tentative tracks that a low score may end; the next pair of plots opens another",
        low=1e-6,
        high=0.5,
    )
    confirmed_misses: int = parameter(
        12, "scans in a row without a plot that end a confirmed track", low=1, high=50
    )
    smoother: str = parameter("imm", "filter of position and velocity", choices=tuple(SMOOTHERS))
    association: str = parameter(
        "global_nearest_neighbour",
        "how plots are given to tracks that compete for them",
        choices=tuple(ASSOCIATIONS),
    )
    gate_sigmas: float = parameter(
        3.5,
        "half axis of the gate in standard deviations of the predicted difference",
        unit="sigma",
        low=1.0,
        high=10.0,
    )
    sharp_turn_rate: float = parameter(
        0.2,
        "turns sharper than manoeuvre_acceleration for which gates of confirmed tracks open to plots that no usual "
        "gate holds; 0 for none",
        unit="rad/s",
        low=0.0,
        high=2.0,
    )
    gate_shape: str = parameter(
        "ellipse",
        "one ellipse wide enough for a manoeuvre, or the smallest of three that holds a plot: for straight flight, for "
        "a manoeuvre, and after misses",
        choices=GATE_SHAPES,
    )
    false_plots_nearer: float = parameter(
        0.02,
        "false plots to expect nearer to the prediction than the plot a track takes, at most; counts where gates "
        "have grown wide after misses",
        low=1e-6,
        high=1e3,
    )
    default_range_std: float = parameter(
        50.0, "range error of plots that do not tell theirs", unit="m", low=0.01, high=10000.0
    )
    default_azimuth_std: float = parameter(
        0.003, "azimuth error of plots that do not tell theirs", unit="rad", low=1e-6, high=0.5
    )
    minimum_range_std: float = parameter(
        5.0, "smallest range error believed of a plot", unit="m", low=0.01, high=10000.0
    )
    minimum_azimuth_std: float = parameter(
        0.0002, "smallest azimuth error believed of a plot", unit="rad", low=1e-6, high=0.5
    )
    range_bias: float = parameter(
        0.0,
        "ranges of all plots are too long by this, and it is subtracted; `register` measures it",
        unit="m",
        low=-10000.0,
        high=10000.0,
    )
    azimuth_bias: float = parameter(
        0.0,
        "azimuths of all plots are too large by this, and it is subtracted; `register` measures it",
        unit="rad",
        low=-0.5,
        high=0.5,
    )
    maximum_range: float = parameter(
        500e3, "plots farther away are dropped", unit="m", low=100.0, high=5e6
    )
    maximum_plots: int = parameter(
        20000,
        "plots a scan that are processed; the weakest of more are dropped, which bounds time and memory",
        low=100,
        high=1000000,
    )
    maximum_tracks: int = parameter(
        20000, "tracks kept at most, tentative ones included", low=10, high=1000000
    )
    state_file: str = parameter(
        "",
        "file in which the node keeps its tracks and from which it goes on after a restart, also after a kill; empty "
        "for none",
        read_only=True,
    )
    state_interval: float = parameter(
        2.0,
        "between two writings of state_file, by the stamps of the messages",
        unit="s",
        low=0.0,
        high=3600.0,
        read_only=True,
    )
    radar_x: float = parameter(0.0, "radar's place in the map, east", unit="m", low=-1e7, high=1e7)
    radar_y: float = parameter(0.0, "radar's place in the map, north", unit="m", low=-1e7, high=1e7)
    radar_z: float = parameter(0.0, "radar's place in the map, up", unit="m", low=-1e5, high=1e5)

    @property
    def bias(self) -> tuple[float, float]:
        """range_bias and azimuth_bias."""
        return self.range_bias, self.azimuth_bias

    def check(self) -> None:
        """Refuse rules that nothing can satisfy."""
        super().check()
        if self.confirm_hits > self.confirm_window:
            raise ParameterError(
                f"confirm_hits {self.confirm_hits} do not fit into a confirm_window of "
                f"{self.confirm_window} scans"
            )
        if self.association in SOFT and self.smoother not in WEIGHING_SMOOTHERS:
            raise ParameterError(
                f"association {self.association} needs a smoother that weighs plots by their errors: "
                f"{', '.join(WEIGHING_SMOOTHERS)}, not {self.smoother}"
            )
        if self.minimum_speed >= self.maximum_speed:
            raise ParameterError(
                f"minimum_speed {self.minimum_speed} must be below maximum_speed {self.maximum_speed}"
            )
