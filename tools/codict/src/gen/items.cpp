// SPDX-License-Identifier: Apache-2.0
// Entries of the table, from the objects of a description.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "gen/eds.hpp"
#include "gen/names.hpp"
#include "gen/parts.hpp"
#include "gen/rules.hpp"
#include "model/srdo.hpp"

namespace lexican::codict::gen {

namespace {

constexpr std::uint32_t cob_id_off = 0x80000000;

constexpr std::uint16_t first_variable = 0x00A0;  // below are definitions of types
constexpr std::uint16_t error_register = 0x1001;
constexpr std::uint16_t manufacturer_status = 0x1002;
constexpr std::uint16_t module_list = 0x1027;
constexpr std::uint16_t eds_format = 0x1022;

constexpr bool is_between(std::uint16_t index, std::uint16_t first, std::uint16_t last) {
  return index >= first && index <= last;
}

// Returns true for values that are constant although their access is "ro". The serial number is excluded because it
// differs between devices.
bool is_fixed(const Item& item, bool has_subs) {
  if (item.sub_index == 0 && has_subs) {
    return item.index != 0x1003;
  }
  if (item.index == 0x1018) {
    return item.sub_index != 4;
  }
  return item.index == 0x1000 || item.index == eds_format || is_between(item.index, 0x1005, 0x1007) ||
         is_between(item.index, 0x1012, 0x1019) || is_between(item.index, 0x1200, 0x1BFF);
}

// Returns false for names of RAM and of constants, which are not stored.
bool is_storage_group(std::string_view name) {
  const std::string id = identifier(name);
  return !name.empty() && id != "ram" && id != "rom" && id != "const_" && id != "constant" && id != "constants";
}

class Items {
 public:
  Items(const Device& device, const Options& options, Plan& plan, Findings& findings)
      : device_(device), options_(options), plan_(plan), findings_(findings) {
    for_each_variable(device, [this](std::uint16_t, std::uint8_t, const Entry& entry) {
      is_of_node_ = is_of_node_ || entry.node->storage_group.is_given || entry.node->count_label->is_given;
    });
  }

  // Entries that are too many are counted, but not stored: they would need much memory.
  void count(const Object& object) {
    const bool has_subs = !object.subs.empty() || has_sub_objects(object.object_code.value);
    const auto enabled = std::count_if(object.subs.begin(), object.subs.end(),
                                       [](const Sub& sub) { return !sub.node->disabled->value; });
    const std::size_t implied = object.subs.empty() || object.find(0) != nullptr ? 0 : 1;
    const bool has_entry = !object.node->disabled->value && !is_type(object);
    number_ += !has_entry ? 0 : has_subs ? static_cast<std::size_t>(enabled) + implied : 1;
  }

  void reserve() { plan_.items.reserve(number_ <= most_items ? number_ : 0); }

  void add(const Object& object) {
    if (object.node->disabled->value) {
      findings_.add(rules::left_out, object.span, "disabled object has no entry", "remove CO_disabled");
      return;
    }
    if (is_type(object)) {
      findings_.add(rules::left_out, object.span, "type definition has no entry", "ignore the note");
      return;
    }
    if (!object.node->count_label->text.empty()) {
      ++plan_.labels[upper(identifier(object.node->count_label->text))];
    }
    if (object.subs.empty() && !has_sub_objects(object.object_code.value)) {
      add(object, 0, object, false);
      return;
    }
    add_subs(object);
  }

 private:
  static bool is_type(const Object& object) { return object.index < first_variable || is_range_type(object); }

  void add_subs(const Object& object) {
    if (object.subs.empty()) {
      findings_.add(rules::no_subs, object.span, "object without sub-objects has no entry", "describe its sub-objects");
      return;
    }
    if (object.find(0) == nullptr) {
      findings_.add(rules::sub_zero, object.span, "sub-index 0 is missing and is added", "describe it");
      Sub number;
      number.name.text = "Highest sub-index supported";
      number.data_type.value = type_code::unsigned8;
      number.access.value = Access::constant;
      number.span = object.span;
      add(object, 0, number, true);
    }
    for (const Sub& sub : object.subs) {
      if (!sub.node->disabled->value) {
        add(object, sub.sub_index, sub, true);
      }
    }
  }

  void add(const Object& object, std::uint8_t sub_index, const Entry& entry, bool has_subs) {
    Item item;
    item.index = object.index;
    item.sub_index = sub_index;
    item.name = has_subs ? name_of(object, entry) : entry.name.text;
    item.own_name_begin = item.name.size() - entry.name.text.size();
    item.span = entry.span;
    item.access = entry.access.value;
    item.pdo = entry.pdo_mapping.value;
    item.place = has_own_values(object) ? nullptr : place_of(item.index, sub_index, has_subs);
    if (!set_form(item, entry) || !set_value(item, object, entry, has_subs)) {
      return;
    }
    set_flags(item, object, entry);
    set_storage(item, entry, has_subs);
    if (is_node_id_right(item)) {
      set_limits(item, entry);
      set_group(item, object, entry);
      ++plan_.entries;
      if (number_ <= most_items) {
        plan_.items.push_back(std::move(item));
      }
    }
  }

  // Returns true for a module list with default values, which are generated as variables.
  static bool has_own_values(const Object& object) {
    return object.index == module_list && std::any_of(object.subs.begin(), object.subs.end(), [](const Sub& sub) {
             return sub.sub_index != 0 && value_in_force(sub).kind != Value::Kind::none;
           });
  }

  static std::string name_of(const Object& object, const Entry& entry) {
    const std::string& of_object = object.name.text;
    const std::string& of_sub = entry.name.text;
    const bool has_both = of_sub.compare(0, of_object.size(), of_object) == 0;
    return has_both ? of_sub : of_object + " " + of_sub;
  }

  bool set_form(Item& item, const Entry& entry) {
    const bool is_domain = entry.object_code.value == ObjectCode::domain;
    const std::uint16_t named = entry.data_type.value == 0 && is_domain ? type_code::domain : entry.data_type.value;
    item.form = form_of(data_type_of(device_, named).code);
    if (item.form == nullptr && item.place == nullptr) {
      const std::string reason = named == 0 ? "data type is missing" : fmt::format("unknown data type {:04X}h", named);
      findings_.add(rules::type, entry.data_type.is_given ? entry.data_type.span : entry.span,
                    reason + "; the application defines the type", "use a data type of CiA 301");
      item.form = form_of(type_code::domain);
      item.has_own_type = true;
    }
    if (item.place != nullptr) {
      set_form_of_place(item);
    } else {
      item.type = item.form->type;
    }
    return set_access(item, entry, is_domain);
  }

  void set_form_of_place(Item& item) {
    const bool is_number = item.place->bytes != 0;
    const Form& form =
        is_number ? unsigned_form(item.place->bytes)
                  : *form_of(item.place->service == Service::eds ? type_code::domain : type_code::octet_string);
    const bool fits = item.form != nullptr && item.form->bytes == form.bytes &&
                      (is_number ? is_integer(data_type(item.form->code).kind) : item.form == &form);
    if (!fits) {
      item.form = &form;
      findings_.add(rules::place, item.span,
                    fmt::format("data type differs from {} of {}, which is used", data_type(form.code).name,
                                is_between(item.index, 0x1300, 0x13FF) ? "EN 50325-5" : "CiA 301"),
                    "correct the data type");
    }
    item.type = item.place->type;
  }

  bool set_access(Item& item, const Entry& entry, bool is_domain) {
    if (item.access == Access::unknown && is_domain) {
      item.access = item.place == nullptr ? Access::rw : Access::ro;
    }
    if (item.access == Access::unknown) {
      findings_.add(rules::access, entry.access.is_given ? entry.access.span : entry.span,
                    "access type is missing or unknown", "add the access type");
    }
    return item.access != Access::unknown;
  }

  bool set_value(Item& item, const Object& object, const Entry& entry, bool has_subs) {
    item.value = is_shared(item) ? Value() : value_in_force(entry);
    set_eds_value(item);
    take_none_for_octets(item);
    const bool is_number = item.form->bytes != 0 && data_type(item.form->code).kind != TypeKind::real;
    const bool is_text = is_number && item.value.kind == Value::Kind::text;  // text of another data type, or a time
    if (item.value.kind == Value::Kind::malformed || is_text) {
      findings_.add(rules::value, item.value.span,
                    fmt::format("{} does not fit {}", in_quotes(item.value.text), data_type(item.form->code).name),
                    "correct the default value");
      return false;
    }
    if (is_number && item.value.kind == Value::Kind::none) {
      set_standard_value(item, object, has_subs);
    }
    correct_cob_id(item);
    return true;
  }

  static bool is_shared(const Item& item) { return item.place != nullptr && item.place->service == Service::shared; }

  void set_eds_value(Item& item) {
    if (options_.embedded_eds == EmbeddedEds::none) {
      return;
    }
    if (item.place != nullptr && item.place->service == Service::eds) {
      item.value = {};
    } else if (item.index == eds_format && item.place != nullptr) {
      item.value = {};
      set_number(item, format_of(options_.embedded_eds));
    }
  }

  void take_none_for_octets(Item& item) {
    const bool is_domain = item.form->code == type_code::domain;
    const bool is_zero = (is_domain || item.form->code == type_code::octet_string) && item.value.text == "0";
    if (item.has_own_type) {
      item.value = {};
    } else if (is_zero || (is_domain && item.value.kind == Value::Kind::malformed)) {
      findings_.add(rules::value_none, item.value.span,
                    fmt::format("{} is not an octet string; ignored", in_quotes(item.value.text)),
                    "remove the default value, or write octets");
      item.value = {};
    }
  }

  void set_number(Item& item, std::uint64_t number) {
    item.value.kind = Value::Kind::integer;
    item.value.integer = number;
  }

  // Sets the value of an entry that has no default value. A PDO without COB-ID is disabled.
  void set_standard_value(Item& item, const Object& object, bool has_subs) {
    const std::string_view type = item.place == nullptr ? "" : item.place->type;
    if (type == "CO_TPDO_ID" || (type == "CO_TSDO_ID" && item.index != 0x1200)) {
      findings_.add(rules::cob_id, item.span, "COB-ID is missing; the service is disabled (bit 31)",
                    "add a default value");
      set_number(item, cob_id_off);
    } else if (type == "CO_TSYNC_ID" || type == "CO_TEMCY_ID" || type == "CO_TTIME_ID") {
      findings_.add(rules::cob_id, item.span, "COB-ID is missing; that of CiA 301 is used", "add a default value");
      set_number(item, type == "CO_TTIME_ID" ? 0x100 : 0x80);
      item.value.adds_node_id = type == "CO_TEMCY_ID";
    } else if (type == "CO_TSDO_ID") {
      set_number(item, item.sub_index == 1 ? 0x600 : 0x580);
    } else if (type == "CO_TSRDO_COM" && item.sub_index == 4) {
      set_number(item, srdo_type);
    } else if (type == "CO_TPDO_NUM" || (type == "CO_TSRDO_MAP" && item.sub_index == 0)) {
      set_number(item, mapped_objects(object));
    } else if (item.sub_index == 0 && has_subs && item.index != 0x1003) {
      set_number(item, highest_sub(object));
    }
  }

  // Returns the number of mapped objects that precede the first sub-index without one.
  static std::uint8_t mapped_objects(const Object& object) {
    std::uint8_t number = 0;
    for (const Sub& sub : object.subs) {
      const bool is_next = sub.sub_index == number + 1 && sub.default_value.integer.magnitude != 0;
      number = is_next ? sub.sub_index : number;
    }
    return number;
  }

  // The default SDO server's COB-IDs are fixed: 600h and 580h + node-ID. [301:7.3.3]
  void correct_cob_id(Item& item) {
    const bool is_default_sdo = item.index == 0x1200 && (item.sub_index == 1 || item.sub_index == 2);
    if (!is_default_sdo || item.value.adds_node_id) {
      return;
    }
    if (item.value.is_given) {
      findings_.add(
          rules::cob_id, item.value.span,
          fmt::format("COB-ID {} of the default SDO without $NODEID; it is added", in_quotes(item.value.text)),
          item.sub_index == 1 ? "write $NODEID+0x600" : "write $NODEID+0x580");
    }
    set_number(item, item.sub_index == 1 ? 0x600 : 0x580);
    item.value.adds_node_id = true;
  }

  // An object for SRDOs needs flag P, with which the network can map it into PDOs, too.
  void set_flags(Item& item, const Object& object, const Entry& entry) const {
    if (entry.node->srdo->value != SrdoAccess::no && item.pdo == PdoMapping::no) {
      item.pdo = PdoMapping::optional;
    }
    item.flags = (is_readable(item.access) ? flag_read : 0U) | (is_writable(item.access) ? flag_write : 0U) |
                 (item.pdo != PdoMapping::no ? flag_pdo : 0U) | (item.value.adds_node_id ? flag_node_id : 0U);
    const bool goes_out = item.pdo != PdoMapping::no && item.pdo != PdoMapping::rpdo && is_readable(item.access) &&
                          item.access != Access::rww && item.access != Access::constant;
    const bool triggers = entry.node->flags_pdo->value || object.node->flags_pdo->value || options_.trigger_tpdos;
    item.flags |= goes_out && triggers ? flag_trigger : 0U;
  }

  bool is_node_id_right(const Item& item) {
    if (!item.value.adds_node_id) {
      return true;
    }
    const bool may_add = item.place != nullptr ? item.place->is_node_id_relative()
                                               : is_integer(data_type(item.form->code).kind) && item.value.is_integer();
    if (!may_add) {
      findings_.add(rules::node_id, item.value.span,
                    fmt::format("{} in an entry that cannot depend on the node-ID", in_quotes(item.value.text)),
                    "write the value without $NODEID");
    }
    return may_add;
  }

  void set_storage(Item& item, const Entry& entry, bool has_subs) {
    if (item.place != nullptr && item.place->service == Service::eds) {
      set_eds(item, entry);
    } else if (item.place != nullptr && item.place->service != Service::value) {
      constexpr Storage of_service[] = {Storage::variable, Storage::variable, Storage::group,
                                        Storage::consumer, Storage::eds,      Storage::shared};
      item.storage = of_service[static_cast<std::size_t>(item.place->service)];
      note_shared(item);
    } else if (is_error_bits(item)) {
      set_error_bits(item, entry);
    } else if (is_written_by_stack(item)) {
      item.storage = Storage::variable;  // the stack writes the value
    } else if (item.place == nullptr && (item.has_own_type || entry.node->extension_io->value)) {
      set_own_type(item);
    } else if (item.place == nullptr && is_external(item, entry)) {
      set_external(item);
    } else if (item.place == nullptr && item.form->bytes == 0) {
      set_memory(item, entry);
    } else {
      set_variable(item, has_subs);
    }
  }

  static bool is_written_by_stack(const Item& item) {
    return item.index == error_register ||
           (item.index == manufacturer_status && !item.has_own_type && item.form->bytes != 0);
  }

  // The EDS is embedded, or its bytes are a default value, or the application defines them.
  void set_eds(Item& item, const Entry& entry) {
    if (options_.embedded_eds != EmbeddedEds::none) {
      item.storage = Storage::eds;
      item.access = Access::ro;
      item.flags = flag_read;
      return;
    }
    if (is_writable(item.access) || item.value.kind != Value::Kind::none) {
      item.type = item.form->type;
      item.place = nullptr;
      set_storage(item, entry, false);
      return;
    }
    set_external(item);
  }

  void note_shared(const Item& item) {
    if (item.storage == Storage::shared) {
      findings_.add(rules::external, item.span, "the application defines the structure of the object",
                    "define it in the application");
    }
  }

  // Returns true for an entry that the options declare as error status bits, if it can be one.
  bool is_error_bits(const Item& item) const {
    return options_.error_bits.count(item.key()) != 0 && item.form->code == type_code::octet_string &&
           !is_writable(item.access);
  }

  // The length of the string is that of the description; 0: as many bytes as the table of errors needs.
  void set_error_bits(Item& item, const Entry& entry) {
    const std::size_t length = std::max<std::size_t>(
        item.value.octets->size(), std::max(entry.node->byte_length->value, entry.node->string_length_min->value));
    item.storage = Storage::error_bits;
    item.type = "CO_TEMCY_BITS";
    item.capacity = static_cast<std::uint32_t>(std::min<std::size_t>(length, UINT8_MAX));
    item.value = {};
  }

  // An object type of the application gets a variable if the entry is a number with a default value.
  void set_own_type(Item& item) {
    const bool has_variable = item.form->bytes != 0 && item.value.is_given;
    item.has_own_type = true;
    item.storage = has_variable ? Storage::variable : Storage::application;
    findings_.add(rules::external, item.span, "the application defines the type", "define it in the application");
  }

  void set_external(Item& item) {
    item.storage = Storage::external;
    if (is_constant_text(item)) {
      item.type = "CO_TSTRING";
    }
    findings_.add(rules::external, item.span, "no default value; the application defines the memory",
                  "add a default value");
  }

  static bool is_constant_text(const Item& item) {
    return item.form->code == type_code::visible_string && !is_writable(item.access);
  }

  // In descriptions of CANopenNode an empty default value means that the application provides the memory, unless
  // CO_extensionIO is false. Domains without value are external in all descriptions.
  bool is_external(const Item& item, const Entry& entry) const {
    const bool is_empty = item.value.kind == Value::Kind::none;
    const bool has_length = entry.node->byte_length->value != 0 || entry.node->string_length_min->value != 0;
    const bool is_xml = device_.format != Format::eds && device_.format != Format::dcf;
    const bool is_domain = item.form->code == type_code::domain;
    const Field<bool>& extension = entry.node->extension_io;
    const bool has_variable = !extension.is_empty() && !extension.value;
    return is_empty && !has_length && (is_domain || (is_xml && is_of_node_ && !has_variable));
  }

  void set_variable(Item& item, bool has_subs) {
    const bool is_constant = item.access == Access::constant || (item.access == Access::ro && is_fixed(item, has_subs));
    const TypeKind kind = data_type(item.form->code).kind;
    const bool fits_entry = (is_integer(kind) || kind == TypeKind::boolean) && item.form->size <= 4;
    if (is_constant && fits_entry) {
      item.storage = Storage::direct;
      item.flags |= flag_direct;
    } else {
      item.storage = is_constant ? Storage::constant : Storage::variable;
    }
  }

  // Sets the capacity and the location of a string or domain.
  void set_memory(Item& item, const Entry& entry) {
    const TypeKind kind = data_type(item.form->code).kind;
    const std::uint32_t unit = kind == TypeKind::unicode_string ? 2 : 1;
    const std::size_t characters = kind == TypeKind::visible_string   ? item.value.text.size()
                                   : kind == TypeKind::unicode_string ? utf16(item.value.text).size()
                                                                      : item.value.octets->size();
    const std::uint32_t length = static_cast<std::uint32_t>(characters) * unit;
    const std::uint32_t asked = std::max(entry.node->byte_length->value, entry.node->string_length_min->value * unit);
    item.storage = kind == TypeKind::domain ? Storage::domain : Storage::string;
    const bool may_grow = length == 0 || (item.storage == Storage::string && is_writable(item.access));
    const std::uint32_t room = asked == 0 && may_grow ? std::max(options_.string_capacity, unit) : asked;
    item.capacity = std::min(std::max(length, room), most_bytes) / unit * unit;
    if (is_constant_text(item) && asked <= length) {
      item.storage = Storage::text;
      item.type = "CO_TSTRING";
    } else if (asked == 0 && may_grow) {
      findings_.add(rules::capacity, item.span,
                    fmt::format("maximum length is missing; {} bytes are used", item.capacity),
                    "set CO_stringLengthMin, or use --string-capacity");
    }
  }

  void set_limits(Item& item, const Entry& entry) {
    const TypeKind kind = data_type(item.form->code).kind;
    const bool is_number = is_integer(kind) || kind == TypeKind::real;
    const bool is_possible = is_number && is_writable(item.access) && !item.has_own_type &&
                             (item.storage == Storage::variable || item.storage == Storage::external) &&
                             (item.place == nullptr || item.place->service == Service::value);
    if (!is_possible || !is_usable(entry.low_limit) || !is_usable(entry.high_limit)) {
      return;
    }
    if (is_less(item, entry.high_limit, entry.low_limit)) {
      findings_.add(rules::limits, entry.low_limit->span,
                    fmt::format("LowLimit {} is above HighLimit {}; both are ignored", in_quotes(entry.low_limit->text),
                                in_quotes(entry.high_limit->text)),
                    "exchange or correct the limits");
      return;
    }
    const bool has_low = has_number(entry.low_limit) && !is_lowest(item, entry.low_limit);
    const bool has_high = has_number(entry.high_limit) && !is_highest(item, entry.high_limit);
    Value value = item.value;
    value.kind = kind == TypeKind::real ? Value::Kind::real : Value::Kind::integer;
    const bool holds_default = !is_less(item, value, entry.low_limit) && !is_less(item, entry.high_limit, value);
    if (has_low || has_high) {
      Limits& limits = item.limits.edit();
      limits.low = has_low ? literal(entry.low_limit, *item.form) : "";
      limits.high = has_high ? literal(entry.high_limit, *item.form) : "";
      limits.holds_default = holds_default && !item.value.adds_node_id;
      set_bits(limits, item, entry);
    }
    if (!holds_default && !item.value.adds_node_id) {
      findings_.add(rules::limits_default, item.value.is_given ? item.value.span : item.span,
                    fmt::format("default value {} is outside the limits {} to {}",
                                item.value.text.empty() ? "0" : shortened(item.value.text),
                                text_or(entry.low_limit, "lowest"), text_or(entry.high_limit, "highest")),
                    "change the value, or widen the limits");
    }
  }

  // Sets the limits as bit patterns of the variable. Missing limits of a real are the NaN patterns at both ends of the
  // order.
  static void set_bits(Limits& limits, const Item& item, const Entry& entry) {
    const unsigned unused = item.form->size > 4 ? 0 : 32;
    const TypeKind kind = data_type(item.form->code).kind;
    const std::uint64_t all = UINT64_MAX >> unused;
    const std::uint64_t sign = all ^ all >> 1U;
    const std::uint64_t lowest = kind == TypeKind::real ? all : (kind == TypeKind::signed_integer ? sign : 0);
    const std::uint64_t highest = kind == TypeKind::unsigned_integer ? all : all ^ sign;
    limits.low_bits = limits.low.empty() ? lowest : bits_of(entry.low_limit, item) & all;
    limits.high_bits = limits.high.empty() ? highest : bits_of(entry.high_limit, item) & all;
  }

  static std::uint64_t bits_of(const Value& value, const Item& item) {
    if (value.kind != Value::Kind::real) {
      return value.integer.bits();
    }
    std::uint64_t bits = 0;
    std::uint32_t single = 0;
    const auto real = static_cast<float>(value.real);
    std::memcpy(&single, &real, sizeof single);
    std::memcpy(&bits, &value.real, sizeof bits);
    return item.form->size == 4 ? single : bits;
  }

  static bool has_number(const Value& value) {
    return value.kind == Value::Kind::integer || value.kind == Value::Kind::real;
  }

  static std::string text_or(const Value& limit, const char* other) {
    return limit.text.empty() ? other : shortened(limit.text);
  }

  // Returns false if either value is no number.
  static bool is_less(const Item& item, const Value& a, const Value& b) {
    if (!has_number(a) || !has_number(b)) {
      return false;
    }
    return data_type(item.form->code).kind == TypeKind::real ? a.real < b.real : a.integer < b.integer;
  }

  bool is_usable(const Value& limit) {
    if (limit.adds_node_id) {
      findings_.add(rules::limits, limit.span,
                    fmt::format("limit {} depends on the node-ID; ignored", in_quotes(limit.text)), "write a number");
      return false;
    }
    if (!has_number(limit) && limit.kind != Value::Kind::none) {
      findings_.add(rules::limits, limit.span,
                    fmt::format("limit {} does not fit the data type; ignored", in_quotes(limit.text)),
                    "write a number of the data type");
      return false;
    }
    return true;
  }

  // Returns true if the limit is the lowest value of the type, so that it has no effect.
  static bool is_lowest(const Item& item, const Value& limit) {
    const std::uint64_t sign = std::uint64_t{1} << (8U * item.form->bytes - 1U);
    switch (data_type(item.form->code).kind) {
      case TypeKind::unsigned_integer: return limit.integer == 0;
      case TypeKind::signed_integer: return limit.integer == Integer(sign, true);
      default: return false;
    }
  }

  // Returns true if the limit is the highest value of the type, so that it has no effect.
  static bool is_highest(const Item& item, const Value& limit) {
    const unsigned unused = 64U - 8U * item.form->bytes;
    switch (data_type(item.form->code).kind) {
      case TypeKind::unsigned_integer: return limit.integer == UINT64_MAX >> unused;
      case TypeKind::signed_integer: return limit.integer == UINT64_MAX >> (unused + 1U);
      default: return false;
    }
  }

  void set_group(Item& item, const Object& object, const Entry& entry) {
    const bool is_memory = item.storage == Storage::variable || item.storage == Storage::string ||
                           item.storage == Storage::domain || item.storage == Storage::consumer;
    const std::string& own = entry.node->storage_group.value;
    const std::string& name = own.empty() ? object.node->storage_group.value : own;
    if (!is_memory || !is_storage_group(name) || item.access == Access::constant) {
      return;
    }
    const auto option = options_.store.find(name);
    if (option != options_.store.end() && option->second == 0) {
      plan_.unstored.insert(name);
      return;
    }
    for (std::size_t n = 1; n < plan_.groups.size(); ++n) {
      item.group = plan_.groups[n].name == name ? n : item.group;
    }
    if (item.group == 0) {
      item.group = plan_.groups.size();
      Group group;
      group.name = name;
      group.id = identifier(name);
      plan_.groups.push_back(std::move(group));
    }
  }

  static constexpr std::uint32_t most_bytes = 1U << 20;

  const Device& device_;
  const Options& options_;
  Plan& plan_;
  Findings& findings_;
  bool is_of_node_ = false;
  std::size_t number_ = 0;  // of the variables of the device that have an entry, unless they have errors
};

}  // namespace

void plan_items(const Device& device, const Options& options, Plan& plan, Findings& findings) {
  Items items(device, options, plan, findings);
  for (const Object& object : device.objects) {
    items.count(object);
  }
  items.reserve();
  for (const Object& object : device.objects) {
    items.add(object);
  }
  const auto is_before = [](const Item& a, const Item& b) { return a.key() < b.key(); };
  if (!std::is_sorted(plan.items.begin(), plan.items.end(), is_before)) {  // a sort needs memory for a second table
    std::stable_sort(plan.items.begin(), plan.items.end(), is_before);
  }
}

}  // namespace lexican::codict::gen
