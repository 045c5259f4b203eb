# SPDX-License-Identifier: Apache-2.0
about="the site of the documentation: it builds without a warning, its links lead somewhere, and it loads nothing from other machines"
minutes=1
packages=(mkdocs mkdocs-material=/usr/share/mkdocs/themes/material/mkdocs_theme.yml graphviz=dot python3)

lane() {
  local site=$build/site
  check "the site builds without a warning" "$root/docs/run" --build || return
  run_tap python3 "$root/docs/site/check.py" "$site/html"
  check "found: a page that loads from elsewhere" planted '<script src="https://example.org/a.js"></script>'
  check "found: a link that leads nowhere" planted '<a href="../nowhere/">nowhere</a>'
}

planted() {  # HTML
  rm -rf "$results/site-planted"
  mkdir -p "$results/site-planted"
  echo "$1" >"$results/site-planted/index.html"
  ! python3 "$root/docs/site/check.py" "$results/site-planted"
}
