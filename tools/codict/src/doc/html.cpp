// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "doc/assets.hpp"
#include "doc/contents.hpp"
#include "doc/picture.hpp"

namespace lexican::codict::doc {

namespace {

class HtmlPage {
 public:
  // Appends formatted HTML. All arguments are escaped, because they may be texts of the description.
  template <typename... Arguments>
  void write(fmt::format_string<decltype(std::string(std::declval<Arguments>()))...> form,
             const Arguments&... arguments) {
    fmt::format_to(std::back_inserter(text_), form, escaped_html(arguments)...);
  }
  void raw(std::string_view html) { text_ += html; }
  std::string take_text() { return std::move(text_); }

 private:
  std::string text_;
};

void write_facts(std::string_view title, const std::vector<Fact>& facts, HtmlPage& page) {
  if (facts.empty()) {
    return;
  }
  page.write("<h2>{}</h2>\n<table><tbody>\n", title);
  for (const Fact& fact : facts) {
    page.write("<tr><th>{}</th><td>{}</td></tr>\n", fact.name, fact.value);
  }
  page.raw("</tbody></table>\n");
}

void write_cob_ids(const std::vector<CobIdRow>& rows, const Options& options, HtmlPage& page) {
  page.write("<h2 id=\"cob-ids\">COB-IDs of node {}</h2>\n", std::to_string(options.node_id));
  page.raw("<table><thead><tr><th>COB-ID</th><th>service</th><th>from</th></tr></thead><tbody>\n");
  for (const CobIdRow& row : rows) {
    page.write("<tr><td class=\"number\">{}</td><td>{}</td><td>{}</td></tr>\n", row.identifier, row.service,
               row.source);
  }
  page.raw("</tbody></table>\n");
}

void write_pdos(const std::vector<PdoItem>& pdos, HtmlPage& page) {
  if (pdos.empty()) {
    return;
  }
  page.raw("<h2 id=\"pdos\">PDOs</h2>\n");
  for (const PdoItem& pdo : pdos) {
    page.write("<h3 id=\"{}\">{}</h3>\n<p>COB-ID {}; {}; {} bits.</p>\n", pdo.anchor, pdo.title,
               pdo.cob_id.empty() ? std::string("?") : pdo.cob_id,
               pdo.transmission.empty() ? std::string("?") : pdo.transmission, std::to_string(pdo.bits));
    if (!pdo.parts.empty()) {
      page.raw(picture_of(pdo));
    }
  }
}

void write_remarks(const Item& item, HtmlPage& page) {
  if (!item.unit.empty()) {
    page.write("Unit: {}. ", item.unit);
  }
  if (!item.range.empty()) {
    page.write("Range: {}. ", item.range);
  }
  if (!item.group.empty()) {
    page.write("Stored in {}. ", item.group);
  }
  for (const std::string& words : item.words) {
    page.write("{} ", words);
  }
  for (const Fact& allowed : item.allowed) {
    page.write("<br>{}: {}", allowed.name, allowed.value);
  }
}

// Writes a table row. The anchor of an object without sub-objects is at its section, not at its row.
void write_row(const Item& item, bool is_sub, HtmlPage& page) {
  page.raw("<tr");
  if (is_sub) {
    page.write(" id=\"{}\"", item.anchor);
  }
  page.write("><td class=\"number\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"value\">{}",
             item.number, item.name, item.type, item.access, item.mapping, item.default_value);
  if (!item.value.empty()) {
    page.write(" → {}", item.value);
  }
  page.raw("</td><td>");
  write_remarks(item, page);
  page.raw("</td></tr>\n");
}

void write_object(const ObjectItem& object, HtmlPage& page) {
  page.write("<section class=\"object\" id=\"{}\"><h3>{} {}</h3>\n", object.object.anchor, object.object.number,
             object.object.name);
  if (object.has_subs) {
    page.write("<p>{}. ", object.object.type);
    write_remarks(object.object, page);
    page.raw("</p>\n");
  }
  page.raw(
      "<table><thead><tr><th>object</th><th>name</th><th>type</th><th>access</th><th>PDO</th><th>default</th>"
      "<th>remarks</th></tr></thead><tbody>\n");
  if (!object.has_subs) {
    write_row(object.object, false, page);
  }
  for (const Item& sub : object.subs) {
    write_row(sub, true, page);
  }
  page.raw("</tbody></table></section>\n");
}

void write_chapters(const std::vector<Chapter>& chapters, HtmlPage& page) {
  for (const Chapter& chapter : chapters) {
    page.write("<h2 id=\"{}\">{}</h2>\n", chapter.anchor, chapter.title);
    if (!chapter.words.empty()) {
      page.write("<p>{}</p>\n", chapter.words);
    }
    for (const ObjectItem& object : chapter.objects) {
      write_object(object, page);
    }
  }
}

void write_header(const Contents& contents, HtmlPage& page) {
  page.write("<header><h1>{}</h1>\n", contents.title);
  page.raw("<label>Search <input id=\"search\" type=\"search\" placeholder=\"2000, speed, RPDO …\"></label>\n");
  page.raw("<output id=\"found\"></output>\n<nav><a href=\"#cob-ids\">COB-IDs</a>");
  if (!contents.pdos.empty()) {
    page.raw("<a href=\"#pdos\">PDOs</a>");
  }
  for (const Chapter& chapter : contents.chapters) {
    page.write("<a href=\"#{}\">{}</a>", chapter.anchor, chapter.title);
  }
  page.raw("</nav></header>\n");
}

}  // namespace

std::string html(const Device& device, const Options& options) {
  const Contents contents = contents_of(device, options);
  HtmlPage page;
  page.write("<!DOCTYPE html>\n<html lang=\"{}\"><head><meta charset=\"utf-8\">", options.language);
  page.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
  page.write("<title>{}</title>\n<style>", contents.title);
  page.raw(style);
  page.raw("</style></head><body>\n");
  write_header(contents, page);
  page.raw("<main>\n<div data-beside-search>\n");
  write_facts("Device", contents.identity, page);
  write_facts("Features", contents.features, page);
  write_cob_ids(contents.cob_ids, options, page);
  write_pdos(contents.pdos, page);
  page.raw("</div>\n");
  write_chapters(contents.chapters, page);
  page.raw("</main>\n<script>");
  page.raw(script);
  page.raw("</script></body></html>\n");
  return page.take_text();
}

}  // namespace lexican::codict::doc
