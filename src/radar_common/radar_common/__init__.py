# SPDX-License-Identifier: Apache-2.0
"""The contract between the nodes: tables, frames, parameters and health."""
