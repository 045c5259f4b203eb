// SPDX-License-Identifier: Apache-2.0
// EMCY producer with error register and history, and EMCY consumer. [301:7.2.7]
#pragma once

#include "core/events.hpp"

namespace co::emcy {

// No error of the stack any more; those of the application are kept.
void init(CO_NODE& node);

// Messages end where EMCY is not allowed.
void on_mode(CO_NODE& node);

// See core/events.hpp.
void raise(CO_NODE& node, event::Fault fault, uint8_t detail);
void resolve(CO_NODE& node, event::Fault fault, uint8_t detail);
void forget(CO_NODE& node, event::Fault fault);
void report_can(CO_NODE& node, CO_CAN_EVENT what);

// The application's errors and the history are no more.
void forget_application(CO_NODE& node);

// The identifier of the messages; wire::no_frame: there are none.
[[nodiscard]] uint32_t identifier(CO_NODE& node);

// What waits under this identifier is not sent any more.
void withdraw(CO_NODE& node, uint32_t identifier);

// 1003h. Its entries are those whose types were initialised; if it has another number of them than before, it is empty.
void init_history(CO_NODE& node);
void add_to_history(CO_NODE& node, uint32_t entry);
void clear_history(CO_NODE& node);

// A message of the node that 1028h names at sub-index number. False: malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// The routes of 1028h.
void init_consumer(CO_NODE& node);

}  // namespace co::emcy
