# SPDX-License-Identifier: Apache-2.0
"""Trials of initiation rules: targets that appear at different times among false plots, the same for all rules."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI
from radar_common.tables import NANOSECONDS, PLOT, Table, TrackStatus
from secondary_proc.parameters import TrackerParameters
from secondary_proc.tracker import Tracker

FloatArray = npt.NDArray[np.float64]

PERIOD = 4.0
DETECTION = 0.85
LONGEST_DELAY = 15
"""Scans after which a target counts as confirmed, for the mean."""
_SECTORS, _WARM_UP = 8, 12
_NEAREST, _FARTHEST = 10e3, 100e3
_RANGE_STD, _AZIMUTH_STD = 20.0, 0.002
_THRESHOLD_DB, _TARGET_DB = 13.0, 20.0
_OWN = 1.5e3


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule of initiation.

    Attributes:
        family: rules drawn as one line.
        label: of the rule within it.
        wanted: false tracks an hour that were asked for; NaN where the rule cannot be asked.
        parameters: of the tracker.
    """

    family: str
    label: str
    wanted: float
    parameters: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a rule did at one density of false plots.

    Attributes:
        family: of the rule.
        label: of the rule.
        wanted: false tracks an hour that were asked for.
        false_plots: in a scan.
        false_tracks_per_hour: that were confirmed.
        delay: scans from a target's first plot to its confirmation, mean.
        false_tracks: number behind the rate.
        targets: number behind the mean.
    """

    family: str
    label: str
    wanted: float
    false_plots: float
    false_tracks_per_hour: float
    delay: float
    false_tracks: int
    targets: int

    def as_dict(self) -> dict[str, Any]:
        """Numbers for JSON."""
        return asdict(self)


def rules() -> list[Rule]:
    """All rules of the study.

    Returns:
        Rules, family by family, the surest last.
    """
    plain = [(2, 2), (2, 3), (3, 3), (3, 4), (4, 5), (4, 6), (5, 7)]
    found = [
        Rule(
            "l of m",
            f"{hits}/{window}",
            np.nan,
            {"initiation": "l_of_m", "confirm_hits": hits, "confirm_window": window},
        )
        for hits, window in plain
    ]
    families: list[tuple[str, dict[str, Any]]] = [
        ("Wald's test on hits", {"initiation": "wald"}),
        ("likelihood ratio", {}),
        ("likelihood ratio with strength", {"amplitude_likelihood": True}),
    ]
    for family, parameters in families:
        for wanted in (3000.0, 300.0, 30.0):
            asked = {"false_tracks_per_hour": wanted, "confirm_hits": 2}
            found.append(Rule(family, f"{wanted:g}", wanted, parameters | asked))
    return found


@dataclass(frozen=True, slots=True)
class Trial:
    """Plots of targets and false ones.

    Attributes:
        rows: dtype PLOT, their time_offset counting from the beginning, in order of time.
        first: time of each target's first plot, seconds, shape (targets,).
        position: of each target at time zero, metres, shape (targets, 2).
        velocity: of each target, m/s, shape (targets, 2).
        scans: turns of the antenna.
        false_plots: mean number in a scan.
    """

    rows: npt.NDArray[np.void]
    first: FloatArray
    position: FloatArray
    velocity: FloatArray
    scans: int
    false_plots: float


def make_trial(false_plots: float, scans: int, targets: int, seed: int) -> Trial:
    """Draw a trial.

    Args:
        false_plots: mean number in a scan, uniform in range and azimuth.
        scans: turns of the antenna.
        targets: number, in uniform motion outwards, each of which appears at its own time.
        seed: of all randomness.

    Returns:
        The trial.
    """
    random = np.random.default_rng(seed)
    azimuth = TWO_PI * (np.arange(targets) + 0.5) / targets
    outward = np.stack([np.sin(azimuth), np.cos(azimuth)], axis=1)
    velocity = random.uniform(80.0, 280.0, targets)[:, None] * outward
    begin = random.integers(_WARM_UP, scans - LONGEST_DELAY, targets)
    position = random.uniform(20e3, 70e3, targets)[:, None] * outward
    position -= velocity * begin[:, None] * PERIOD
    scan = np.arange(scans)[:, None]
    seen = (scan >= begin) & (random.random((scans, targets)) < DETECTION)
    time = (scan + azimuth / TWO_PI) * PERIOD
    distance = np.hypot(*np.moveaxis(position + velocity * time[:, :, None], 2, 0))
    count = random.poisson(false_plots * scans)
    false_time = random.uniform(0.0, scans * PERIOD, count)
    rows = np.zeros(np.count_nonzero(seen) + count, PLOT)
    rows["time_offset"] = np.concatenate([time[seen], false_time])
    rows["range"] = np.concatenate([distance[seen], random.uniform(_NEAREST, _FARTHEST, count)])
    true_azimuth = np.broadcast_to(azimuth, seen.shape)[seen]
    rows["azimuth"] = np.concatenate([true_azimuth, TWO_PI * false_time / PERIOD % TWO_PI])
    own = np.arange(np.count_nonzero(seen))
    rows["range"][own] += _RANGE_STD * random.standard_normal(len(own))
    rows["azimuth"][own] += _AZIMUTH_STD * random.standard_normal(len(own))
    rows["range_std"], rows["azimuth_std"] = _RANGE_STD, _AZIMUTH_STD
    rows["snr_db"] = _strengths(len(own), count, random)
    rows["radial_speed"] = rows["radial_speed_std"] = np.nan
    first = np.where(seen.any(axis=0), time[seen.argmax(axis=0), np.arange(targets)], np.nan)
    order = np.argsort(rows["time_offset"], kind="stable")
    return Trial(rows[order], first, position, velocity, scans, false_plots)


def try_rule(trial: Trial, rule: Rule) -> Outcome:
    """Run the tracker with a rule.

    Args:
        trial: the plots.
        rule: of initiation.

    Returns:
        False tracks and delay.
    """
    tracker = Tracker(TrackerParameters(scan_period=PERIOD, **rule.parameters))
    tables = [tracker.process(message) for message in _messages(trial)]
    tables.append(tracker.flush())
    confirmed = np.concatenate(
        [table.rows[table.rows["status"] == TrackStatus.CONFIRMED] for table in tables]
    )
    time = np.concatenate(
        [
            table.stamp / NANOSECONDS
            + table.rows["time_offset"][table.rows["status"] == TrackStatus.CONFIRMED]
            for table in tables
        ]
    )
    _, first = np.unique(confirmed["id"], return_index=True)
    place = np.stack([confirmed["x"][first], confirmed["y"][first]], axis=1)
    time = time[first]
    targets = trial.position + trial.velocity * time[:, None, None]
    near = np.hypot(*np.moveaxis(place[:, None] - targets, 2, 0)) < _OWN
    near &= time[:, None] >= trial.first
    delay = np.where(near, time[:, None] - trial.first, np.inf).min(axis=0, initial=np.inf)
    delay = np.minimum(delay / PERIOD, LONGEST_DELAY)[np.isfinite(trial.first)]
    false = int(np.count_nonzero(~near.any(axis=1)))
    return Outcome(
        rule.family,
        rule.label,
        rule.wanted,
        trial.false_plots,
        false * 3600.0 / (trial.scans * PERIOD),
        float(delay.mean()),
        false,
        len(delay),
    )


def _strengths(targets: int, false: int, random: np.random.Generator) -> FloatArray:
    """Strengths over the same threshold: of fluctuating targets, and of noise."""
    threshold, mean = 10.0 ** (np.array([_THRESHOLD_DB, _TARGET_DB]) / 10.0)
    scale = np.repeat([1.0 + mean, 1.0], [targets, false])
    strength: FloatArray = 10.0 * np.log10(threshold + scale * random.exponential(size=len(scale)))
    return strength


def _messages(trial: Trial) -> Iterator[Table]:
    edges = np.arange(trial.scans * _SECTORS + 1) * (PERIOD / _SECTORS)
    cuts = np.searchsorted(trial.rows["time_offset"], edges)
    for edge, begin, end in zip(edges[:-1].tolist(), cuts[:-1], cuts[1:], strict=True):
        part = trial.rows[begin:end].copy()
        part["time_offset"] -= edge
        yield Table(round(edge * NANOSECONDS), part)
