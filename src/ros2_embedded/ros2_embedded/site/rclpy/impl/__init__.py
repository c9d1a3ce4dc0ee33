# SPDX-License-Identifier: Apache-2.0
"""Inner parts of the client library that programs import by name."""
