# SPDX-License-Identifier: Apache-2.0
about="the documentation site: builds without warnings, comments for every symbol of the headers, valid links, no content from other hosts"
minutes=1
packages=(mkdocs mkdocs-material=/usr/share/mkdocs/themes/material/mkdocs_theme.yml graphviz=dot doxygen python3)

lane() {
  local site=$build/site
  check "the site builds without a warning" "$root/docs/run" --build || return
  run_tap python3 "$root/docs/site/check.py" "$site/html"
  check "found: a page that loads from elsewhere" planted '<script src="https://example.org/a.js"></script>'
  check "found: a link that leads nowhere" planted '<a href="../nowhere/">nowhere</a>'
  check "the API reference accepts a documented header" reference '/// \file planted.hpp' '/// A header.' '' \
    'int a();  ///< returns 0'
  check "found: a header without comment" undocumented '/// A function.' 'int a();'
  local symbol
  for symbol in 'int a();' 'namespace co { int a(); }' 'namespace co { inline constexpr int a = 1; }' '#define A 1' \
    'struct A {};' 'typedef int A;' $'/// A\nstruct A { int a; };' $'/// A\nclass A { public: int a(); };' \
    $'/// A\nenum A { a };'; do
    check "found: no comment in: ${symbol//$'\n'/ }" undocumented '/// \file planted.hpp' '/// A header.' '' "$symbol"
  done
}

# Makes the API reference of a header.
reference() {  # LINE...
  printf '%s\n' "$@" >"$results/planted.hpp"
  "$root/docs/site/reference.sh" "$root" "$results/reference" "$results/planted.hpp"
}

undocumented() {  # LINE...
  local said
  ! said=$(reference "$@" 2>&1) && grep ' has no comment$' <<<"$said"
}

planted() {  # HTML
  rm -rf "$results/site-planted"
  mkdir -p "$results/site-planted"
  echo "$1" >"$results/site-planted/index.html"
  ! python3 "$root/docs/site/check.py" "$results/site-planted"
}
