# SPDX-License-Identifier: Apache-2.0
"""Cell averaging on video with several samples in a pulse: reference cells that are correlated count for fewer."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from radar_common.pulse_response import PulseResponse

FloatArray = npt.NDArray[np.float64]


def effective_reference_cells(
    reference_cells: int, samples_per_pulse: float, response: PulseResponse
) -> float:
    """Number of independent cells whose average scatters as much as that of correlated ones.

    Powers are correlated by the square of what their quadratures are, and the two sides are taken as independent.

    Args:
        reference_cells: on each side.
        samples_per_pulse: range cells in a pulse length.
        response: pulse and noise along range.

    Returns:
        Equivalent number on both sides together, at most twice the reference cells.
    """
    lag = np.arange(1, reference_cells)
    shared = np.square(response.correlation(lag / samples_per_pulse)) * (
        1.0 - lag / reference_cells
    )
    return float(2.0 * reference_cells / (1.0 + 2.0 * shared.sum()))


def averaging_exceedance(threshold: npt.ArrayLike, effective_cells: float) -> FloatArray:
    """Probability that noise exceeds a multiple of the average of its reference cells.

    Exact for independent cells; correlated ones are put in their place by their number, as if their average still
    had a gamma law.

    Source: P. P. Gandhi, S. A. Kassam, IEEE Trans. AES 24, 1988, (7), for the law.

    Args:
        threshold: multiple of the average, any shape.
        effective_cells: number of independent cells, see `effective_reference_cells`.

    Returns:
        p_N, same shape.
    """
    multiple = np.asarray(threshold, dtype=float)
    return np.asarray(np.exp(-effective_cells * np.log1p(multiple / effective_cells)))


def averaging_threshold(probability: npt.ArrayLike, effective_cells: float) -> FloatArray:
    """Multiple of the average that noise exceeds with a given probability; inverse of the above.

    Args:
        probability: p_N in (0, 1), any shape.
        effective_cells: number of independent cells.

    Returns:
        Multiple, same shape.
    """
    rare = -np.log(np.asarray(probability, dtype=float)) / effective_cells
    return np.asarray(effective_cells * np.expm1(rare))
