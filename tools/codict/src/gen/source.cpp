// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "gen/names.hpp"
#include "gen/text.hpp"
#include "gen/write.hpp"

namespace lexican::codict::gen {

namespace {

// Names in co_obj.h for sets of flags, the largest sets first.
constexpr struct {
  std::uint32_t flags;
  const char* name;
} flag_names[] = {
    {0xC3, "CO_OBJ_DN__RW"}, {0xC2, "CO_OBJ_DN__R_"}, {0xC1, "CO_OBJ_DN___W"}, {0x83, "CO_OBJ_D___RW"},
    {0x82, "CO_OBJ_D___R_"}, {0x81, "CO_OBJ_D____W"}, {0x47, "CO_OBJ__N_PRW"}, {0x46, "CO_OBJ__N_PR_"},
    {0x45, "CO_OBJ__N_P_W"}, {0x43, "CO_OBJ__N__RW"}, {0x42, "CO_OBJ__N__R_"}, {0x41, "CO_OBJ__N___W"},
    {0x0F, "CO_OBJ___APRW"}, {0x0E, "CO_OBJ___APR_"}, {0x0D, "CO_OBJ___AP_W"}, {0x07, "CO_OBJ____PRW"},
    {0x06, "CO_OBJ____PR_"}, {0x05, "CO_OBJ____P_W"}, {0x03, "CO_OBJ_____RW"}, {0x02, "CO_OBJ_____R_"},
    {0x01, "CO_OBJ______W"}, {0x80, "CO_OBJ_D_____"}, {0x40, "CO_OBJ__N____"}, {0x08, "CO_OBJ___A___"},
    {0x04, "CO_OBJ____P__"}, {0x00, "CO_OBJ_______"},
};

std::string flags_text(std::uint32_t flags) {
  std::string text;
  for (const auto& named : flag_names) {
    const bool is_next = named.flags != 0 ? (flags & named.flags) == named.flags : flags == 0 && text.empty();
    if (is_next) {
      text += (text.empty() ? "" : " | ") + std::string(named.name);
      flags &= ~named.flags;
    }
  }
  return text;
}

constexpr const char* limited_functions = R"(
// Type of a number of up to {0} bits with limits. Values outside Low and High are refused; the functions of Plain, the
// type without limits, read and write the others. Order: Low and High are compared as 0 unsigned, 1 signed, 2 real.
typedef struct {{
  CO_OBJ_TYPE Type;
  const CO_OBJ_TYPE *Plain;
  uint{0}_t Low;
  uint{0}_t High;
  uint8_t Order;
}} limited{0}_t;

static const limited{0}_t *limited{0}(const CO_OBJ *obj) {{ return (const limited{0}_t *)(const void *)obj->Type; }}

static uint32_t limited{0}_size(CO_OBJ *obj, CO_NODE *node, uint32_t width) {{
  return limited{0}(obj)->Plain->Size(obj, node, width);
}}

static CO_ERR limited{0}_init(CO_OBJ *obj, CO_NODE *node) {{
  const CO_OBJ_INIT_FUNC init = limited{0}(obj)->Plain->Init;
  return init == NULL ? CO_ERR_NONE : init(obj, node);
}}

static CO_ERR limited{0}_read(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {{
  return limited{0}(obj)->Plain->Read(obj, node, buffer, size);
}}

// Converts the bits of a number to an unsigned number with the same order, so that one comparison serves all types. The
// bits of positive reals increase with the value, those of negative ones decrease; NaN is beyond all other numbers.
static uint{0}_t limited{0}_rank(uint{0}_t bits, uint32_t size, uint8_t order) {{
  const uint{0}_t highest = (uint{0}_t)1 << {1};
  const uint{0}_t sign = (uint{0}_t)1 << (8u * size - 1u);
  if (order == 0u) {{
    return bits;
  }}
  if (order == 1u) {{
    return ((bits ^ sign) - sign) ^ highest;
  }}
  if ((bits & ~highest) == 0u) {{
    return highest;
  }}
  return (bits & highest) != 0u ? ~bits : bits | highest;
}}

static CO_ERR limited{0}_write(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {{
  const limited{0}_t *const type = limited{0}(obj);
  const uint8_t *const byte = (const uint8_t *)buffer;
  uint{0}_t bits = 0;
  uint{0}_t rank;
  uint32_t n;
  if (size == 0u || size > sizeof bits) {{
    return CO_ERR_BAD_ARG;
  }}
  for (n = 0; n < size; ++n) {{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    bits = (uint{0}_t)(bits << 8) | byte[n];
#else
    bits = (uint{0}_t)(bits << 8) | byte[size - 1u - n];
#endif
  }}
  rank = limited{0}_rank(bits, size, type->Order);
  if (rank < limited{0}_rank(type->Low, sizeof bits, type->Order)) {{
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_RANGE_LOW);
    return CO_ERR_OBJ_RANGE;
  }}
  if (rank > limited{0}_rank(type->High, sizeof bits, type->Order)) {{
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_RANGE_HIGH);
    return CO_ERR_OBJ_RANGE;
  }}
  return type->Plain->Write(obj, node, buffer, size);
}}
)";

constexpr const char* stored_string_functions = R"(
// A string in a storage group. Its length belongs to the group, too, and is copied to String before each access, because
// the group may have been loaded since the last one.
typedef struct {
  CO_OBJ_STR_RW String;
  uint32_t *Length;
  const CO_OBJ_TYPE *Plain;
} stored_string_t;

static const CO_OBJ_TYPE *stored_string(CO_OBJ *obj) {
  stored_string_t *const stored = (stored_string_t *)obj->Data;
  stored->String.Size = *stored->Length;
  return stored->Plain;
}

static uint32_t stored_string_size(CO_OBJ *obj, CO_NODE *node, uint32_t width) {
  return stored_string(obj)->Size(obj, node, width);
}

static CO_ERR stored_string_init(CO_OBJ *obj, CO_NODE *node) { return stored_string(obj)->Init(obj, node); }

static CO_ERR stored_string_read(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {
  return stored_string(obj)->Read(obj, node, buffer, size);
}

static CO_ERR stored_string_write(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {
  const CO_ERR error = stored_string(obj)->Write(obj, node, buffer, size);
  stored_string_t *const stored = (stored_string_t *)obj->Data;
  *stored->Length = stored->String.Size;
  return error;
}

static CO_ERR stored_string_reset(CO_OBJ *obj, CO_NODE *node, uint32_t position) {
  return stored_string(obj)->Reset(obj, node, position);
}

static const CO_OBJ_TYPE stored_string_type = {stored_string_size, stored_string_init, stored_string_read,
                                               stored_string_write, stored_string_reset};
)";

constexpr const char* stored_consumer_functions = R"(
// A heartbeat consumer (1016h) in a storage group, which contains the value of the entry: time and node-ID.
typedef struct {
  CO_HBCONS Consumer;
  uint32_t *Value;
} stored_consumer_t;

static uint32_t stored_consumer_size(CO_OBJ *obj, CO_NODE *node, uint32_t width) {
  return CO_THB_CONS->Size(obj, node, width);
}

static CO_ERR stored_consumer_init(CO_OBJ *obj, CO_NODE *node) {
  stored_consumer_t *const stored = (stored_consumer_t *)obj->Data;
  stored->Consumer.Time = (uint16_t)*stored->Value;
  stored->Consumer.NodeId = (uint8_t)(*stored->Value >> 16);
  return CO_THB_CONS->Init(obj, node);
}

static CO_ERR stored_consumer_read(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {
  return CO_THB_CONS->Read(obj, node, buffer, size);
}

// Sets 1020h to 0 (the configuration has changed), where it exists: the stack does so only for entries whose data is in
// a storage group.
static CO_ERR stored_consumer_write(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {
  const CO_ERR error = CO_THB_CONS->Write(obj, node, buffer, size);
  stored_consumer_t *const stored = (stored_consumer_t *)obj->Data;
  *stored->Value = (uint32_t)stored->Consumer.NodeId << 16 | stored->Consumer.Time;
  for (uint32_t sub = 1; error == CO_ERR_NONE && sub <= 2; ++sub) {
    if (CODictFind(&node->Dict, CO_DEV(0x1020, sub)) != NULL) {
      (void)CODictWrLong(&node->Dict, CO_DEV(0x1020, sub), 0);
    }
  }
  return error;
}

static const CO_OBJ_TYPE stored_consumer_type = {stored_consumer_size, stored_consumer_init, stored_consumer_read,
                                                 stored_consumer_write, NULL};
)";

class SourceText {
 public:
  SourceText(const Plan& plan, const Options& options)
      : plan_(plan), options_(options), out_(plan.items.size() * usual_length) {}

  std::string write() {
    write_top();
    write_limits();
    write_stored_types();
    write_constants();
    write_variables();
    write_group_descriptors();
    write_paras();
    write_defaults();
    write_table();
    write_proofs();
    return out_.take_text();
  }

 private:
  bool is_cpp() const { return options_.language == Language::cpp; }
  const char* proof() const { return is_cpp() ? "static_assert" : "_Static_assert"; }

  const Group& group_of(const Item& item) const { return plan_.groups[item.group]; }
  std::string struct_name(const Item& item) const { return struct_of(group_of(item), options_); }
  // Returns a name for an entry's further variable: "od_2201_0" with another prefix.
  static std::string named(const char* what, const Item& item) { return what + item.member().substr(2); }

  // Returns the entries for which the predicate is true.
  template <typename Predicate>
  std::vector<const Item*> those(Predicate predicate) const {
    std::vector<const Item*> items;
    for (const Item& item : plan_.items) {
      if (predicate(item)) {
        items.push_back(&item);
      }
    }
    return items;
  }

  void write_top() {
    out_.raw(generated_comment(options_));
    out_.add("#include \"{}_od.h\"\n\n#include <stddef.h>{}", options_.name,
             has_defaults(plan_) ? "\n#include <string.h>" : "");
    const bool has_reals = std::any_of(plan_.items.begin(), plan_.items.end(), [](const Item& item) {
      return data_type(item.form->code).kind == TypeKind::real;
    });
    if (has_reals) {
      out_.raw("#include <math.h>\n");
    }
    if (is_cpp()) {
      out_.raw("\n#include \"lexican/dictionary.hpp\"\n");
    }
  }

  // Limits -----------------------------------------------------------------------------------------------------------

  // Writes the functions for 32 or 64 bits; all values are compared as unsigned numbers of this width.
  void write_limited_functions(unsigned bits) { out_.raw(fmt::format(limited_functions, bits, bits - 1)); }

  void write_limits() {
    const auto limited = those([](const Item& item) { return item.limited != 0; });
    for (const unsigned bits : {32U, 64U}) {
      const bool is_used = std::any_of(limited.begin(), limited.end(),
                                       [bits](const Item* item) { return (item->form->size > 4) == (bits == 64); });
      if (is_used) {
        write_limited_functions(bits);
      }
    }
    std::set<std::size_t> written;
    for (const Item* const item : limited) {
      if (written.insert(item->limited).second) {
        write_limited_type(*item);
      }
    }
  }

  void write_limited_type(const Item& item) {
    const unsigned bits = item.form->size > 4 ? 64 : 32;
    const TypeKind kind = data_type(item.form->code).kind;
    const unsigned order = kind == TypeKind::real ? 2 : (kind == TypeKind::signed_integer ? 1 : 0);
    out_.add("\n// {}: {} to {}", place_name(item), item.limits->low.empty() ? "any" : item.limits->low,
             item.limits->high.empty() ? "any" : item.limits->high);
    out_.add(
        "static const limited{0}_t limits_{1} = {{{{limited{0}_size, limited{0}_init, limited{0}_read, "
        "limited{0}_write, NULL}}, {2}, {3}, {4}, {5}}};",
        bits, item.limited, item.type, bound(item.limits->low_bits, bits), bound(item.limits->high_bits, bits), order);
  }

  static std::string bound(std::uint64_t number, unsigned bits) {
    return bits == 64 ? fmt::format("0x{:X}ull", number) : fmt::format("0x{:X}u", static_cast<std::uint32_t>(number));
  }

  // Types of stored strings and consumers -----------------------------------------------------------------------------

  bool has_stored(Storage storage) const {
    return !those([storage](const Item& item) { return item.group != 0 && item.storage == storage; }).empty();
  }

  void write_stored_types() {
    if (has_stored(Storage::string)) {
      out_.raw(stored_string_functions);
    }
    if (has_stored(Storage::consumer)) {
      out_.raw(stored_consumer_functions);
    }
  }

  // Constants --------------------------------------------------------------------------------------------------------

  void write_constants() {
    out_.blank();
    for (const Item& item : plan_.items) {
      if (item.storage == Storage::constant) {
        out_.add("static const {} {} = {};", item.form->variable, named("constant", item),
                 literal(item.value, *item.form));
      } else if (item.storage == Storage::text) {
        out_.add("static const uint8_t {}[] = {};", named("text", item), string_literal(item.value.text));
      } else if (item.storage == Storage::eds) {
        write_eds(item);
      } else if (item.storage == Storage::error_bits) {
        out_.add("static CO_EMCY_BITS {} = {{0, {}, 0}};", named("bits", item), item.capacity);
      } else if (has_constant_memory(item)) {
        const bool is_wide = item.form->alignment == 2;
        out_.add("static const {} {}[{}] = {};", is_wide ? "uint16_t" : "uint8_t", named("constant", item),
                 is_wide ? item.capacity / 2 : item.capacity + 1, memory_text(item));
      }
    }
  }

  // Writes the bytes of the EDS as numbers: C compilers limit the length of a string literal.
  void write_eds(const Item& item) {
    constexpr std::size_t in_line = 20;
    const std::string bytes = named("bytes", item);
    out_.add("static const uint8_t {}[{}] = {{", bytes, plan_.eds.size());
    for (std::size_t at = 0; at < plan_.eds.size(); at += in_line) {
      std::string line;
      for (const char byte : plan_.eds.substr(at, in_line)) {
        line += fmt::format("{}0x{:02X},", line.empty() ? "" : " ", static_cast<unsigned char>(byte));
      }
      out_.add("    {}", line);
    }
    out_.add("}};\nstatic CO_OBJ_DOM_RO {0} = {{0, sizeof {1}, {1}}};", named("eds", item), bytes);
  }

  static bool has_constant_memory(const Item& item) {
    return item.access == Access::constant && (item.storage == Storage::string || item.storage == Storage::domain);
  }

  // Returns the initialiser for the memory of a string or domain.
  static std::string memory_text(const Item& item) {
    const TypeKind kind = data_type(item.form->code).kind;
    if (kind == TypeKind::visible_string) {
      return string_literal(item.value.text);
    }
    std::string list;
    if (kind == TypeKind::unicode_string) {
      for (const char16_t character : utf16(item.value.text)) {
        list += fmt::format("{}0x{:04X}", list.empty() ? "" : ", ", static_cast<unsigned>(character));
      }
    } else {
      for (const char octet : *item.value.octets) {
        list += fmt::format("{}0x{:02X}", list.empty() ? "" : ", ", static_cast<unsigned char>(octet));
      }
    }
    return list.empty() ? "{0}" : "{" + list + "}";
  }

  static std::size_t length_of(const Item& item) {
    switch (data_type(item.form->code).kind) {
      case TypeKind::visible_string: return item.value.text.size();
      case TypeKind::unicode_string: return 2 * utf16(item.value.text).size();
      default: return item.value.octets->size();
    }
  }

  // Variables --------------------------------------------------------------------------------------------------------

  static std::string consumer_text(const Item& item) {
    const std::uint64_t value = item.value.integer.magnitude;
    return fmt::format("{{NULL, NULL, CO_INVALID, 0, {}u, {}u, 0}}", value & 0xFFFF, value >> 16 & 0xFF);
  }

  std::string descriptor_text(const Item& item, const std::string& memory) const {
    switch (item.storage) {
      case Storage::text: return fmt::format("{{0, {}}}", named("text", item));
      case Storage::string: return fmt::format("{{0, {}, {}, (uint8_t *){}}}", length_of(item), item.capacity, memory);
      case Storage::domain: return fmt::format("{{0, {}, (uint8_t *){}}}", item.capacity, memory);
      default: return consumer_text(item);
    }
  }

  std::string initialiser(const Member& member) const {
    const Item& item = plan_.items[member.item];
    switch (member.role) {
      case Role::descriptor: {
        const std::string memory =
            has_constant_memory(item)
                ? named("constant", item)
                : fmt::format("{}.{}_memory", struct_of(plan_.groups.front(), options_), item.member());
        return descriptor_text(item, memory);
      }
      case Role::length: return fmt::format("{}", length_of(item));
      case Role::memory: return memory_text(item);
      case Role::value: break;
    }
    return item.storage == Storage::consumer ? literal(item.value.integer, *item.form)
                                             : literal(item.value, *item.form);
  }

  void write_initialiser(const Group& group) {
    for (const Member& member : group.members) {
      if (member.unused_before != 0) {
        out_.raw("    {0},\n");
      }
      const bool is_union = member.has_alias && !plan_.items[member.item].alias.empty();
      const std::string text = initialiser(member);
      out_.add("    {},  // {}", is_union ? "{" + text + "}" : text, member.name);
    }
    if (group.unused != 0) {
      out_.raw("    {0},\n");
    }
  }

  // Returns true if CONodeInit() sets the members of a struct.
  bool is_set_by_node(const Group& group) const {
    return !group.members.empty() && (&group != &plan_.groups.front() || has_defaults(plan_));
  }

  void write_variables() {
    for (const Group& group : plan_.groups) {
      if (group.members.empty()) {
        continue;
      }
      const std::string name = struct_of(group, options_);
      if (is_set_by_node(group)) {
        out_.add("\n{}_t {};\nstatic const {}_t {}_default = {{", name, name, name, name);
      } else {
        out_.add("\n{}_t {} = {{", name, name);
      }
      write_initialiser(group);
      out_.raw("};\n");
    }
  }

  void write_group_descriptors() {
    out_.blank();
    for (const Item* const item : those([](const Item& one) { return one.group != 0; })) {
      const std::string place = fmt::format("{}.{}", struct_name(*item), item->member());
      if (item->storage == Storage::string) {
        out_.add("static stored_string_t {} = {{{}, &{}_length, {}}};", named("string", *item),
                 descriptor_text(*item, place), place, item->type);
      } else if (item->storage == Storage::domain) {
        out_.add("static CO_OBJ_DOM {} = {};", named("domain", *item), descriptor_text(*item, place));
      } else if (item->storage == Storage::consumer) {
        out_.add("static stored_consumer_t {} = {{{}, &{}}};", named("consumer", *item), consumer_text(*item), place);
      }
    }
  }

  void write_paras() {
    const auto groups = those([](const Item& item) { return item.storage == Storage::group; });
    const std::string cast = is_cpp() ? "" : "(uint8_t *)";
    for (const Group& group : plan_.groups) {
      if (group.sub_index != 0) {
        const std::string name = struct_of(group, options_);
        out_.add(
            "const CO_PARA {0}_para = {{{1}_OFFSET, sizeof {0}, {2}&{0}, {2}&{0}_default, {3}, NULL, CO_PARA___E | "
            "CO_PARA_VERSION({1}_LAYOUT), {4}, 0}};",
            name, upper(name), cast, group.is_communication ? "CO_RESET_COM" : "CO_RESET_NODE", group.com_size);
      }
    }
    std::set<std::string> others;
    for (const Item* const item : groups) {
      others.insert(para_of(*item));
    }
    if (others.count("all_groups") != 0) {
      out_.raw("static const CO_PARA all_groups = {0, 0, NULL, NULL, CO_RESET_NODE, NULL, CO_PARA___E, 0, 0};\n");
    }
    if (others.count("no_group") != 0) {
      out_.raw("static const CO_PARA no_group = {0, 0, NULL, NULL, CO_RESET_NODE, NULL, CO_PARA____, 0, 0};\n");
    }
  }

  // Returns the CO_PARA for a sub-index of 1010h or 1011h; no_group if the sub-index has no storage group.
  std::string para_of(const Item& item) const {
    const bool stores = item.index == 0x1010;
    for (const Group& group : plan_.groups) {
      if (group.sub_index != 0 && (stores ? group.sub_index : group.restore_sub) == item.sub_index) {
        return struct_of(group, options_) + "_para";
      }
    }
    const bool is_all = stores ? plan_.stores_all : plan_.restores_all;
    return item.sub_index == 1 && is_all ? "all_groups" : "no_group";
  }

  // Power-on values ---------------------------------------------------------------------------------------------------

  void write_defaults() {
    const bool has_type = has_defaults(plan_);
    if (has_type) {
      out_.add("\nstatic uint8_t has_defaults;  // CONodeInit() or {}_set_defaults() was called", options_.name);
    }
    out_.add("\nvoid {}_set_defaults(void) {{", options_.name);
    for (const Group& group : plan_.groups) {
      if (is_set_by_node(group)) {
        out_.add("  {0} = {0}_default;", struct_of(group, options_));
      }
    }
    out_.raw(has_type ? "  has_defaults = 1;\n}\n" : "}\n");
    if (has_type) {
      write_power_on_type();
    }
  }

  // Returns the offset of the first RAM member that a reset sets.
  std::string begin_of(Reset reset) const {
    const std::string name = struct_of(plan_.groups.front(), options_);
    const Member* const first = first_reset(plan_, reset);
    return first == nullptr ? "sizeof " + name : fmt::format("offsetof({}_t, {})", name, first->name);
  }

  void write_first() {
    const std::string of_node = begin_of(Reset::node);
    const std::string of_communication = begin_of(Reset::communication);
    const bool is_same = of_node == of_communication;
    out_.raw(
        "  // Order of the variables: first those that the network cannot write, which are set only once; then those "
        "that\n"
        "  // \"reset node\" sets; then those that both resets set.\n");
    out_.add("  const size_t written = {};",
             is_same ? of_node : fmt::format("reset == CO_RESET_NODE ? {} : {}", of_node, of_communication));
    out_.raw("  const size_t first = has_defaults != 0 ? written : 0;\n");
  }

  void write_power_on_type() {
    out_.raw(
        "\n// Sets variables to their default values. Called by CONodeInit() and at each NMT reset.\n"
        "static CO_ERR set_power_on_values(CO_OBJ *end, CO_NODE *node, uint32_t reset) {\n");
    if (!plan_.groups.front().members.empty()) {
      write_first();
    }
    out_.raw("  (void)end;\n  (void)node;\n  (void)reset;\n");
    for (const Group& group : plan_.groups) {
      if (group.sub_index == 0 && is_set_by_node(group)) {
        write_copy(group);
      }
    }
    out_.raw(
        "  has_defaults = 1;\n  return CO_ERR_NONE;\n}\n\n"
        "static const CO_OBJ_TYPE power_on_type = {NULL, NULL, NULL, NULL, set_power_on_values};\n");
  }

  void write_copy(const Group& group) {
    const std::string name = struct_of(group, options_);
    if (&group == &plan_.groups.front()) {
      out_.add("  memcpy((uint8_t *)&{0} + first, (const uint8_t *)&{0}_default + first, sizeof {0} - first);", name);
    } else if (group.is_communication) {
      out_.add("  memcpy(&{0}, &{0}_default, sizeof {0});", name);
    } else {
      out_.add("  memcpy(&{0}, &{0}_default, reset == CO_RESET_NODE ? sizeof {0} : {1});", name, group.com_size);
    }
  }

  // Table ------------------------------------------------------------------------------------------------------------

  std::string type_text(const Item& item) const {
    if (item.limited != 0) {
      return fmt::format("&limits_{}.Type", item.limited);
    }
    if (item.has_own_type) {
      return fmt::format("&{}_type", external_of(item, options_));
    }
    const bool is_stored = item.group != 0;
    return is_stored && item.storage == Storage::string     ? "&stored_string_type"
           : is_stored && item.storage == Storage::consumer ? "&stored_consumer_type"
                                                            : std::string(item.type);
  }

  std::string data_text(const Item& item) const {
    const bool is_stored = item.group != 0;
    switch (item.storage) {
      case Storage::direct: return literal(item.value.integer, *item.form);
      case Storage::constant: return "&" + named("constant", item);
      case Storage::group: return "&" + para_of(item);
      case Storage::external: return "&" + external_of(item, options_);
      case Storage::application: return "0";
      case Storage::eds: return "&" + named("eds", item);
      case Storage::error_bits: return "&" + named("bits", item);
      case Storage::shared: return "&" + shared_of(item, options_);
      case Storage::string:
        if (is_stored) {
          return "&" + named("string", item);
        }
        break;
      case Storage::domain:
        if (is_stored) {
          return "&" + named("domain", item);
        }
        break;
      case Storage::consumer:
        if (is_stored) {
          return "&" + named("consumer", item);
        }
        break;
      default: break;
    }
    return fmt::format("&{}.{}", struct_name(item), item.member());
  }

  void write_table() {
    out_.add("\n{} CO_OBJ {}_od[{}_OD_NUM] = {{", is_cpp() ? "constexpr" : "const", options_.name,
             upper(options_.name));
    for (const Item& item : plan_.items) {
      out_.add("    {{{} | {}, {}, (CO_DATA)({})}},", macro_of(item, options_), flags_text(item.flags), type_text(item),
               data_text(item));
    }
    if (has_defaults(plan_)) {
      out_.raw("    {CO_DEFAULTS_KEY, &power_on_type, (CO_DATA)(0)},\n");
    }
    out_.raw("};\n");
  }

  // Compile-time checks ----------------------------------------------------------------------------------------------

  void write_proofs() {
    out_.raw("\n// Compile-time checks of the table.\n");
    if (is_cpp()) {
      out_.add("CO_OD_CHECK_PART({}_od);  // mandatory objects and lengths: codict check", options_.name);
    } else {
      for (std::size_t n = 1; n < plan_.items.size(); ++n) {
        out_.add("{}({} < {}, \"ascending\");", proof(), macro_of(plan_.items[n - 1], options_),
                 macro_of(plan_.items[n], options_));
      }
    }
    out_.raw("// Layout of the storage groups.\n");
    for (std::size_t n = 1; n < plan_.groups.size(); ++n) {
      prove_layout(plan_.groups[n]);
    }
    out_.raw("// Default values are within their limits.\n");
    for (const Item* const item :
         those([](const Item& one) { return one.limited != 0 && one.limits->holds_default; })) {
      prove_limits(*item);
    }
    out_.raw("// The mapping of each PDO has at most 64 bits and CO_PDO_MAP_N objects.\n");
    for (const PdoSum& pdo : plan_.pdos) {
      prove_pdo(pdo);
    }
  }

  void prove_layout(const Group& group) {
    const std::string name = struct_of(group, options_);
    std::uint32_t offset = 0;
    for (const Member& member : group.members) {
      offset += member.unused_before;
      out_.add("{0}(offsetof({1}_t, {2}) == {3} && sizeof {1}.{2} == {4}, \"{2}\");", proof(), name, member.name,
               offset, member.size);
      offset += member.size;
    }
    out_.add("{0}(sizeof({1}_t) == {2}, \"{1}\");", proof(), name, group.size);
  }

  // Writes compile-time checks of a default value against its limits. Omitted for reals in C, whose constant
  // expressions cannot contain them, and for the unsigned value 0, the lowest of its type.
  void prove_limits(const Item& item) {
    const TypeKind kind = data_type(item.form->code).kind;
    if (kind == TypeKind::real && !is_cpp()) {
      return;
    }
    const std::string value = literal(item.value, *item.form);
    const bool is_least = kind == TypeKind::unsigned_integer && item.value.integer == 0;
    for (const auto& [limit, sign] : {std::pair(&item.limits->low, ">="), std::pair(&item.limits->high, "<=")}) {
      if (!limit->empty() && !is_least) {
        out_.add("{}({} {} {}, \"{}\");", proof(), value, sign, *limit, place_name(item));
      }
    }
  }

  void prove_pdo(const PdoSum& pdo) {
    std::string sum;
    for (const unsigned bits : pdo.bits) {
      sum += fmt::format("{}{}", sum.empty() ? "" : " + ", bits);
    }
    if (!sum.empty()) {
      out_.add("{}({} <= 64 && {} <= CO_PDO_MAP_N, \"{:04X}h\");", proof(), sum, pdo.bits.size(), pdo.index);
    }
  }

  const Plan& plan_;
  const Options& options_;
  Lines out_;
};

}  // namespace

std::string write_source(const Plan& plan, const Options& options) { return SourceText(plan, options).write(); }

}  // namespace lexican::codict::gen
