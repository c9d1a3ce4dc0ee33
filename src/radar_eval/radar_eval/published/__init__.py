# SPDX-License-Identifier: Apache-2.0
"""Published results, each held against what the packages of this chain compute; one module a group of results."""
