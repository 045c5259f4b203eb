// SPDX-License-Identifier: Apache-2.0
// lexican pdo send: sends a PDO that a device receives, with values by name.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "program/command.hpp"
#include "program/pdo.hpp"

namespace lexican::program {
namespace {

using describe::EntryKey;

/// A value for an object.
struct GivenValue {
  EntryKey key;
  std::string text;
};

/// Parses OBJECT=VALUE.
/// \retval nothing  the reason is printed
std::optional<GivenValue> given_value_of(const std::string& word, const describe::Description& description) {
  const std::size_t equals = word.find('=');
  ObjectReference object;
  std::string why;
  if (equals == std::string::npos || equals == 0) {
    print_message(fmt::format("'{}' is not OBJECT=VALUE, such as \"target velocity=1000\"", word));
    return std::nullopt;
  }
  if (!find_object(word.substr(0, equals), description, object, why)) {
    print_message(why);
    return std::nullopt;
  }
  return GivenValue{{object.index, object.sub_index}, word.substr(equals + 1)};
}

class PdoSender {
 public:
  PdoSender(const PdoOptions& options, PdoReader& reader) : options_(options), reader_(reader) {}

  /// Chooses the PDO, and makes its data.
  /// \retval status of the program
  int prepare(const std::vector<std::string>& words) {
    std::optional<PdoName> name = words.empty() ? std::nullopt : pdo_of(words.front());
    if (name && name->is_transmit) {
      print_message(name->text() + " is sent by the device; pdo send sends RPDOs, which it receives");
      return usage;
    }
    for (std::size_t n = name ? 1 : 0; n < words.size(); ++n) {
      const std::optional<GivenValue> value = given_value_of(words[n], reader_.description());
      if (!value) {
        return usage;
      }
      const bool is_twice =
          std::any_of(given_.begin(), given_.end(), [&](const GivenValue& other) { return other.key == value->key; });
      if (is_twice) {
        print_message(words[n] + ": the object has a value already");
        return usage;
      }
      given_.push_back(*value);
    }
    if (given_.empty()) {
      print_message("give the values, such as lexican pdo send 5 \"target velocity=1000\"");
      return usage;
    }
    const int status = name ? read_named(*name) : find_pdo();
    return status == ok ? fill() : status;
  }

  int send() {
    host_bus::Bus& bus = reader_.session().bus();
    BusHost& host = reader_.session().host();
    const std::optional<std::uint8_t> state = device_state();
    if (state && *state != operational) {
      print_message(fmt::format("node {0} is {1} and receives no PDOs: lexican nmt start {0}", reader_.node(),
                                state_text(*state)));
      return refused;
    }
    if (!state) {
      print_note(fmt::format("node {} sends no heartbeat: it has to be operational to receive PDOs", reader_.node()));
    }
    const bool needs_sync = pdo_.type.value_or(255) <= 240;
    if (needs_sync && !options_.sends_sync) {
      print_note(pdo_.name.text() + " takes effect with the next SYNC; --sync sends one");
    }
    print_result();
    std::fflush(stdout);
    const Micros period = options_.period * millisecond;
    Micros due = host.now();
    do {
      if (!send_frame(bus, host, frame_) || (options_.sends_sync && !send_frame(bus, host, sync_))) {
        return report_bus(bus);
      }
      ++sent_;
      due = std::max(due + period, host.now());  // what is late is not made up for
      while (period != 0 && !host.interrupted() && host.now() < due) {
        host.wait(due - host.now());
        while (bus.receive()) {
        }
      }
    } while (period != 0 && !host.interrupted());
    if (!bus.fault().empty()) {
      return report_bus(bus);
    }
    if (period != 0 && !options_.common.is_json) {
      print(fmt::format("sent {} times\n", sent_));
    }
    return ok;
  }

 private:
  static constexpr std::uint8_t operational = 0x05;

  /// Returns the NMT state of the device by its heartbeat, for which it waits; nothing: it sends none.
  std::optional<std::uint8_t> device_state() {
    Session& session = reader_.session();
    constexpr Micros longest = 5 * second;
    if (!session.state()) {
      const Transfer transfer = session.sdo().upload(0x1017, 0, {SdoClient::small, reader_.timeout(), {}});
      const Micros period = transfer.done() ? number_of(transfer.data) * millisecond : 0;
      const std::uint8_t heard =
          period != 0 && !session.state()
              ? wait_for_state(session, reader_.node(), operational, std::min(period + period / 2, longest))
              : no_state;
      return heard != no_state ? std::optional(heard) : session.state();
    }
    return session.state();
  }

  bool maps_all(const DevicePdo& pdo) const {
    return std::all_of(given_.begin(), given_.end(), [&](const GivenValue& value) {
      return std::any_of(pdo.mapped.begin(), pdo.mapped.end(),
                         [&](const MappedEntry& entry) { return entry.key == value.key; });
    });
  }

  int read_named(const PdoName& name) {
    std::optional<DevicePdo> pdo;
    const int status = reader_.read(name, pdo);
    if (status != ok) {
      return status;
    }
    if (!pdo || !pdo->is_valid()) {
      print_message(fmt::format("node {} has no {} that is on; lexican pdo show {} has all", reader_.node(),
                                name.text(), reader_.node()));
      return refused;
    }
    if (!maps_all(*pdo)) {
      print_message(name.text() + " does not map all of these objects:\n" + text_of(*pdo, reader_.description()));
      return refused;
    }
    pdo_ = *pdo;
    return ok;
  }

  /// Finds the first valid RPDO that maps all objects.
  int find_pdo() {
    std::vector<DevicePdo> pdos;
    const int status = reader_.read_all(pdos);
    if (status != ok) {
      return status;
    }
    const auto found = std::find_if(pdos.begin(), pdos.end(), [this](const DevicePdo& pdo) {
      return !pdo.name.is_transmit && pdo.is_valid() && maps_all(pdo);
    });
    if (found == pdos.end()) {
      const EntryKey key = given_.front().key;
      print_message(fmt::format("no RPDO of node {} that is on maps {}{}; lexican pdo map {} rpdo1 ... changes one",
                                reader_.node(), reader_.description().object(key.first, key.second),
                                given_.size() > 1 ? " and the others together" : "", reader_.node()));
      return refused;
    }
    pdo_ = *found;
    return ok;
  }

  /// Makes the data: objects that are not given keep the value that the device has.
  int fill() {
    if (pdo_.bits() > 64) {
      print_message(fmt::format("{} maps {} bits, and a PDO has 64", pdo_.name.text(), pdo_.bits()));
      return refused;
    }
    frame_ = pdo_.frame();
    sync_.Identifier = 0x080;
    unsigned position = 0;
    for (const MappedEntry& entry : pdo_.mapped) {
      Bytes bytes;
      if (entry.bits == 0) {
        print_message(fmt::format("{} maps {} with a length of 0 bits", pdo_.name.text(),
                                  reader_.description().object(entry.key.first, entry.key.second)));
        return refused;
      }
      const int status = entry.is_dummy() ? ok : value_of(entry, bytes);
      if (status != ok) {
        return status;
      }
      bytes.resize((entry.bits + 7) / 8);
      for (unsigned n = 0; n < entry.bits; ++n, ++position) {
        const unsigned bit = bytes[n / 8] >> (n % 8) & 1U;
        frame_.Data[position / 8] = static_cast<std::uint8_t>(frame_.Data[position / 8] | bit << (position % 8));
      }
      if (!entry.is_dummy()) {
        values_[entry.key] = bytes;
      }
    }
    return ok;
  }

  int value_of(const MappedEntry& entry, Bytes& bytes) {
    const auto [index, sub_index] = entry.key;
    const auto given =
        std::find_if(given_.begin(), given_.end(), [&](const GivenValue& value) { return value.key == entry.key; });
    if (given != given_.end()) {
      return encode_given(*given, entry.bits, bytes) ? ok : usage;
    }
    const Transfer transfer =
        reader_.session().sdo().upload(index, sub_index, {SdoClient::small, reader_.timeout(), {}});
    if (!transfer.done()) {
      const int status = reader_.report(entry.key, transfer);
      if (status == refused) {
        print_message(fmt::format("{} is in {}, too: give its value", reader_.description().object(index, sub_index),
                                  pdo_.name.text()));
      }
      return status;
    }
    bytes = transfer.data;
    return ok;
  }

  /// \retval false  the reason is printed
  bool encode_given(const GivenValue& given, unsigned bits, Bytes& bytes) const {
    const auto [index, sub_index] = given.key;
    const describe::Description& description = reader_.description();
    const std::size_t size = (bits + 7) / 8;
    std::optional<ValueType> type = description.type_of(index, sub_index);
    if (!type) {
      const bool is_negative = given.text.substr(0, 1) == "-";
      type = ValueType{is_negative ? ValueType::Kind::integer : ValueType::Kind::unsigned_integer,
                       static_cast<unsigned>(size)};
    }
    const Encoded encoded = encode(*type, given.text);
    std::string why = encoded.fault;
    if (why.empty() && !options_.is_forced) {
      why = beyond_limits(description, reader_.node(), given.key, given.text);
    }
    const bool has_more_bits =
        bits % 8 != 0 && encoded.bytes.size() == size && (encoded.bytes.back() >> (bits % 8)) != 0;
    if (why.empty() && (encoded.bytes.size() > size || has_more_bits)) {
      why = fmt::format("'{}' does not fit the {} bits of it that {} maps", given.text, bits, pdo_.name.text());
    }
    if (!why.empty()) {
      print_message(description.object(index, sub_index) + ": " + why);
      return false;
    }
    bytes = encoded.bytes;
    return true;
  }

  static bool send_frame(host_bus::Bus& bus, BusHost& host, const CO_IF_FRM& frame) {
    while (!bus.send(frame)) {
      if (host.interrupted()) {
        return false;
      }
      host.wait(millisecond);
      bus.receive();
    }
    return true;
  }

  static int report_bus(const host_bus::Bus& bus) {
    print_message(bus.fault().empty() ? "interrupted" : bus.fault());
    return bus.fault().empty() ? interrupted : bus_fault;
  }

  void print_result() const {
    const describe::Description& description = reader_.description();
    if (options_.common.is_json) {
      nlohmann::json values = nlohmann::json::array();
      for (const auto& [key, bytes] : values_) {
        values.push_back({{"index", key.first},
                          {"sub", key.second},
                          {"object", description.object(key.first, key.second)},
                          {"text", description.show(key.first, key.second, bytes)}});
      }
      const nlohmann::json json = {{"node", reader_.node()},
                                   {"pdo", pdo_.name.text()},
                                   {"cob_id", frame_.Identifier & CO_IF_FRM_ID},
                                   {"values", values}};
      print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
      return;
    }
    std::string text = fmt::format("{} ({})", pdo_.name.text(), pdo_.identifier());
    const char* separator = " ";
    for (const auto& [key, bytes] : values_) {
      const std::string name = description.name_of(key.first, key.second);
      text += separator + (name.empty() ? description.object(key.first, key.second) : name) + " = " +
              description.show(key.first, key.second, bytes);
      separator = ", ";
    }
    print(text + '\n');
  }

  const PdoOptions& options_;
  PdoReader& reader_;
  std::vector<GivenValue> given_;
  DevicePdo pdo_;
  CO_IF_FRM frame_{};
  CO_IF_FRM sync_{};
  std::map<EntryKey, Bytes> values_;
  unsigned sent_ = 0;
};

}  // namespace

int run_send(const PdoOptions& options, PdoReader& reader, const std::vector<std::string>& words) {
  PdoSender sender(options, reader);
  const int status = sender.prepare(words);
  return status == ok ? sender.send() : status;
}

}  // namespace lexican::program
