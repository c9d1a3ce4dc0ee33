# SPDX-License-Identifier: Apache-2.0
"""Bearings of active and passive channels to fused bearings and located emitters."""
