// SPDX-License-Identifier: Apache-2.0
#include "doc/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "text/encoding.hpp"

namespace lexican::codict::doc {

namespace {

constexpr unsigned bits_of_frame = 64;
constexpr unsigned bits_of_row = 8;
constexpr unsigned bit_width = 84;
constexpr unsigned row_height = 30;
constexpr unsigned left = 56;
constexpr unsigned top = 20;

// Box for the bits `low` … `low + count - 1` of byte `row`.
struct Box {
  unsigned row;
  unsigned low;
  unsigned count;
};

void draw(const Box& box, const PdoPart& part, bool is_first, std::string& svg) {
  const unsigned x = left + (bits_of_row - box.low - box.count) * bit_width;
  const unsigned y = top + box.row * row_height;
  const std::string name = escaped_html(part.number + " " + part.name);
  fmt::format_to(std::back_inserter(svg),
                 "<g class=\"part\" data-object=\"{}\"><title>{}</title>"
                 "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
                 part.number, name, x, y, box.count * bit_width, row_height);
  if (is_first) {
    // A character is about 7 wide. The title element has the complete text.
    const std::size_t letters = box.count * bit_width / 7;
    const std::string label = box.count * bit_width >= 2 * bit_width ? part.number + " " + part.name : part.number;
    fmt::format_to(std::back_inserter(svg), "<text x=\"{}\" y=\"{}\">{}</text>", x + 5, y + 20,
                   escaped_html(shortened_to(label, letters)));
  }
  svg += "</g>\n";
}

}  // namespace

std::string escaped_html(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\'': result += "&#39;"; break;
      default: result += static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return result;
}

std::string picture_of(const PdoItem& pdo) {
  const unsigned bits = std::min(pdo.bits, bits_of_frame);
  const unsigned rows = (bits + bits_of_row - 1) / bits_of_row;
  std::string svg =
      fmt::format("<svg class=\"pdo\" role=\"img\" aria-label=\"{}\" viewBox=\"0 0 {} {}\">\n", escaped_html(pdo.title),
                  left + bits_of_row * bit_width + 2, top + rows * row_height + 2);
  for (unsigned bit = 0; bit < bits_of_row; ++bit) {
    fmt::format_to(std::back_inserter(svg), "<text class=\"scale\" x=\"{}\" y=\"14\">{}</text>\n",
                   left + (bits_of_row - bit) * bit_width - bit_width / 2, bit);
  }
  for (unsigned row = 0; row < rows; ++row) {
    fmt::format_to(std::back_inserter(svg), "<text class=\"scale\" x=\"24\" y=\"{}\">byte {}</text>\n",
                   top + row * row_height + 20, row);
  }
  for (const PdoPart& part : pdo.parts) {
    const unsigned end = std::min(part.first_bit + part.bits, bits_of_frame);
    for (unsigned bit = part.first_bit; bit < end;) {
      const unsigned low = bit % bits_of_row;
      const unsigned count = std::min(bits_of_row - low, end - bit);
      draw({bit / bits_of_row, low, count}, part, bit == part.first_bit, svg);
      bit += count;
    }
  }
  return svg + "</svg>\n";
}

}  // namespace lexican::codict::doc
