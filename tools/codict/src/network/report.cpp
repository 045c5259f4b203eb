// SPDX-License-Identifier: Apache-2.0
#include "network/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "doc/assets.hpp"
#include "doc/picture.hpp"
#include "eds/write.hpp"
#include "network/concise.hpp"
#include "network/picture.hpp"

namespace lexican::codict::network {

namespace {

using doc::escaped_html;

constexpr std::string_view own_style = R"css(
svg.network { max-width: 60rem; width: 100%; display: block; font: 12px ui-monospace, monospace; fill: CanvasText; }
svg.network rect { fill: var(--part); stroke: CanvasText; } svg.network .master { stroke-width: 2.5; }
svg.network line, svg.network path { stroke: CanvasText; fill: none; } svg.network .bus { stroke-width: 3; }
svg.network .soft { opacity: .7; } .scroll { overflow-x: auto; }
td.error { color: #c33; font-weight: bold; } td.warning { color: #b70; font-weight: bold; }
)css";

class Page {
 public:
  void raw(std::string_view html) { text_ += html; }
  void heading(std::string_view anchor, std::string_view title) {
    text_ += fmt::format("<h2 id=\"{}\">{}</h2>\n", anchor, escaped_html(title));
  }
  void begin_table(const std::vector<std::string_view>& columns) {
    text_ += "<div class=\"scroll\"><table><thead><tr>";
    for (const std::string_view column : columns) {
      text_ += fmt::format("<th>{}</th>", escaped_html(column));
    }
    text_ += "</tr></thead><tbody>\n";
  }
  void row(const std::vector<std::string>& cells) {
    text_ += "<tr>";
    for (const std::string& cell : cells) {
      text_ += fmt::format("<td>{}</td>", escaped_html(cell));
    }
    text_ += "</tr>\n";
  }
  void end_table() { text_ += "</tbody></table></div>\n"; }
  std::string take_text() { return std::move(text_); }

 private:
  std::string text_;
};

std::string percent(double value) { return value == 0 ? "" : fmt::format("{:.2f}", value); }

std::string count_pdos(const Links& links, std::size_t node, bool is_transmit) {
  return std::to_string(std::count_if(links.pdos.begin(), links.pdos.end(), [&](const ActivePdo& pdo) {
    return pdo.node == node && pdo.pdo.is_transmit == is_transmit;
  }));
}

void write_nodes(const Network& network, const Links& links, Page& page) {
  page.heading("nodes", "Nodes");
  page.raw(bus_picture(network, links));
  page.begin_table({"node-ID", "name", "product", "heartbeat", "guarding", "TPDOs", "RPDOs"});
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    const Node& node = network.nodes[n];
    const std::uint64_t heartbeat = node.number_or(0x1017, 0, 0);
    const std::uint64_t life_time = node.number_or(0x100C, 0, 0) * node.number_or(0x100D, 0, 0);
    page.row({std::to_string(node.node_id), node.name + (node.is_master ? " (NMT master)" : ""),
              node.device.identity.product_name.text, heartbeat == 0 ? "" : fmt::format("{} ms", heartbeat),
              life_time == 0 ? "" : fmt::format("{} ms", life_time), count_pdos(links, n, true),
              count_pdos(links, n, false)});
  }
  page.end_table();
}

std::string mapped_text(const ActivePdo& pdo) {
  std::string text;
  for (const MappedObject& mapped : pdo.pdo.mapped) {
    const std::string name = mapped.entry != nullptr ? mapped.entry->name.text : mapped.is_dummy() ? "dummy" : "?";
    text += fmt::format("{}{:04X}h:{} {} ({} bits)", text.empty() ? "" : ", ", mapped.index, mapped.sub_index, name,
                        mapped.bits);
  }
  return text;
}

std::string transmission_text(const Network& network, const ActivePdo& pdo) {
  const Node& node = network.nodes[pdo.node];
  const std::uint16_t index = pdo.pdo.communication->index;
  const std::uint64_t type = node.number_or(index, 2, 255);
  const std::uint64_t inhibit = node.number_or(index, 3, 0);
  const std::uint64_t event = node.number_or(index, 5, 0);
  std::string text = type == 1                                       ? "every SYNC"
                     : type == 0                                     ? "synchronous, on events"
                     : type <= transmission_type::last_synchronous   ? fmt::format("every {} SYNC", type)
                     : type >= transmission_type::event_manufacturer ? "event-driven"
                                                                     : "on remote requests";
  text += inhibit != 0 && type >= transmission_type::event_manufacturer
              ? fmt::format(", inhibit time {}.{} ms", inhibit / 10, inhibit % 10)
              : "";
  return text +
         (event != 0 && type >= transmission_type::event_manufacturer ? fmt::format(", event timer {} ms", event) : "");
}

void write_links(const Network& network, const Links& links, Page& page) {
  page.heading("links", "PDO links");
  page.raw(link_picture(network, links));
  page.begin_table({"COB-ID", "producer", "transmission", "bytes", "objects", "consumer", "bytes", "objects"});
  for (const Link& link : links.links) {
    const ActivePdo& from = links.pdos[link.producer];
    const ActivePdo& to = links.pdos[link.consumer];
    page.row({cob_id_text(from.identifier, from.is_extended),
              fmt::format("{} {}", network.nodes[from.node].name, from.title()), transmission_text(network, from),
              std::to_string(from.bytes()), mapped_text(from),
              fmt::format("{} {}", network.nodes[to.node].name, to.title()), std::to_string(to.bytes()),
              mapped_text(to)});
  }
  page.end_table();
}

void write_traffic(const Network& network, const Traffic& traffic, Page& page) {
  page.heading("load", "Bus load and response times");
  if (traffic.bit_rate == 0) {
    page.raw("<p>The bit rate is unknown.</p>\n");
    return;
  }
  page.raw(
      fmt::format("<p>{} kbit/s: worst case {:.1f} %, average {:.1f} %. Frames without a period only delay others: "
                  "SDO, NMT, TIME, EMCY without inhibit time, PDOs without times.</p>\n",
                  traffic.bit_rate, traffic.worst_load, traffic.average_load));
  page.begin_table({"COB-ID", "service", "node", "bytes", "bits, longest", "bits, mean", "shortest period",
                    "usual period", "load, worst %", "load, average %", "response time", "deadline"});
  for (const Message& message : traffic.messages) {
    page.row({cob_id_text(message.frame.identifier, message.frame.is_extended), message.service,
              network.nodes[message.node].name, std::to_string(message.frame.is_remote ? 0 : message.frame.bytes),
              std::to_string(message.longest), fmt::format("{:.1f}", message.mean), time_text(message.shortest_period),
              time_text(message.usual_period), percent(message.worst_load(traffic.bit_rate)),
              percent(message.average_load(traffic.bit_rate)), time_text(message.response.value_or(0)),
              time_text(message.deadline)});
  }
  page.end_table();
}

void write_findings(const NetworkFindings& findings, Page& page) {
  page.heading("findings", "Findings");
  std::vector<const Findings*> all = {&findings.plan};
  for (const Findings& each : findings.nodes) {
    all.push_back(&each);
  }
  page.begin_table({"severity", "text", "rule"});
  for (const Findings* each : all) {
    for (const Finding& finding : each->all()) {
      page.raw(fmt::format("<tr><td class=\"{0}\">{0}</td><td>{1}</td><td>{2}</td></tr>\n", name_of(finding.severity),
                           escaped_html(finding.text), finding.rule->id));
    }
  }
  page.end_table();
}

}  // namespace

std::string time_text(Nanoseconds time) {
  constexpr Nanoseconds us = 1000;
  const Nanoseconds rounded = (time + us - 1) / us;
  return time == 0 ? "" : fmt::format("{}.{:03} ms", rounded / 1000, rounded % 1000);
}

std::vector<File> configuration_files(const Network& network, NetworkFindings& findings) {
  std::vector<File> files;
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    const Node& node = network.nodes[n];
    Device device = node.device;
    device.file.file_name.text = node.name + ".dcf";
    device.file.file_name.is_given = true;
    if (!node.description.empty() && !device.file.last_eds.is_given) {
      device.file.last_eds.text = node.description.substr(node.description.find_last_of('/') + 1);
      device.file.last_eds.is_given = true;
    }
    eds::WriteOptions options;
    options.as_dcf = true;
    files.push_back({node.name + ".dcf", eds::write(device, options)});
    if (!node.is_master) {
      files.push_back({node.name + ".bin", concise_dcf(downloads_of(network, n, findings))});
    }
  }
  return files;
}

std::string html_report(const Network& network, const Links& links, const Traffic& traffic,
                        const NetworkFindings& findings) {
  const std::string title = network.name.empty() ? "CANopen network" : network.name;
  Page page;
  page.raw("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">");
  page.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
  page.raw(fmt::format("<title>{}</title>\n<style>", escaped_html(title)));
  page.raw(doc::style);
  page.raw(own_style);
  page.raw("</style></head><body>\n");
  page.raw(fmt::format("<header><h1>{}</h1>\n", escaped_html(title)));
  page.raw(
      "<nav><a href=\"#nodes\">Nodes</a><a href=\"#links\">PDO links</a><a href=\"#load\">Bus load</a>"
      "<a href=\"#findings\">Findings</a></nav></header>\n<main>\n");
  write_nodes(network, links, page);
  write_links(network, links, page);
  write_traffic(network, traffic, page);
  write_findings(findings, page);
  page.raw("</main>\n</body></html>\n");
  return page.take_text();
}

}  // namespace lexican::codict::network
