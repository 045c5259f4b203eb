# SPDX-License-Identifier: Apache-2.0
about="mutants of src, each of which the doctest cases or the C programs must kill"
packages=("${build_packages[@]}" python3)

# Prints all mutants: a developer reads what has killed them.
lane() {
  run_tap python3 -B "$root/tests/lanes/mutants.py" --root "$root" --work "$build/mutate" --number "$mutants" --seed "$seed"
  cat "$results/mutate.tap"
}
