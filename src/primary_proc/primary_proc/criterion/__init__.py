# SPDX-License-Identifier: Apache-2.0
"""Control of the detection criterion: where it is raised so that clutter does not flood the plots."""
