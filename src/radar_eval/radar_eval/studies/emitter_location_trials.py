# SPDX-License-Identifier: Apache-2.0
"""Runs a filter many times past one truth, all runs at once, and compares its errors with the Cramer-Rao bound."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import numpy.typing as npt

from bearing_tracker.emitters import Belief, EmitterFilter
from radar_eval.studies.emitter_location_scenes import LocationScene

FloatArray = npt.NDArray[np.float64]

_LOST_SHARE, _LOST_BOUNDS = 0.3, 5.0
_CURVE = 50


@dataclass(frozen=True, slots=True)
class LocationOutcome:
    """What one filter made of a scene.

    Attributes:
        scene: name.
        filter: name.
        runs: number of them.
        bound: Cramer-Rao bound of the position at the end, metres.
        rms: position error at the end over all runs, metres.
        rms_std: standard error of `rms` from the sample, metres.
        rms_kept: the same over the runs that did not diverge, metres.
        median: metres.
        diverged: share of runs with a final error over 30 % of the range or five bounds.
        nees: mean normalised error squared of the state over its dimension, of the runs that did not diverge; 1 is
            right.
        range_known: share of runs that call the range known at the end.
        seconds: since the first bearing, where the errors are taken, shape (K,).
        error: RMS position error then, metres, shape (K,).
        bounds: then, metres, shape (K,).
        known: share of runs with known range then, shape (K,).
        places: (x, y) estimated at the end, metres, shape (runs, 2).
    """

    scene: str
    filter: str
    runs: int
    bound: float
    rms: float
    rms_std: float
    rms_kept: float
    median: float
    diverged: float
    nees: float
    range_known: float
    seconds: FloatArray
    error: FloatArray
    bounds: FloatArray
    known: FloatArray
    places: FloatArray

    def as_dict(self) -> dict[str, Any]:
        """Give the values for machines, without the single runs."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        del values["places"]
        return {
            name: [float(f"{number:.6g}") for number in value]
            if isinstance(value, np.ndarray)
            else value
            for name, value in values.items()
        }


def try_filter(
    scene: LocationScene,
    name: str,
    chosen: EmitterFilter,
    runs: int,
    seed: int,
    begun: Callable[[Belief], Belief] | None = None,
) -> LocationOutcome:
    """Run a filter.

    Args:
        scene: truth and prior.
        name: of the filter.
        chosen: the filter.
        runs: number of them; each has a prior and bearing errors of its own.
        seed: of both; all filters see the same.
        begun: changes what the filter believes after the first bearing; None leaves it.

    Returns:
        Errors and what they are against the bound.
    """
    random = np.random.default_rng(seed)
    prior, bearings = scene.prior(runs, random), scene.bearings(runs, random)
    std, seconds = np.full(runs, scene.std), np.full(runs, scene.period)
    heard = np.ones(runs, dtype=bool)
    places = np.broadcast_to(scene.observer[:, np.newaxis], (len(scene.observer), runs, 2))
    belief = chosen.start(bearings[0], std, places[0], prior)
    if begun is not None:
        belief = begun(belief)
    estimates, looks = [chosen.estimate(belief)], [0]
    last_look = len(places) - 1
    every = max(last_look // _CURVE, 1)
    for look in range(1, last_look + 1):
        belief = chosen.step(belief, seconds, places[look], bearings[look], std, heard)
        if look % every == 0 or look == last_look:
            estimates.append(chosen.estimate(belief))
            looks.append(look)

    bounds = np.sqrt(np.trace(scene.bound()[looks, :2, :2], axis1=1, axis2=2))
    errors = np.stack([e.state for e in estimates]) - scene.path[looks, np.newaxis]
    distances = np.hypot(errors[..., 0], errors[..., 1])
    last, final = distances[-1], errors[-1]
    lost = (last > _LOST_SHARE * scene.distance[-1]) | (last > _LOST_BOUNDS * bounds[-1])
    kept = ~lost
    weighted = np.linalg.solve(estimates[-1].covariance, final[..., np.newaxis])[..., 0]
    nees = (final * weighted).sum(axis=-1) / 4.0
    rms = _rms(last)
    return LocationOutcome(
        scene=scene.name,
        filter=name,
        runs=runs,
        bound=float(bounds[-1]),
        rms=rms,
        rms_std=float(np.std(last**2) / (2.0 * rms * np.sqrt(runs))),
        rms_kept=_rms(last[kept]) if kept.any() else float("nan"),
        median=float(np.median(last)),
        diverged=float(lost.mean()),
        nees=float(nees[kept].mean()) if kept.any() else float("nan"),
        range_known=float(estimates[-1].range_known.mean()),
        error=np.sqrt((distances**2).mean(axis=1)),
        seconds=scene.period * np.array(looks),
        bounds=bounds,
        known=np.stack([e.range_known.mean() for e in estimates]),
        places=estimates[-1].state[:, :2],
    )


def _rms(values: FloatArray) -> float:
    return float(np.sqrt((values**2).mean()))
