# SPDX-License-Identifier: Apache-2.0
about="the rules of inclusion between the rooms, the tags of rules in the tests, and that a violation is found"
minutes=1
packages=(python3)

lane() {
  run_tap python3 "$root/tests/lanes/layers.py" "$root"
  run_tap python3 "$root/tests/lanes/layers.py" --self-test
  run_tap python3 "$root/tests/conformance/rules.py" "$root"
  run_tap python3 "$root/tests/conformance/rules.py" --self-test
}
