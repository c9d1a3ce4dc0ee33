# SPDX-License-Identifier: Apache-2.0
"""What an evaluation is worth in numbers, one question a module."""
