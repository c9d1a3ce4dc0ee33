# SPDX-License-Identifier: Apache-2.0
"""Unwanted echoes: land and sea in patches, rain that drifts, and fixed strong scatterers."""
