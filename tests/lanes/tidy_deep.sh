# SPDX-License-Identifier: Apache-2.0
. "$root/tests/lanes/tidy.sh"
about="clang-tidy over src, drivers and codict, with the default limit of its analyzer"
unset minutes
packages+=("${tool_packages[@]}")
places=(src drivers tools/codict/src)
with_tools=ON
limits=()
