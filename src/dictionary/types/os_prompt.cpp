// SPDX-License-Identifier: Apache-2.0
// 1026h, OS prompt. [301:7.5.2.29]
#include "co_os.h"

#include "base/events.hpp"
#include "base/timer.hpp"
#include "co_core.h"
#include "dictionary/dict.hpp"
#include "dictionary/types/place.hpp"

namespace {

using namespace co;

constexpr uint16_t index_prompt = 0x1026;
constexpr uint8_t sub_out = 2;
constexpr uint8_t sub_err = 3;

uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) { return uintptr_t{obj->Data} == 0 ? 0 : 1; }

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t length) {
  const auto* const prompt = data_of<const CO_OS_PROMPT>(*obj);
  if (prompt == nullptr || length != 1) {
    return CO_ERR_BAD_ARG;
  }
  if (prompt->Input == nullptr) {
    return CO_ERR_TYPE_WR;
  }
  prompt->Input(node, node->Ext->User, *static_cast<const uint8_t*>(buffer));
  return CO_ERR_NONE;
}

CO_OS_OUTPUT* output_of(const CO_OBJ& obj) {
  auto* const prompt = data_of<CO_OS_PROMPT>(obj);
  if (prompt == nullptr) {
    return nullptr;
  }
  return CO_GET_SUB(obj.Key) == sub_err ? &prompt->Err : &prompt->Out;
}

// Stops the timer of an output. The timer's own state is not valid before the first initialisation of the node, and
// after another one: only the list of the node is.
void stop_timer(CO_NODE& node, CO_TMR_MEM& timer) {
  const CO_TMR_MEM* running = node.Tmr.First;
  while (running != nullptr && running != &timer) {
    running = running->Next;
  }
  if (running != nullptr) {
    tmr::stop(node.Tmr, timer);
  }
  timer = {};
}

// Empties the ring.
CO_ERR init_output(CO_OBJ* obj, CO_NODE* node) {
  const CO_ERR err = dict::check_type(*obj, *node, rules::os_output);
  CO_OS_OUTPUT* const output = output_of(*obj);
  if (err == CO_ERR_NONE && output != nullptr) {
    output->First = 0;
    output->Num = 0;
    output->Node = node;
    output->Key = obj->Key;
    stop_timer(*node, output->Tmr);
  }
  return err;
}

// Triggers the TPDOs of the next character. CODictInit() may have moved the entry.
void on_time(void* output_pointer) {
  const CO_OS_OUTPUT& output = *static_cast<CO_OS_OUTPUT*>(output_pointer);
  const CO_OBJ* const obj = dict::find(output.Node->Dict, output.Key);
  if (obj != nullptr && output.Num != 0) {
    event::change_object(*output.Node, *obj);
  }
}

void start_timer(CO_OS_OUTPUT& output) {
  CO_TMR& timers = output.Node->Tmr;
  const uint32_t ticks = tmr::ticks(timers, 1, CO_TMR_UNIT_1MS);
  tmr::start(timers, output.Tmr, ticks != 0 ? ticks : 1, 0, on_time, &output);
}

// Removes the oldest character; there is one.
uint8_t take(CO_OS_OUTPUT& output) {
  const uint8_t character = output.Start[output.First];
  output.First = static_cast<uint16_t>(output.First + 1U < output.Size ? output.First + 1U : 0U);
  --output.Num;
  return character;
}

// Starts the time until the next character triggers TPDOs, if there is one: events of a TPDO while it reads its objects
// have no effect. An SDO client is refused without a character; a TPDO is transmitted with 0.
CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t length) {
  CO_OS_OUTPUT* const output = output_of(*obj);
  if (output == nullptr || length != 1) {
    return CO_ERR_BAD_ARG;
  }
  if (output->Num == 0) {
    *static_cast<uint8_t*>(buffer) = 0;
    return node->RequestObj == obj ? CO_ERR_OBJ_NO_DATA : CO_ERR_NONE;
  }
  *static_cast<uint8_t*>(buffer) = take(*output);
  if (output->Num != 0 && output->Node == node) {
    start_timer(*output);
  }
  return CO_ERR_NONE;
}

void append(CO_OS_OUTPUT& output, const uint8_t* text, uint16_t length) {
  unsigned at = output.First + unsigned{output.Num};
  for (uint16_t n = 0; n < length; ++n, ++at) {
    output.Start[at % output.Size] = text[n];
  }
  output.Num = static_cast<uint16_t>(output.Num + length);
}

bool fits(const CO_OS_OUTPUT& output, uint16_t length) {
  return output.Start != nullptr && output.Num <= output.Size && length <= output.Size - output.Num;
}

}  // namespace

extern "C" {

const CO_OBJ_TYPE COTOsStdin = {size, co::dict::checked_by<co::rules::os_input>, nullptr, write, nullptr};
const CO_OBJ_TYPE COTOsStdout = {size, init_output, read, nullptr, nullptr};

CO_ERR COOsPrint(CO_NODE* node, uint8_t sub, const uint8_t* text, uint16_t length) {
  if (node == nullptr || node->Dict.Node == nullptr || text == nullptr || sub < sub_out || sub > sub_err) {
    return CO_ERR_BAD_ARG;
  }
  CO_OBJ* const obj = dict::find(node->Dict, CO_DEV(index_prompt, sub));
  CO_OS_OUTPUT* const output = obj != nullptr && obj->Type == CO_TOS_STDOUT ? output_of(*obj) : nullptr;
  if (output == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  if (!fits(*output, length)) {
    return CO_ERR_OBJ_SIZE;
  }
  append(*output, text, length);
  if (length != 0 && !tmr::is_running(output->Tmr)) {
    event::change_object(*node, *obj);
    event::run_deferred(*node);
  }
  return CO_ERR_NONE;
}

}  // extern "C"
