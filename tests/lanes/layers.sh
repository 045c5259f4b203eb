# SPDX-License-Identifier: Apache-2.0
about="the include rules between modules and the tags of rules in the tests, with self-tests"
minutes=1
packages=(python3)

lane() {
  run_tap python3 "$root/tests/lanes/layers.py" "$root"
  run_tap python3 "$root/tests/lanes/layers.py" --self-test
  run_tap python3 "$root/tests/stack/conformance/rules.py" "$root"
  run_tap python3 "$root/tests/stack/conformance/rules.py" --self-test
}
