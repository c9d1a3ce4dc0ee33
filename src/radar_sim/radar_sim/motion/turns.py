# SPDX-License-Identifier: Apache-2.0
"""The way made on a leg, in closed form.

In complex numbers with north as the real and east as the imaginary axis, a unit vector of course Q is exp(iQ).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_SERIES_BELOW = 1e-2
# A leg continued backwards would come to a stand somewhere; before that it is not asked for.
_LEAST_CHANGE = -0.99


def displacement(
    speed: FloatArray | float,
    course: FloatArray | float,
    turn_rate: FloatArray | float,
    acceleration: FloatArray | float,
    elapsed: FloatArray | float,
) -> ComplexArray:
    """Way made at a constant turn rate: the integral of (V + a t) exp(i (Q + w t)).

    Args:
        speed: V at the beginning, m/s, any shape.
        course: Q at the beginning, rad clockwise from north.
        turn_rate: w, rad/s, positive clockwise.
        acceleration: a, along the course, m/s².
        elapsed: s since the beginning.

    Returns:
        Metres north + i east, broadcast shape.
    """
    t = np.asarray(elapsed, dtype=float)
    z = 1j * np.asarray(turn_rate, dtype=float) * t
    small = np.abs(z) < _SERIES_BELOW
    safe = np.where(small, 1.0, z)
    turned = np.exp(safe)
    # Moments 0 and 1 of exp(z s) over s in [0, 1]; near zero their closed forms lose all digits.
    zeroth = np.where(
        small, 1 + z / 2 * (1 + z / 3 * (1 + z / 4 * (1 + z / 5))), (turned - 1) / safe
    )
    first = np.where(
        small,
        1 / 2 + z * (1 / 3 + z * (1 / 8 + z * (1 / 30 + z / 144))),
        ((safe - 1) * turned + 1) / np.square(safe),
    )
    return np.exp(1j * np.asarray(course)) * t * (speed * zeroth + acceleration * t * first)


def centripetal_turn(
    speed: FloatArray | float,
    centripetal: FloatArray | float,
    acceleration: FloatArray | float,
    elapsed: FloatArray | float,
) -> tuple[FloatArray, ComplexArray]:
    """Turn and way made at constant accelerations across and along the course.

    V' = a and Q' = c / V (Kuzmin 1967, § 4.2.1, version A), so that Q = (c / a) ln(V / V0), and the integral of
    V exp(iQ) over time is one of a power of V.

    Args:
        speed: V0 at the beginning, m/s, above zero, any shape.
        centripetal: c, m/s², positive to the right.
        acceleration: a, m/s².
        elapsed: s since the beginning.

    Returns:
        Change of course in rad, and the way in metres along the first course + i metres to its right.
    """
    t = np.asarray(elapsed, dtype=float)
    change = np.maximum(np.asarray(acceleration) * t / speed, _LEAST_CHANGE)
    steady = np.abs(change) < _SERIES_BELOW**2
    safe = np.where(steady, 1.0, change)
    # ln(1 + q) / q, the shortening of time as seen by a turn that slows down with speed.
    slowing = np.where(steady, 1 - change / 2 * (1 - 2 * change / 3), np.log1p(safe) / safe)
    turn = np.asarray(centripetal) * t * slowing / speed
    z = 2.0 * np.log1p(change) + 1j * turn
    small = np.abs(z) < _SERIES_BELOW
    far = np.where(small, 1.0, z)
    mean = np.where(
        small, 1 + z / 2 * (1 + z / 3 * (1 + z / 4 * (1 + z / 5))), (np.exp(far) - 1) / far
    )
    return turn, np.asarray(speed * t * slowing * mean, dtype=complex)
