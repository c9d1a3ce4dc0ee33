# SPDX-License-Identifier: Apache-2.0
"""Parameters of the plot extractor."""

from __future__ import annotations

from dataclasses import dataclass

from primary_proc.calculators.pulse.target_models import TARGETS
from primary_proc.calculators.quantisation.level_thresholds import LEVEL_KINDS
from primary_proc.choices import ESTIMATORS, METHODS, NORMALISERS, RANGE_WINDOWS, find_method
from primary_proc.stream.video_law import VIDEO_LAWS
from radar_common.antenna_pattern import PATTERNS
from radar_common.parameters import ParameterError, Parameters, parameter


@dataclass(frozen=True, kw_only=True)
class ExtractorParameters(Parameters):
    """What a user may choose; thresholds follow from it."""

    false_plots_per_scan: float = parameter(
        10.0,
        "false plots that receiver noise may make in one turn, over all cells; sets the threshold",
        low=0.01,
        high=1e5,
    )
    detector: str = parameter(
        "3/4-2",
        "burst detector: a program l/m-k, which is ones / positions that start a burst - zeros that end it, "
        f"or one of {', '.join(METHODS)}; auto takes the program that needs the least signal",
    )
    second_threshold: int = parameter(
        0,
        "what the detector counts up to, where it counts: of an accumulator the positions of a burst; "
        "0 lets it choose, 1.5 times the root of the pulses of a point target's burst",
        low=0,
        high=1000,
    )
    end_zeros: int = parameter(
        2,
        "accumulators: zeros in a row that end a burst; of a program its name says it",
        low=1,
        high=50,
    )
    weights_snr_db: float = parameter(
        10.0,
        "signal-to-noise ratio at the beam's axis that the weights of weighting detectors are made for",
        unit="dB",
        low=-20.0,
        high=40.0,
    )
    quantiser_levels: int = parameter(
        8, "levels of the envelope that detector multi-level tells apart", low=2, high=64
    )
    level_placement: str = parameter(
        "weak-signal",
        "how detector multi-level places the thresholds between its levels",
        choices=tuple(LEVEL_KINDS),
    )
    normaliser: str = parameter(
        "cell-averaging", "how the noise level is found", choices=tuple(NORMALISERS)
    )
    reference_cells: int = parameter(
        16,
        "reference cells on each side that tell the noise level; a power of two is fastest",
        low=2,
        high=256,
    )
    guard_cells: int = parameter(
        2,
        "cells on each side left out beside the one under test, so that a target does not raise its own threshold",
        low=0,
        high=64,
    )
    order: float = parameter(
        0.75,
        "ordered-statistic: rank of the reference cell that is the noise level, as a share of all of them; "
        "the share above it may hold other echoes",
        low=0.05,
        high=1.0,
    )
    map_weight: float = parameter(
        0.05,
        "clutter-map: share of the latest turn in the map; an echo that stays in one cell disappears after 5 turns "
        "with 0.05, 3 with 0.1 and 11 with 0.025",
        low=0.005,
        high=0.2,
    )
    noise_level: float = parameter(
        0.0,
        "fixed level: rms of the noise envelope in units of the video; must be given there",
        low=0.0,
        high=1e9,
    )
    azimuth_estimator: str = parameter(
        "start-end", "how the azimuth of a burst is found", choices=tuple(ESTIMATORS)
    )
    beamwidth_deg: float = parameter(
        1.4,
        "one-way half-power beamwidth, as data sheets give it; with the rotation it tells the pulses of a burst",
        unit="deg",
        low=0.05,
        high=30.0,
    )
    pattern: str = parameter(
        "gaussian", "two-way amplitude pattern of the antenna", choices=tuple(PATTERNS)
    )
    fluctuation: str = parameter(
        "steady",
        "what targets do, for the stated azimuth errors and the predicted detection: steady, slow from turn to turn or "
        "fast from pulse to pulse, each also with one dominant scatterer (Swerling 0, 1, 2, 3, 4)",
        choices=tuple(TARGETS),
    )
    longest_burst: float = parameter(
        4.0,
        "limit of a burst, as a multiple of the pulses of a point target's; longer ones are clutter",
        low=1.5,
        high=100.0,
    )
    merge_gap: float = parameter(
        0.5,
        "bursts in the same or adjacent range cells this near in azimuth, as a share of the pulses of a "
        "point target's, make one plot",
        low=0.0,
        high=2.0,
    )
    split_valley_db: float = parameter(
        3.0,
        "echoes that nearness has joined make two plots if the signal between them, in range or azimuth, falls this "
        "far under the weaker one",
        unit="dB",
        low=1.0,
        high=60.0,
    )
    target_rings: int = parameter(
        6,
        "range cells that a target may fill; plots that fill more have quality 0",
        low=1,
        high=1000,
    )
    video_law: str = parameter(
        "linear",
        "samples are the envelope, or its logarithm in steps of db_per_count",
        choices=VIDEO_LAWS,
    )
    db_per_count: float = parameter(
        0.4,
        "step of logarithmic video",
        unit="dB",
        low=1e-3,
        high=10.0,
    )
    largest_raise_db: float = parameter(
        20.0,
        "most by which the detection criterion is raised where clutter makes more plots than noise would; "
        "0 never raises it",
        unit="dB",
        low=0.0,
        high=40.0,
    )
    plots_limit_per_scan: float = parameter(
        0.0,
        "plots in one turn, targets among them, that the computer behind can take: the criterion is raised everywhere, "
        "by largest_raise_db at most, to keep them fewer; 0 for no limit",
        low=0.0,
        high=1e6,
    )

    ppi_pixels: int = parameter(
        0,
        "size of the picture for people on radar/ppi, one a turn; 0 for none",
        low=0,
        high=4096,
    )

    def check(self) -> None:
        """Check what must hold between the values.

        Raises:
            ParameterError: the combination cannot work; the text says why.
        """
        try:
            find_method(self.detector)
        except ValueError as error:
            raise ParameterError(str(error)) from error
        if 0.0 < self.plots_limit_per_scan < 2.0 * self.false_plots_per_scan:
            raise ParameterError(
                f"a plots_limit_per_scan of {self.plots_limit_per_scan:g} leaves targets no room beside "
                f"{self.false_plots_per_scan:g} false_plots_per_scan; ask for fewer of these"
            )
        if self.normaliser == "fixed-level" and self.noise_level == 0.0:
            raise ParameterError("normaliser fixed-level needs a noise_level over 0")
        looks_around = self.normaliser in (*RANGE_WINDOWS, "clutter-map")
        if looks_around and self.guard_cells > 2 * self.reference_cells:
            raise ParameterError(
                f"{self.guard_cells} guard_cells lie between a cell and its {self.reference_cells} reference_cells: "
                "a noise level from so far away is not that of the cell"
            )
