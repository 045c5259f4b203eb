// SPDX-License-Identifier: Apache-2.0
// Program that starts a node with the generated dictionary and prints the errors that the stack reports.
#include "gen/names.hpp"
#include "gen/text.hpp"
#include "gen/write.hpp"

namespace lexican::codict::gen {

namespace {

constexpr const char* drivers = R"(
static void init_can(void *ctx) { (void)ctx; }
static void enable_can(void *ctx, uint32_t baud) {
  (void)ctx;
  (void)baud;
}
static int16_t read_can(void *ctx, CO_IF_FRM *frm) {
  (void)ctx;
  (void)frm;
  return 0;
}
static int16_t send_can(void *ctx, const CO_IF_FRM *frm) {
  (void)ctx;
  (void)frm;
  return (int16_t)sizeof(CO_IF_FRM);
}
static const CO_IF_CAN_DRV_EX can = {init_can, enable_can, read_can, send_can, init_can, init_can, NULL, NULL};

static void init_timer(void *ctx, uint32_t freq) {
  (void)ctx;
  (void)freq;
}
static uint32_t now(void *ctx) {
  (void)ctx;
  return 0;
}
static const CO_IF_TIMER_DRV_EX timer = {init_timer, now, NULL};

static void init_memory(void *ctx) {
  (void)ctx;
  memset(memory, 0xFF, sizeof memory);
}
static uint32_t read_memory(void *ctx, uint32_t start, uint8_t *buffer, uint32_t size) {
  (void)ctx;
  if (start > sizeof memory || size > sizeof memory - start) {
    return 0;
  }
  memcpy(buffer, memory + start, size);
  return size;
}
static uint32_t write_memory(void *ctx, uint32_t start, const uint8_t *buffer, uint32_t size) {
  (void)ctx;
  if (start > sizeof memory || size > sizeof memory - start) {
    return 0;
  }
  memcpy(memory + start, buffer, size);
  return size;
}
static CO_NVM_SHAPE shape(void *ctx) {
  CO_NVM_SHAPE result;
  (void)ctx;
  result.Capacity = (uint32_t)sizeof memory;
  result.ProgramSize = 1;
  result.EraseSize = 0;
  return result;
}
static const CO_IF_NVM_DRV_EX nvm = {init_memory, read_memory, write_memory, NULL, shape};
)";

// Format text for fmt, in which braces are doubled.
constexpr const char* start = R"(
static CO_NODE node;
static CO_NODE_EXT ext;
static CO_OBJ table[{1}_OD_NUM];

static void init_node(void) {{
  CO_NODE_SPEC spec;
  memset(&spec, 0, sizeof spec);
  spec.NodeId = {2};
  spec.Baudrate = 125000;
  spec.Dict = table;
  spec.DictLen = {1}_OD_NUM;
  spec.TmrFreq = 1000;
  ext.Size = sizeof ext;
  ext.Can = &can;
  ext.Timer = &timer;
  ext.Nvm = &nvm;
  CONodeInitEx(&node, &spec, &ext);
}}

static void report(uint32_t key, const char *name, const char *text) {{
  size_t n = 0;
  while (n < sizeof names / sizeof *names && CO_GET_DEV(names[n].Key) != CO_GET_DEV(key)) {{
    ++n;
  }}
  if (CO_GET_IDX(key) == 0) {{
    printf("verify: {0}: %s [%s]\n", text, name);
  }} else {{
    printf("verify: {0}: %04Xh sub %X (%s): %s [%s]\n", (unsigned)CO_GET_IDX(key), (unsigned)CO_GET_SUB(key),
           n < sizeof names / sizeof *names ? names[n].Name : "no entry", text, name);
  }}
}}

// CONodeGetErr() returns the last error only. A PDO that was reported is switched off for the next round.
static int switch_off(uint32_t key) {{
  const uint32_t index = CO_GET_IDX(key) & 0x1DFFu;
  size_t n;
  for (n = 0; n < {1}_OD_NUM; ++n) {{
    if (index >= 0x1400u && CO_GET_IDX(table[n].Key) == index && CO_GET_SUB(table[n].Key) == 1u) {{
      table[n].Key = CO_KEY(index, 1, CO_OBJ_D___R_);
      table[n].Data = (CO_DATA)(0x80000000u);
      return 1;
    }}
  }}
  return 0;
}}

int main(void) {{
  CO_ERR error = CO_ERR_NONE;
  uint32_t previous = 0;
  uint32_t key = 0;
  unsigned reports = 0;
  size_t n;
  for (n = 0; n < {1}_OD_NUM; ++n) {{
    table[n] = {0}_od[n];
  }}
  do {{
    CO_DICT_FAULT fault;
    previous = key;
    init_node();
    fault = CODictGetFault(&node.Dict, &key);
    if (fault != CO_DICT_OK) {{
      report(key, CODictFaultName(fault), CODictFaultText(fault));
      return 1;
    }}
    error = CONodeGetErr(&node);
    key = CONodeGetErrKey(&node);
    if (error != CO_ERR_NONE) {{
      report(key, COErrName(error), COErrText(error));
      ++reports;
    }}
  }} while (error != CO_ERR_NONE && key != previous && switch_off(key));
  if (reports == 0) {{
    printf("verify: {0}: CONodeInit() reports no error\n");
  }}
  return reports != 0;
}}
)";

void write_names(const Plan& plan, const Options& options, Lines& out) {
  out.add("\ntypedef struct {{\n  uint32_t Key;\n  const char *Name;\n}} entry_name_t;\n");
  out.add("static const entry_name_t names[] = {{");
  for (const Item& item : plan.items) {
    out.add("    {{{}, {}}},", macro_of(item, options), string_literal(comment_text(item.name)));
  }
  out.add("}};");
}

}  // namespace

std::string write_verify(const Plan& plan, const Options& options) {
  const std::string prefix = upper(options.name);
  Lines out;
  out.raw(generated_comment(options));
  out.add(
      "// Starts a node with the dictionary and prints the errors of the stack. The status is 1 if there is "
      "one.");
  out.add("#include <stddef.h>\n#include <stdio.h>\n#include <string.h>\n\n#include \"co_core.h\"\n");
  out.raw(write_requirements(plan));
  out.raw(write_stubs(plan, options));
  write_names(plan, options, out);
  out.add("\n#ifdef {0}_PARA_END\nstatic uint8_t memory[{0}_PARA_END];\n#else\nstatic uint8_t memory[1];\n#endif",
          prefix);
  out.raw(drivers);
  out.raw(fmt::format(start, options.name, prefix, options.node_id));
  return out.take_text();
}

}  // namespace lexican::codict::gen
