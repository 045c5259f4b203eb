# SPDX-License-Identifier: Apache-2.0
. "$root/tests/lanes/tidy.sh"
about="clang-tidy over tools"
unset minutes
packages+=("${tool_packages[@]}")
places=(tools)
with_tools=ON
