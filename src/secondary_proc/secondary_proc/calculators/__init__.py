# SPDX-License-Identifier: Apache-2.0
"""What a tracker's design will do: false tracks, detection, accuracy, gates."""
