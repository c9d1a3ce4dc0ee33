# SPDX-License-Identifier: Apache-2.0
"""Curves of a design; needs matplotlib, which no node does."""
