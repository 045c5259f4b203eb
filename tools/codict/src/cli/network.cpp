// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/json.hpp"
#include "cli/letters.hpp"
#include "cli/output.hpp"
#include "cli/render.hpp"
#include "network/check.hpp"
#include "network/links.hpp"
#include "network/network.hpp"
#include "network/plan.hpp"
#include "network/report.hpp"
#include "network/traffic.hpp"
#include "text/file.hpp"

namespace lexican::codict::cli {

namespace {

struct NetworkOptions {
  std::vector<std::string> files;
  std::string directory;
  std::uint32_t bit_rate = 0;
  bool is_json = false;
  bool is_forced = false;
  bool shows_notes = false;
};

// Network with the files from which it was read.
struct Project {
  network::Network network;
  Findings findings;  // findings of the plan
  std::optional<Source> plan;
  std::vector<Input> inputs;       // descriptions by node, for a network without a plan
  std::vector<std::string> paths;  // paths of all files that were read
};

bool is_plan(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == "yaml" || ending == "yml";
}

std::string beside(const std::string& plan, const std::string& path) {
  return (std::filesystem::path(plan).parent_path() / path).string();
}

// Reads the descriptions of a plan. Returns false after a message if one of them cannot be read.
bool read_devices(const network::Plan& plan, Project& project, std::vector<Device>& devices) {
  std::map<std::string, Device> known;
  for (const network::PlannedSlave& slave : plan.slaves) {
    const std::string path = beside(project.plan->name(), slave.description.value);
    auto place = known.find(path);
    if (place == known.end()) {
      std::optional<Input> input = open(path);
      if (!input) {
        return false;
      }
      place = known.emplace(path, input->device()).first;
      project.paths.push_back(path);
    }
    devices.push_back(place->second);
  }
  return true;
}

std::optional<Project> planned_project(const NetworkOptions& options) {
  Project project;
  std::string why;
  project.plan = read_file(options.files.front(), why);
  if (!project.plan) {
    print_message(why);
    return std::nullopt;
  }
  project.paths = options.files;
  network::Plan plan = network::read_plan(*project.plan, project.findings);
  if (options.bit_rate != 0) {
    plan.master.bit_rate.value = options.bit_rate;
  }
  std::vector<Device> devices;
  if (project.findings.count(Severity::error) != 0) {
    project.network.is_planned = true;  // the network has no nodes
  } else if (!read_devices(plan, project, devices)) {
    return std::nullopt;
  } else {
    project.network = network::planned_network(plan, std::move(devices), project.findings);
  }
  return project;
}

std::optional<Project> described_project(const NetworkOptions& options) {
  Project project;
  std::vector<network::NamedDevice> devices;
  std::set<std::string> names;
  for (const std::string& path : options.files) {
    std::optional<Input> input = open(path);
    if (!input) {
      return std::nullopt;
    }
    std::string name = std::filesystem::path(path).stem().string();
    while (!names.insert(name).second) {
      name += fmt::format("-{}", devices.size() + 1);
    }
    devices.push_back({std::move(name), path, input->device()});
    project.inputs.push_back(std::move(*input));
  }
  project.paths = options.files;
  project.network = network::described_network(std::move(devices), options.bit_rate);
  return project;
}

// Returns the findings of each source as text, and appends them to json.
std::string sources_text(const Project& project, const network::NetworkFindings& findings, bool shows_notes,
                         Json& json) {
  std::string text;
  const auto show = [&](const Source& source, Encoding encoding, const Findings& all) {
    std::vector<Finding> wanted;
    std::copy_if(all.all().begin(), all.all().end(), std::back_inserter(wanted),
                 [shows_notes](const Finding& finding) { return shows_notes || finding.severity != Severity::note; });
    text += render(source, encoding, fold(wanted), false);
    json.push_back({{"file", source.name()}, {"findings", to_json(source, fold(all.all()))}});
  };
  if (project.plan) {
    show(*project.plan, Encoding::utf8, findings.plan);
  }
  for (std::size_t n = 0; n < std::min(project.inputs.size(), findings.nodes.size()); ++n) {
    show(project.inputs[n].source(), project.inputs[n].encoding(), findings.nodes[n]);
  }
  return text;
}

std::string text_of(const network::Network& network, const network::Links& links, const network::Traffic& traffic) {
  std::string text = fmt::format("{} nodes, {} PDO links", network.nodes.size(), links.links.size());
  if (traffic.bit_rate == 0) {
    return text + "; bit rate unknown: --bit-rate gives loads and response times\n";
  }
  text += fmt::format(", {} kbit/s; bus load: worst case {:.1f} %, average {:.1f} %\n\n", traffic.bit_rate,
                      traffic.worst_load, traffic.average_load);
  text += fmt::format("{:<9} {:<24} {:<20} {:>5} {:>14} {:>14} {:>14}\n", "COB-ID", "service", "node", "bits", "period",
                      "response", "deadline");
  for (const network::Message& message : traffic.messages) {
    if (message.shortest_period != 0) {
      text += fmt::format(
          "{:<9} {:<24} {:<20} {:>5} {:>14} {:>14} {:>14}\n", fmt::format("{:03X}h", message.frame.identifier),
          message.service, visible(network.nodes[message.node].name), message.longest,
          network::time_text(message.shortest_period),
          message.response ? network::time_text(*message.response) : "no bound", network::time_text(message.deadline));
    }
  }
  return text;
}

std::uint64_t permille(double percent) { return static_cast<std::uint64_t>(std::llround(percent * 10)); }

Json json_of(const network::Network& network, const network::Links& links, const network::Traffic& traffic) {
  Json json{{"schema", "codict-network-1"}, {"bit_rate", traffic.bit_rate}};
  json["nodes"] = Json::array();
  for (const network::Node& node : network.nodes) {
    json["nodes"].push_back({{"name", node.name}, {"node_id", node.node_id}, {"master", node.is_master}});
  }
  json["links"] = Json::array();
  for (const network::Link& link : links.links) {
    const network::ActivePdo& from = links.pdos[link.producer];
    const network::ActivePdo& to = links.pdos[link.consumer];
    json["links"].push_back({{"cob_id", from.identifier},
                             {"extended", from.is_extended},
                             {"producer", network.nodes[from.node].name},
                             {"tpdo", from.pdo.number},
                             {"consumer", network.nodes[to.node].name},
                             {"rpdo", to.pdo.number}});
  }
  json["worst_load_permille"] = permille(traffic.worst_load);
  json["average_load_permille"] = permille(traffic.average_load);
  json["messages"] = Json::array();
  for (const network::Message& message : traffic.messages) {
    Json each{{"cob_id", message.frame.identifier},
              {"extended", message.frame.is_extended},
              {"service", message.service},
              {"node", network.nodes[message.node].name},
              {"bytes", message.frame.is_remote ? 0U : unsigned{message.frame.bytes}},
              {"longest_bits", message.longest},
              {"shortest_period_ns", message.shortest_period},
              {"usual_period_ns", message.usual_period}};
    if (message.response) {
      each["response_ns"] = *message.response;
      each["deadline_ns"] = message.deadline;
    }
    json["messages"].push_back(std::move(each));
  }
  return json;
}

int write_files(const NetworkOptions& options, const Project& project, const std::vector<network::File>& files) {
  if (!make_directory(options.directory)) {
    return unusable;
  }
  std::vector<std::pair<std::string, const network::File*>> places;
  for (const network::File& file : files) {
    places.emplace_back(options.directory + "/" + file.name, &file);
    for (const std::string& path : project.paths) {
      if (is_same_file(places.back().first, path)) {
        print_message(path + ": an output would overwrite an input; choose another directory");
        return unusable;
      }
    }
  }
  int status = clean;
  for (const auto& [path, file] : places) {
    status = std::max<int>(status, write_output(path, file->bytes));
  }
  return status;
}

int finish(const NetworkOptions& options, const Project& project) {
  const network::Network& net = project.network;
  network::NetworkFindings findings(net);
  findings.plan = project.findings;
  const network::Links links = network::links_of(net);
  network::check_all(net, links, findings);
  const network::Traffic traffic = network::traffic_of(net, links, findings);
  std::vector<network::File> files = network::configuration_files(net, findings);
  files.push_back({"network.html", network::html_report(net, links, traffic, findings)});
  Json json = json_of(net, links, traffic);
  json["sources"] = Json::array();
  fmt::print(stderr, "{}", sources_text(project, findings, options.shows_notes, json["sources"]));
  if (options.is_json) {
    print_json(json);
  } else if (!net.nodes.empty()) {
    print(text_of(net, links, traffic));
  }
  const bool has_errors = findings.count(Severity::error) != 0;
  if (options.directory.empty() || net.nodes.empty() || (has_errors && !options.is_forced)) {
    if (!options.directory.empty()) {
      print_message(net.nodes.empty() ? "no node could be read, no file was written"
                                      : "errors, no file was written; --force writes the files nevertheless");
    }
    return has_errors ? found : clean;
  }
  return std::max<int>(write_files(options, project, files), has_errors ? found : clean);
}

int run_network(const NetworkOptions& options) {
  constexpr std::size_t most_nodes = 127;
  const bool has_plan = std::any_of(options.files.begin(), options.files.end(), is_plan);
  if ((has_plan && options.files.size() != 1) || options.files.size() > most_nodes) {
    print_message(has_plan ? "give either one plan (.yaml), or descriptions (.dcf, .xdc) without a plan"
                           : "more than 127 descriptions; a network has at most 127 nodes");
    return unusable;
  }
  const std::optional<Project> project = has_plan ? planned_project(options) : described_project(options);
  return project ? finish(options, *project) : unusable;
}

}  // namespace

Command add_network(CommandLine& line) {
  const auto options = std::make_shared<NetworkOptions>();
  Arguments command =
      line.add_command("network", "Check a network: COB-IDs, PDO links, heartbeats, SYNC, bus load, response times");
  command.add_option("file", options->files, "Plan (.yaml), or DCFs and XDCs of all nodes").required();
  command.add_option("-o,--output", options->directory,
                     "Directory of a DCF and a concise DCF (.bin) for each node, the master's DCF, and network.html");
  command
      .add_option("--bit-rate", options->bit_rate,
                  "Bit rate in kbit/s; default: that of the plan or of the descriptions")
      .in_hidden_range(1, 1000);
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  command.add_flag("--notes", options->shows_notes, "Also show notes");
  command.add_flag("--force", options->is_forced, "Write the files although there are errors");
  return {command, [options] { return run_network(*options); }};
}

}  // namespace lexican::codict::cli
