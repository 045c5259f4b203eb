// SPDX-License-Identifier: Apache-2.0
#include "check/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "model/subject.hpp"

namespace lexican::codict::check {

namespace rules {

const Rule profile_object_missing{"profile-object-missing", Severity::warning,
                                  "mandatory object of the device profile is missing"};
const Rule profile_kind{"profile-kind", Severity::warning,
                        "profile object with another object type than in the profile"};
const Rule profile_type{"profile-type", Severity::warning, "profile object with another data type than in the profile"};
const Rule profile_access{"profile-access", Severity::warning, "profile object with an access that its use excludes"};

}  // namespace rules

const std::vector<const Rule*>& profile_rules() {
  static const std::vector<const Rule*> all = {&rules::profile_object_missing, &rules::profile_kind,
                                               &rules::profile_type, &rules::profile_access};
  return all;
}

namespace {

constexpr std::uint16_t i8 = type_code::integer8;
constexpr std::uint16_t i16 = 0x03;
constexpr std::uint16_t i32 = 0x04;
constexpr std::uint16_t u8 = type_code::unsigned8;
constexpr std::uint16_t u16 = type_code::unsigned16;
constexpr std::uint16_t u32 = type_code::unsigned32;
constexpr std::uint16_t r32 = 0x08;
constexpr std::uint16_t flag = type_code::boolean;

constexpr ObjectCode var = ObjectCode::variable;
constexpr ObjectCode array = ObjectCode::array;

// Access of a master to an object. `set` is a parameter, which may also be constant.
enum class Use : unsigned char { read, write, set };

// Objects of a device profile. The data type of an ARRAY is that of its elements.
struct Fact {
  std::uint16_t first;
  std::uint16_t last;
  ObjectCode code;
  std::uint16_t type;
  Use use;
};

// Objects of CiA 401 (inputs and outputs). [401]
constexpr std::array<Fact, 26> io_facts = {{
    {0x6000, 0x6000, array, u8, Use::read},   {0x6002, 0x6003, array, u8, Use::set},
    {0x6005, 0x6005, var, flag, Use::set},    {0x6006, 0x6008, array, u8, Use::set},
    {0x6100, 0x6100, array, u16, Use::read},  {0x6120, 0x6120, array, u32, Use::read},
    {0x6200, 0x6200, array, u8, Use::write},  {0x6202, 0x6203, array, u8, Use::set},
    {0x6206, 0x6208, array, u8, Use::set},    {0x6300, 0x6300, array, u16, Use::write},
    {0x6320, 0x6320, array, u32, Use::write}, {0x6400, 0x6400, array, i8, Use::read},
    {0x6401, 0x6401, array, i16, Use::read},  {0x6402, 0x6402, array, i32, Use::read},
    {0x6403, 0x6403, array, r32, Use::read},  {0x6410, 0x6410, array, i8, Use::write},
    {0x6411, 0x6411, array, i16, Use::write}, {0x6412, 0x6412, array, i32, Use::write},
    {0x6413, 0x6413, array, r32, Use::write}, {0x6421, 0x6421, array, u8, Use::set},
    {0x6422, 0x6422, array, u32, Use::read},  {0x6423, 0x6423, var, flag, Use::set},
    {0x6424, 0x6425, array, i32, Use::set},   {0x6426, 0x6428, array, u32, Use::set},
    {0x6443, 0x6443, array, u8, Use::set},    {0x6444, 0x6444, array, i32, Use::set},
}};

// Objects of CiA 402 (drives). [402]
constexpr std::array<Fact, 45> drive_facts = {{
    {0x603F, 0x603F, var, u16, Use::read},  {0x6040, 0x6040, var, u16, Use::write},
    {0x6041, 0x6041, var, u16, Use::read},  {0x6042, 0x6042, var, i16, Use::write},
    {0x6043, 0x6044, var, i16, Use::read},  {0x6046, 0x6046, array, u32, Use::set},
    {0x605A, 0x605E, var, i16, Use::set},   {0x6060, 0x6060, var, i8, Use::write},
    {0x6061, 0x6061, var, i8, Use::read},   {0x6062, 0x6064, var, i32, Use::read},
    {0x6065, 0x6065, var, u32, Use::set},   {0x6066, 0x6066, var, u16, Use::set},
    {0x6067, 0x6067, var, u32, Use::set},   {0x6068, 0x6068, var, u16, Use::set},
    {0x6069, 0x6069, var, i32, Use::read},  {0x606A, 0x606A, var, i16, Use::set},
    {0x606B, 0x606C, var, i32, Use::read},  {0x606D, 0x6070, var, u16, Use::set},
    {0x6071, 0x6071, var, i16, Use::write}, {0x6072, 0x6073, var, u16, Use::set},
    {0x6074, 0x6074, var, i16, Use::read},  {0x6075, 0x6076, var, u32, Use::set},
    {0x6077, 0x6078, var, i16, Use::read},  {0x6079, 0x6079, var, u32, Use::read},
    {0x607A, 0x607A, var, i32, Use::write}, {0x607B, 0x607B, array, i32, Use::set},
    {0x607C, 0x607C, var, i32, Use::set},   {0x607D, 0x607D, array, i32, Use::set},
    {0x607E, 0x607E, var, u8, Use::set},    {0x607F, 0x6085, var, u32, Use::set},
    {0x6086, 0x6086, var, i16, Use::set},   {0x6087, 0x6087, var, u32, Use::set},
    {0x6088, 0x6088, var, i16, Use::set},   {0x608F, 0x6092, array, u32, Use::set},
    {0x6098, 0x6098, var, i8, Use::set},    {0x6099, 0x6099, array, u32, Use::set},
    {0x609A, 0x609A, var, u32, Use::set},   {0x60B0, 0x60B1, var, i32, Use::set},
    {0x60B2, 0x60B2, var, i16, Use::set},   {0x60C5, 0x60C6, var, u32, Use::set},
    {0x60F4, 0x60F4, var, i32, Use::read},  {0x60FA, 0x60FA, var, i32, Use::read},
    {0x60FD, 0x60FD, var, u32, Use::read},  {0x60FF, 0x60FF, var, i32, Use::write},
    {0x6502, 0x6502, var, u32, Use::read},
}};

struct Profile {
  std::uint16_t number;
  const Fact* begin;
  const Fact* end;
};

constexpr std::array<Profile, 2> profiles = {{{401, io_facts.data(), io_facts.data() + io_facts.size()},
                                              {402, drive_facts.data(), drive_facts.data() + drive_facts.size()}}};

std::string named(const Profile& profile) { return "CiA " + std::to_string(profile.number); }

// Returns the value of 1000h, 0 if it is missing or no number.
std::uint32_t device_type(const Device& device) {
  const Entry* const entry = device.find(0x1000, 0);
  const bool is_known = entry != nullptr && value_in_force(*entry).is_integer();
  return is_known ? static_cast<std::uint32_t>(value_in_force(*entry).integer.bits()) : 0;
}

void check_entry(const Entry& entry, const Fact& fact, const Profile& profile, Findings& findings) {
  if (entry.data_type.value != 0 && entry.data_type.value != fact.type) {
    findings.add(rules::profile_type, entry.data_type.is_given ? entry.data_type.span : entry.span,
                 fmt::format("data type {}, but {} defines {}", type_text(entry.data_type.value), named(profile),
                             type_text(fact.type)),
                 "use " + type_text(fact.type));
  }
  const Access access = entry.access.value;
  if (fact.use == Use::write && is_readable(access) && !is_writable(access)) {
    findings.add(rules::profile_access, entry.access.span,
                 fmt::format("access {}, but masters write this object of {}", name_of(access), named(profile)),
                 "make it writable");
  } else if (fact.use == Use::read && is_writable(access)) {
    findings.add(rules::profile_access, entry.access.span,
                 fmt::format("access {}, but masters only read this object of {}", name_of(access), named(profile)),
                 "make it read-only");
  }
}

void check_object(const Object& object, const Fact& fact, const Profile& profile, Findings& findings) {
  if (object.object_code.value != fact.code) {
    findings.add(rules::profile_kind, object.object_code.is_given ? object.object_code.span : object.span,
                 fmt::format("object type {}, but {} defines {}", name_of(object.object_code.value), named(profile),
                             name_of(fact.code)),
                 fmt::format("use {}", name_of(fact.code)));
  }
  if (fact.code == var && object.subs.empty()) {
    check_entry(object, fact, profile, findings);
  }
  for (const Sub& sub : object.subs) {
    if (fact.code == array && sub.sub_index != 0 && sub.sub_index != 0xFF) {
      check_entry(sub, fact, profile, findings);
    }
  }
}

void check_missing(const Device& device, std::uint16_t index, const char* text, Findings& findings) {
  if (device.find(index) == nullptr) {
    const Object* const type = device.find(0x1000);
    findings.add(rules::profile_object_missing, type != nullptr ? type->span : Span{}, text, "describe the object");
  }
}

void check_all_there(const Device& device, const Profile& profile, Findings& findings) {
  constexpr std::uint32_t digital_inputs = 1U << 16;
  constexpr std::uint32_t digital_outputs = 1U << 17;
  if (profile.number == 402) {
    check_missing(device, 0x6040, "profile 402, but controlword 6040h is missing", findings);
    check_missing(device, 0x6041, "profile 402, but statusword 6041h is missing", findings);
    return;
  }
  if ((device_type(device) & digital_inputs) != 0) {
    check_missing(device, 0x6000, "bit 16 announces digital inputs, but 6000h is missing", findings);
  }
  if ((device_type(device) & digital_outputs) != 0) {
    check_missing(device, 0x6200, "bit 17 announces digital outputs, but 6200h is missing", findings);
  }
}

}  // namespace

std::uint16_t profile_of(const Device& device) { return static_cast<std::uint16_t>(device_type(device)); }

void check_profile(const Device& device, std::uint16_t profile, Findings& findings) {
  const auto* const known =
      std::find_if(profiles.begin(), profiles.end(), [profile](const Profile& each) { return each.number == profile; });
  if (known == profiles.end()) {
    return;
  }
  check_all_there(device, *known, findings);
  for (const Object& object : device.objects) {
    const auto* const fact = std::find_if(known->begin, known->end, [&object](const Fact& each) {
      return object.index >= each.first && object.index <= each.last;
    });
    if (fact != known->end) {
      check_object(object, *fact, *known, findings);
    }
  }
}

}  // namespace lexican::codict::check
