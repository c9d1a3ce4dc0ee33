# SPDX-License-Identifier: Apache-2.0
"""Coasts, rings, walls and patches: a few plots without quality, whatever their shape, not one for each part."""

from __future__ import annotations

import numpy as np
import pytest

SCAN = 1024
NOISE_LEVEL = 0.02 * np.sqrt(2.0)


def echo(name):
    """Where the clutter lies, shape (pulses, cells)."""
    pulse, cell = np.mgrid[0 : 2 * SCAN, 0:256]
    first = 20 * (cell - 40)
    masks = {
        "arc of three cells": (cell >= 80) & (cell < 83) & (pulse > 100) & (pulse < 1500),
        "turn and a half": (cell == 80) & (pulse > 100) & (pulse < 1600),
        "wall along range": (pulse > 700) & (pulse < 712) & (cell > 20) & (cell < 240),
        "steep coast": (pulse > 3 * cell + 300) & (pulse < 3 * cell + 320),
        "slanting coast": (cell >= 40) & (cell < 110) & (pulse > first) & (pulse < first + 30),
        "patch": (pulse > 500) & (pulse < 900) & (cell > 100) & (cell < 160),
    }
    return masks[name]


NAMES = (
    "arc of three cells",
    "turn and a half",
    "wall along range",
    "steep coast",
    "slanting coast",
    "patch",
)


@pytest.mark.parametrize("speckle", [False, True])
@pytest.mark.parametrize("name", NAMES)
def test_an_extended_echo_is_a_few_plots_without_quality(scene, extract, cut, name, speckle):
    made = scene(3, 2 * SCAN, 256)
    rng = np.random.default_rng(5)
    strength = rng.rayleigh(0.5, made.video.shape) if speckle else 0.5
    made.video[:] += (echo(name) * strength).astype(np.float32)
    plots, health = extract(
        made.sectors(*cut(64, made)),
        normaliser="fixed-level",
        noise_level=NOISE_LEVEL,
        false_plots_per_scan=0.01,
    )
    assert 1 <= len(plots) <= 4
    # A piece that speckle has torn off may look like a target.
    assert (plots["quality"] > 0.0).sum() <= 2 * speckle
    assert len(plots) == 1 or speckle
    if "coast" in name:
        assert health.dropped["bursts that prolong an extended echo"] > 20


def test_a_target_is_seen_again_where_an_echo_has_ended(scene, extract, cut):
    """The ring that was full of clutter serves the next target as any other."""
    made = scene(6, 2 * SCAN, 256, [(1400.0, 80.5, 12.0)])
    made.video[echo("slanting coast")] += 0.5
    plots, _ = extract(
        made.sectors(*cut(64, made)),
        normaliser="fixed-level",
        noise_level=NOISE_LEVEL,
        false_plots_per_scan=0.01,
    )
    target = plots[plots["quality"] > 0.0]
    assert len(target) == 1
    assert target["azimuth"][0] == pytest.approx(2 * np.pi * (1400 - SCAN) / SCAN, abs=0.02)


def test_the_error_of_an_extended_echo_is_its_extent(scene, extract):
    made = scene(7, 2 * SCAN, 256)
    made.video[echo("wall along range")] += 0.5
    plots, _ = extract(
        made.sectors(), normaliser="fixed-level", noise_level=NOISE_LEVEL, false_plots_per_scan=0.01
    )
    assert len(plots) == 1
    assert plots["range_std"][0] == pytest.approx(219 * made.range_step / np.sqrt(12.0), rel=0.03)
    assert plots["azimuth_std"][0] == pytest.approx(12 * made.step / np.sqrt(12.0), rel=0.4)
