# SPDX-License-Identifier: Apache-2.0
"""Corrections of a Gaussian density by one bearing."""
