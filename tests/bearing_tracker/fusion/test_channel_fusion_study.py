# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import re

import numpy as np
import pytest

from bearing_tracker.fusion import FILTERS
from radar_eval.published.detkov_trials import COLUMNS
from radar_eval.studies.channel_fusion import PICTURE, measure_channel_fusion
from radar_eval.studies.registry import STUDIES


def test_the_study_draws_and_tells_the_errors(tmp_path):
    told = measure_channel_fusion(tmp_path, runs=6)
    picture = (tmp_path / PICTURE).read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert len(picture) > 50_000
    assert set(told["rms"]) == {"dcmp", "kalman", "oracle"}
    for parts in told["rms"].values():
        assert set(parts) == {"undisturbed", "active jammed", "passive silent"}
        for errors in parts.values():
            assert tuple(errors) == COLUMNS
            assert all(math.isfinite(error) and error > 0.0 for error in errors.values())
    jammed = {name: parts["active jammed"] for name, parts in told["rms"].items()}
    assert jammed["dcmp"]["both channels"] < 0.5 * jammed["kalman"]["both channels"]
    assert "channel_fusion" in STUDIES


@pytest.fixture(scope="module")
def page(repository):
    return (repository / "docs" / "channel_fusion.md").read_text("utf-8")


def test_the_example_of_the_page_runs(page):
    example = re.search(r"```python\n(.*?)```", page, re.DOTALL)[1]
    names = {}
    exec(compile(example, "docs/channel_fusion.md", "exec"), names)
    assert names["answer"].mean.shape == (3, 2)
    assert np.isfinite(names["answer"].covariance).all()


def test_the_page_names_every_filter(page):
    assert all(f"`{name}`" in page for name in FILTERS)
