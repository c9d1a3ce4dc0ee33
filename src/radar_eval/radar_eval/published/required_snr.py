# SPDX-License-Identifier: Apache-2.0
"""Signal-to-noise ratio that each of n non-coherently integrated pulses needs behind a square-law detector.

Exact after J. I. Marcum (1947) and P. Swerling (1954), and by the formulas of W. J. Albersheim, Proc. IEEE 69, 1981,
and D. A. Shnidman, IEEE Trans. AES 38, 2002. The values are these, evaluated; one is printed in the documentation of
the library sdr.
"""

from __future__ import annotations

from collections.abc import Iterator

from primary_proc.calculators.integration.integrated_pulses import integrated_snr_db
from primary_proc.calculators.integration.snr_approximations import (
    albersheim_snr_db,
    shnidman_snr_db,
)
from radar_eval.published.result import Row

_TARGETS = ("steady", "slow", "fast", "slow-dominant", "fast-dominant")
# Half a unit of the last digit, and the 2e-6 dB that one of the values was inverted to.
_DECIBELS = 7e-6
_SDR = 13.183490056794499

# P_fa, n, P_d; exact for Swerling 0 to 4; Albersheim's formula; Shnidman's for Swerling 0 to 4; all in dB.
_TABLE = """
1e-4  1 0.5 9.39795 10.89471 10.89471 10.08763 10.08763 9.39560 9.42563 10.76775 10.76775 10.09669 10.09669
1e-4  1 0.8 11.01265 16.05040 16.05040 13.56829 13.56829 10.96525 11.03994 16.39702 16.39702 13.71848 13.71848
1e-4  1 0.9 11.74908 19.36601 19.36601 15.59938 15.59938 11.67432 11.76271 19.66474 19.66474 15.71373 15.71373
1e-4 10 0.5 2.21558 3.71665 2.32754 2.90331 2.26737 2.15737 2.34636 3.68848 2.48057 3.01742 2.41346
1e-4 10 0.8 3.53120 8.79579 4.13867 6.25900 3.84353 3.35310 3.63914 8.99622 4.17485 6.31768 3.90699
1e-4 10 0.9 4.13774 12.09300 5.06533 8.25012 4.61794 3.89325 4.22366 12.14819 5.01611 8.18592 4.61989
1e-4 20 0.5 0.30978 1.80951 0.35919 0.99490 0.33270 0.27492 0.39086 1.73298 0.45796 1.06192 0.42441
1e-4 20 0.8 1.54245 6.87061 1.86701 4.32043 1.70790 1.40761 1.60796 6.96504 1.87581 4.28650 1.74188
1e-4 20 0.9 2.11120 10.16343 2.61218 6.30174 2.36818 1.91929 2.15773 10.10726 2.55521 6.13250 2.35647
1e-6  1 0.5 11.24255 12.77187 12.77187 11.95371 11.95371 11.23198 11.17161 12.51374 12.51374 11.84268 11.84268
1e-6  1 0.8 12.56539 17.84711 17.84711 15.30520 15.30520 12.51078 12.50897 17.86605 17.86605 15.18751 15.18751
1e-6  1 0.9 13.18349 21.14364 21.14364 17.29596 17.29596 13.11454 13.12169 21.34608 21.34608 17.23389 17.23389
1e-6 10 0.5 3.65145 5.18673 3.77144 4.36484 3.70708 3.55629 3.74535 5.08747 3.87956 4.41641 3.81245
1e-6 10 0.8 4.74949 10.21457 5.42514 7.63656 5.10254 4.53045 4.83134 10.18842 5.36705 7.50988 5.09919
1e-6 10 0.9 5.26749 13.49956 6.29185 9.60135 5.80624 4.99039 5.33364 13.58053 6.15833 9.45709 5.74599
1e-6 20 0.5 1.65609 3.19153 1.71017 2.36878 1.68113 1.60009 1.70787 3.04999 1.77497 2.37893 1.74142
1e-6 20 0.8 2.68456 8.20675 3.05160 5.61891 2.87394 2.52290 2.72916 8.08625 2.99702 5.40770 2.86309
1e-6 20 0.9 3.17040 11.48865 3.73186 7.57657 3.46188 2.95859 3.20152 11.47341 3.61511 7.33746 3.40831
"""


def required_snr() -> Iterator[Row]:
    """Compute the table.

    Yields:
        Exact values and approximations, row by row.
    """
    for line in _TABLE.split("\n")[1:-1]:
        false_alarm, number, detection, *rest = line.split()
        point = float(false_alarm), float(detection), int(number)
        values = [float(value) for value in rest]
        place = f"P_fa = {point[0]:g}, P_d = {point[1]:g}, n = {point[2]}"
        for case, target in enumerate(_TARGETS):
            ours = integrated_snr_db(*point, target)
            yield Row(f"{place}: Swerling {case}, dB", None, values[case], ours, _DECIBELS)
        ours = albersheim_snr_db(*point)
        yield Row(f"{place}: Albersheim, dB", None, values[5], ours, _DECIBELS)
        for case, target in enumerate(_TARGETS):
            ours = shnidman_snr_db(*point, target)
            label = f"{place}: Shnidman, Swerling {case}, dB"
            yield Row(label, None, values[6 + case], ours, _DECIBELS)
    ours = integrated_snr_db(1e-6, 0.9, 1, "steady")
    yield Row("sdr.min_snr(0.9, 1e-6), dB", _SDR, _SDR, ours, 1e-9)
