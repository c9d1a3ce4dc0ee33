# SPDX-License-Identifier: Apache-2.0
"""Finite automata of the detectors, and the Markov chains that they are in noise and signal."""
