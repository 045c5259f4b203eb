// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "network/plan.hpp"
#include "network/rules.hpp"
#include "network/yaml.hpp"
#include "text/number.hpp"
#include "text/similar.hpp"

namespace lexican::codict::network {

namespace {

using yaml::Node;

struct Key {
  std::string_view name;
  std::function<void(const Node&)> read;
};
using Keys = std::vector<Key>;

// Key that only ROS 2 canopen reads, with its places.
struct RosKey {
  Span first;
  std::set<std::uint32_t> places;
};

constexpr std::size_t longest_shown = 40;
constexpr std::size_t most_slaves = 126;

// Returns the text of a value for a message.
std::string shown(const Node& node) {
  if (node.kind != Node::Kind::scalar) {
    return std::string(yaml::name_of(node.kind));
  }
  return node.text.size() <= longest_shown ? '"' + node.text + '"' : '"' + node.text.substr(0, longest_shown) + "…\"";
}

// Returns whether a plan is one of ROS 2 canopen: a section or a node names its driver.
bool has_driver(const Node& node, unsigned levels) {
  for (std::size_t n = 0; n < node.members(); ++n) {
    const bool is_driver = node.name(n).text == "driver" && node.value(n).kind == Node::Kind::scalar;
    if (is_driver || (levels != 0 && has_driver(node.value(n), levels - 1))) {
      return true;
    }
  }
  return node.kind == Node::Kind::sequence && levels != 0 &&
         std::any_of(node.items.begin(), node.items.end(),
                     [levels](const Node& item) { return has_driver(item, levels - 1); });
}

// Returns a node with the members of `defaults` that it lacks.
Node with_defaults(Node node, const Node& defaults) {
  if (node.kind != Node::Kind::map && node.kind != Node::Kind::null) {
    return node;
  }
  node.kind = Node::Kind::map;
  std::set<std::string> own;
  for (std::size_t n = 0; n < node.members(); ++n) {
    own.insert(node.name(n).text);
  }
  for (std::size_t n = 0; n < defaults.members(); ++n) {
    if (own.count(defaults.name(n).text) == 0) {
      node.items.push_back(defaults.name(n));
      node.items.push_back(defaults.value(n));
    }
  }
  return node;
}

class Reader {
 public:
  explicit Reader(Findings& findings) : findings_(findings) {}

  Plan read(const Node& root);

 private:
  void refuse(const Node& node, std::string_view wanted) {
    findings_.add(rules::value, node.span, fmt::format("invalid {}: {}", path_, shown(node)),
                  fmt::format("write {}", wanted));
  }

  bool is_map(const Node& node) {
    if (node.kind != Node::Kind::map) {
      refuse(node, "a map");
    }
    return node.kind == Node::Kind::map;
  }

  // Calls the reader of each key; `path_` is the path of that key for its messages.
  void map(const Node& node, std::string_view path, const Keys& keys) {
    path_ = path;
    if (!is_map(node)) {
      return;
    }
    for (std::size_t n = 0; n < node.members(); ++n) {
      const Node& name = node.name(n);
      const auto key =
          std::find_if(keys.begin(), keys.end(), [&name](const Key& each) { return each.name == name.text; });
      if (key == keys.end()) {
        unknown(name, path, keys);
        continue;
      }
      path_ = fmt::format("{}.{}", path, name.text);
      key->read(node.value(n));
    }
  }

  void unknown(const Node& name, std::string_view path, const Keys& keys) {
    std::vector<std::string_view> names;
    for (const Key& key : keys) {
      names.push_back(key.name);
    }
    const std::vector<std::string_view> near = similar(name.text, names);
    // Drivers define further keys of sections and nodes; one that resembles a key of the plan is misspelt.
    if (is_of_ros_ && path.find('.') == std::string_view::npos && near.empty()) {
      RosKey& key = ros_keys_.try_emplace(name.text, RosKey{name.span, {}}).first->second;
      key.places.insert(name.span.begin);
      return;
    }
    findings_.add(rules::key, name.span, fmt::format("unknown key {} in {}", shown(name), path),
                  near.empty() ? fmt::format("the keys are {}", fmt::join(names, ", "))
                               : fmt::format("did you mean {}?", fmt::join(near, ", ")));
  }

  // Returns false, with a finding, if the value is no integer of this range.
  bool integer(const Node& node, std::uint64_t low, std::uint64_t high, std::uint64_t& value) {
    const ParsedInteger number =
        node.kind == Node::Kind::scalar && !node.is_quoted ? parse_integer(node.text) : ParsedInteger{};
    const bool is_number = node.kind == Node::Kind::scalar && !node.is_quoted && number.is_number();
    if (!is_number || number.value.is_negative || number.value.magnitude < low || number.value.magnitude > high) {
      refuse(node,
             fmt::format(high > 0xFFFF ? "an integer from {:#x} to {:#x}" : "an integer from {} to {}", low, high));
      return false;
    }
    value = number.value.magnitude;
    return true;
  }

  template <typename T>
  void number(const Node& node, PlanField<T>& planned, std::uint64_t low, std::uint64_t high) {
    std::uint64_t value = 0;
    if (integer(node, low, high, value)) {
      planned = {static_cast<T>(value), node.span, true};
    }
  }

  void real(const Node& node, PlanField<double>& planned, double low, double high) {
    double value = 0;
    const char* const end = node.text.data() + node.text.size();
    const auto [stop, error] = std::from_chars(node.text.data(), end, value);
    const bool is_number = node.kind == Node::Kind::scalar && error == std::errc() && stop == end;
    if (!is_number || !(value >= low && value <= high)) {
      refuse(node, fmt::format("a number from {} to {}", low, high));
      return;
    }
    planned = {value, node.span, true};
  }

  void flag(const Node& node, PlanField<bool>& planned) {
    for (const auto& [word, value] : {std::pair("true", true), std::pair("false", false), std::pair("yes", true),
                                      std::pair("no", false), std::pair("on", true), std::pair("off", false)}) {
      if (node.kind == Node::Kind::scalar && equal_ignoring_case(node.text, word)) {
        planned = {value, node.span, true};
        return;
      }
    }
    refuse(node, "true or false");
  }

  void text(const Node& node, PlanField<std::string>& planned) {
    const bool is_text = node.kind == Node::Kind::scalar;
    const bool is_line = node.text.find_first_of("\r\n") == std::string::npos;
    if (!is_text || !is_line) {
      refuse(node, "one line of text");
      return;
    }
    planned = {node.text, node.span, true};
  }

  void connect(const Node& node, PlanField<Connect>& planned) {
    for (const auto& [word, value] :
         {std::pair("all", Connect::all), std::pair("planned", Connect::planned), std::pair("none", Connect::none)}) {
      if (node.kind == Node::Kind::scalar && node.text == word) {
        planned = {value, node.span, true};
        return;
      }
    }
    refuse(node, "all, planned or none");
  }

  void error_behavior(const Node& node, PlanField<ErrorBehavior>& planned) {
    const std::string path = path_;
    if (!is_map(node)) {
      return;
    }
    planned = {{}, node.span, true};
    for (std::size_t n = 0; n < node.members(); ++n) {
      std::uint64_t sub_index = 0;
      std::uint64_t value = 0;
      path_ = "sub-index of 1029h in " + path;
      const bool has_sub_index = integer(node.name(n), 1, 254, sub_index);
      path_ = fmt::format("{}.{}", path, sub_index);
      if (has_sub_index && integer(node.value(n), 0, 255, value)) {
        planned.value.emplace_back(static_cast<std::uint8_t>(sub_index), static_cast<std::uint8_t>(value));
      }
    }
  }

  Keys common_keys(PlannedNode& node) {
    return {{"node_id", [this, &node](const Node& n) { number(n, node.node_id, 1, 127); }},
            {"revision_number", [this, &node](const Node& n) { number(n, node.revision_number, 0, 0xFFFFFFFF); }},
            {"serial_number", [this, &node](const Node& n) { number(n, node.serial_number, 0, 0xFFFFFFFF); }},
            {"heartbeat_multiplier", [this, &node](const Node& n) { real(n, node.heartbeat_multiplier, 1, 1000); }},
            {"heartbeat_consumer", [this, &node](const Node& n) { flag(n, node.heartbeat_consumer); }},
            {"heartbeat_producer", [this, &node](const Node& n) { number(n, node.heartbeat_producer, 0, 65535); }},
            {"error_behavior", [this, &node](const Node& n) { error_behavior(n, node.error_behavior); }}};
  }

  void read_options(const Node& node, Plan& plan);
  void read_master(const Node& name, const Node& node, PlannedMaster& master);
  void read_slave(const Node& name, const Node& node, PlannedSlave& slave);
  bool read_defaults(const Node& root);
  void read_node(const Node& name, const Node& node, Plan& plan);
  void read_nodes(const Node& nodes, Plan& plan);
  void report_ros(const Plan& plan);
  void read_pdos(const Node& node, std::vector<PlannedPdo>& pdos);
  void read_pdo(const Node& node, PlannedPdo& pdo);
  void read_cob_id(const Node& node, PlannedPdo& pdo);
  void read_mapping(const Node& node, PlanField<std::vector<PlannedMapping>>& mapping);
  void read_values(const Node& node, std::vector<PlannedValue>& values);
  bool has_name(const Node& name);
  void require(bool is_given, const Node& name, std::string_view key, std::string_view remedy);

  Findings& findings_;
  std::string path_;
  bool is_of_ros_ = false;
  std::map<std::string, RosKey> ros_keys_;
  Node defaults_;
  Span defaults_name_;
};

void Reader::read_options(const Node& node, Plan& plan) {
  map(node, "options",
      {{"dcf_path", [&](const Node& n) { text(n, plan.dcf_path); }},
       {"heartbeat_multiplier", [&](const Node& n) { real(n, plan.heartbeat_multiplier, 1, 1000); }},
       {"network_name", [&](const Node& n) { text(n, plan.network_name); }},
       {"load_limit", [&](const Node& n) { real(n, plan.load_limit, 1, 100); }},
       {"event_interval", [&](const Node& n) { number(n, plan.event_interval, 1, 3600000); }}});
}

void Reader::read_master(const Node& name, const Node& node, PlannedMaster& master) {
  master.name = name.text;
  master.span = name.span;
  Keys keys = common_keys(master);
  const Keys own = {{"baudrate", [&](const Node& n) { number(n, master.bit_rate, 10, 1000); }},
                    {"vendor_id", [&](const Node& n) { number(n, master.vendor_id, 0, 0xFFFFFFFF); }},
                    {"product_code", [&](const Node& n) { number(n, master.product_code, 0, 0xFFFFFFFF); }},
                    {"emcy_inhibit_time", [&](const Node& n) { number(n, master.emcy_inhibit_time, 0, 65535); }},
                    {"sync_period", [&](const Node& n) { number(n, master.sync_period, 0, 0xFFFFFFFF); }},
                    {"sync_window", [&](const Node& n) { number(n, master.sync_window, 0, 0xFFFFFFFF); }},
                    {"sync_overflow", [&](const Node& n) { number(n, master.sync_overflow, 0, 240); }},
                    {"nmt_inhibit_time", [&](const Node& n) { number(n, master.nmt_inhibit_time, 0, 65535); }},
                    {"start", [&](const Node& n) { flag(n, master.start); }},
                    {"start_nodes", [&](const Node& n) { flag(n, master.start_nodes); }},
                    {"start_all_nodes", [&](const Node& n) { flag(n, master.start_all_nodes); }},
                    {"reset_all_nodes", [&](const Node& n) { flag(n, master.reset_all_nodes); }},
                    {"stop_all_nodes", [&](const Node& n) { flag(n, master.stop_all_nodes); }},
                    {"boot_time", [&](const Node& n) { number(n, master.boot_time, 0, 0xFFFFFFFF); }},
                    {"pdo", [&](const Node& n) { connect(n, master.connect); }}};
  keys.insert(keys.end(), own.begin(), own.end());
  map(node, name.text, keys);
  require(master.node_id.is_given || node.kind != Node::Kind::map, name, "node_id", "add one: node_id: 127");
}

void Reader::read_slave(const Node& name, const Node& node, PlannedSlave& slave) {
  slave.name = name.text;
  slave.span = name.span;
  Keys keys = common_keys(slave);
  const Keys own = {{"dcf", [&](const Node& n) { text(n, slave.description); }},
                    {"dcf_path", [&](const Node& n) { text(n, slave.dcf_path); }},
                    {"boot", [&](const Node& n) { flag(n, slave.is_booted); }},
                    {"mandatory", [&](const Node& n) { flag(n, slave.is_mandatory); }},
                    {"reset_communication", [&](const Node& n) { flag(n, slave.may_reset); }},
                    {"software_file", [&](const Node& n) { text(n, slave.software_file); }},
                    {"software_version", [&](const Node& n) { number(n, slave.software_version, 0, 0xFFFFFFFF); }},
                    {"configuration_file", [&](const Node& n) { text(n, slave.configuration_file); }},
                    {"restore_configuration", [&](const Node& n) { number(n, slave.restore_configuration, 0, 127); }},
                    {"guard_time", [&](const Node& n) { number(n, slave.guard_time, 0, 65535); }},
                    {"life_time_factor", [&](const Node& n) { number(n, slave.life_time_factor, 0, 255); }},
                    {"rpdo", [&](const Node& n) { read_pdos(n, slave.rpdos); }},
                    {"tpdo", [&](const Node& n) { read_pdos(n, slave.tpdos); }},
                    {"sdo", [&](const Node& n) { read_values(n, slave.values); }}};
  keys.insert(keys.end(), own.begin(), own.end());
  map(node, name.text, keys);
}

void Reader::require(bool is_given, const Node& name, std::string_view key, std::string_view remedy) {
  if (!is_given) {
    findings_.add(rules::missing, name.span, fmt::format("{} has no {}", name.text, key), std::string(remedy));
  }
}

void Reader::read_pdos(const Node& node, std::vector<PlannedPdo>& pdos) {
  const std::string path = path_;
  if (!is_map(node)) {
    return;
  }
  for (std::size_t n = 0; n < node.members(); ++n) {
    std::uint64_t number = 0;
    path_ = "PDO number in " + path;
    if (!integer(node.name(n), 1, 512, number)) {
      continue;
    }
    PlannedPdo& pdo = pdos.emplace_back();
    pdo.number = static_cast<std::uint16_t>(number);
    pdo.span = node.name(n).span;
    path_ = fmt::format("{}.{}", path, number);
    if (node.value(n).kind != Node::Kind::null) {
      read_pdo(node.value(n), pdo);
    }
  }
}

void Reader::read_pdo(const Node& node, PlannedPdo& pdo) {
  const std::string path = path_;
  map(node, path,
      {{"enabled", [&](const Node& n) { flag(n, pdo.is_enabled); }},
       {"cob_id", [&](const Node& n) { read_cob_id(n, pdo); }},
       {"transmission", [&](const Node& n) { number(n, pdo.transmission, 0, 255); }},
       {"inhibit_time", [&](const Node& n) { number(n, pdo.inhibit_time, 0, 65535); }},
       {"event_timer", [&](const Node& n) { number(n, pdo.event_timer, 0, 65535); }},
       {"event_deadline", [&](const Node& n) { number(n, pdo.event_deadline, 0, 65535); }},
       {"sync_start", [&](const Node& n) { number(n, pdo.sync_start, 0, 240); }},
       {"mapping", [&](const Node& n) { read_mapping(n, pdo.mapping); }}});
}

void Reader::read_cob_id(const Node& node, PlannedPdo& pdo) {
  if (node.kind != Node::Kind::scalar || node.text != "auto") {  // auto: the COB-ID of the description
    number(node, pdo.cob_id, 1, 0x1FFFFFFF);
  }
}

void Reader::read_mapping(const Node& node, PlanField<std::vector<PlannedMapping>>& mapping) {
  const std::string path = path_;
  if (node.kind != Node::Kind::sequence || node.items.size() > 64) {
    refuse(node, "a list of at most 64 objects: - {index: 0x2000, sub_index: 0}");
    return;
  }
  mapping = {{}, node.span, true};
  for (const Node& item : node.items) {
    PlanField<std::uint16_t> index;
    PlanField<std::uint8_t> sub_index;
    map(item, path, {{"index", [&](const Node& n) { number(n, index, 1, 0xFFFF); }}, {"sub_index", [&](const Node& n) {
                                                                                        number(n, sub_index, 0, 255);
                                                                                      }}});
    if (index.is_given) {
      mapping.value.push_back({index.value, sub_index.value, item.span});
    } else if (item.kind == Node::Kind::map) {
      findings_.add(rules::missing, item.span, path + ": object without index", "write {index: 0x2000, sub_index: 0}");
    }
  }
}

void Reader::read_values(const Node& node, std::vector<PlannedValue>& values) {
  const std::string path = path_;
  if (node.kind != Node::Kind::sequence) {
    refuse(node, "a list of values: - {index: 0x2000, sub_index: 0, value: 1}");
    return;
  }
  for (const Node& item : node.items) {
    PlanField<std::uint16_t> index;
    PlanField<std::uint8_t> sub_index;
    PlanField<std::string> value;
    map(item, path,
        {{"index", [&](const Node& n) { number(n, index, 1, 0xFFFF); }},
         {"sub_index", [&](const Node& n) { number(n, sub_index, 0, 255); }},
         {"value", [&](const Node& n) { text(n, value); }}});
    if (index.is_given && value.is_given) {
      values.push_back({index.value, sub_index.value, value.value, value.span});
    } else if (item.kind == Node::Kind::map) {
      findings_.add(rules::missing, item.span,
                    fmt::format("{}: entry without {}", path, index.is_given ? "value" : "index"),
                    "write {index: 0x2000, sub_index: 0, value: 1}");
    }
  }
}

// Checks the name of a node, after which its files are named.
bool Reader::has_name(const Node& name) {
  constexpr std::size_t longest = 64;
  const bool is_name =
      !name.text.empty() && name.text.size() <= longest && std::all_of(name.text.begin(), name.text.end(), [](char c) {
        const char small = to_lower(c);
        return (small >= 'a' && small <= 'z') || is_digit(c) || c == '_' || c == '-';
      });
  if (!is_name) {
    findings_.add(rules::value, name.span, fmt::format("invalid name of a node: {}", shown(name)),
                  "use at most 64 letters, digits, - and _: files are named after the node");
  }
  return is_name;
}

// Reads the section defaults, if there is one. Returns false, with findings, if it has errors.
bool Reader::read_defaults(const Node& root) {
  const std::size_t errors = findings_.count(Severity::error);
  for (std::size_t n = 0; n < root.members(); ++n) {
    if (root.name(n).text == "defaults") {
      PlannedSlave unused;
      read_slave(root.name(n), root.value(n), unused);
      defaults_ = root.value(n);
      defaults_name_ = root.name(n).span;
    }
  }
  return findings_.count(Severity::error) == errors;
}

void Reader::read_node(const Node& name, const Node& node, Plan& plan) {
  if (name.text.substr(0, 1) == "." || !has_name(name)) {  // .name: a disabled section
    return;
  }
  // Files are named after the nodes, and some file systems do not distinguish capitals.
  const auto is_name = [&name](std::string_view other) { return equal_ignoring_case(other, name.text); };
  const bool is_double =
      is_name("master") || std::any_of(plan.slaves.begin(), plan.slaves.end(),
                                       [&](const PlannedSlave& slave) { return is_name(slave.name); });
  if (is_double) {
    findings_.add(rules::value, name.span, fmt::format("duplicate name of a node: {}", shown(name)),
                  "rename one of them");
  }
  PlannedSlave& slave = plan.slaves.emplace_back();
  const bool is_within_limit = plan.slaves.size() <= most_slaves;  // bounds the time for copies of the defaults
  read_slave(name, is_within_limit ? with_defaults(node, defaults_) : node, slave);
  require(slave.description.is_given || node.kind != Node::Kind::map, name, "dcf",
          "add the path of its description: dcf: drive.eds");
}

// Reads the section nodes: a map of nodes, or a list of such maps.
void Reader::read_nodes(const Node& nodes, Plan& plan) {
  if (nodes.kind == Node::Kind::sequence) {
    for (const Node& item : nodes.items) {
      path_ = "nodes";
      if (is_map(item)) {
        read_nodes(item, plan);
      }
    }
    return;
  }
  path_ = "nodes";
  if (is_map(nodes)) {
    for (std::size_t n = 0; n < nodes.members(); ++n) {
      read_node(nodes.name(n), nodes.value(n), plan);
    }
  }
}

void Reader::report_ros(const Plan& plan) {
  if (defaults_.kind == Node::Kind::map) {
    findings_.add(
        rules::defaults, defaults_name_,
        fmt::format("defaults are used for {} node{}", plan.slaves.size(), plan.slaves.size() == 1 ? "" : "s"),
        "to replace a default, write the key into the node");
  }
  for (const auto& [name, key] : ros_keys_) {
    findings_.add(rules::key_ros, key.first,
                  fmt::format("key \"{}\" has no effect here, only in ROS 2 ({} place{})", shortened(name),
                              key.places.size(), key.places.size() == 1 ? "" : "s"),
                  "remove it if the plan is not for ROS 2");
  }
}

Plan Reader::read(const Node& root) {
  Plan plan;
  path_ = "plan";
  if (!is_map(root)) {
    return plan;
  }
  is_of_ros_ = has_driver(root, 3);
  if (!read_defaults(root)) {
    return plan;
  }
  bool has_master = false;
  for (std::size_t n = 0; n < root.members(); ++n) {
    const Node& name = root.name(n);
    if (name.text == "options") {
      read_options(root.value(n), plan);
    } else if (name.text == "master") {
      has_master = true;
      read_master(name, root.value(n), plan.master);
    } else if (name.text == "nodes") {
      read_nodes(root.value(n), plan);
    } else if (name.text != "defaults") {
      read_node(name, root.value(n), plan);
    }
  }
  report_ros(plan);
  if (plan.slaves.size() > most_slaves) {
    findings_.add(rules::node_id, plan.slaves[most_slaves].span,
                  fmt::format("{} nodes and a master: a network has 127 node-IDs", plan.slaves.size()),
                  "divide the nodes between several networks");
    plan.slaves.clear();
  }
  if (!has_master) {
    findings_.add(rules::missing, root.span, "the plan has no section master",
                  "add one: master: {node_id: 127, baudrate: 250}");
  }
  return plan;
}

}  // namespace

Plan read_plan(const Source& source, Findings& findings) {
  Node root;
  return yaml::read(source, root, findings) ? Reader(findings).read(root) : Plan();
}

}  // namespace lexican::codict::network
