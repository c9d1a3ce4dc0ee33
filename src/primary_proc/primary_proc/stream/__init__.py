# SPDX-License-Identifier: Apache-2.0
"""From sector messages to one unbroken stream of pulses."""
