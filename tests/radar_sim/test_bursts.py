# SPDX-License-Identifier: Apache-2.0
"""When the beam passes a target, and where its echoes lie in pulse, cell and phase."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from radar_common.frames import polar_from_enu, wrap_pi
from radar_sim.bursts import find_crossings, make_echoes
from radar_sim.motion import Path
from radar_sim.radar import Radar
from radar_sim.signal_strength import amplitude_from_snr, snr_db_at_range
from radar_sim.targets import Target, Targets

RADAR = Radar(scan_period=4.0, pulse_rate=1024.0, pattern="gaussian", reference_range=20_000.0)


def steady(x, y, speed=0.0, course=0.0, snr_db=20.0, **path):
    return Target(Path(x, y, speed, course, **path), snr_db, "none")


def echoes_of(target, radar=RADAR, turn=0, seed=0):
    targets = Targets([target])
    crossings = find_crossings(targets, radar, turn)
    return make_echoes(crossings, targets, radar, np.random.default_rng(seed))


@settings(max_examples=50)
@given(
    x=st.floats(-5e4, 5e4),
    y=st.floats(2e3, 5e4),
    speed=st.floats(0.0, 600.0),
    course=st.floats(0.0, 6.3),
    turn=st.integers(0, 40),
)
def test_at_a_crossing_the_beam_points_at_the_target(x, y, speed, course, turn):
    targets = Targets([steady(x, y, speed, course)])
    crossings = find_crossings(targets, RADAR, turn)
    assert np.all((turn * 4.0 <= crossings.time) & (crossings.time < (turn + 1) * 4.0))
    state = targets.fleet.state(crossings.target, crossings.time)
    distance, azimuth = polar_from_enu(state.x, state.y)
    beam = 2.0 * np.pi * crossings.time / 4.0
    np.testing.assert_allclose(wrap_pi(beam - azimuth), 0.0, atol=1e-7)
    np.testing.assert_allclose(crossings.distance, distance)


@pytest.mark.parametrize(("course", "crossings"), [(np.pi / 2, 9), (-np.pi / 2, 11)])
def test_across_north_no_crossing_is_lost_or_doubled(course, crossings):
    # Ten turns. Its own passage over north, with or against the antenna, is one revolution less or more.
    x = -2000.0 * np.sin(course)
    targets = Targets([steady(x, 5000.0, 100.0, course)])
    times = np.concatenate([find_crossings(targets, RADAR, turn).time for turn in range(10)])
    assert len(times) == crossings
    assert np.all(np.abs(np.diff(times) - 4.0) < 0.1)


def test_a_target_on_the_antenna_is_left_out_or_harmless():
    targets = Targets([steady(0.0, -400.0, 400.0, 0.0)])
    for turn in range(3):
        crossings = find_crossings(targets, RADAR, turn)
        echoes = make_echoes(crossings, targets, RADAR, np.random.default_rng(0))
        assert np.all(np.isfinite(echoes.amplitude))


def test_an_absent_target_is_not_crossed():
    targets = Targets([steady(0.0, -20_000.0, appears=5.0, disappears=11.0)])
    found = [len(find_crossings(targets, RADAR, turn).time) for turn in range(4)]
    assert found == [0, 1, 1, 0]


def test_a_burst_is_modulated_by_the_pattern():
    distance = 100.5 * RADAR.range_step
    echoes = echoes_of(steady(0.0, -distance))
    alpha = wrap_pi(RADAR.azimuth(echoes.pulse) - np.pi) / RADAR.half_width
    peak = amplitude_from_snr(snr_db_at_range(RADAR, 20.0, distance))
    in_cell = echoes.cell == 100
    np.testing.assert_allclose(
        np.abs(echoes.amplitude[in_cell]), peak * np.exp(-np.square(alpha[in_cell])), rtol=1e-9
    )
    assert np.abs(echoes.amplitude[~in_cell]).max(initial=0.0) < 1e-9 * peak
    inside = np.abs(alpha[in_cell]) <= 1.0
    assert inside.sum() == pytest.approx(RADAR.pulses_in_beam, abs=1.0)


@given(share=st.floats(0.0, 0.999))
def test_an_echo_is_shared_by_two_cells_in_phase(share):
    distance = (200.5 + share) * RADAR.range_step
    echoes = echoes_of(steady(0.0, -distance))
    near, far = (echoes.amplitude[echoes.cell == cell] for cell in (200, 201))
    assert set(np.unique(echoes.cell)) <= {199, 200, 201}
    whole = near + far
    np.testing.assert_allclose(np.abs(far), share * np.abs(whole), atol=1e-6 * np.abs(whole).max())
    centroid = (200 * np.abs(near) + 201 * np.abs(far)).sum() / np.abs(whole).sum()
    assert (centroid + 0.5) * RADAR.range_step == pytest.approx(distance, abs=1e-3)


def test_a_moving_target_changes_its_cell_within_the_dwell():
    slow_turn = Radar(
        scan_period=60.0, pulse_rate=100.0, beamwidth_deg=10.0, reference_range=20_000.0
    )
    echoes = echoes_of(steady(0.0, -20_000.0, 600.0, np.pi), slow_turn)
    strongest = [
        echoes.cell[echoes.pulse == pulse][np.abs(echoes.amplitude[echoes.pulse == pulse]).argmax()]
        for pulse in np.unique(echoes.pulse)
    ]
    assert np.all(np.diff(strongest) >= 0)
    seconds = np.ptp(echoes.pulse) / slow_turn.pulse_rate
    assert strongest[-1] - strongest[0] == pytest.approx(600.0 * seconds / 108.0, abs=1.0)


def test_radial_motion_turns_the_carrier_phase():
    # 4 pi v T / lambda from pulse to pulse: chosen as a quarter turn.
    speed = RADAR.wavelength * RADAR.pulse_rate / 8.0
    distance = 150.5 * RADAR.range_step
    echoes = echoes_of(steady(0.0, -distance, speed, np.pi))
    strong = echoes.cell == 150
    steps = np.diff(np.unwrap(np.angle(echoes.amplitude[strong])))
    np.testing.assert_allclose(np.abs(wrap_pi(steps)), np.pi / 2, atol=0.02)


def test_the_first_burst_across_north_begins_in_the_turn_before():
    echoes = echoes_of(steady(10.0, 20_000.0), turn=1)
    assert echoes.pulse.min() < 4096 < echoes.pulse.max()


def test_echoes_beyond_the_cells_are_cut():
    edge = Radar(cells=100, reference_range=10_000.0)
    echoes = echoes_of(steady(0.0, -(edge.range_end - 1.0)), edge)
    assert set(np.unique(echoes.cell)) == {99}
    assert len(echoes_of(steady(0.0, -2.0 * edge.range_end), edge).pulse) == 0
