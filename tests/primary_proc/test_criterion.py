# SPDX-License-Identifier: Apache-2.0
"""Control of the criterion: acts on clutter, leaves noise and targets alone, releases, and never drops a plot."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.ndimage import convolve1d

from primary_proc.calculators.pulse.burst_shape import burst_shape, pulses_in_burst
from primary_proc.criterion.clutter_tail import LEVELS_DB, needed_raise_db
from primary_proc.criterion.examiner import Examiner
from primary_proc.criterion.plots_limit import PlotsLimit
from primary_proc.criterion.zones import Zones
from primary_proc.design import design
from primary_proc.normalisers.fixed_level import FixedLevel
from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from radar_common.health import Health
from radar_common.parameters import ParameterError

SCAN, CELLS, BEAM = 512, 256, 6.0
STEP = 2 * np.pi / SCAN
SHARE = "share of the coverage with a raised criterion (expected: no clutter)"
LARGEST = "largest raise of the criterion, dB (expected: no clutter)"


def clutter(seed, turns, *, power=100.0, cells=slice(64, 192), pulses=slice(128, 384)):
    """Rayleigh clutter that stays the same while the beam passes, new in every turn: amplitude over the noise's."""
    generator = np.random.default_rng(seed)
    in_burst = pulses_in_burst("gaussian", np.radians(BEAM), STEP)
    shape = burst_shape("gaussian", in_burst, book=False)
    shape /= np.sqrt(np.square(shape).sum())
    field = np.zeros((turns, SCAN, CELLS), complex)
    size = field[:, pulses, cells].shape
    field[:, pulses, cells] = generator.standard_normal(size) + 1j * generator.standard_normal(size)
    return np.sqrt(power) * convolve1d(field, shape, axis=1, mode="wrap").reshape(-1, CELLS)


def video(seed, field, sigma=0.02):
    """Envelope of noise and a field in units of its quadratures."""
    generator = np.random.default_rng(seed)
    noise = generator.standard_normal(field.shape) + 1j * generator.standard_normal(field.shape)
    return (sigma * np.abs(noise + field)).astype(np.float32)


@pytest.fixture
def watch(scene):
    """Run turns of video; give plots of each turn, the extractor's control and its health."""
    empty = scene(0, 1, CELLS, pulses_per_scan=SCAN)

    def go(envelope, *, cuts=None, **parameters):
        made = type(empty)(envelope, SCAN)
        health = Health()
        chosen = {"beamwidth_deg": BEAM, "false_plots_per_scan": 10.0} | parameters
        extractor = PlotExtractor(ExtractorParameters(**chosen), health)
        found = []
        for table in made.sectors(*(range(64, len(envelope), 64) if cuts is None else cuts)):
            rows = extractor.process(table).rows.copy()
            rows["time_offset"] += (table.stamp - 1_700_000_000 * 10**9) * 1e-9
            found.append(rows)
        plots = np.concatenate(found)
        turn = (plots["time_offset"] / (SCAN * 1e-3)).astype(int)
        counts = np.bincount(np.maximum(turn, 0), minlength=len(envelope) // SCAN)
        return plots, counts, extractor._chain._criterion, health

    return go


@pytest.mark.parametrize("beamwidth", [0.3, 1.4, 6.0, 30.0])
def test_every_place_is_in_one_zone(beamwidth):
    zones = Zones(700, np.radians(beamwidth))
    assert zones.widths.sum() == 700
    assert (
        zones.zone(np.arange(700)).tolist()
        == np.repeat(np.arange(len(zones)), zones.widths).tolist()
    )
    sector = zones.sector(np.linspace(0, 2 * np.pi, 1000, endpoint=False))
    assert sector.min() == 0
    assert sector.max() == zones.sectors - 1
    assert (np.diff(sector) >= 0).all()
    cells, place = zones.cells(np.array([1, 3]))
    assert (zones.zone(cells) == np.array([1, 3])[place]).all()
    assert len(cells) == zones.widths[[1, 3]].sum()


def test_zones_touch_across_north_and_end_with_the_range():
    zones = Zones(256, np.radians(BEAM))
    sector, zone = zones.neighbours(0, np.array([0]))
    found = set(zip(sector.tolist(), zone.tolist(), strict=True))
    last = zones.sectors - 1
    assert found == {(s, z) for s in (last, 0, 1) for z in (0, 1)}


@pytest.mark.parametrize("shape", [0.5, 0.7, 1.0])
@pytest.mark.parametrize("scale", [0.6, 1.0, 2.0])
def test_the_criterion_found_gives_the_wanted_bursts(shape, scale):
    """On curves that are exactly the model's; taking off targets costs some of the counts, hence the tolerance."""
    resolution, wanted = np.array([512.0]), np.array([0.1])
    level = 10.0 ** (LEVELS_DB / 10.0)
    counts = resolution * np.exp(-((4.0 * level / scale) ** shape))[None]
    exact = 10 * np.log10(scale / 4.0 * np.log(resolution / wanted) ** (1 / shape))[0]
    found = needed_raise_db(counts, np.zeros_like(counts), wanted, resolution)[0]
    assert found == pytest.approx(max(exact, 0.0), abs=1.2)


def test_nothing_to_raise_and_clutter_at_all_levels():
    quiet, flooded = np.zeros((1, len(LEVELS_DB))), np.zeros((1, len(LEVELS_DB)))
    flooded[0, :-3] = 200.0
    for counts, expected in ((quiet, 0.0), (flooded, np.inf)):
        assert needed_raise_db(counts, quiet, np.array([0.1]), np.array([512.0])) == expected
    targets = np.full((1, len(LEVELS_DB)), 30.0)
    assert needed_raise_db(targets, quiet, np.array([0.1]), np.array([512.0])) == 0.0


@pytest.mark.parametrize("rate", [0.1, 10.0, 100.0])
def test_a_look_at_noise_finds_nothing(rate):
    """Four hundred looks at zones of noise, each as if it were suspicious."""
    zones = Zones(CELLS, np.radians(BEAM))
    plan = design(ExtractorParameters(beamwidth_deg=BEAM, false_plots_per_scan=rate), CELLS, STEP)
    pulses = SCAN // zones.sectors
    examiner = Examiner(plan, FixedLevel(CELLS, 1.0), pulses)
    cells, place = zones.cells(np.arange(len(zones)))
    expected = plan.method.false_starts * pulses * zones.widths
    generator = np.random.default_rng(17)
    for _ in range(100):
        ratios = generator.standard_exponential((pulses, CELLS), np.float32)
        counts = examiner.counts(ratios, cells, place)
        noise = np.outer(zones.widths, examiner.noise)
        assert not needed_raise_db(counts, noise, expected, zones.resolution_cells).any()


def test_noise_is_never_touched(watch):
    """Fifty turns; and what comes out is what comes without control, bit for bit."""
    envelope = video(1, np.zeros((50 * SCAN, CELLS)))
    plots, counts, control, health = watch(envelope)
    assert counts.mean() == pytest.approx(10.0, abs=3.3 * np.sqrt(10.0 / 50))
    assert not control.raise_db.any()
    assert (health.watches[SHARE].observed, health.watches[LARGEST].observed) == (0.0, 0.0)
    free, counts, *_ = watch(envelope[: 10 * SCAN], largest_raise_db=0.0)
    assert free.tobytes() == plots[: len(free)].tobytes()


def test_clutter_is_held_to_the_wanted_rate_and_released(watch):
    turns, quiet = 14, 30
    field = np.zeros(((turns + quiet) * SCAN, CELLS), complex)
    field[: turns * SCAN] = clutter(2, turns)
    plots, counts, control, health = watch(video(3, field))
    assert (counts[:2] > 80).all(), "nothing is raised before it was seen"
    assert counts[7:turns].mean() < 20.0, "factor of two"
    assert counts[-10:].mean() == pytest.approx(10.0, abs=4.0)
    assert not control.raise_db.any(), "released"
    assert health.watches[LARGEST].observed == 0.0
    outside = (plots["range"] > 500 + 100 * 195) | (plots["range"] < 500 + 100 * 60)
    clear = plots[outside]
    assert len(clear) / (turns + quiet) == pytest.approx(10.0 * 121 / 256, abs=1.3)


def test_raises_are_reported_while_they_last(watch):
    *_, control, health = watch(video(4, clutter(5, 8)))
    assert control.raise_db.max() > 2.0
    assert health.watches[LARGEST].observed > 2.0
    assert 0.2 < health.watches[SHARE].observed < 0.6


@pytest.mark.parametrize("detector", ["4/4-2", "accumulator-from-first-one", "auto"])
def test_any_detector_is_controlled(watch, detector):
    _, counts, control, _ = watch(video(6, clutter(7, 9)), detector=detector)
    assert control.raise_db.any()
    assert counts[6:].mean() < 0.3 * counts[:2].mean()


@pytest.mark.parametrize("snr_db", [11.0, 30.0])
def test_formations_of_targets_raise_nothing(watch, snr_db):
    """Eight targets in one zone, turn by turn, and single ones elsewhere."""
    turns = 12
    generator = np.random.default_rng(8)
    in_burst = pulses_in_burst("gaussian", np.radians(BEAM), STEP)
    shape = burst_shape("gaussian", in_burst, book=False)
    field = np.zeros((turns * SCAN, CELLS), complex)
    places = [(150 + 12 * i, 70 + 7 * i) for i in range(5)]
    places += [(146 + 15 * i, 120 - 6 * i) for i in range(3)] + [(400, 30), (300, 240)]
    for turn in range(turns):
        for pulse, cell in places:
            rows = turn * SCAN + pulse + np.arange(len(shape)) - len(shape) // 2
            phase = np.exp(2j * np.pi * generator.random())
            field[rows, cell] += np.sqrt(2.0) * 10 ** (snr_db / 20) * phase * shape
    _, counts, control, _ = watch(video(9, field), false_plots_per_scan=2.0)
    assert counts.mean() > 7.0
    assert not control.raise_db.any()


def test_the_strength_of_plots_is_not_touched(watch):
    """A strong target in clutter: the same power, bit for bit, whether the criterion is raised or not."""
    turns = 9
    field = clutter(10, turns)
    pulses = np.arange(turns) * SCAN + 256
    for shift in range(-4, 5):
        field[pulses + shift, 128] += 2000.0
    envelope = video(11, field)
    strong = {}
    for limit in (0.0, 20.0):
        plots, _, control, _ = watch(envelope, largest_raise_db=limit)
        strong[limit] = plots[plots["snr_db"] > 20.0]
    assert control.raise_db[4, 2] > 0.0 or control.raise_db[3, 2] > 0.0
    assert len(strong[20.0]) == turns
    assert np.array_equal(strong[20.0]["snr_db"], strong[0.0]["snr_db"])
    assert strong[20.0]["range"] == pytest.approx(strong[0.0]["range"], abs=50.0)


@settings(
    deadline=None, max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(cuts=st.lists(st.integers(1, 6 * SCAN - 1), unique=True, max_size=25))
def test_plots_do_not_depend_on_how_pulses_are_cut(watch, cuts):
    envelope = video(12, clutter(13, 6))
    settings = {"plots_limit_per_scan": 60.0}
    reference, _, control, _ = watch(envelope, **settings)
    plots, _, other, _ = watch(envelope, cuts=sorted(cuts), **settings)
    assert np.array_equal(other.raise_db, control.raise_db)
    assert other._limit.raise_db == control._limit.raise_db
    assert control.raise_db.any()
    order = ["range", "azimuth"]
    plots, reference = (np.sort(table, order=order) for table in (plots, reference))
    for name in ("range", "azimuth", "snr_db", "quality", "pulse_count"):
        assert plots[name] == pytest.approx(reference[name], rel=1e-6), name


def test_the_limit_of_a_turn_is_kept(watch):
    """Clutter everywhere, so that zones alone would leave many plots; the limit is reached and then left alone."""
    turns, quiet = 16, 24
    field = np.zeros(((turns + quiet) * SCAN, CELLS), complex)
    field[: turns * SCAN] = clutter(14, turns, cells=slice(0, 256), pulses=slice(0, 512))
    envelope = video(15, field)
    limit = {"plots_limit_per_scan": 40.0, "false_plots_per_scan": 15.0}
    _, counts, control, health = watch(envelope, **limit)
    assert counts[0] > 400
    assert (counts[8:turns] <= 40).all()
    assert control._limit.raise_db == 0.0
    assert counts[-5:].mean() == pytest.approx(15.0, abs=6.0)
    name = "plots of the last turn (expected: their limit)"
    assert (health.watches[name].expected, health.watches[name].observed) == (
        40.0,
        pytest.approx(counts[-1], abs=10),
    )


@pytest.mark.parametrize("plots", [50.0, 150.0, 1000.0])
def test_the_limit_settles_on_clutter(plots):
    """Plots that fall by 5 dB for each dB of raise, as those of Rayleigh clutter do."""
    limit = PlotsLimit(100.0, 20.0, 32)
    loads, raises = [], []
    for entry in range(12 * 32):
        number = round(plots / 32 * 10.0 ** (-0.5 * limit.raise_db))
        limit.add(np.full(number, (entry - 3) % 32))
        limit.settle((entry - 3) % 32)
        loads.append(limit.load)
        raises.append(limit.raise_db)
    assert max(loads[6 * 32 :]) <= 100
    assert (max(raises) > 0.0) == (plots > 100.0)
    assert min(loads[6 * 32 :]) >= 0.6 * min(plots, 100.0), (
        "no more is raised than the limit asks for"
    )
    for entry in range(8 * 32):
        limit.settle(entry % 32)
    assert limit.raise_db == 0.0, "released"


def test_a_limit_below_the_false_plots_is_refused():
    with pytest.raises(ParameterError, match="leaves targets no room"):
        ExtractorParameters(plots_limit_per_scan=15.0, false_plots_per_scan=10.0)
