# SPDX-License-Identifier: Apache-2.0
"""One pulse of noise or of a target, and the burst that the beam makes of pulses."""
