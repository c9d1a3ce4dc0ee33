# SPDX-License-Identifier: Apache-2.0
"""Bursts: when the beam crosses a target, and what each of its pulses brings back."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from radar_common.frames import TWO_PI, FloatArray, polar_from_enu, wrap_pi
from radar_sim.echoes import Echoes, IntArray
from radar_sim.fluctuation import fluctuate
from radar_sim.motion import State
from radar_sim.radar import Radar
from radar_sim.signal_strength import amplitude_from_snr, snr_db_at_range
from radar_sim.targets import Targets

_NEWTON_STEPS = 6
_CONVERGED = 1e-9
# A target that runs along with the beam is longer in it; a quarter more pulses are looked at.
_RUN_ALONG = 1.25


@dataclass(frozen=True, slots=True)
class Crossings:
    """Moments at which the beam's axis passes a target, in order of the targets.

    Attributes:
        target: index of the target, shape (n,).
        time: s after the start, shape (n,).
        distance: from the antenna, m, shape (n,).
        azimuth: rad clockwise from north, shape (n,).
        state: position and velocity in the map, each of shape (n,).
    """

    target: npt.NDArray[np.intp]
    time: FloatArray
    distance: FloatArray
    azimuth: FloatArray
    state: State


def find_crossings(targets: Targets, radar: Radar, turn: int) -> Crossings:
    """Find when the beam passes each target in one turn, by Newton's method on the angle between them.

    A target that runs against the rotation across north is passed twice in a turn, one that runs with it perhaps
    never. A target that moves faster in azimuth than half the antenna, which is closer than some hundred metres,
    is left out where no moment can be told.

    Args:
        targets: all targets.
        radar: how the antenna turns.
        turn: number of the turn, from one pointing north to the next.

    Returns:
        Crossings with begin of turn <= time < end of turn, of targets that are present.
    """
    fleet, period = targets.fleet, radar.scan_period
    begin, end = turn * period, (turn + 1) * period
    there = np.flatnonzero((fleet.appears < end) & (fleet.disappears > begin))
    first = _polar(fleet.state(there, np.full(len(there), begin)), radar)[1]
    target = np.concatenate([there, there])
    time = begin + period * np.concatenate([first, first + TWO_PI]) / TWO_PI
    offset = np.zeros(len(target))
    for _ in range(_NEWTON_STEPS):
        state = fleet.state(target, time)
        distance, azimuth = _polar(state, radar)
        offset = wrap_pi(TWO_PI * np.mod(time / period, 1.0) - azimuth)
        east, north = state.x - radar.x, state.y - radar.y
        own_rate = (state.vx * north - state.vy * east) / np.maximum(np.square(distance), 1e-6)
        time = time - offset / np.maximum(radar.rotation_rate - own_rate, radar.rotation_rate / 2)
    twice = np.zeros(len(target), dtype=bool)
    twice[len(there) :] = time[len(there) :] - time[: len(there)] < period / 2
    keep = (np.abs(offset) < _CONVERGED) & (begin <= time) & (time < end) & ~twice
    keep &= fleet.present(target, time)
    target, time = target[keep], time[keep]
    state = fleet.state(target, time)
    return Crossings(target, time, *_polar(state, radar), state)


def make_echoes(
    crossings: Crossings, targets: Targets, radar: Radar, rng: np.random.Generator
) -> Echoes:
    """Compute what the pulses of each burst bring back.

    Every pulse sees its target where it is at that pulse's own time: its angle off the axis, its range cell, its
    distance by the fourth-power law and its carrier phase. Behind the matched filter an echo covers several cells,
    with one phase in all. A rectangular pulse as long as a cell becomes a triangle two cells wide: an echo between
    two cell centres is shared linearly, (1 - d) and d.

    Args:
        crossings: bursts to make.
        targets: all targets.
        radar: pattern, cells and pulse rate.
        rng: source of the fluctuations.

    Returns:
        Echoes of all bursts, in order of the pulses.
    """
    reach = pulses_to_either_side(radar)
    centre = np.rint(crossings.time / radar.pulse_interval).astype(np.int64)
    pulse = centre[:, None] + np.arange(-reach, reach + 1)
    target = np.broadcast_to(crossings.target[:, None], pulse.shape)
    time: FloatArray = np.multiply(pulse, radar.pulse_interval, dtype=float)
    distance, azimuth = _polar(targets.fleet.state(target, time), radar)
    distance = np.maximum(distance, radar.range_step / 2)
    alpha = wrap_pi(radar.azimuth(pulse) - azimuth) / radar.half_width
    snr_db = snr_db_at_range(radar, targets.snr_db[target], distance)
    factors = fluctuate(targets.fluctuation[crossings.target], pulse.shape[1], rng)
    carrier = np.exp(-2j * TWO_PI * np.mod(distance / radar.wavelength, 1.0))
    amplitude = amplitude_from_snr(snr_db) * radar.beam(alpha) * factors * carrier
    lit = (amplitude != 0.0) & (pulse >= 0) & targets.fleet.present(target, time)
    return into_cells(pulse[lit], distance[lit], amplitude[lit], radar)


def pulses_to_either_side(radar: Radar) -> int:
    """Bound how many pulses before and after its centre a burst can have.

    Args:
        radar: pattern and pulse rate.

    Returns:
        Number of pulses.
    """
    return int(np.ceil(radar.pulses_in_beam / 2 * radar.beam.extent * _RUN_ALONG)) + 1


def into_cells(
    pulse: IntArray, distance: FloatArray, amplitude: npt.NDArray[np.complex128], radar: Radar
) -> Echoes:
    """Share echoes among the cells that the pulse covers, by the distance of their centres.

    Args:
        pulse: number of each echo's pulse, shape (n,).
        distance: m, shape (n,).
        amplitude: over the rms of one quadrature of the noise, shape (n,).
        radar: range cells and the shape of the pulse in them.

    Returns:
        What falls into cells, in order of the pulses.
    """
    along = (distance - radar.range_start) / radar.range_step - 0.5
    near = np.floor(along).astype(np.int64)
    samples = radar.samples_per_pulse
    reach = math.ceil(radar.response.echo_extent * samples)
    offset = np.arange(1 - reach, reach + 1)[:, None]
    share = radar.response.echo((offset - (along - near)) / samples)
    cell = (near + offset).ravel()
    pulse = np.broadcast_to(pulse, share.shape).ravel()
    amplitude = (share * amplitude).ravel()
    inside = (cell >= 0) & (cell < radar.cells)
    order = np.argsort(pulse[inside], kind="stable")
    return Echoes(pulse[inside][order], cell[inside][order], amplitude[inside][order])


def _polar(state: State, radar: Radar) -> tuple[FloatArray, FloatArray]:
    return polar_from_enu(state.x - radar.x, state.y - radar.y)
