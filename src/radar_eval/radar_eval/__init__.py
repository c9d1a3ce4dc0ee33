# SPDX-License-Identifier: Apache-2.0
"""Offline evaluation of radar recordings: import, offline runs, scores, reports, published numbers."""
