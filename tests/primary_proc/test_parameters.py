# SPDX-License-Identifier: Apache-2.0
"""Parameters: refused with a reason where they cannot work, and the same in file, class and choices."""

from __future__ import annotations

import pytest

from primary_proc.choices import ESTIMATORS, NORMALISERS
from primary_proc.parameters import ExtractorParameters
from radar_common.parameters import ParameterError, describe, from_file, to_yaml


def test_the_file_is_the_class(repository):
    path = repository / "src/primary_proc/config/plot_extractor.yaml"
    assert path.read_text(encoding="utf-8") == to_yaml(ExtractorParameters, "plot_extractor")
    assert from_file(ExtractorParameters, path, "plot_extractor") == ExtractorParameters()


def test_choices_are_what_is_registered():
    choices = {item.name: item.choices for item in describe(ExtractorParameters)}
    assert choices["normaliser"] == tuple(NORMALISERS)
    assert choices["azimuth_estimator"] == tuple(ESTIMATORS)


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"normaliser": "fixed-level"}, "noise_level"),
        ({"guard_cells": 9, "reference_cells": 4}, "guard_cells"),
        ({"detector": "5/3-2"}, "detector"),
        ({"false_plots_per_scan": 0.0}, "false_plots_per_scan"),
        ({"false_plots_per_scan": float("nan")}, "finite"),
        ({"reference_cells": 1}, "reference_cells"),
        ({"beamwidth_deg": 60.0}, "beamwidth_deg"),
        ({"pattern": "cosine"}, "pattern"),
    ],
)
def test_impossible_values_are_refused_with_the_reason(values, reason):
    with pytest.raises(ParameterError, match=reason):
        ExtractorParameters(**values)


def test_what_one_normaliser_needs_does_not_bind_the_other():
    ExtractorParameters(normaliser="fixed-level", noise_level=0.5, guard_cells=9, reference_cells=4)
    ExtractorParameters(normaliser="cell-averaging", noise_level=0.0)
