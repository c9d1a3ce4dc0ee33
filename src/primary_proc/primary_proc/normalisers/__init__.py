# SPDX-License-Identifier: Apache-2.0
"""Ways to find the noise level of a cell."""
