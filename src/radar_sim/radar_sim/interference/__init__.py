# SPDX-License-Identifier: Apache-2.0
"""What others transmit: the pulses of another radar and the noise of a jammer."""
