// SPDX-License-Identifier: Apache-2.0
// Checks of SRDOs. [EN 50325-5] They are the checks of the stack when it enters Operational, and the use of
// safety-relevant objects in ordinary PDOs.
#include "model/srdo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "check/network.hpp"
#include "model/subject.hpp"

namespace lexican::codict::check {

namespace {

constexpr std::uint64_t first_plain_id = 0x101;
constexpr std::uint64_t last_plain_id = 0x17F;

Span span_of(const Entry& entry) {
  const Value& value = value_in_force(entry);
  return value.is_given ? value.span : entry.span;
}

std::string title_of(const Srdo& srdo) { return fmt::format("SRDO {}", srdo.number); }

// Parameters ---------------------------------------------------------------------------------------------------------

class Parameters {
 public:
  Parameters(const Srdo& srdo, Findings& findings) : srdo_(srdo), findings_(findings) {}

  void check() {
    check_one(1, "direction", srdo_.direction == srdo_transmitted || srdo_.direction == srdo_received,
              "write 0 (the SRDO does not exist), 1 (transmitted) or 2 (received)");
    check_one(2, srdo_.is_transmit() ? "refresh time" : "safeguard cycle time", number(2) != 0,
              "write 1 to 65535, in ms");
    check_one(3, "validation time", number(3) != 0, "write 1 to 255, in ms");
    check_one(4, "transmission type", is_type(), "write 254");
    check_identifiers();
  }

 private:
  // A missing value is 254, the only one.
  bool is_type() const {
    const Entry* const entry = srdo_.parameter(4);
    return number(4) == srdo_type || (entry != nullptr && value_in_force(*entry).kind == Value::Kind::none);
  }

  std::uint64_t number(std::uint8_t sub_index) const {
    const Entry* const entry = srdo_.parameter(sub_index);
    return entry == nullptr ? 0 : value_in_force(*entry).integer.bits();
  }

  // Values that are no numbers are reported by the reader.
  void check_one(std::uint8_t sub_index, const char* name, bool is_right, const char* hint) {
    const Entry* const entry = srdo_.parameter(sub_index);
    if (entry == nullptr) {
      findings_.add(
          rules::srdo_missing, srdo_.communication->span,
          fmt::format("{} has no {} ({:04X}h sub {})", title_of(srdo_), name, srdo_.communication->index, sub_index),
          "describe it");
    } else if (value_in_force(*entry).kind != Value::Kind::malformed && !is_right) {
      findings_.add(rules::srdo_parameter, span_of(*entry),
                    fmt::format("{} has the invalid {} {}", title_of(srdo_), name, number(sub_index)), hint);
    }
  }

  void check_identifiers() {
    const std::uint64_t plain = number(5);
    const bool is_plain = plain >= first_plain_id && plain <= last_plain_id && plain % 2 == 1;
    if (is_of_node(5) || is_of_node(6)) {
      const Entry& entry = *srdo_.parameter(is_of_node(5) ? std::uint8_t{5} : std::uint8_t{6});
      findings_.add(
          rules::srdo_parameter, span_of(entry),
          fmt::format("COB-ID {} of {} depends on the node-ID", text_of(value_in_force(entry)), title_of(srdo_)),
          "write a number, for example FFh + 2 * node-ID for COB-ID 1");
      return;
    }
    check_one(5, "COB-ID 1", is_plain, "write an odd COB-ID, 101h to 17Fh");
    if (is_plain) {
      check_one(6, "COB-ID 2", number(6) == plain + 1, "write COB-ID 1 plus 1");
    }
  }

  bool is_of_node(std::uint8_t sub_index) const {
    const Entry* const entry = srdo_.parameter(sub_index);
    return entry != nullptr && value_in_force(*entry).adds_node_id;
  }

  const Srdo& srdo_;
  Findings& findings_;
};

// Mapping ------------------------------------------------------------------------------------------------------------

// Returns false after a finding if the number of mapped objects is invalid.
bool check_number(const Srdo& srdo, Findings& findings) {
  const Sub* const zero = srdo.mapping->find(0);
  const bool is_known = zero != nullptr && value_in_force(*zero).is_integer();
  const std::uint64_t number = is_known ? value_in_force(*zero).integer.bits() : srdo.mapped.size();
  const Span span = zero != nullptr ? span_of(*zero) : srdo.mapping->span;
  if (number == 0 || number % 2 != 0 || number > srdo_mapped_limit) {
    findings.add(rules::srdo_mapping, span, fmt::format("{} maps {} objects", title_of(srdo), number),
                 "map pairs of objects, 2 to 16: alternately the data and the inverted data");
    return false;
  }
  if (number != srdo.mapped.size()) {
    findings.add(rules::srdo_mapping, span,
                 fmt::format("sub-index 0 is {}, but {} maps {} objects", number, title_of(srdo), srdo.mapped.size()),
                 "correct sub-index 0, or map the missing objects");
    return false;
  }
  return true;
}

void check_lengths(const Srdo& srdo, Findings& findings) {
  constexpr unsigned srdo_bits = 64;
  unsigned bits = 0;
  for (std::size_t place = 0; place + 1 < srdo.mapped.size(); place += 2) {
    const MappedObject& plain = srdo.mapped[place];
    const MappedObject& inverse = srdo.mapped[place + 1];
    bits += plain.bits;
    if (plain.bits % 8 != 0) {
      findings.add(rules::srdo_mapping, value_in_force(*plain.mapping).span,
                   fmt::format("{} maps {} bits, not whole bytes", title_of(srdo), plain.bits), "map whole bytes");
    } else if (plain.bits != inverse.bits) {
      findings.add(rules::srdo_mapping, value_in_force(*inverse.mapping).span,
                   fmt::format("inverted data of {} bits for data of {} bits", inverse.bits, plain.bits),
                   "map an object of the same length");
    }
  }
  if (bits > srdo_bits) {
    findings.add(rules::srdo_mapping, srdo.mapping->span,
                 fmt::format("{} has {} bits, more than {}", title_of(srdo), bits, srdo_bits),
                 "map fewer or shorter objects");
  }
}

// Returns true if flag P and the access of an object permit the mapping, and CO_accessSRDO does not exclude it.
bool is_mappable(const Entry& entry, bool is_transmit) {
  const SrdoAccess access = entry.node->srdo->value;
  const bool has_direction =
      access == SrdoAccess::no || access == SrdoAccess::trx || (access == SrdoAccess::tx) == is_transmit;
  const bool has_flag = entry.pdo_mapping.value != PdoMapping::no || access != SrdoAccess::no;
  return has_flag && has_direction && (is_transmit ? is_readable(entry.access.value) : is_writable(entry.access.value));
}

void check_mapped(const Device& device, const Srdo& srdo, const MappedObject& mapped, Findings& findings) {
  const Span span = value_in_force(*mapped.mapping).span;
  const std::string name = subject_of(device, mapped.index, mapped.sub_index);
  if (mapped.is_dummy() && mapped.bits == data_type(mapped.index).bits) {
    return;
  }
  if (mapped.entry == nullptr) {
    findings.add(rules::srdo_object, span, fmt::format("mapped object {} does not exist", name),
                 "describe the object, or correct the mapping");
    return;
  }
  if (!is_mappable(*mapped.entry, srdo.is_transmit())) {
    findings.add(rules::srdo_object, span,
                 fmt::format("{} cannot map {} (access {}, PDO mapping {})", title_of(srdo), name,
                             name_of(mapped.entry->access.value), name_of(mapped.entry->pdo_mapping.value)),
                 srdo.is_transmit() ? "make it readable and mappable (PDOMapping or CO_accessSRDO)"
                                    : "make it writable and mappable (PDOMapping or CO_accessSRDO)");
    return;
  }
  const unsigned bits = data_type_of(device, mapped.entry->data_type.value).bits;
  if (bits != 0 && bits != mapped.bits) {
    findings.add(rules::srdo_object, span, fmt::format("mapping of {} bits, but {} has {}", mapped.bits, name, bits),
                 fmt::format("write {:04X}{:02X}{:02X}h", mapped.index, mapped.sub_index, bits));
  }
}

void check_mapping(const Device& device, const Srdo& srdo, Findings& findings) {
  if (srdo.mapping == nullptr) {
    findings.add(rules::srdo_missing, srdo.communication->span, title_of(srdo) + " has no mapping parameter",
                 fmt::format("describe {:04X}h", srdo_index::mapping + srdo.number - 1));
    return;
  }
  if (check_number(srdo, findings)) {
    check_lengths(srdo, findings);
  }
  for (const MappedObject& mapped : srdo.mapped) {
    check_mapped(device, srdo, mapped, findings);
  }
}

// Signature ----------------------------------------------------------------------------------------------------------

bool is_valid(const Device& device) {
  const Entry* const valid = device.find(srdo_index::valid, 0);
  return valid != nullptr && value_in_force(*valid).integer == Integer(srdo_valid_value);
}

// A signature of 0 means that there is none: it is written later, or `codict gen` fills it in.
void check_signature(const Device& device, const Srdo& srdo, Findings& findings) {
  const Entry* const entry = device.find(srdo_index::signatures, srdo.number);
  if (entry == nullptr) {
    findings.add(rules::srdo_missing, srdo.communication->span,
                 fmt::format("{} has no signature: the device does not start it", title_of(srdo)),
                 fmt::format("describe 13FFh sub {:X}", srdo.number));
    return;
  }
  const Value& value = value_in_force(*entry);
  const std::optional<std::uint16_t> expected = srdo_signature(srdo.number, device);
  if (value.kind == Value::Kind::malformed || !expected || value.integer == Integer(*expected)) {
    return;
  }
  if (value.integer != Integer(0)) {
    findings.add(rules::srdo_signature, span_of(*entry),
                 fmt::format("signature {:04X}h of {} differs from {:04X}h, that of its parameters",
                             value.integer.bits(), title_of(srdo), *expected),
                 fmt::format("correct the parameters, or review them and write 0x{:04X}", *expected));
  } else if (is_valid(device)) {
    findings.add(rules::srdo_signature_zero, span_of(*entry),
                 fmt::format("13FEh is A5h (valid), but the signature of {} is 0", title_of(srdo)),
                 fmt::format("review the parameters, and write 0x{:04X}", *expected));
  }
}

// Other PDOs ---------------------------------------------------------------------------------------------------------

bool maps(const std::vector<MappedObject>& mapped, const MappedObject& wanted) {
  return std::any_of(mapped.begin(), mapped.end(), [&wanted](const MappedObject& each) {
    return each.index == wanted.index && each.sub_index == wanted.sub_index;
  });
}

bool is_safety(const std::vector<Srdo>& srdos, const MappedObject& mapped) {
  return !mapped.is_dummy() &&
         std::any_of(srdos.begin(), srdos.end(), [&mapped](const Srdo& srdo) { return maps(srdo.mapped, mapped); });
}

// Reports a PDO that maps an object of an SRDO: in an RPDO, another device can change it without any safety check.
void check_pdos(const Device& device, const std::vector<Srdo>& srdos, Findings& findings) {
  for (const Pdo& pdo : pdos_of(device)) {
    for (const MappedObject& mapped : pdo.mapped) {
      if (is_safety(srdos, mapped)) {
        findings.add(rules::srdo_pdo, value_in_force(*mapped.mapping).span,
                     fmt::format("{}PDO {} maps {}, which an SRDO maps, too", pdo.is_transmit ? 'T' : 'R', pdo.number,
                                 subject_of(device, mapped.index, mapped.sub_index)),
                     "map another object with a copy of the value");
      }
    }
  }
}

}  // namespace

void check_srdos(const Device& device, Findings& findings) {
  const std::vector<Srdo> srdos = srdos_of(device);
  for (const Srdo& srdo : srdos) {
    Parameters(srdo, findings).check();
    check_mapping(device, srdo, findings);
    check_signature(device, srdo, findings);
  }
  if (!srdos.empty()) {
    if (device.find(srdo_index::valid) == nullptr) {
      findings.add(rules::srdo_missing, srdos.front().communication->span,
                   "13FEh is missing: the device starts no SRDO", "describe 13FEh");
    }
    check_pdos(device, srdos, findings);
  }
}

}  // namespace lexican::codict::check
