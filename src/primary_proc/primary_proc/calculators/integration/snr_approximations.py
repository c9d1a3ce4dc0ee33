# SPDX-License-Identifier: Apache-2.0
"""Formulas for the signal-to-noise ratio that n integrated pulses need, for the back of an envelope.

`integrated_pulses` has the exact values; these are here because specifications and textbooks use them. Between a P_d of
0.3 and 0.9 Albersheim's formula is off by 0.3 dB at most, Shnidman's by 0.2 dB for the steady target and by 0.75 dB for
the others; below 0.2 Albersheim's fails (4 dB at P_fa = 1e-3, P_d = 0.1, one pulse).
"""

from __future__ import annotations

import math

from primary_proc.calculators.integration.integrated_pulses import ENERGY_DEGREES

_MANY = 40
_HIGH = 0.872


def albersheim_snr_db(false_alarm: float, detection: float, pulses: int) -> float:
    """Albersheim's formula for a steady target behind a linear detector.

    Source: W. J. Albersheim, Proc. IEEE 69, 1981; made for P_fa of 1e-7 to 1e-3, P_d of 0.1 to 0.9, to 8096 pulses.

    Args:
        false_alarm: P_fa, in (0, 0.62).
        detection: P_d, in (0, 1).
        pulses: n.

    Returns:
        dB for each pulse.

    Raises:
        ValueError: the probabilities give no value.
    """
    _check(false_alarm, detection, pulses)
    noise, target = math.log(0.62 / false_alarm), math.log(detection / (1.0 - detection))
    argument = noise + 0.12 * noise * target + 1.7 * target
    if argument <= 0.0:
        raise ValueError(f"the formula has no value at {false_alarm} and {detection}")
    slope = 6.2 + 4.54 / math.sqrt(pulses + 0.44)
    return -5.0 * math.log10(pulses) + slope * math.log10(argument)


def shnidman_snr_db(false_alarm: float, detection: float, pulses: int, target: str) -> float:
    """Shnidman's formula for the steady target and Swerling's cases 1 to 4 behind a square-law detector.

    Source: D. A. Shnidman, IEEE Trans. AES 38, 2002; made for P_fa of 1e-9 to 1e-3, P_d of 0.1 to 0.99, to 100 pulses.

    Args:
        false_alarm: P_fa.
        detection: P_d.
        pulses: n.
        target: name in `target_models.TARGETS`.

    Returns:
        dB for each pulse.

    Raises:
        ValueError: the probabilities give no value.
    """
    _check(false_alarm, detection, pulses)
    eta = _normal_quantile(false_alarm) + math.copysign(
        _normal_quantile(detection), detection - 0.5
    )
    shift = 0.25 if pulses >= _MANY else 0.0
    energy = eta * (eta + 2.0 * math.sqrt(pulses / 2.0 + shift - 0.25))
    if energy <= 0.0:
        raise ValueError(f"the formula has no value at {false_alarm} and {detection}")
    fluctuation = ((17.7006 * detection - 18.4496) * detection + 14.5339) * detection - 3.525
    if detection > _HIGH:
        few = 0.7 * math.log(1e-5 / false_alarm) + (2.0 * pulses - 20.0) / 80.0
        fluctuation += math.exp(27.31 * detection - 25.14) + (detection - 0.8) * few
    return fluctuation / ENERGY_DEGREES[target](pulses) + 10.0 * math.log10(energy / pulses)


def _normal_quantile(probability: float) -> float:
    return math.sqrt(-0.8 * math.log(4.0 * probability * (1.0 - probability)))


def _check(false_alarm: float, detection: float, pulses: int) -> None:
    if not (0.0 < false_alarm < 0.5 and 0.0 < detection < 1.0 and pulses >= 1):
        raise ValueError(
            f"no signal-to-noise ratio for {pulses} pulses at {false_alarm} and {detection}"
        )
