# SPDX-License-Identifier: Apache-2.0
"""Ways to detect bursts: quantiser, detector and the calculators that set them up, under one name."""
