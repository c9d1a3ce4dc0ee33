# SPDX-License-Identifier: Apache-2.0
"""Each normaliser against its peer on the same video: scipy's moving average, numpy's partition of sliding windows."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import uniform_filter1d

from primary_proc.choices import NORMALISERS, RANGE_WINDOWS
from primary_proc.parameters import ExtractorParameters

PULSES, CELLS, SECTOR = 1024, 1024, 128
PARAMETERS = ExtractorParameters(noise_level=1.0)
REFERENCE, GUARD = PARAMETERS.reference_cells, PARAMETERS.guard_cells
RANK = round(2 * REFERENCE * PARAMETERS.order)
# Eight pulses at once make the partition fastest; a sector at once is how one would write it.
PARTITIONS = {"8 pulses at once": 8, "a sector at once": SECTOR}
BEST = {}


@pytest.fixture(scope="module")
def video():
    return np.random.default_rng(1).rayleigh(0.7, (PULSES, CELLS)).astype(np.float32)


def moving_average(video):
    power = video * video
    wide, narrow = 2 * (REFERENCE + GUARD) + 1, 2 * GUARD + 1
    window = uniform_filter1d(power, wide, axis=1, mode="constant") * wide
    inner = uniform_filter1d(power, narrow, axis=1, mode="constant") * narrow
    return power / (window - inner)


def sliding_partition(video, rows):
    """The cells that have a whole window around them, some pulses at once."""
    length = 2 * (REFERENCE + GUARD) + 1
    found = np.empty((len(video), CELLS - length + 1), np.float32)
    for first in range(0, len(video), rows):
        power = np.square(video[first : first + rows])
        windows = np.lib.stride_tricks.sliding_window_view(power, length, axis=1)
        reference = np.concatenate([windows[..., :REFERENCE], windows[..., -REFERENCE:]], axis=-1)
        reference.partition(RANK - 1, axis=-1)
        middle = power[:, REFERENCE + GUARD : -(REFERENCE + GUARD)]
        found[first : first + rows] = middle / reference[..., RANK - 1]
    return found


def run(benchmark, name, cells, function):
    benchmark.group = "normalisers"
    result = benchmark.pedantic(function, rounds=15, warmup_rounds=1)
    BEST[name] = benchmark.stats.stats.min / cells
    return result


def test_peer_moving_average(benchmark, video):
    run(benchmark, "moving average", video.size, lambda: moving_average(video))


@pytest.mark.parametrize("at_once", PARTITIONS)
def test_peer_sliding_partition(benchmark, video, at_once):
    part = video[:SECTOR]
    cells = SECTOR * (CELLS - 2 * (REFERENCE + GUARD))
    rows = PARTITIONS[at_once]
    found = run(benchmark, at_once, cells, lambda: sliding_partition(part, rows))
    ours = np.empty(part.shape, np.float32)
    normaliser = NORMALISERS["ordered-statistic"](PARAMETERS, CELLS)
    normaliser.ratios(part, np.zeros(len(part)), ours)
    inside = ours[:, REFERENCE + GUARD : -(REFERENCE + GUARD)]
    assert found == pytest.approx(inside, rel=1e-3), "both do the same work"


@pytest.mark.parametrize("name", [*RANGE_WINDOWS, "fixed-level"])
def test_normaliser(benchmark, video, ratio, name):
    normaliser = NORMALISERS[name](PARAMETERS, CELLS)
    azimuth, out = np.zeros(SECTOR), np.empty((SECTOR, CELLS), np.float32)
    sectors = np.split(video, PULSES // SECTOR)

    run(
        benchmark,
        name,
        video.size,
        lambda: [normaliser.ratios(part, azimuth, out) for part in sectors],
    )
    ratio(f"{name}: cells a second", 1.0 / BEST[name], "1/s")
    if name == "ordered-statistic":
        for at_once in PARTITIONS:
            faster = BEST[at_once] / BEST[name]
            ratio(f"{name} / np.partition, {at_once}", faster, "times faster, goal 10")
    else:
        faster = BEST["moving average"] / BEST[name]
        ratio(f"{name} / scipy moving average", faster, "times faster")
