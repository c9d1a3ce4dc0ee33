# SPDX-License-Identifier: Apache-2.0
"""What each score means, in the words of the report and of the command."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

MEANINGS = {
    "targets": "targets with ten plots or more",
    "targets_tracked": "of these, with a confirmed track",
    "targets_missed": "of these, without one",
    "tracks_per_target": "confirmed tracks a tracked target",
    "plots_in_tracks": "share of the targets' plots that are in confirmed tracks",
    "completeness": "share of the antenna's passes over a target with a confirmed track of it alive",
    "confirmed_tracks": "confirmed tracks",
    "false_tracks": "of these, with less than half of the plots from one target",
    "scans_to_confirmation_mean": "scans from the first plot to the confirmed track, mean",
    "scans_to_confirmation_median": "the same, median",
    "rms_raw_m": "position error of the targets' plots, root mean square (m)",
    "rms_tracked_m": "position error of confirmed tracks past their tenth plot (m)",
    "rms_raw_of_tracked_m": "position error of the plots that these were updated with (m)",
    "rms_tracked_any_plot_m": "position error of tracks, also where a false plot misled them (m)",
    "rms_velocity_m_s": "velocity error of the same tracks (m/s)",
    "nis_mean": "innovations of confirmed tracks, normalised and squared; 2 where the models are right",
    "plots": "plots",
    "plots_per_scan": "plots a scan",
    "false_plots_per_scan": "plots of no target a scan",
    "looks": "passes of the antenna over targets",
    "probability_of_detection": "share of these with a plot",
    "gospa_m": "GOSPA distance between targets and tracks, mean over the scans (m)",
    "gospa_missed": "targets without a track a scan, by GOSPA",
    "gospa_false": "tracks without a target a scan, by GOSPA",
    "gospa_cutoff_m": "cutoff of GOSPA (m)",
    "scans": "turns of the antenna",
    "scan_period_s": "seconds a turn",
    "duration_s": "seconds from the first message of plots to the last plot",
    "plots_per_second": "plots processed a second by the offline run",
    "fused_targets": "targets with fused bearings",
    "fused_targets_false": "of these, near no true source",
    "fused_bearings": "fused bearings",
    "rms_fused_mrad": "error of the fused bearings, root mean square (mrad)",
    "rms_active_mrad": "error of the plots' azimuths (mrad)",
    "rms_passive_mrad": "error of the passive bearings (mrad)",
    "fused_error_normalised": "squared error of fused bearings over the told variance; 1 if told right",
    "active_state_right": "share of fused bearings whose likeliest state of the radar is the true one",
    "passive_state_right": "the same of the direction finder",
    "emitters": "confirmed emitters",
    "emitters_false": "of these, near no true source",
    "emitters_located": "true sources with an emitter of known range",
    "emitter_rows_range_known": "share of the emitters' rows that know the range",
    "rms_emitter_m": "position error of these rows (m)",
    "rms_emitter_bound_m": "their Cramer-Rao bound (m)",
    "rms_emitter_last_m": "position error of each emitter's last such row (m)",
    "rms_emitter_last_bound_m": "their Cramer-Rao bound (m)",
    "emitter_error_normalised": "squared error in units of the covariance, a component; 1 if told right",
}


def describe_scores(scores: Mapping[str, Any]) -> list[tuple[str, str, str]]:
    """Write scores for people.

    Args:
        scores: names and values.

    Returns:
        (name, value, meaning) of each.
    """
    return [(name, _text(value), MEANINGS[name]) for name, value in scores.items()]


def _text(value: float) -> str:
    if isinstance(value, int):
        return str(value)
    if value != value:
        return "-"
    return f"{value:.0f}" if abs(value) >= 10_000 else f"{value:.4g}"
