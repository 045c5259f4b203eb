// SPDX-License-Identifier: Apache-2.0
// lexican apply: writes the configuration of a DCF or XDC into a device.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "describe/configuration.hpp"
#include "model/downloads.hpp"
#include "model/pdo.hpp"
#include "program/command.hpp"
#include "program/identity.hpp"
#include "trace/decode.hpp"

namespace lexican::program {
namespace {

using codict::Download;
using describe::EntryKey;
using describe::Part;

constexpr std::uint16_t store_parameters = 0x1010;
constexpr Micros boot_time = 10'000 * millisecond;

struct ApplyOptions {
  Common common;
  std::string file;
  std::string node;
  bool shows_only = false;  ///< --diff
  bool stores = false;
  bool is_forced = false;
};

/// A value that the device has not, or that cannot be compared.
struct Difference {
  EntryKey key;
  Bytes before;            ///< in the device
  Bytes wanted;            ///< in the file
  std::uint32_t code = 0;  ///< why the device has refused to read or to write it; 0: it has not
};

Bytes bytes_of(const Download& download) { return {download.bytes.begin(), download.bytes.end()}; }

class Apply {
 public:
  Apply(const ApplyOptions& options, Session& session, const describe::Description& description, std::uint8_t node)
      : options_(options), session_(session), description_(description), device_(*description.device()), node_(node) {}

  /// Plans the downloads: reads the device type, and the COB-ID and the number of mapped objects of PDOs for which the
  /// file has other parameters only.
  /// \retval false  as compare()
  bool plan() {
    const std::vector<EntryKey> given = given_values();
    if (!complete()) {
      return false;
    }
    const std::set<EntryKey> mapped = describe::mapped_entries(device_);
    std::set<EntryKey> planned;
    for (Download& download : codict::downloads_of(
             device_, node_, [this](std::uint16_t index, std::uint8_t sub_index, const codict::Entry&) {
               malformed_.emplace_back(index, sub_index);
             })) {
      const EntryKey key{download.index, download.sub_index};
      const Part part = describe::part_of(device_, key, mapped);
      if (part != Part::configuration && part != Part::write_only) {
        continue;
      }
      planned.insert(key);
      if (part == Part::write_only) {
        write_only_.insert(key);
      }
      compared_ += is_compared(download) ? 1U : 0U;
      downloads_.push_back(std::move(download));
    }
    for (const EntryKey& key : given) {
      if (planned.count(key) == 0 && std::count(malformed_.begin(), malformed_.end(), key) == 0) {
        left_out_.push_back(key);
      }
    }
    return true;
  }

  /// Compares the values of the device with those of the file.
  /// \retval false  the device does not answer, or the program was interrupted: transfer() is the last one
  bool compare() {
    differences_.clear();
    EntryCount count(compared_);
    for (const Download& download : downloads_) {
      const EntryKey key{download.index, download.sub_index};
      if (!is_compared(download)) {
        continue;
      }
      count.next();
      if (!read(key)) {
        return false;
      }
      const Bytes wanted = bytes_of(download);
      if (!transfer_.done() || !describe::is_equal(device_, key, transfer_.data, wanted)) {
        differences_.push_back({key, transfer_.data, wanted, transfer_.code});
      }
    }
    return true;
  }

  /// Writes the values that differ, those that cannot be compared, and PDOs of which a parameter differs as a whole.
  /// \retval false  as compare()
  bool write() {
    refused_.clear();
    broken_pdos_.clear();
    const auto differs = [this](const Download& download) {
      return std::any_of(differences_.begin(), differences_.end(), [&](const Difference& difference) {
        return difference.key == EntryKey{download.index, download.sub_index};
      });
    };
    std::set<std::uint16_t> pdos;
    for (const Download& download : downloads_) {
      if (download.communication != 0 && differs(download)) {
        pdos.insert(download.communication);
      }
    }
    for (const Download& download : downloads_) {
      const EntryKey key{download.index, download.sub_index};
      const bool is_wanted = download.communication != 0 ? pdos.count(download.communication) != 0
                                                         : write_only_.count(key) != 0 || differs(download);
      if (!is_wanted) {
        continue;
      }
      last_ = key;
      open_pdo_ = download.communication;
      transfer_ = session_.sdo().download(key.first, key.second, bytes_of(download),
                                          {SdoClient::small, options_.common.timeout, {}});
      if (!transfer_.done() && !is_refusal()) {
        return false;
      }
      if (transfer_.done()) {
        written_ += download.is_intermediate ? 0U : 1U;
      } else {
        refused_[key] = transfer_.code;
        if (pdos.erase(download.communication) != 0) {  // with a part of its parameters it must not be switched on
          broken_pdos_.insert(download.communication);
        }
      }
    }
    open_pdo_ = 0;
    return true;
  }

  /// Asks the device whether it can store its parameters.
  /// \retval false  as compare()
  bool check_store(bool& can_store) {
    const bool has_answer = read({store_parameters, 1});
    can_store = transfer_.code != CO_SDO_ERR_OBJ && transfer_.code != CO_SDO_ERR_SUB;
    return has_answer;
  }

  /// Prints a line for each difference. \a before: words for the value of the device, \a after: for that of the file.
  void print_differences() const {
    std::size_t width = 0;
    for (const Difference& difference : differences_) {
      width = std::max(width, name_of(difference.key).size());
    }
    for (const Difference& difference : differences_) {
      const auto [key, before, wanted, code] = difference;
      const std::string shown = code != 0 ? fmt::format("refused {}", trace::abort_code(code))
                                          : description_.show(key.first, key.second, before);
      print(fmt::format("  {:<{}}  {} -> {}\n", name_of(key), width, shown,
                        description_.show(key.first, key.second, wanted)));
    }
  }

  void print_refused() const {
    for (const auto& [key, code] : refused_) {
      print_message(
          fmt::format("{} refused: {} {}", name_of(key), trace::abort_code(code), trace::abort_meaning(code)));
    }
    for (const std::uint16_t index : broken_pdos_) {
      print_message(fmt::format("{:04X}h: the rest of this PDO was not written, and it is not switched on", index));
    }
  }

  std::string name_of(const EntryKey& key) const { return description_.object(key.first, key.second); }
  const Transfer& transfer() const { return transfer_; }
  const EntryKey& last() const { return last_; }
  std::size_t compared() const { return compared_; }
  std::size_t written() const { return written_; }
  /// Returns the communication parameter of the PDO that was being written when the device stopped answering; 0: none.
  std::uint16_t open_pdo() const { return open_pdo_; }
  /// Returns true if the file has values that cannot be read from the device.
  bool has_write_only() const { return !write_only_.empty(); }
  bool has_downloads() const { return !downloads_.empty(); }
  const std::vector<Difference>& differences() const { return differences_; }
  const std::map<EntryKey, std::uint32_t>& refused() const { return refused_; }
  /// Values of the file that are not written: commands, set-points, process values, read-only ones.
  const std::vector<EntryKey>& left_out() const { return left_out_; }
  /// Values of the file that do not fit their types.
  const std::vector<EntryKey>& malformed() const { return malformed_; }
  /// Values that are beyond the limits of the file, with these limits.
  std::map<EntryKey, std::string> beyond_limits() const {
    std::map<EntryKey, std::string> result;
    for (const Download& download : downloads_) {
      const codict::Entry* const entry = device_.find(download.index, download.sub_index);
      const bool is_integer = !download.is_intermediate && entry != nullptr && entry->actual_value->is_integer();
      const std::string limits =
          is_integer ? exceeded_limits(*entry, node_, entry->actual_value->integer_for(node_)) : std::string();
      if (!limits.empty() && completed_.count({download.index, download.sub_index}) == 0) {
        result[{download.index, download.sub_index}] = limits;
      }
    }
    return result;
  }
  std::string text_of(const EntryKey& key) const { return device_.find(key.first, key.second)->actual_value->text; }

 private:
  bool is_refusal() const {
    return transfer_.fault.empty() && !transfer_.is_unanswered() && !session_.is_interrupted();
  }

  bool is_compared(const Download& download) const {
    const EntryKey key{download.index, download.sub_index};
    return !download.is_intermediate && write_only_.count(key) == 0 && completed_.count(key) == 0;
  }

  std::vector<EntryKey> given_values() const {
    std::vector<EntryKey> given;
    codict::for_each_variable(device_, [&](std::uint16_t index, std::uint8_t sub_index, const codict::Entry& entry) {
      if (!entry.actual_value->is_empty()) {
        given.emplace_back(index, sub_index);
      }
    });
    return given;
  }

  /// Reads what the order of the downloads depends on, and the file does not have.
  bool complete() {
    last_ = describe::device_type;
    if (!read_device_type(session_.sdo(), options_.common.timeout, device_, transfer_) || session_.is_interrupted()) {
      return false;
    }
    std::vector<EntryKey> missing;
    for (const codict::Pdo& pdo : codict::pdos_of(device_)) {
      const bool has_mapping = pdo.mapping != nullptr && has_value(*pdo.mapping);
      if (pdo.communication != nullptr && (has_mapping || has_value(*pdo.communication))) {
        missing.emplace_back(pdo.communication->index, std::uint8_t{1});
      }
      if (has_mapping) {
        missing.emplace_back(pdo.mapping->index, std::uint8_t{0});
      }
    }
    for (const EntryKey& key : missing) {
      const codict::Entry* const entry = device_.find(key.first, key.second);
      if (entry == nullptr || !entry->actual_value->is_empty() || !codict::is_writable(entry->access.value)) {
        continue;
      }
      if (!read(key)) {
        return false;
      }
      if (transfer_.done() && describe::store_value(device_, key, node_, transfer_.data)) {
        completed_.insert(key);
      }
    }
    return true;
  }

  static bool has_value(const codict::Object& object) {
    return std::any_of(object.subs.begin(), object.subs.end(),
                       [](const codict::Sub& sub) { return !sub.actual_value->is_empty(); });
  }

  /// \retval false  as compare(); true also if the device has refused it
  bool read(const EntryKey& key) {
    constexpr std::uint32_t most = 65536;
    last_ = key;
    transfer_ = session_.sdo().upload(key.first, key.second, {most, options_.common.timeout, {}});
    return transfer_.done() || is_refusal();
  }

  const ApplyOptions& options_;
  Session& session_;
  const describe::Description& description_;
  codict::Device device_;
  std::uint8_t node_;
  std::set<EntryKey> write_only_;
  std::set<std::uint16_t> broken_pdos_;  ///< communication parameters of PDOs of which the device has refused a part
  std::set<EntryKey> completed_;         ///< read from the device, not of the file
  std::vector<EntryKey> malformed_;
  std::vector<Download> downloads_;
  std::vector<EntryKey> left_out_;
  std::size_t compared_ = 0;
  std::size_t written_ = 0;
  std::uint16_t open_pdo_ = 0;
  std::vector<Difference> differences_;
  std::map<EntryKey, std::uint32_t> refused_;
  Transfer transfer_;
  EntryKey last_{};
};

/// Prints the failure of the last transfer, and how to go on.
int report_break(Session& session, const Apply& apply, std::uint8_t node) {
  Target target;
  target.node = node;
  target.name = apply.name_of(apply.last());
  const int status = report_failure(session, target, apply.transfer());
  const std::uint16_t pdo = apply.open_pdo();
  if (apply.written() != 0 || pdo != 0) {
    print_message(fmt::format(
        "{} value{} written{}; the same command goes on", apply.written(), apply.written() == 1 ? " was" : "s were",
        pdo == 0 ? ""
                 : fmt::format(", and {}PDO{} may be switched off", pdo >= 0x1800 ? 'T' : 'R', (pdo & 0x1FFU) + 1)));
  }
  return status;
}

/// Stores the parameters, resets the device, and compares again.
int store(Session& session, Apply& apply, std::uint8_t node, const Common& common) {
  Transfer ignored;
  const std::optional<describe::Identity> before = read_identity(session.sdo(), common.timeout, ignored);
  Target target;
  target.node = node;
  target.name = apply.name_of({store_parameters, 1});
  const std::uint32_t patience = std::max(common.timeout, std::uint32_t{10'000});  // of a slow memory
  const Transfer saved =
      session.sdo().download(store_parameters, 1, {'s', 'a', 'v', 'e'}, {SdoClient::small, patience, {}});
  if (!saved.done()) {
    return report_failure(session, target, saved);
  }
  if (!send_command(session.bus(), session.host(), CO_NMT_COMMAND_RESET_NODE, node, common.timeout * millisecond)) {
    print_message(fmt::format("stored; but node {} was not reset", node));
    return report_unsent(session);
  }
  if (wait_for_state(session, node, 0, boot_time) != 0) {
    print_message(
        fmt::format("stored; but node {} has sent no boot-up message after its reset; lexican apply --diff "
                    "shows after a power cycle whether all is there",
                    node));
    return session.is_interrupted() ? interrupted : no_answer;
  }
  const std::optional<describe::Identity> after = read_identity(session.sdo(), common.timeout, ignored);
  if (before && (!after || after->vendor != before->vendor || after->product != before->product)) {
    print_message(fmt::format("after the reset, another device answers as node {}", node));
    return refused;
  }
  if (!apply.compare()) {
    return report_break(session, apply, node);
  }
  return ok;
}

void print_json_result(const Apply& apply, std::uint8_t node, bool is_stored,
                       const std::vector<Difference>& differences) {
  const auto object = [](const EntryKey& key) { return nlohmann::json{{"index", key.first}, {"sub", key.second}}; };
  nlohmann::json differ = nlohmann::json::array();
  for (const Difference& difference : differences) {
    differ.push_back(object(difference.key));
  }
  nlohmann::json refused = nlohmann::json::array();
  for (const auto& [key, code] : apply.refused()) {
    refused.push_back(object(key));
    refused.back()["abort"] = code;
  }
  const nlohmann::json json = {{"node", node},       {"values", apply.compared()},
                               {"differ", differ},   {"written", apply.written()},
                               {"refused", refused}, {"stored", is_stored}};
  print(json.dump() + '\n');
}

/// Prints the values of the file that cannot be written.
/// \retval false  some do not fit their types, or are beyond their limits, and --force is not given
bool check_values(const Apply& apply, const ApplyOptions& options) {
  for (const EntryKey& key : apply.malformed()) {
    (options.is_forced ? print_note : print_message)(fmt::format("{}: {} = '{}' is no value of its type{}",
                                                                 options.file, apply.name_of(key), apply.text_of(key),
                                                                 options.is_forced ? "; it is left out" : ""));
  }
  if (!apply.malformed().empty() && !options.is_forced) {
    print_message("nothing was written; --force leaves such values out");
    return false;
  }
  const std::map<EntryKey, std::string> beyond_limits = apply.beyond_limits();
  for (const auto& [key, limits] : beyond_limits) {
    (options.is_forced ? print_note : print_message)(fmt::format("{}: {} = {} is beyond its limits, {}", options.file,
                                                                 apply.name_of(key), apply.text_of(key), limits));
  }
  if (!beyond_limits.empty() && !options.is_forced) {
    print_message("nothing was written; --force writes values beyond their limits");
    return false;
  }
  if (!apply.left_out().empty()) {
    print_note(fmt::format("not written from a file, as commands, set-points, process values or read-only: {}",
                           describe::keys_text(apply.left_out())));
  }
  return true;
}

/// Compares, and writes what differs.
int apply_to(Session& session, Apply& apply, std::uint8_t node, const ApplyOptions& options) {
  if (!apply.plan()) {
    return report_break(session, apply, node);
  }
  if (!check_values(apply, options)) {
    return usage;
  }
  if (!apply.has_downloads()) {
    print_message(options.file + " has no values that can be written; lexican dump reads a DCF that has");
    return usage;
  }
  bool can_store = true;
  if (options.stores && !options.shows_only && !apply.check_store(can_store)) {
    return report_break(session, apply, node);
  }
  if (!can_store) {
    print_message(fmt::format(
        "node {} cannot store parameters, as it has no 1010h:01: apply the file after each power-up, without --store",
        node));
    print_message("nothing was written");
    return refused;
  }
  if (!apply.compare()) {
    return report_break(session, apply, node);
  }
  const std::vector<Difference> differences = apply.differences();
  if (!options.common.is_json) {
    print(fmt::format("{} of {} values differ\n", differences.size(), apply.compared()));
    apply.print_differences();
  }
  if (options.shows_only) {
    if (options.common.is_json) {
      print_json_result(apply, node, false, differences);
    }
    if (options.common.is_json && !differences.empty()) {
      print_message(fmt::format("{} of {} values differ", differences.size(), apply.compared()));
    }
    return differences.empty() ? ok : refused;
  }
  const bool has_work = !differences.empty() || apply.has_write_only() || options.stores;
  int status = has_work ? agree(session.bus(), options.common,
                                fmt::format("write {} of {} values{} node {}", differences.size(), apply.compared(),
                                            options.stores ? ", store all, and reset" : " to", node))
                        : int{ok};
  if (status != ok) {
    return status;
  }
  if (!differences.empty() || apply.has_write_only()) {
    if (!send_command(session.bus(), session.host(), CO_NMT_COMMAND_PREOP, node,
                      options.common.timeout * millisecond)) {
      print_message("nothing was written");
      return report_unsent(session);
    }
    if (!apply.write() || !apply.compare()) {
      return report_break(session, apply, node);
    }
  }
  apply.print_refused();
  bool is_stored = false;
  if (apply.differences().empty() && apply.refused().empty() && options.stores) {
    status = store(session, apply, node, options.common);
    if (status != ok) {
      return status;
    }
    is_stored = true;
  }
  if (!apply.differences().empty() || !apply.refused().empty()) {
    status = refused;
    const std::string text = fmt::format("after {}, {} of {} values differ{}",
                                         is_stored ? "the reset of the device" : "writing", apply.differences().size(),
                                         apply.compared(), options.stores && !is_stored ? "; nothing was stored" : "");
    if (options.common.is_json) {
      print_message(text);
    } else {
      print(text + ":\n");
      apply.print_differences();
    }
  }
  if (options.common.is_json) {
    print_json_result(apply, node, is_stored && status == ok, differences);
  } else if (status == ok && (apply.written() != 0 || options.stores)) {
    print(fmt::format("all {} values are as in the file{}\n", apply.compared(),
                      is_stored ? ", also after a reset of the device"
                                : fmt::format("; node {0} is pre-operational: lexican nmt start {0}", node)));
  }
  return status;
}

int run_apply(const ApplyOptions& options) {
  std::string why;
  const std::optional<describe::Description> description = describe::read_description(options.file, why);
  if (!description) {
    print_message(why);
    return usage;
  }
  const std::uint8_t commissioned = description->device()->commissioning.node_id.value;
  const std::uint8_t node =
      options.node.empty() ? (commissioned <= 127 ? commissioned : std::uint8_t{0}) : node_of(options.node);
  if (node == 0) {
    print_message(options.node.empty() ? options.file + " has no node-ID; give it by -n NODE"
                                       : "'" + options.node + "' is no node-ID, which is 1 to 127");
    return usage;
  }
  int status = ok;
  std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  Session session(std::move(bus), node);
  Apply apply(options, session, *description, node);
  Target target;
  target.node = node;
  target.name = "identity (1018h)";
  Transfer transfer;
  const std::optional<describe::Identity> identity = read_identity(session.sdo(), options.common.timeout, transfer);
  if (!identity && (transfer.is_unanswered() || session.is_interrupted())) {
    return report_failure(session, target, transfer);
  }
  const codict::Identity& described = description->device()->identity;
  const bool is_named = described.vendor_number.value != 0 || described.product_number.value != 0;
  const std::string other = identity   ? other_identity(described, *identity)
                            : is_named ? "the device does not have the vendor-ID and product code (1018h) of the file"
                                       : std::string();
  if (!other.empty() && !options.is_forced) {
    print_message(other + "; --force applies it all the same");
    return refused;
  }
  return apply_to(session, apply, node, options);
}

}  // namespace

Verb add_apply(CommandLine& line) {
  const auto options = std::make_shared<ApplyOptions>();
  Arguments arguments = line.add_command("apply", "Write the configuration of a DCF into a device");
  arguments.add_option("file", options->file, "DCF or XDC with the values, such as lexican dump writes it").required();
  arguments.add_option("-n,--node", options->node, "Node-ID of the device; default: that of the file");
  arguments.add_flag("--diff", options->shows_only, "Only show what differs");
  arguments.add_flag("--store", options->stores, "Store the parameters (1010h), reset the device, and compare again");
  arguments.add_flag("--force", options->is_forced,
                     "Also into a device with another identity, without values that do not fit their types, and beyond "
                     "the limits of the file");
  add_bus_options(arguments, options->common);
  add_timeout_option(arguments, options->common, 1000);
  arguments.end_help(
      "Examples:\n"
      "  lexican apply drive5.dcf --diff -i can0\n"
      "  lexican apply drive5.dcf -n 6 --store -i can0");
  return {arguments, [options] { return finish(options->common, run_apply(*options)); }};
}

}  // namespace lexican::program
