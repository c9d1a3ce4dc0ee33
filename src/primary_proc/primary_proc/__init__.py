# SPDX-License-Identifier: Apache-2.0
"""Primary processing of radar video: sweeps to plots."""
