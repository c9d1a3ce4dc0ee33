# SPDX-License-Identifier: Apache-2.0
"""How Stone Soup's trackers are put together for the comparison.

Stone Soup is wanted for this alone, so it is imported only when one of its trackers is asked for.
"""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from radar_eval.errors import EvaluationError


@dataclass(frozen=True, kw_only=True, slots=True)
class PeerSettings:
    """What a user of Stone Soup has to choose; the defaults did best over the scenes of the study.

    Attributes:
        noise_density: of the white acceleration of their constant-velocity model, m²/s³.
        speed_std: of the velocity that a first plot is given, m/s per axis.
        gate: half axis of the gate, standard deviations.
        plots_to_confirm: number.
        misses_tentative: scans without a plot that delete a candidate.
        misses_confirmed: the same for a track.
        detection_probability: as JPDA assumes it.
        gate_probability: the same.
    """

    noise_density: float = 20.0
    speed_std: float = 150.0
    gate: float = 4.0
    plots_to_confirm: int = 4
    misses_tentative: int = 2
    misses_confirmed: int = 4
    detection_probability: float = 0.85
    gate_probability: float = 0.999


def require_stone_soup() -> None:
    """Make sure that Stone Soup is there before anything long is begun.

    Raises:
        EvaluationError: it is not installed.
    """
    if importlib.util.find_spec("stonesoup") is None:
        raise EvaluationError("the comparison needs Stone Soup: pip install stonesoup")


def build_tracker(settings: PeerSettings, *, joint: bool, density: float) -> Any:
    """Put a tracker together.

    Args:
        settings: what a user chooses.
        joint: probabilistic association of confirmed tracks; else the global nearest neighbour for all.
        density: false plots per square metre and scan, for the former.

    Returns:
        The tracker; its `detector` is to be set.

    Raises:
        ImportError: Stone Soup is not installed.
    """
    from stonesoup.dataassociator.base import DataAssociator
    from stonesoup.dataassociator.neighbour import GNNWith2DAssignment
    from stonesoup.dataassociator.probability import JPDAwithEHM
    from stonesoup.deleter.time import UpdateTimeStepsDeleter
    from stonesoup.hypothesiser.distance import DistanceHypothesiser
    from stonesoup.hypothesiser.probability import PDAHypothesiser
    from stonesoup.initiator.simple import MultiMeasurementInitiator
    from stonesoup.measures import Mahalanobis
    from stonesoup.models.transition.linear import (
        CombinedLinearGaussianTransitionModel,
        ConstantVelocity,
    )
    from stonesoup.predictor.kalman import KalmanPredictor
    from stonesoup.tracker.simple import MultiTargetMixtureTracker, MultiTargetTracker
    from stonesoup.types.state import GaussianState
    from stonesoup.updater.kalman import KalmanUpdater

    motion = CombinedLinearGaussianTransitionModel([ConstantVelocity(settings.noise_density)] * 2)
    predictor, updater = KalmanPredictor(motion), KalmanUpdater(None)

    class NearPlots(DataAssociator):
        """Tries only plots that can lie in the gate: the results are the same, many times sooner."""

        def generate_hypotheses(
            self, tracks: set[Any], detections: set[Any], timestamp: Any, **options: Any
        ) -> dict[Any, Any]:
            near = plots_in_reach(tracks, detections, timestamp, settings)
            return {
                track: self.hypothesiser.hypothesise(track, plots, timestamp, **options)
                for track, plots in near.items()
            }

    class Nearest(NearPlots, GNNWith2DAssignment):
        """Global nearest neighbour among near plots."""

    class Joint(NearPlots, JPDAwithEHM):
        """Joint probabilistic association, exact by efficient hypothesis management, among near plots."""

    nearest = Nearest(
        DistanceHypothesiser(predictor, updater, Mahalanobis(), missed_distance=settings.gate)
    )
    prior = GaussianState(
        np.zeros(4), np.diag([0.0, settings.speed_std, 0.0, settings.speed_std]) ** 2
    )
    initiator = MultiMeasurementInitiator(
        prior,
        UpdateTimeStepsDeleter(settings.misses_tentative + 1),
        nearest,
        updater,
        min_points=settings.plots_to_confirm,
    )
    deleter = UpdateTimeStepsDeleter(settings.misses_confirmed + 1)
    if not joint:
        return MultiTargetTracker(initiator, deleter, [], nearest, updater)
    hypotheses = PDAHypothesiser(
        predictor,
        updater,
        clutter_spatial_density=max(density, 1e-15),
        prob_detect=settings.detection_probability,
        prob_gate=settings.gate_probability,
    )
    return MultiTargetMixtureTracker(initiator, deleter, [], Joint(hypotheses), updater)


def plots_in_reach(
    tracks: set[Any], detections: set[Any], timestamp: Any, settings: PeerSettings
) -> dict[Any, set[Any]]:
    """Find the plots that can lie in the gates.

    Args:
        tracks: Stone Soup's.
        detections: of one scan.
        timestamp: end of the scan.
        settings: gate and noise.

    Returns:
        For each track the plots within a radius that no plot in its gate exceeds.
    """
    if not tracks or not detections:
        return {track: set(detections) for track in tracks}
    plots = list(detections)
    tree = cKDTree(np.array([np.ravel(plot.state_vector) for plot in plots], dtype=float))
    error = max(float(np.trace(plot.measurement_model.covar())) for plot in plots)
    # The probabilistic association has a gate of its own, chi-square in two dimensions.
    sigmas = max(settings.gate, np.sqrt(-2.0 * np.log1p(-settings.gate_probability)))
    near = {}
    for track in tracks:
        state = np.ravel(np.asarray(track.state.state_vector, dtype=float))
        covariance = np.asarray(track.state.covar, dtype=float)
        seconds = (timestamp - track.state.timestamp).total_seconds()
        # Traces for the largest eigenvalues and a sum of standard deviations bound the predicted error.
        place = np.sqrt(covariance[0, 0] + covariance[2, 2])
        drift = seconds * np.sqrt(covariance[1, 1] + covariance[3, 3])
        noise = np.sqrt(2.0 / 3.0 * settings.noise_density * seconds**3)
        speed = float(np.hypot(state[1], state[3]))
        radius = sigmas * (place + drift + noise + np.sqrt(error)) + speed * seconds
        found = tree.query_ball_point(state[[0, 2]], radius)
        near[track] = {plots[i] for i in found}
    return near
