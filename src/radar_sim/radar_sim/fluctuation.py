# SPDX-License-Identifier: Apache-2.0
"""Fluctuation of a target's echo by name: what one burst's pulses are multiplied with.

Every model has mean power one. Phases start anew in every burst, as the aspect of a target does from turn to turn.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

ComplexArray = npt.NDArray[np.complex128]


def _steady(bursts: int, pulses: int, rng: np.random.Generator) -> ComplexArray:
    return np.broadcast_to(np.exp(2j * np.pi * rng.random((bursts, 1))), (bursts, pulses))


def _slow(bursts: int, pulses: int, rng: np.random.Generator) -> ComplexArray:
    return np.broadcast_to(_complex_normal((bursts, 1), rng), (bursts, pulses))


def _fast(bursts: int, pulses: int, rng: np.random.Generator) -> ComplexArray:
    return _complex_normal((bursts, pulses), rng)


def _slow_dominant(bursts: int, pulses: int, rng: np.random.Generator) -> ComplexArray:
    return np.broadcast_to(_dominant((bursts, 1), rng), (bursts, pulses))


def _fast_dominant(bursts: int, pulses: int, rng: np.random.Generator) -> ComplexArray:
    return _dominant((bursts, pulses), rng)


def _dominant(shape: tuple[int, int], rng: np.random.Generator) -> ComplexArray:
    """Power chi-squared with four degrees of freedom, at random phase."""
    amplitude = np.sqrt(rng.standard_gamma(2.0, shape) / 2.0)
    return np.asarray(amplitude * np.exp(2j * np.pi * rng.random(shape)))


def _complex_normal(shape: tuple[int, int], rng: np.random.Generator) -> ComplexArray:
    quadratures = rng.standard_normal((*shape, 2))
    return np.asarray((quadratures[..., 0] + 1j * quadratures[..., 1]) / np.sqrt(2.0))


FLUCTUATIONS: dict[str, Callable[[int, int, np.random.Generator], ComplexArray]] = {
    "none": _steady,
    "slow": _slow,
    "fast": _fast,
    "slow-dominant": _slow_dominant,
    "fast-dominant": _fast_dominant,
}
"""Kuzmin 1967, § 1.2: no fluctuation; one Rayleigh amplitude a burst (Swerling 1); one a pulse (Swerling 2).

With one dominant scatterer among many small ones the power has four degrees of freedom: once a burst (Swerling 3) or
once a pulse (Swerling 4); P. Swerling, IRE Trans. IT-6, 1960.

Each takes the number of bursts, of pulses in each and a generator, and returns factors of shape (bursts, pulses).
"""


def fluctuate(kinds: npt.NDArray[np.str_], pulses: int, rng: np.random.Generator) -> ComplexArray:
    """Draw the factors of several bursts, each by its own model.

    Args:
        kinds: name of each burst's model, shape (bursts,).
        pulses: number of pulses of every burst.
        rng: source of randomness.

    Returns:
        Factors with mean power one, shape (bursts, pulses).
    """
    factors = np.empty((len(kinds), pulses), dtype=complex)
    for name, draw in FLUCTUATIONS.items():
        chosen = np.flatnonzero(kinds == name)
        factors[chosen] = draw(len(chosen), pulses, rng)
    return factors
