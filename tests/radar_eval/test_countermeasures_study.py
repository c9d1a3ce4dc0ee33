# SPDX-License-Identifier: Apache-2.0
"""The fused bearing stays beside the better of two channels through jamming and silence."""

from __future__ import annotations

import numpy as np
import pytest

from radar_eval.studies.countermeasures import PICTURE, measure_countermeasures
from radar_eval.studies.countermeasures_trials import run_trial
from radar_sim.scenario import load_scenario


def test_fused_is_better_than_both_while_nothing_is_disturbed(tmp_path):
    numbers = measure_countermeasures(tmp_path, [1], 30.0)
    rms = numbers["rms_mrad"]["clear"]
    assert rms["fused"] < min(rms["active"], rms["passive"])
    assert numbers["rms_mrad"]["jammed"] == {}
    assert (tmp_path / PICTURE).stat().st_size > 10_000


def test_a_target_that_never_transmits_is_followed_by_the_radar_alone():
    trial = run_trial(load_scenario("countermeasures"), 2, np.arange(5.0, 20.0), [4])
    np.testing.assert_allclose(trial.error["fused"], trial.error["active"], rtol=1e-6, atol=1e-9)
    assert np.isnan(trial.error["passive"]).all()
    assert not trial.truly_jammed.any()


@pytest.mark.study
def test_fused_keeps_to_the_better_channel_throughout(tmp_path):
    numbers = measure_countermeasures(tmp_path, range(1, 7), 240.0)
    for part in ("clear", "jammed", "silent"):
        rms = numbers["rms_mrad"][part]
        assert rms["fused"] < 1.1 * min(rms["active"], rms["passive"])
    assert numbers["fused_over_better"]["median"] < 1.0
