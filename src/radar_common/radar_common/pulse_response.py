# SPDX-License-Identifier: Apache-2.0
"""What the receiver's filter makes of a pulse and of noise along range, by name.

The argument is nu, the time over the pulse length. A rectangular pulse as long as the cell's nominal length gives a
triangle, and so does white noise behind its matched filter. A Gaussian pulse exp(-pi nu^2) behind its matched filter
comes out as exp(-pi nu^2 / 2), and so does the correlation of noise. Kuzmin (1967, 2.18-2.21) takes the pulse itself
for the output, and gives the noise a correlation in which an angular bandwidth stands for one in hertz: noise that
changes 2.5 times as fast. His numbers need his own pair, so it is kept whole, under its own name.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PulseResponse:
    """A receiver along range.

    Attributes:
        echo: amplitude of a point target's echo at the distance nu from its middle, one there.
        slope: derivative of `echo`.
        correlation: correlation of each quadrature of the noise at the distance nu.
        bandwidth: delta-omega, root of minus the second derivative of `correlation` at zero; infinite where the
            correlation has an edge there.
        echo_extent: nu beyond which the echo is left out.
        noise_extent: nu beyond which noise is independent.
    """

    echo: Callable[[FloatArray], FloatArray]
    slope: Callable[[FloatArray], FloatArray]
    correlation: Callable[[FloatArray], FloatArray]
    bandwidth: float
    echo_extent: float
    noise_extent: float


def _triangle(nu: FloatArray) -> FloatArray:
    return np.maximum(1.0 - np.abs(nu), 0.0)


def _triangle_slope(nu: FloatArray) -> FloatArray:
    return np.where(np.abs(nu) < 1.0, -np.sign(nu), 0.0)


def _gaussian(echo: float, noise: float) -> PulseResponse:
    """Echo exp(-echo nu^2), correlation exp(-noise nu^2)."""
    # An echo is cut 60 dB below its peak; a cut in the correlation would spread over all lines of its spectrum.
    return PulseResponse(
        lambda nu: np.exp(-echo * np.square(nu)),
        lambda nu: -2.0 * echo * nu * np.exp(-echo * np.square(nu)),
        lambda nu: np.exp(-noise * np.square(nu)),
        math.sqrt(2.0 * noise),
        math.sqrt(math.log(1e3) / echo),
        math.sqrt(math.log(1e12) / noise),
    )


PULSE_RESPONSES = {
    "rectangular": PulseResponse(_triangle, _triangle_slope, _triangle, math.inf, 1.0, 1.0),
    "gaussian": _gaussian(math.pi / 2.0, math.pi / 2.0),
    "gaussian-book": _gaussian(math.pi, math.pi**2),
}
"""A rectangular and a Gaussian pulse with their matched filters, and the book's Gaussian pulse and noise."""
