# SPDX-License-Identifier: Apache-2.0
"""A surveillance radar to test against: sweeps with targets and noise, and the truth."""
