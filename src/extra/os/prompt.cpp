// SPDX-License-Identifier: Apache-2.0
// 1026h, OS prompt. [301:7.5.2.29]
//
// A character that a TPDO has read stays in the ring until its frame has left the transmit queue: until then a newer
// frame of the TPDO would replace it, and the end of Operational withdraws it.
#include "co_os.h"

#include "base/events.hpp"
#include "base/timer.hpp"
#include "co_core.h"
#include "dictionary/access.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"

namespace co::os_prompt {
namespace {

using event::Outlet;

constexpr uint16_t index_prompt = 0x1026;
constexpr uint8_t sub_out = 2;
constexpr uint8_t sub_err = 3;

// Values of CO_OS_OUTPUT.Taken.
constexpr uint8_t taken = 1;    // a TPDO has read the oldest character
constexpr uint8_t waiting = 2;  // and its frame is queued

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
    tmr::stop(node, timer);
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
    output->Taken = 0;
    output->Node = node;
    output->Key = obj->Key;
    stop_timer(*node, output->Tmr);
  }
  return err;
}

void on_time(void* output_pointer);

void start_timer(CO_OS_OUTPUT& output, uint16_t ms) {
  CO_NODE& node = *output.Node;
  const uint32_t ticks = tmr::ticks(node, ms, CO_TMR_UNIT_1MS);
  tmr::start(node, output.Tmr, ticks != 0 ? ticks : 1, 0, on_time, &output);
}

// Removes the oldest character; there is one.
uint8_t take_oldest(CO_OS_OUTPUT& output) {
  const uint8_t character = output.Start[output.First];
  output.First = static_cast<uint16_t>(output.First + 1U < output.Size ? output.First + 1U : 0U);
  --output.Num;
  return character;
}

// Removes the character that a TPDO has read, unless its frame is queued, or was seen queued before Operational ended.
// A frame that is queued and withdrawn within a millisecond is taken for sent: its character is lost.
void settle(CO_OS_OUTPUT& output, Outlet outlet) {
  if (output.Taken == 0) {
    return;
  }
  if (outlet == Outlet::queued) {
    output.Taken = waiting;
    return;
  }
  const bool is_withdrawn = output.Taken == waiting && (outlet == Outlet::closed || outlet == Outlet::none);
  output.Taken = 0;
  if (!is_withdrawn) {
    take_oldest(output);
  }
}

// Triggers the TPDOs of the next character as soon as they can transmit it, and until then comes back. CODictInit() may
// have moved the entry.
void on_time(void* output_pointer) {
  CO_OS_OUTPUT& output = *static_cast<CO_OS_OUTPUT*>(output_pointer);
  const CO_OBJ* const obj = dict::find(*output.Node, output.Key);
  if (obj == nullptr) {
    return;
  }
  const Outlet outlet = event::find_outlet(*output.Node, *obj);
  settle(output, outlet);
  if (output.Num == 0) {
    return;
  }
  switch (outlet) {
    case Outlet::open: event::change_object(*output.Node, *obj); return;
    case Outlet::none: start_timer(output, 10); return;
    default: start_timer(output, 1);
  }
}

// Reads the next character for a TPDO, which is transmitted with 0 if there is none.
uint8_t read_for_tpdo(CO_OS_OUTPUT& output, Outlet outlet) {
  if (output.Num == 0) {
    return 0;
  }
  start_timer(output, 1);
  if (outlet == Outlet::full) {  // the frame will be lost
    return 0;
  }
  output.Taken = output.Taken == 0 ? taken : output.Taken;
  return output.Start[output.First];
}

// An SDO client is refused without a character, and while the oldest one is queued in a frame.
CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t length) {
  CO_OS_OUTPUT* const output = output_of(*obj);
  if (output == nullptr || length != 1) {
    return CO_ERR_BAD_ARG;
  }
  const Outlet outlet = event::find_outlet(*node, *obj);
  uint8_t& character = *static_cast<uint8_t*>(buffer);
  settle(*output, outlet);
  if (access::requested_object(*node) != obj && output->Node == node) {
    character = read_for_tpdo(*output, outlet);
    return CO_ERR_NONE;
  }
  if (output->Num == 0 || output->Taken != 0) {
    return CO_ERR_OBJ_NO_DATA;
  }
  character = take_oldest(*output);
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
}  // namespace co::os_prompt

extern "C" {

const CO_OBJ_TYPE COTOsStdin = {co::os_prompt::size, co::dict::checked_by<co::rules::os_input>, nullptr,
                                co::os_prompt::write, nullptr};
const CO_OBJ_TYPE COTOsStdout = {co::os_prompt::size, co::os_prompt::init_output, co::os_prompt::read, nullptr,
                                 nullptr};

CO_ERR COOsPrint(CO_NODE* node, uint8_t sub, const uint8_t* text, uint16_t length) {
  if (node == nullptr || node->Dict.Node == nullptr || text == nullptr || sub < co::os_prompt::sub_out ||
      sub > co::os_prompt::sub_err) {
    return CO_ERR_BAD_ARG;
  }
  CO_OBJ* const obj = co::dict::find(*node, CO_DEV(co::os_prompt::index_prompt, sub));
  CO_OS_OUTPUT* const output = obj != nullptr && obj->Type == CO_TOS_STDOUT ? co::os_prompt::output_of(*obj) : nullptr;
  if (output == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  if (!co::os_prompt::fits(*output, length)) {
    return CO_ERR_OBJ_SIZE;
  }
  co::os_prompt::append(*output, text, length);
  if (length != 0 && output->Node == node && !co::tmr::is_running(output->Tmr)) {
    co::os_prompt::on_time(output);
    co::event::run_deferred(*node);
  }
  return CO_ERR_NONE;
}

}  // extern "C"
