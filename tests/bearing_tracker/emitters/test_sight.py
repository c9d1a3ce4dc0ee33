# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from bearing_tracker.emitters.sight import NEAREST, sight


def bracket(first, second):
    return 0.5 * np.pi * (2.0 - np.sign(first) - np.sign(second[:, 0]) * np.sign(second[:, 1]))


def wrong(azimuth, true):
    return np.mean(np.abs(np.mod(azimuth - true + np.pi, 2 * np.pi) - np.pi) > 1e-6)


def test_the_printed_azimuth_is_wrong_and_the_corrected_one_is_ours():
    """Both misprints of the paper, one at a time, in its axes: x north, z east."""
    random = np.random.default_rng(1)
    emitter, finder = random.uniform(-1e4, 1e4, (2, 50_000, 2))
    relative = emitter - finder
    ours = sight(relative[:, ::-1]).azimuth
    arctangent = np.arctan(relative[:, 1] / relative[:, 0])
    sampling = 4.0 * np.sqrt(0.25 / 50_000)
    assert wrong(arctangent + bracket(emitter[:, 0], emitter), ours) == pytest.approx(
        0.4995, abs=sampling
    )
    assert wrong(arctangent + bracket(relative[:, 0], relative), ours) == pytest.approx(
        0.4995, abs=sampling
    )
    assert wrong(arctangent + bracket(emitter[:, 1], emitter), ours) == pytest.approx(
        0.25, abs=sampling
    )
    assert wrong(arctangent + bracket(relative[:, 1], relative), ours) == 0.0


def test_on_the_axes_where_the_sign_form_fails():
    relative = np.array([[0.0, 5.0], [5.0, 0.0], [0.0, -5.0], [-5.0, 0.0]])
    seen = sight(relative)
    np.testing.assert_allclose(seen.azimuth, np.pi * np.array([0.0, 0.5, 1.0, 1.5]), atol=1e-12)
    np.testing.assert_allclose(seen.range, 5.0)


def test_gradient_is_the_derivative():
    random = np.random.default_rng(2)
    relative = random.uniform(-1e4, 1e4, (30, 2))
    for axis in (0, 1):
        step = 0.1 * np.eye(2)[axis]
        ahead, behind = sight(relative + step).azimuth, sight(relative - step).azimuth
        slope = (np.mod(ahead - behind + np.pi, 2 * np.pi) - np.pi) / 0.2
        np.testing.assert_allclose(sight(relative).gradient[:, axis], slope, rtol=1e-3, atol=1e-9)


def test_on_the_spot_everything_is_finite():
    seen = sight(np.zeros((1, 2)))
    assert seen.range[0] == NEAREST
    assert np.isfinite(seen.gradient).all()
    assert np.isfinite(seen.azimuth).all()
