# SPDX-License-Identifier: Apache-2.0
"""What a design will do: false alarms, detection, accuracy."""
