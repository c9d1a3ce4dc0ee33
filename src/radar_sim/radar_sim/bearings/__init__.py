# SPDX-License-Identifier: Apache-2.0
"""Bearings from a direction finder and angles from an active channel, with jamming, silence and the truth."""
