// SPDX-License-Identifier: Apache-2.0
// Stubs for the symbols that the application has to define: they compile, and the node starts with them.
#include <algorithm>

#include "gen/names.hpp"
#include "gen/text.hpp"
#include "gen/write.hpp"

namespace lexican::codict::gen {

namespace {

constexpr std::uint32_t memory_size = 32;

std::string comment_of(const Item& item) {
  return fmt::format("{}: {}, {} {}", place_name(item), comment_text(item.name), data_type(item.form->code).name,
                     name_of(item.access));
}

std::string_view memory_type(const Item& item) {
  if (item.form->bytes != 0) {
    return item.form->variable;
  }
  return item.type == "CO_TDOMAIN_RO"           ? "CO_OBJ_DOM_RO"
         : item.form->code == type_code::domain ? "CO_OBJ_DOM"
         : item.type == "CO_TSTRING"            ? "CO_OBJ_STR"
                                                : "CO_OBJ_STR_RW";
}

void write_memory(const Item& item, const std::string& symbol, Lines& out) {
  const std::string_view type = memory_type(item);
  if (item.form->bytes != 0) {
    out.add("{} {};", type, symbol);
  } else if (type == "CO_OBJ_DOM_RO") {
    out.add("static const uint8_t {}_bytes[] = \"\";", symbol);
    out.add("CO_OBJ_DOM_RO {0} = {{0, 0, {0}_bytes}};", symbol);
  } else if (type == "CO_OBJ_STR") {
    out.add("static const uint8_t {}_text[] = \"\";", symbol);
    out.add("CO_OBJ_STR {0} = {{0, {0}_text}};", symbol);
  } else {
    const bool is_wide = item.form->alignment == 2;
    out.add("static {} {}_memory[{}];", is_wide ? "uint16_t" : "uint8_t", symbol,
            is_wide ? memory_size / 2 : memory_size);
    out.add("{0} {1} = {{0, {2}sizeof {1}_memory, (uint8_t *){1}_memory}};", type, symbol,
            type == "CO_OBJ_DOM" ? "" : "0, ");
  }
}

// Functions of an object type with a variable: they call the functions of the stack's type.
constexpr const char* forwarding_functions = R"(static uint32_t {0}_size(CO_OBJ *obj, CO_NODE *node, uint32_t width) {{
  return {1}->Size(obj, node, width);
}}
static CO_ERR {0}_init(CO_OBJ *obj, CO_NODE *node) {{ return {1}->Init == NULL ? CO_ERR_NONE : {1}->Init(obj, node); }}
static CO_ERR {0}_read(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {{
  return {1}->Read(obj, node, buffer, size);
}}
static CO_ERR {0}_write(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {{
  return {1}->Write(obj, node, buffer, size);
}}
)";

// Functions of an object type without a variable: the stub defines the memory.
constexpr const char* own_functions = R"(static uint8_t {0}_value[{1}];
static uint32_t {0}_size(CO_OBJ *obj, CO_NODE *node, uint32_t width) {{
  (void)obj;
  (void)node;
  (void)width;
  return sizeof {0}_value;
}}
static CO_ERR {0}_init(CO_OBJ *obj, CO_NODE *node) {{
  (void)obj;
  (void)node;
  return CO_ERR_NONE;
}}
static CO_ERR {0}_read(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {{
  (void)obj;
  (void)node;
  if (size != sizeof {0}_value) {{
    return CO_ERR_OBJ_SIZE;
  }}
  memcpy(buffer, {0}_value, size);
  return CO_ERR_NONE;
}}
static CO_ERR {0}_write(CO_OBJ *obj, CO_NODE *node, void *buffer, uint32_t size) {{
  (void)obj;
  (void)node;
  if (size != sizeof {0}_value) {{
    return CO_ERR_OBJ_SIZE;
  }}
  memcpy({0}_value, buffer, size);
  return CO_ERR_NONE;
}}
)";

void write_type(const Item& item, const std::string& symbol, Lines& out) {
  if (item.storage == Storage::variable) {
    out.add(forwarding_functions, symbol, item.type);
  } else {
    out.add(own_functions, symbol, item.form->bytes != 0 ? item.form->bytes : memory_size);
  }
  out.add("const CO_OBJ_TYPE {0}_type = {{{0}_size, {0}_init, {0}_read, {0}_write, NULL}};", symbol);
}

bool is_external(const Item& item) { return item.has_own_type || item.storage == Storage::external; }

// Structures that all entries of an object share: type, and the text that defines it, for its name.
struct Shared {
  std::uint16_t first;
  std::uint16_t last;
  const char* type;
  const char* stub;
};

// Format texts for fmt, in which braces are doubled.
constexpr const char* command_stub =
    R"(static uint8_t {0}_command[64];
static uint8_t {0}_reply[64];
CO_OS_COMMAND {0} = CO_OS_COMMAND_OF({0}_command, {0}_reply, NULL, NULL);
)";
constexpr const char* prompt_stub =
    R"(static uint8_t {0}_out[64];
static uint8_t {0}_err[64];
CO_OS_PROMPT {0} = CO_OS_PROMPT_OF(NULL, {0}_out, {0}_err);
)";
constexpr const char* modules_stub =
    R"(static CO_ERR {0}_read(CO_NODE *node, void *user, uint8_t sub, uint16_t *value) {{
  (void)node;
  (void)user;
  (void)value;
  return sub == 0u ? CO_ERR_NONE : CO_ERR_OBJ_NO_DATA;
}}
const CO_MODULE_LIST {0} = {{{0}_read}};
)";

constexpr Shared shared[] = {
    {0x1023, 0x1025, "CO_OS_COMMAND", command_stub},
    {0x1026, 0x1026, "CO_OS_PROMPT", prompt_stub},
    {0x1027, 0x1027, "const CO_MODULE_LIST", modules_stub},
};

const Shared& shared_type(const Item& item) {
  return *std::find_if(std::begin(shared), std::end(shared),
                       [&item](const Shared& one) { return item.index >= one.first && item.index <= one.last; });
}

// Returns true for the first entry that uses its structure.
bool is_first_of_shared(const Plan& plan, const Item& item, const Options& options) {
  const auto has_it = [&](const Item& other) {
    return other.storage == Storage::shared && shared_of(other, options) == shared_of(item, options);
  };
  return item.storage == Storage::shared && &*std::find_if(plan.items.begin(), plan.items.end(), has_it) == &item;
}

}  // namespace

std::vector<External> externals_of(const Plan& plan, const Options& options) {
  std::vector<External> all;
  for (const Item& item : plan.items) {
    const std::string name = external_of(item, options);
    if (is_first_of_shared(plan, item, options)) {
      const std::string structure = shared_of(item, options);
      all.push_back({structure, fmt::format("extern {} {};", shared_type(item).type, structure), comment_of(item)});
    } else if (item.has_own_type) {
      all.push_back({name + "_type", fmt::format("extern const CO_OBJ_TYPE {}_type;", name), comment_of(item)});
    } else if (item.storage == Storage::external) {
      all.push_back({name, fmt::format("extern {} {};", memory_type(item), name), comment_of(item)});
    }
  }
  return all;
}

std::string write_stubs(const Plan& plan, const Options& options) {
  Lines out;
  out.add("// First versions of what the application defines for {}_od.h, written by codict gen from {}.", options.name,
          comment_text(options.source));
  out.add("// Replace them. codict does not change this file again.");
  out.add("#include \"{}_od.h\"\n\n#include <stddef.h>\n#include <string.h>", options.name);
  for (const Item& item : plan.items) {
    if (is_first_of_shared(plan, item, options)) {
      out.add("\n// {}", comment_of(item));
      out.add(fmt::runtime(shared_type(item).stub), shared_of(item, options));
    }
    if (!is_external(item)) {
      continue;
    }
    out.add("\n// {}", comment_of(item));
    if (item.has_own_type) {
      write_type(item, external_of(item, options), out);
    } else {
      write_memory(item, external_of(item, options), out);
    }
  }
  return out.take_text();
}

}  // namespace lexican::codict::gen
