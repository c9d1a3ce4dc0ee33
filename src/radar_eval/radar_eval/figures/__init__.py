# SPDX-License-Identifier: Apache-2.0
"""The pictures of a report, one a module, all drawn from an evaluation."""
