# SPDX-License-Identifier: Apache-2.0
"""Two tracks side by side: how often they take each other's plots.

Source: Kuzmin 1967, § 4.7.5, (4.150)-(4.153). One coordinate; the distance m is over the standard deviation of the
difference between plot and prediction; both targets are seen, and there is nothing else.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq
from scipy.special import erf
from scipy.stats import norm

from secondary_proc.calculators.rule_chain import FloatArray

RULES = ("book", "nearest", "assignment")
_NODES = 64


def own_plot_probability(distance: npt.ArrayLike, sigmas: float | None = None) -> FloatArray:
    """Probability that one track's nearest plot is its own.

    Source: (4.152), its integral from zero and doubled; closed where the gate has no end.

    Args:
        distance: m, not negative, any shape.
        sigmas: half size of the gate, None for one without end.

    Returns:
        P_11, same shape.
    """
    m = np.asarray(distance, dtype=float)
    if sigmas is None:
        alone = norm.cdf(m / np.sqrt(2.0))
        return np.asarray(alone**2 + (1.0 - alone) ** 2)
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    x = (node + 1.0) * sigmas / 2.0
    nearer = erf((m[..., None] + x) / np.sqrt(2.0)) - erf((m[..., None] - x) / np.sqrt(2.0))
    return np.asarray(((1.0 - nearer / 2.0) * norm.pdf(x)) @ weight * sigmas)


def confusion_probability(
    distance: npt.ArrayLike, rule: str = "book", sigmas: float | None = None
) -> FloatArray:
    """Probability that not both tracks get their own plot in a scan.

    Source: (4.153) for "book", which takes the errors of both tracks as independent.

    Args:
        distance: m, not negative, any shape.
        rule: "book"; "nearest" for the same choice without that assumption; "assignment" where each plot goes to one
            track only and the sum of squared distances is least, as the tracker's association does.
        sigmas: half size of the gate for "book", None for one without end.

    Returns:
        Probability, same shape.

    Raises:
        ValueError: there is no such rule.
    """
    if rule == "book":
        return np.asarray(1.0 - own_plot_probability(distance, sigmas) ** 2)
    alone = norm.cdf(np.asarray(distance, dtype=float) / np.sqrt(2.0))
    if rule == "nearest":
        return np.asarray(1.0 - alone * (2.0 * alone - 1.0))
    if rule == "assignment":
        return np.asarray(1.0 - alone)
    raise ValueError(f"no rule {rule!r}; there are {', '.join(RULES)}")


def resolved_distance(confusion: float, rule: str = "book", sigmas: float | None = None) -> float:
    """Distance at which confusion has a wanted probability.

    Args:
        confusion: probability in a scan, less than that of tracks in one place and more than the gate alone costs.
        rule: as for `confusion_probability`.
        sigmas: as there.

    Returns:
        m.

    Raises:
        ValueError: there is no such rule, or no such distance.
    """
    return float(
        brentq(lambda m: float(confusion_probability(m, rule, sigmas)) - confusion, 0.0, 12.0)
    )
