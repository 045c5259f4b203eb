// SPDX-License-Identifier: Apache-2.0
#include "network/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include "doc/picture.hpp"
#include "text/encoding.hpp"

namespace lexican::codict::network {

namespace {

using doc::escaped_html;

constexpr std::size_t boxes_of_row = 5;
constexpr std::size_t box_width = 160;
constexpr std::size_t box_height = 58;
constexpr std::size_t box_gap = 24;
constexpr std::size_t row_height = 110;
constexpr std::size_t left = 20;

void draw_node(const Node& node, std::size_t tpdos, std::size_t rpdos, std::size_t at, std::string& svg) {
  const std::size_t x = left + at % boxes_of_row * (box_width + box_gap);
  const std::size_t y = 10 + at / boxes_of_row * row_height;
  fmt::format_to(std::back_inserter(svg),
                 "<g><title>{}</title><rect{} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"4\"/>"
                 "<text x=\"{}\" y=\"{}\">{}</text><text x=\"{}\" y=\"{}\">node-ID {}</text>"
                 "<text class=\"soft\" x=\"{}\" y=\"{}\">{} TPDO, {} RPDO</text>"
                 "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/></g>\n",
                 escaped_html(node.title()), node.is_master ? " class=\"master\"" : "", x, y, box_width, box_height,
                 x + 8, y + 18, escaped_html(shortened_to(node.name, 21)), x + 8, y + 34, node.node_id, x + 8, y + 50,
                 tpdos, rpdos, x + box_width / 2, y + box_height, x + box_width / 2, y + box_height + 22);
}

constexpr std::size_t line_height = 22;
constexpr std::size_t column_width = 250;
constexpr std::size_t picture_width = 900;

// Returns the row of each PDO of one direction, sorted by COB-ID; the keys are indexes in Links::pdos.
std::map<std::size_t, std::size_t> column_of(const Links& links, bool is_transmit) {
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < links.pdos.size(); ++n) {
    if (links.pdos[n].pdo.is_transmit == is_transmit) {
      order.push_back(n);
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&links](std::size_t a, std::size_t b) { return links.pdos[a].key() < links.pdos[b].key(); });
  std::map<std::size_t, std::size_t> rows;
  for (std::size_t row = 0; row < order.size(); ++row) {
    rows[order[row]] = row;
  }
  return rows;
}

std::size_t middle_of(std::size_t row) { return 14 + row * line_height; }

void draw_column(const Network& network, const Links& links, const std::map<std::size_t, std::size_t>& rows,
                 bool is_transmit, std::string& svg) {
  for (const auto& [index, row] : rows) {
    const ActivePdo& pdo = links.pdos[index];
    const std::string label = fmt::format("{} {} {}", cob_id_text(pdo.identifier, pdo.is_extended),
                                          network.nodes[pdo.node].name, pdo.title());
    const std::size_t x = is_transmit ? 0 : picture_width - column_width;
    fmt::format_to(std::back_inserter(svg),
                   "<g><title>{0}</title><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/>"
                   "<text x=\"{5}\" y=\"{6}\">{7}</text></g>\n",
                   escaped_html(label), x, middle_of(row) - 9, column_width, line_height - 4, x + 6, middle_of(row) + 4,
                   escaped_html(shortened_to(label, 34)));
  }
}

}  // namespace

std::string bus_picture(const Network& network, const Links& links) {
  const std::size_t rows = (network.nodes.size() + boxes_of_row - 1) / boxes_of_row;
  const std::size_t width = 2 * left + boxes_of_row * (box_width + box_gap) - box_gap;
  std::string svg =
      fmt::format("<svg class=\"network\" role=\"img\" aria-label=\"Nodes on the bus\" viewBox=\"0 0 {} {}\">\n", width,
                  rows * row_height);
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    const auto count = [&](bool is_transmit) {
      return static_cast<std::size_t>(std::count_if(links.pdos.begin(), links.pdos.end(), [&](const ActivePdo& pdo) {
        return pdo.node == n && pdo.pdo.is_transmit == is_transmit;
      }));
    };
    draw_node(network.nodes[n], count(true), count(false), n, svg);
  }
  constexpr std::size_t bus = 10 + box_height + 22;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t y = bus + row * row_height;
    fmt::format_to(std::back_inserter(svg), "<line class=\"bus\" x1=\"8\" y1=\"{0}\" x2=\"{1}\" y2=\"{0}\"/>\n", y,
                   width - 8);
    if (row != 0) {
      fmt::format_to(std::back_inserter(svg), "<line class=\"bus\" x1=\"8\" y1=\"{}\" x2=\"8\" y2=\"{}\"/>\n",
                     y - row_height, y);
    }
  }
  return svg + "</svg>\n";
}

std::string link_picture(const Network& network, const Links& links) {
  const std::map<std::size_t, std::size_t> producers = column_of(links, true);
  const std::map<std::size_t, std::size_t> consumers = column_of(links, false);
  const std::size_t rows = std::max(producers.size(), consumers.size());
  if (rows == 0) {
    return {};
  }
  std::string svg = fmt::format("<svg class=\"network\" role=\"img\" aria-label=\"PDO links\" viewBox=\"0 0 {} {}\">\n",
                                picture_width, middle_of(rows));
  draw_column(network, links, producers, true, svg);
  draw_column(network, links, consumers, false, svg);
  for (const Link& link : links.links) {
    const std::size_t from = middle_of(producers.at(link.producer));
    const std::size_t to = middle_of(consumers.at(link.consumer));
    constexpr std::size_t begin = column_width;
    constexpr std::size_t end = picture_width - column_width;
    fmt::format_to(std::back_inserter(svg), "<path d=\"M{0} {1} C{2} {1} {2} {3} {4} {3}\"/>\n", begin, from,
                   (begin + end) / 2, to, end);
  }
  return svg + "</svg>\n";
}

}  // namespace lexican::codict::network
