# SPDX-License-Identifier: Apache-2.0
"""How well the azimuth of a burst is known, and can be."""
