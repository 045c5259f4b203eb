# SPDX-License-Identifier: Apache-2.0
about="the rules of inclusion between the rooms, and that their violation is found"
minutes=1
packages=(python3)

lane() {
  run_tap python3 "$root/tests/lanes/layers.py" "$root"
  run_tap python3 "$root/tests/lanes/layers.py" --self-test
}
