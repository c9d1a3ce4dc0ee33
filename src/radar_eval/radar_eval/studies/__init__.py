# SPDX-License-Identifier: Apache-2.0
"""Studies: what the chain does under conditions that are made for the question, measured and drawn."""
