# SPDX-License-Identifier: Apache-2.0
"""Secondary processing of radar plots: plots to tracks."""
