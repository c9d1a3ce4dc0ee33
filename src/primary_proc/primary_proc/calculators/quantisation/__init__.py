# SPDX-License-Identifier: Apache-2.0
"""Quantisation in amplitude and in time, and what it costs."""
