// SPDX-License-Identifier: Apache-2.0
/// \file assets.hpp
/// Styles and script of all HTML pages.
#pragma once

#include <string_view>

namespace lexican::codict::doc {

constexpr std::string_view style = R"css(
:root { color-scheme: light dark; --line: #8884; --soft: #8882; --part: #4a90d955; }
body { font: 15px/1.45 system-ui, sans-serif; max-width: 75rem; margin: 0 auto; padding: 0 1rem 4rem; }
header { position: sticky; top: 0; background: Canvas; padding: .6rem 0; border-bottom: 1px solid var(--line); }
h1, h3, p, th, td { overflow-wrap: anywhere; }
h1 { font-size: 1.5rem; margin: 0 0 .4rem; } h2 { margin-top: 2.2rem; } h3 { margin: 1.4rem 0 .3rem; }
input { font: inherit; width: 22rem; max-width: 60%; padding: .25rem .5rem; }
nav a { margin-right: .8rem; white-space: nowrap; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .2rem .5rem; border-bottom: 1px solid var(--line); }
tr:target, section:target > h3 { background: var(--part); }
td, p { white-space: pre-line; }
td.number, td.value { font-family: ui-monospace, monospace; } td.number { white-space: nowrap; }
svg.pdo { max-width: 46rem; width: 100%; display: block; font: 12px ui-monospace, monospace; fill: CanvasText; }
svg.pdo rect { fill: var(--part); stroke: CanvasText; stroke-width: 1; } svg.pdo .scale { text-anchor: middle; opacity: .6; }
@media (max-width: 45rem) {
  header { position: static; } nav a { white-space: normal; } thead { display: none; }
  table, tbody, tr { display: block; } tr { border-bottom: 1px solid var(--line); padding: .2rem 0; }
  td, th { display: block; border: 0; padding: 0 .5rem; } td:empty { display: none; }
}
[hidden] { display: none; }
@media print { header { position: static; } input { display: none; } }
)css";

// Search: shows the objects that contain all words. Rows without them are hidden, unless the object itself contains
// them. The query ?q=WORDS in the address starts a search when the page is opened.
constexpr std::string_view script = R"js(
'use strict';
const search = document.getElementById('search');
const found = document.getElementById('found');
const objects = Array.from(document.querySelectorAll('section.object'), section => ({
  section, text: section.querySelector('h3').textContent.toLowerCase(),
  rows: Array.from(section.querySelectorAll('tbody tr'), row => ({ row, text: row.textContent.toLowerCase() })) }));
function show() {
  const words = search.value.toLowerCase().split(/\s+/).filter(word => word !== '');
  const has = text => words.every(word => text.includes(word));
  let count = 0;
  for (const object of objects) {
    const whole = has(object.text);
    let any = whole;
    for (const { row, text } of object.rows) {
      const shown = whole || has(object.text + ' ' + text);
      row.hidden = !shown;
      any = any || shown;
    }
    object.section.hidden = !any;
    count += any ? 1 : 0;
  }
  for (const part of document.querySelectorAll('[data-beside-search]')) part.hidden = words.length > 0;
  found.textContent = words.length > 0 ? count + ' of ' + objects.length + ' objects' : objects.length + ' objects';
}
search.addEventListener('input', show);
window.addEventListener('hashchange', () => {
  if (search.value !== '') { search.value = ''; show(); document.getElementById(location.hash.slice(1))?.scrollIntoView(); }
});
search.value = new URLSearchParams(location.search).get('q') ?? '';
show();
)js";

}  // namespace lexican::codict::doc
