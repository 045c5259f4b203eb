// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "gen/names.hpp"
#include "gen/text.hpp"
#include "gen/write.hpp"

namespace lexican::codict::gen {

namespace {

// Services with several instances: objects of each, and the setting of co_cfg.h for their number.
struct Instances {
  std::uint16_t first;
  std::uint16_t last;
  const char* macro;
  const char* needs;  // setting that must not be 0; may be empty
};

constexpr Instances instances[] = {
    {0x1200, 0x127F, "CO_SSDO_N", ""}, {0x1280, 0x12FF, "CO_CSDO_N", "USE_CSDO"}, {0x1301, 0x1340, "CO_SRDO_N", ""},
    {0x1381, 0x13C0, "CO_SRDO_N", ""}, {0x1400, 0x15FF, "CO_RPDO_N", ""},         {0x1600, 0x17FF, "CO_RPDO_N", ""},
    {0x1800, 0x19FF, "CO_TPDO_N", ""}, {0x1A00, 0x1BFF, "CO_TPDO_N", ""},
};

// Returns the service that a setting counts: "TPDO" in "the description has TPDO 12".
const char* service_of(const std::string& macro) {
  static const std::map<std::string, const char*> services = {
      {"CO_SSDO_N", "SDO server"}, {"CO_CSDO_N", "SDO client"},           {"CO_RPDO_N", "RPDO"},
      {"CO_TPDO_N", "TPDO"},       {"CO_HBCONS_N", "heartbeat consumer"}, {"CO_EMCY_CONS_N", "EMCY consumer"},
      {"CO_SRDO_N", "SRDO"}};
  return services.at(macro);
}

// Smallest configuration of co_cfg.h in which all entries work.
class Configuration {
 public:
  explicit Configuration(const Plan& plan) {
    for (const Item& item : plan.items) {
      add(item);
    }
    for (const PdoSum& pdo : plan.pdos) {
      if (std::find(pdo.bits.begin(), pdo.bits.end(), 1U) != pdo.bits.end()) {
        needs_.insert("USE_PDO_BITS");
      }
    }
  }

  void write(Lines& out, const Options& options) const {
    for (const std::string& macro : needs_) {
      out.add("#if !{}\n#error \"{}: the dictionary needs {} (co_cfg.h)\"\n#endif", macro, options.name, macro);
    }
    for (const auto& [macro, number] : numbers_) {
      out.add(
          "#if {0} < {1}\n#error \"{2}: the description has {3} {1}, {0} is less: set {0} to {1} (co_cfg.h, "
          "-D{0}={1})\"\n#endif",
          macro, number, options.name, service_of(macro));
    }
    for (const auto& [macro, number] : numbers_) {
      out.add("#define {}_OD_{} {}  ///< of co_cfg.h, at least", upper(options.name), macro.substr(3), number);
    }
    out.blank();
  }

  // Uses #pragma message, as #error cannot show the value of a macro.
  void write_messages(Lines& out) const {
    const char* const form =
        "#if {0}\n#pragma message(\"verify: the description has {1}, the configuration has {2} = \" "
        "CODICT_VALUE({2}) \": set {2} to {3}\")\n#define CODICT_REFUSED\n#endif";
    for (const std::string& macro : needs_) {
      out.add(fmt::runtime(form), "!" + macro, "objects that need " + macro, macro, 1);
    }
    for (const auto& [macro, number] : numbers_) {
      out.add(fmt::runtime(form), fmt::format("{} < {}", macro, number),
              fmt::format("{} {}", service_of(macro), number), macro, number);
    }
  }

 private:
  void add(const Item& item) {
    need(item.place == nullptr ? "" : item.place->needs);
    need(item.storage == Storage::error_bits ? "USE_EMCY" : "");
    const auto* const service = std::find_if(std::begin(instances), std::end(instances), [&](const Instances& one) {
      return item.index >= one.first && item.index <= one.last;
    });
    if (service != std::end(instances)) {
      raise(service->macro, item.index - service->first + 1U);
      need(service->needs);
    }
    need(item.index == 0x1028 && item.place != nullptr ? "USE_EMCY" : "");
    if (item.index == 0x1016 || item.index == 0x1028) {
      raise(item.index == 0x1016 ? "CO_HBCONS_N" : "CO_EMCY_CONS_N", item.sub_index);
    }
    if (item.index == 0x13FF) {
      raise("CO_SRDO_N", item.sub_index);
    }
  }

  void need(std::string_view macro) {
    if (macro.substr(0, 4) == "USE_" || macro == "CO_MPDO_N") {
      needs_.emplace(macro);
    }
  }

  void raise(const std::string& macro, unsigned number) { numbers_[macro] = std::max(numbers_[macro], number); }

  std::set<std::string> needs_;
  std::map<std::string, unsigned> numbers_;
};

std::string about(const Item& item) {
  return fmt::format("{}, {} {}", comment_text(item.name), data_type(item.form->code).name, name_of(item.access));
}

void write_keys(const Plan& plan, const Options& options, Lines& out) {
  out.raw("\n/// \\name Keys of the entries\n/// \\{\n");
  for (const Item& item : plan.items) {
    out.add("#define {} CO_DEV(0x{:04X}, 0x{:02X})  ///< {}", macro_of(item, options), item.index, item.sub_index,
            about(item));
    if (!item.alias.empty()) {
      out.add("#define {}_{} {}", upper(options.name), upper(item.alias), macro_of(item, options));
    }
  }
  out.raw("/// \\}\n");
}

void write_counts(const Plan& plan, const Options& options, Lines& out) {
  const std::string prefix = upper(options.name);
  const std::size_t end_mark = has_defaults(plan) ? 1 : 0;
  out.add("#define {}_OD_NUM {}  ///< entries{}: CO_NODE_SPEC.DictLen", prefix, plan.items.size() + end_mark,
          end_mark == 0 ? "" : " and end mark");
  for (const auto& [label, count] : plan.labels) {
    out.add("#define {}_OD_CNT_{} {}", prefix, label, count);
  }
}

std::string declaration(const Member& member, std::string_view name) {
  return member.count == 0 ? fmt::format("{} {};", member.type, name)
                           : fmt::format("{} {}[{}];", member.type, name, member.count);
}

void write_struct(const Plan& plan, const Group& group, const Options& options, Lines& out) {
  const std::string name = struct_of(group, options);
  out.add("typedef struct {}_t_ {{", name);
  for (const Member& member : group.members) {
    const Item& item = plan.items[member.item];
    const bool has_alias = member.has_alias && !item.alias.empty();
    const std::string text =
        has_alias ? fmt::format("union {{ {} {} }};", declaration(member, member.name), declaration(member, item.alias))
                  : declaration(member, member.name);
    if (member.unused_before != 0) {
      out.add("  uint8_t unused_com[{}];", member.unused_before);
    }
    out.add("  {}{}", text, member.has_alias ? "  ///< " + about(item) : "");
  }
  if (group.unused != 0) {
    out.add("  uint8_t unused[{}];", group.unused);
  }
  out.add("}} {}_t;\nextern {}_t {};", name, name, name);
}

void write_groups(const Plan& plan, const Options& options, Lines& out) {
  const std::string prefix = upper(options.name);
  for (const Group& group : plan.groups) {
    if (group.members.empty()) {
      continue;
    }
    const bool is_ram = &group == &plan.groups.front();
    out.blank();
    if (is_ram) {
      out.add("/// Variables that are not stored.{}",
              has_defaults(plan) ? " CONodeInit() gives them their default values; NMT resets do so for those\n"
                                   "/// that the network can write."
                                 : "");
      write_struct(plan, group, options, out);
      continue;
    }
    const std::string macro = upper(struct_of(group, options));
    out.add("/// Storage group {}{}. CONodeInit() fills it.", comment_text(group.name),
            group.sub_index == 0 ? "" : fmt::format(", 1010h sub {:X}", group.sub_index));
    write_struct(plan, group, options, out);
    out.add("#define {}_LAYOUT 0x{:06X}u  ///< hash of its entries, their types and sizes: CO_PARA_VERSION()", macro,
            group.layout);
    if (group.sub_index != 0) {
      out.add("extern const CO_PARA {}_para;", struct_of(group, options));
    }
  }
  if (!needs_para(plan)) {
    return;
  }
  out.add("\n/// \\name Where the groups lie in the memory that is not volatile: from a byte on, and its larger of");
  out.add(
      "/// ProgramSize and EraseSize, and its ProgramSize (co_if_nvm.h). Another memory: define them for the source");
  out.add("/// file and the application.\n/// \\{{");
  out.add("#ifndef {0}_PARA_BASE\n#define {0}_PARA_BASE 0u\n#endif", prefix);
  out.add("#ifndef {0}_PARA_UNIT\n#define {0}_PARA_UNIT 1u\n#endif", prefix);
  out.add("#ifndef {0}_PARA_PROGRAM\n#define {0}_PARA_PROGRAM 1u\n#endif", prefix);
  std::string offset = prefix + "_PARA_BASE";
  for (const Group& group : plan.groups) {
    if (group.sub_index != 0) {
      const std::string name = struct_of(group, options);
      out.add("#define {}_OFFSET {}", upper(name), offset);
      offset = upper(name) + "_END";
      out.add("#define {0} ({1}_OFFSET + CO_PARA_SPACE(sizeof({2}_t), {3}_PARA_UNIT, {3}_PARA_PROGRAM))", offset,
              upper(name), name, prefix);
    }
  }
  out.add("#define {}_PARA_END {}  ///< behind the last group\n/// \\}}", prefix, offset);
}

std::string handle_type(const Item& item) {
  if (item.form->code == type_code::boolean) {
    return "bool";
  }
  return item.form->bytes == 0 || data_type(item.form->code).kind == TypeKind::time ? ""
                                                                                    : std::string(item.form->variable);
}

void write_handles(const Plan& plan, const Options& options, Lines& out) {
  out.add("\n#ifdef __cplusplus\n#include \"lexican/object.hpp\"\n");
  out.add("/// Entries as values of their C++ types: {}_objects::od_1017_0(node).set(500).", options.name);
  out.add("namespace {}_objects {{\n", options.name);
  out.raw(
      "template <class T, std::uint16_t index, std::uint8_t sub>\n"
      "struct Handle {\n"
      "  co::Object<T> operator()(CO_NODE& node) const noexcept { return co::object<T>(node, index, sub); }\n"
      "};\n\n");
  for (const Item& item : plan.items) {
    const std::string type = handle_type(item);
    if (type.empty()) {
      continue;
    }
    out.add("inline constexpr Handle<{}, 0x{:04X}, 0x{:02X}> {}{{}};", type, item.index, item.sub_index, item.member());
    if (!item.alias.empty()) {
      out.add("inline constexpr auto& {} = {};", item.alias, item.member());
    }
  }
  out.add("\n}}  // namespace {}_objects\n#endif", options.name);
}

}  // namespace

std::string macro_of(const Item& item, const Options& options) {
  return fmt::format("{}_{:04X}_{:X}", upper(options.name), item.index, item.sub_index);
}

std::string external_of(const Item& item, const Options& options) {
  return fmt::format("{}_{:04X}_{:X}", options.name, item.index, item.sub_index);
}

std::string shared_of(const Item& item, const Options& options) {
  constexpr std::uint16_t os_command = 0x1023;
  constexpr std::uint16_t os_mode = 0x1024;  // uses the structure of 1023h
  return fmt::format("{}_{:04X}", options.name, item.index == os_mode ? os_command : item.index);
}

std::string struct_of(const Group& group, const Options& options) { return options.name + "_" + group.id; }

std::string generated_comment(const Options& options) {
  return fmt::format("// Generated by codict gen from {}: do not edit.\n", comment_text(options.source));
}

bool needs_para(const Plan& plan) {
  return std::any_of(plan.groups.begin(), plan.groups.end(), [](const Group& group) { return group.sub_index != 0; });
}

std::string write_requirements(const Plan& plan) {
  Lines out;
  out.add("#define CODICT_TEXT(value) #value\n#define CODICT_VALUE(macro) CODICT_TEXT(macro)");
  Configuration(plan).write_messages(out);
  out.add("#ifdef CODICT_REFUSED\n#error \"the configuration is too small for the description\"\n#endif\n");
  return out.take_text();
}

std::string write_header(const Plan& plan, const Options& options) {
  const std::string prefix = upper(options.name);
  Lines out(plan.items.size() * usual_length);
  out.raw(generated_comment(options));
  out.add("/// \\file {}_od.h\n/// An object dictionary.", options.name);
  out.add("#ifndef {0}_OD_H_\n#define {0}_OD_H_\n\n#include \"co_core.h\"\n", prefix);
  Configuration(plan).write(out, options);
  write_counts(plan, options, out);
  write_keys(plan, options, out);
  out.raw("\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n");
  write_groups(plan, options, out);
  if (has_defaults(plan)) {
    out.raw(
        "\n/// Gives all variables their default values, for an application that uses them before CONodeInit(). Those "
        "that\n");
    out.raw("/// the network cannot write then keep what the application writes to them.\n");
  } else {
    out.raw(
        "\n/// Gives the variables of the storage groups their default values, for an application that uses them "
        "before\n"
        "/// CONodeInit(). The compiler initialises all others, and no reset changes them.\n");
  }
  out.add("void {}_set_defaults(void);", options.name);
  const std::vector<External> externals = externals_of(plan, options);
  if (!externals.empty()) {
    out.raw("\n/// \\name To be defined by the application\n/// \\{\n");
    for (const External& external : externals) {
      out.add("{}", external.declaration);
    }
    out.raw("/// \\}\n");
  }
  out.add("\n/// The dictionary: CO_NODE_SPEC.Dict = (CO_OBJ *){}_od.", options.name);
  out.add("extern const CO_OBJ {}_od[{}_OD_NUM];\n\n#ifdef __cplusplus\n}}\n#endif", options.name, prefix);
  write_handles(plan, options, out);
  out.raw("\n#endif\n");
  return out.take_text();
}

}  // namespace lexican::codict::gen
