# SPDX-License-Identifier: Apache-2.0
"""Emitters located from bearings that a moving observer takes."""
