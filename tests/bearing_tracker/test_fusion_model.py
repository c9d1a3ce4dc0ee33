# SPDX-License-Identifier: Apache-2.0
"""The model of motion that the parameters name moves each target by what is known of it."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_tracker.bearing_fusion import BearingFusion
from bearing_tracker.fused_targets import TARGET
from bearing_tracker.fusion.guidance import guidance_motion
from bearing_tracker.fusion_model import FusionModel
from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.sightings import Deviations, from_plots, from_tracks
from radar_common.frames import wrap_pi
from radar_common.health import Health
from radar_common.tables import PLOT, BearingChannel, Table

MU, SIGMA, UNKNOWN = 0.2, 0.04, 0.01
GUIDANCE = FusionParameters(
    model="guidance", swing_frequency=MU, swing_std=SIGMA, unknown_decay=UNKNOWN
)


def targets(distance, closing, time=0.0, ranged=0.0):
    rows = np.zeros(len(distance), TARGET)
    rows["range"], rows["closing_speed"], rows["axis"] = distance, closing, 0.3
    rows["time"], rows["ranged"] = time, ranged
    return rows


def test_the_swing_decays_as_range_and_closing_speed_say():
    seconds = np.array([1.0, 2.0, 3.0, 4.0])
    rows = targets([20e3, np.nan, 20e3, 20e3], [200.0, 200.0, np.nan, -50.0])
    motion = FusionModel(GUIDANCE).motion(seconds, rows)
    wanted = guidance_motion(seconds, MU, [0.02, UNKNOWN, UNKNOWN, UNKNOWN], SIGMA, rows["axis"])
    np.testing.assert_allclose(motion.transition, wanted.transition)
    np.testing.assert_allclose(motion.noise, wanted.noise)
    np.testing.assert_array_equal(motion.axis, [[0.3, 0.0]] * 4)
    assert motion.active_chain.shape == (4, 2, 2)


def test_the_range_goes_on_falling_while_nobody_measures_it():
    rows = targets([20e3, 20e3], [100.0, 100.0], time=[50.0, 1e3], ranged=0.0)
    motion = FusionModel(GUIDANCE).motion(np.ones(2), rows)
    wanted = guidance_motion(np.ones(2), MU, [200.0 / 15e3, 200.0 / 1e3], SIGMA, rows["axis"])
    np.testing.assert_allclose(motion.transition, wanted.transition)


def test_surveillance_has_no_axis():
    assert FusionModel(FusionParameters()).motion(np.ones(1), targets([1e4], [0.0])).axis is None


def test_tracks_and_plots_tell_how_fast_a_target_comes(make_tracks):
    deviations, health = Deviations(0.01, 0.001), Health()
    tracks = make_tracks([[3e3, 4e3], [3e3, 4e3]], [1, 2])
    tracks["vx"], tracks["vy"] = [-30.0, 40.0], [-40.0, -30.0]
    seen = from_tracks(tracks, 0.0, deviations, 10, health, place=(0.0, 0.0), as_plots=False)
    assert seen["closing_speed"] == pytest.approx([50.0, 0.0])
    plots = np.zeros(3, PLOT)
    plots["range"], plots["azimuth_std"], plots["radial_speed"] = 5e3, 0.01, [-60.0, np.nan, 1e9]
    seen = from_plots(plots, 0.0, deviations, 10, health)
    np.testing.assert_array_equal(seen["closing_speed"], [60.0, np.nan, np.nan])


@pytest.fixture(scope="module")
def swinging(make_bearings, start):
    """A line of sight that swings across north as (26) says, in two channels, the active one jammed for a time."""
    random = np.random.default_rng(4)
    motion = guidance_motion(1.0, 0.16, 1.0 / 350.0, 0.087)
    step = np.linalg.cholesky(motion.noise)
    state, truth, messages = np.array([0.087, 0.0]), [], []
    for second in range(150):
        state = motion.transition @ state + step @ random.standard_normal(2)
        jam = 10.0 if 51 <= second <= 90 else 1.0
        plots = np.zeros(1, PLOT)
        plots["azimuth"] = np.mod(state[0] + jam * 0.0087 * random.standard_normal(), 2 * np.pi)
        plots["azimuth_std"], plots["range"], plots["radial_speed"] = 0.0087, np.nan, np.nan
        stamp = start + second * 1_000_000_000
        heard = np.mod(state[0] + 0.017 * random.standard_normal(), 2 * np.pi)
        messages += [Table(stamp, plots), Table(stamp + 1000, make_bearings(heard, std=0.017))]
        truth.append(state[0])
    return messages, np.array(truth)


def test_guidance_follows_a_swing_that_surveillance_cannot(swinging, run):
    messages, truth = swinging
    rms = {}
    for model in ("surveillance", "guidance"):
        parameters = FusionParameters(
            model=model, active_input="plots", swing_std=0.087, clear_time=300.0, jammed_time=50.0
        )
        fusion = BearingFusion(parameters)
        rows, times = run(fusion, messages)
        error = wrap_pi(rows["azimuth"] - truth[np.round(times).astype(int)])
        rms[model] = np.sqrt(np.mean(error[times > 20.0] ** 2))
        if model == "guidance":
            assert len(set(rows["id"].tolist())) == 1
            assert (rows["channel"] == BearingChannel.FUSED).all()
            normalised = (error / rows["azimuth_std"])[times > 20.0]
            assert 0.5 < np.mean(normalised**2) < 1.5
            jammed = (times > 55.0) & (times < 90.0)
            assert rows["active_health"][jammed, 1].mean() > 0.8
            # The axis was never told: it is the mean direction, north.
            assert abs(fusion._targets.columns["axis"][0]) < 0.05
    assert rms["guidance"] < 0.6 * rms["surveillance"]
    assert rms["guidance"] < 0.0087
