// SPDX-License-Identifier: Apache-2.0
#include "network/master.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "network/links.hpp"
#include "network/rules.hpp"

namespace lexican::codict::network {

namespace {

constexpr std::uint16_t domain = 0x0F;
constexpr std::size_t most_pdos = 512;
constexpr std::uint16_t received_objects = 0x2000;
constexpr std::uint16_t transmitted_objects = 0x2200;

// Returns a name in one line of at most 200 bytes, for use in a description.
std::string one_line(std::string_view text) {
  constexpr std::size_t longest = 200;
  std::string line(text.substr(0, longest));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return line;
}

struct Sub {
  std::uint8_t sub_index = 0;
  std::string name;
  std::uint16_t type = 0;
  std::string_view access = "rw";
  std::string value;
  bool is_mappable = false;
};

// Text of the dictionary as a DCF, from which the reader of descriptions builds a device.
class Dictionary {
 public:
  void section(std::string_view name) { text_ += fmt::format("\n[{}]\n", name); }
  void line(std::string_view key, std::string_view value) { text_ += fmt::format("{}={}\n", key, value); }

  void entry(const Sub& sub) {
    line("ParameterName", sub.name);
    line("ObjectType", "0x7");
    line("DataType", fmt::format("0x{:04X}", sub.type));
    line("AccessType", sub.access);
    line("DefaultValue", sub.value);
    line("PDOMapping", sub.is_mappable ? "1" : "0");
  }
  void variable(std::uint16_t index, const Sub& sub) {
    section(fmt::format("{:04X}", index));
    entry(sub);
  }
  void record(std::uint16_t index, std::string_view name, const std::vector<Sub>& subs) {
    section(fmt::format("{:04X}", index));
    line("ParameterName", name);
    line("ObjectType", "0x9");
    line("SubNumber", std::to_string(subs.size() + 1));
    section(fmt::format("{:04X}sub0", index));
    entry({0, "Highest sub-index supported", 5, "const", std::to_string(subs.back().sub_index), false});
    for (const Sub& sub : subs) {
      section(fmt::format("{:04X}sub{:X}", index, sub.sub_index));
      entry(sub);
    }
  }
  // Adds an ARRAY with sub-indexes 1…length, some of which have values.
  void array(std::uint16_t index, std::string_view name, std::uint16_t type, unsigned length,
             const std::map<unsigned, std::uint64_t>& values) {
    section(fmt::format("{:04X}", index));
    line("ParameterName", name);
    line("ObjectType", "0x8");
    line("DataType", fmt::format("0x{:04X}", type));
    line("AccessType", "rw");
    line("DefaultValue", "0");
    line("CompactSubObj", std::to_string(length));
    if (!values.empty()) {
      section(fmt::format("{:04X}Value", index));
      line("NrOfEntries", std::to_string(values.size()));
      for (const auto& [sub_index, value] : values) {
        line(std::to_string(sub_index), fmt::format("0x{:X}", value));
      }
    }
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string hex(std::uint64_t value) { return fmt::format("0x{:08X}", value); }

class Master {
 public:
  Master(const Plan& plan, const Network& network, Findings& findings)
      : plan_(plan), master_(plan.master), network_(network), findings_(findings) {}

  void headers();
  void communication(const std::vector<std::uint64_t>& consumer_times);
  void sync();
  void pdos();
  void sdo_clients();
  void startup();
  Device device() const;

 private:
  using Values = std::map<unsigned, std::uint64_t>;

  // Returns values by node-ID, without nodes whose value is 0.
  Values by_node(const std::function<std::uint64_t(const Node&, const PlannedSlave&)>& value) const {
    Values values;
    for (std::size_t n = 0; n < network_.nodes.size(); ++n) {
      const std::uint64_t each = value(network_.nodes[n], plan_.slaves[n]);
      if (each != 0 && network_.nodes[n].node_id != 0) {
        values[network_.nodes[n].node_id] = each;
      }
    }
    return values;
  }
  void by_node(std::uint16_t index, std::string_view name,
               const std::function<std::uint64_t(const Node&, const PlannedSlave&)>& value) {
    dictionary_.array(index, name, 7, 127, by_node(value));
  }
  void files(std::uint16_t index, const std::string& name,
             const std::function<std::string(const Node&, const PlannedSlave&)>& file);
  const PlannedPdo* planned(const ActivePdo& active) const;
  bool is_wanted(const ActivePdo& active) const;
  std::vector<const ActivePdo*> unconnected(const Links& links, bool is_transmit) const;
  void pdo(const ActivePdo& partner, std::uint16_t at);
  void communication_of(const ActivePdo& partner, std::uint16_t index);
  void mapping_of(const ActivePdo& partner, std::uint16_t index, std::uint16_t objects);
  std::uint16_t mirror_type(const ActivePdo& partner, const MappedObject& mapped) const;

  const Plan& plan_;
  const PlannedMaster& master_;
  const Network& network_;
  Findings& findings_;
  Dictionary dictionary_;
  std::size_t rpdo_count_ = 0;
  std::size_t tpdo_count_ = 0;
};

void Master::headers() {
  Dictionary& d = dictionary_;
  d.section("DeviceComissioning");
  d.line("NodeID", std::to_string(master_.node_id.value));
  d.line("NodeName", "master");
  d.line("Baudrate", std::to_string(master_.bit_rate.value));
  d.line("NetNumber", "1");
  d.line("NetworkName", one_line(plan_.network_name.value));
  d.line("CANopenManager", "1");
  d.line("LSS_SerialNumber", hex(master_.serial_number.value));
  d.section("DeviceInfo");
  d.line("VendorNumber", hex(master_.vendor_id.value));
  d.line("ProductName", "master");
  d.line("ProductNumber", hex(master_.product_code.value));
  d.line("RevisionNumber", hex(master_.revision_number.value));
  for (const unsigned kbit : {10U, 20U, 50U, 125U, 250U, 500U, 800U, 1000U}) {
    d.line(fmt::format("BaudRate_{}", kbit), "1");
  }
  d.line("SimpleBootUpMaster", "1");
  d.line("SimpleBootUpSlave", "0");
  d.line("Granularity", "8");
  d.line("DynamicChannelsSupported", "0");
  d.line("GroupMessaging", "0");
  d.line("NrOfRXPDO", std::to_string(rpdo_count_));
  d.line("NrOfTXPDO", std::to_string(tpdo_count_));
  d.line("LSS_Supported", "0");
}

void Master::communication(const std::vector<std::uint64_t>& consumer_times) {
  Dictionary& d = dictionary_;
  d.variable(0x1000, {0, "Device type", 7, "ro", "0", false});
  d.variable(0x1001, {0, "Error register", 5, "ro", "0", false});
  d.array(0x1003, "Pre-defined error field", 7, 8, {});
  d.variable(0x1014, {0, "COB-ID EMCY", 7, "rw", "$NODEID+0x80", false});
  d.variable(0x1015, {0, "Inhibit time EMCY", 6, "rw", std::to_string(master_.emcy_inhibit_time.value), false});
  Values consumers;
  for (std::size_t n = 0; n < network_.nodes.size(); ++n) {
    const bool is_consumed = !master_.heartbeat_consumer.is_given || master_.heartbeat_consumer.value;
    if (is_consumed && consumer_times[n] != 0 && n < 127) {
      consumers[static_cast<unsigned>(n) + 1] = std::uint64_t{network_.nodes[n].node_id} << 16 | consumer_times[n];
    }
  }
  d.array(0x1016, "Consumer heartbeat time", 7, 127, consumers);
  d.variable(0x1017, {0, "Producer heartbeat time", 6, "rw", std::to_string(master_.heartbeat_producer.value), false});
  d.record(0x1018, "Identity object",
           {{1, "Vendor-ID", 7, "ro", hex(master_.vendor_id.value), false},
            {2, "Product code", 7, "ro", hex(master_.product_code.value), false},
            {3, "Revision number", 7, "ro", hex(master_.revision_number.value), false},
            {4, "Serial number", 7, "ro", hex(master_.serial_number.value), false}});
  d.array(0x1028, "Emergency consumer object", 7, 127, by_node([](const Node& node, const PlannedSlave& /*plan*/) {
            for (const CobId& cob_id : node.cob_ids()) {
              if (cob_id.index == 0x1014 && cob_id.is_valid()) {
                return std::uint64_t{cob_id.value & 0x3FFFFFFFU};
              }
            }
            return std::uint64_t{0};
          }));
  Values errors;
  for (const auto& [sub_index, value] : master_.error_behavior.value) {
    errors[sub_index] = value;
  }
  d.array(0x1029, "Error behavior object", 5, errors.empty() ? 1 : errors.rbegin()->first, errors);
  d.variable(0x102A, {0, "NMT inhibit time", 6, "rw", std::to_string(master_.nmt_inhibit_time.value), false});
}

void Master::sync() {
  Dictionary& d = dictionary_;
  constexpr std::uint32_t generates = 0x40000000;
  const std::uint32_t cob_id = 0x80 | (master_.sync_period.value != 0 ? generates : 0U);
  d.variable(0x1005, {0, "COB-ID SYNC message", 7, "rw", hex(cob_id), false});
  d.variable(0x1006, {0, "Communication cycle period", 7, "rw", std::to_string(master_.sync_period.value), false});
  d.variable(0x1007, {0, "Synchronous window length", 7, "rw", std::to_string(master_.sync_window.value), false});
  d.variable(0x1019,
             {0, "Synchronous counter overflow value", 5, "rw", std::to_string(master_.sync_overflow.value), false});
}

// PDOs -------------------------------------------------------------------------------------------------------------

const PlannedPdo* Master::planned(const ActivePdo& active) const {
  const PlannedSlave& slave = plan_.slaves[active.node];
  const std::vector<PlannedPdo>& pdos = active.pdo.is_transmit ? slave.tpdos : slave.rpdos;
  const auto place = std::find_if(pdos.begin(), pdos.end(),
                                  [&active](const PlannedPdo& pdo) { return pdo.number == active.pdo.number; });
  return place != pdos.end() ? &*place : nullptr;
}

bool Master::is_wanted(const ActivePdo& active) const {
  const Connect connect = master_.connect.value;
  return !active.pdo.is_multiplexed &&
         (connect == Connect::all || (connect == Connect::planned && planned(active) != nullptr));
}

// Returns the PDOs of one direction without link: the longest one for each COB-ID.
std::vector<const ActivePdo*> Master::unconnected(const Links& links, bool is_transmit) const {
  std::vector<const ActivePdo*> result;
  std::map<std::uint64_t, std::size_t> seen;
  for (std::size_t n = 0; n < links.pdos.size(); ++n) {
    const ActivePdo& pdo = links.pdos[n];
    if (pdo.pdo.is_transmit != is_transmit || links.are_connected[n] || !is_wanted(pdo)) {
      continue;
    }
    const auto [place, is_new] = seen.emplace(pdo.key(), result.size());
    if (is_new) {
      result.push_back(&pdo);
    } else if (result[place->second]->pdo.bits() < pdo.pdo.bits()) {
      result[place->second] = &pdo;
    }
  }
  result.resize(std::min(result.size(), most_pdos));
  return result;
}

void Master::communication_of(const ActivePdo& partner, std::uint16_t index) {
  const PlannedPdo* const plan = planned(partner);
  const std::uint64_t type =
      network_.nodes[partner.node].number_or(partner.pdo.communication->index, 2, transmission_type::event_profile);
  const std::uint64_t own_type = type <= transmission_type::last_synchronous ? type : transmission_type::event_profile;
  const std::uint64_t extended = partner.is_extended ? cob_id_extended : 0U;
  const auto number = [plan](const auto& planned) { return std::to_string(plan != nullptr ? planned(*plan) : 0); };
  std::vector<Sub> subs = {{1, "COB-ID", 7, "rw", hex(partner.identifier | extended), false},
                           {2, "Transmission type", 5, "rw", std::to_string(own_type), false}};
  if (partner.pdo.is_transmit) {
    subs.push_back(
        {5, "Event timer", 6, "rw", number([](const PlannedPdo& p) { return p.event_deadline.value; }), false});
    dictionary_.record(index, "RPDO communication parameter", subs);
    return;
  }
  subs.push_back({3, "Inhibit time", 6, "rw", number([](const PlannedPdo& p) { return p.inhibit_time.value; }), false});
  subs.push_back({5, "Event timer", 6, "rw", number([](const PlannedPdo& p) { return p.event_timer.value; }), false});
  subs.push_back(
      {6, "SYNC start value", 5, "rw", number([](const PlannedPdo& p) { return p.sync_start.value; }), false});
  dictionary_.record(index, "TPDO communication parameter", subs);
}

// Returns the data type of the mapped object, else an unsigned type of the same length; 0 if there is none.
std::uint16_t Master::mirror_type(const ActivePdo& partner, const MappedObject& mapped) const {
  const Device& device = network_.nodes[partner.node].device;
  const std::uint16_t code = mapped.is_dummy()         ? mapped.index
                             : mapped.entry != nullptr ? mapped.entry->data_type.value
                                                       : std::uint16_t{0};
  const DataType& type = data_type_of(device, code);
  const bool is_number = is_integer(type.kind) || type.kind == TypeKind::real || type.kind == TypeKind::boolean;
  if (is_number && type.bits == mapped.bits) {
    return type.code;
  }
  constexpr std::uint16_t of_bits[][2] = {{1, 1},     {8, 5},     {16, 6},    {24, 0x16}, {32, 7},
                                          {40, 0x18}, {48, 0x19}, {56, 0x1A}, {64, 0x1B}};
  for (const auto& [bits, unsigned_type] : of_bits) {
    if (bits == mapped.bits) {
      return unsigned_type;
    }
  }
  return 0;
}

void Master::mapping_of(const ActivePdo& partner, std::uint16_t index, std::uint16_t objects) {
  const Node& node = network_.nodes[partner.node];
  const bool is_received = partner.pdo.is_transmit;
  std::vector<Sub> values;
  std::vector<Sub> maps;
  for (const MappedObject& mapped : partner.pdo.mapped) {
    const std::uint16_t type = mirror_type(partner, mapped);
    if (type == 0) {
      findings_.add(rules::mapping, node.span,
                    fmt::format("{}: {} maps {} bits of {:04X}h:{}; no data type of the master has as many", node.name,
                                partner.title(), mapped.bits, mapped.index, mapped.sub_index),
                    "change the mapping, or set pdo: none in the section master");
      return;
    }
    const auto sub_index = static_cast<std::uint8_t>(values.size() + 1);
    const std::string name = mapped.entry != nullptr ? one_line(mapped.entry->name.text) : "dummy";
    values.push_back({sub_index, fmt::format("{}: {}", node.name, name), type, is_received ? "rww" : "rwr", "", true});
    maps.push_back({sub_index, fmt::format("Mapped object {}", sub_index), 7, "rw",
                    hex(std::uint64_t{objects} << 16 | std::uint64_t{sub_index} << 8 | mapped.bits), false});
  }
  if (!values.empty()) {
    dictionary_.record(index, is_received ? "RPDO mapping parameter" : "TPDO mapping parameter", maps);
    dictionary_.record(objects, fmt::format("{} of {}", partner.title(), node.name), values);
  }
}

void Master::pdo(const ActivePdo& partner, std::uint16_t at) {
  const bool is_received = partner.pdo.is_transmit;
  const auto communication = static_cast<std::uint16_t>((is_received ? 0x1400 : 0x1800) + at);
  communication_of(partner, communication);
  mapping_of(partner, static_cast<std::uint16_t>(communication + 0x200),
             static_cast<std::uint16_t>((is_received ? received_objects : transmitted_objects) + at));
}

void Master::pdos() {
  const Links links = links_of(network_);
  for (const bool is_transmit : {true, false}) {
    const std::vector<const ActivePdo*> partners = unconnected(links, is_transmit);
    (is_transmit ? rpdo_count_ : tpdo_count_) = partners.size();
    for (std::size_t n = 0; n < partners.size(); ++n) {
      pdo(*partners[n], static_cast<std::uint16_t>(n));
    }
  }
}

// Configuration and boot-up ----------------------------------------------------------------------------------------

void Master::sdo_clients() {
  constexpr std::uint16_t first_client = 0x1280;
  for (std::size_t n = 0; n < network_.nodes.size() && n < 127; ++n) {
    const Node& node = network_.nodes[n];
    dictionary_.record(static_cast<std::uint16_t>(first_client + n), fmt::format("SDO client of {}", node.name),
                       {{1, "COB-ID client to server", 7, "rw", hex(0x600U + node.node_id), false},
                        {2, "COB-ID server to client", 7, "rw", hex(0x580U + node.node_id), false},
                        {3, "Node-ID of the SDO server", 5, "rw", std::to_string(node.node_id), false}});
  }
}

// Adds an array of domains by node-ID, whose contents are files.
void Master::files(std::uint16_t index, const std::string& name,
                   const std::function<std::string(const Node&, const PlannedSlave&)>& file) {
  std::map<std::uint8_t, std::string> files;
  for (std::size_t n = 0; n < network_.nodes.size(); ++n) {
    const std::string path = file(network_.nodes[n], plan_.slaves[n]);
    if (!path.empty() && network_.nodes[n].node_id != 0) {
      files[network_.nodes[n].node_id] = path;
    }
  }
  if (files.empty()) {
    return;
  }
  dictionary_.section(fmt::format("{:04X}", index));
  dictionary_.line("ParameterName", name);
  dictionary_.line("ObjectType", "0x8");
  dictionary_.line("SubNumber", std::to_string(files.size() + 1));
  dictionary_.section(fmt::format("{:04X}sub0", index));
  dictionary_.entry({0, "Highest sub-index supported", 5, "const", std::to_string(files.rbegin()->first), false});
  for (const auto& [node_id, path] : files) {
    dictionary_.section(fmt::format("{:04X}sub{:X}", index, node_id));
    dictionary_.entry({node_id, fmt::format("{} of node {}", name, node_id), domain, "rw", "", false});
    dictionary_.line("UploadFile", one_line(path));
  }
}

void Master::startup() {
  const PlannedMaster& m = master_;
  const std::uint64_t startup = 1U | (m.start_all_nodes.value ? 2U : 0U) | (m.start.value ? 0U : 4U) |
                                (m.start_nodes.value ? 0U : 8U) | (m.reset_all_nodes.value ? 0x10U : 0U) |
                                (m.stop_all_nodes.value ? 0x40U : 0U);
  files(0x1F22, "Concise DCF", [](const Node& node, const PlannedSlave& /*plan*/) { return node.configured_files; });
  files(0x1F58, "Program data",
        [](const Node& /*node*/, const PlannedSlave& plan) { return plan.software_file.value; });
  by_node(0x1F55, "Expected software identification",
          [](const Node& /*node*/, const PlannedSlave& plan) { return plan.software_version.value; });
  dictionary_.variable(0x1F80, {0, "NMT startup", 7, "rw", hex(startup), false});
  by_node(0x1F81, "NMT slave assignment", [](const Node& node, const PlannedSlave& plan) {
    const std::uint64_t guard_time = plan.guard_time.is_given ? node.number_or(0x100C, 0, 0) : 0;
    const std::uint64_t retries = guard_time != 0 ? node.number_or(0x100D, 0, 0) : 0;
    return 1U | (plan.is_booted.value ? 4U : 0U) | (plan.is_mandatory.value ? 8U : 0U) |
           (plan.may_reset.value ? 0U : 0x10U) | retries << 8 | guard_time << 16;
  });
  dictionary_.array(0x1F82, "Request NMT", 5, 128, {});
  by_node(0x1F84, "Device type identification",
          [](const Node& node, const PlannedSlave& /*plan*/) { return node.number_or(0x1000, 0, 0); });
  by_node(0x1F85, "Vendor identification",
          [](const Node& node, const PlannedSlave& /*plan*/) { return node.number_or(0x1018, 1, 0); });
  by_node(0x1F86, "Product code",
          [](const Node& node, const PlannedSlave& /*plan*/) { return node.number_or(0x1018, 2, 0); });
  by_node(0x1F87, "Revision number",
          [](const Node& /*node*/, const PlannedSlave& plan) { return plan.revision_number.value; });
  by_node(0x1F88, "Serial number",
          [](const Node& /*node*/, const PlannedSlave& plan) { return plan.serial_number.value; });
  dictionary_.variable(0x1F89, {0, "Boot time", 7, "rw", std::to_string(m.boot_time.value), false});
  dictionary_.array(
      0x1F8A, "Restore configuration", 5, 127,
      by_node([](const Node& /*node*/, const PlannedSlave& plan) { return plan.restore_configuration.value; }));
}

Device Master::device() const {
  Findings ignored;
  const eds::Document document(Source("master.dcf", dictionary_.text()), ignored);
  return eds::read(document, ignored).devices.front();
}

}  // namespace

Node generated_master(const Plan& plan, const Network& network, const std::vector<std::uint64_t>& consumer_times,
                      Findings& findings) {
  Master master(plan, network, findings);
  master.communication(consumer_times);
  master.sync();
  master.sdo_clients();
  master.pdos();
  master.startup();
  master.headers();
  Node node;
  node.name = "master";
  node.node_id = plan.master.node_id.value;
  node.is_master = true;
  node.span = plan.master.span;
  node.device = master.device();
  return node;
}

}  // namespace lexican::codict::network
