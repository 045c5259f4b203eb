// SPDX-License-Identifier: Apache-2.0
// EMCY producer with error register and history, and EMCY consumer. [301:7.2.7]
#pragma once

#include "base/part.hpp"
#include "base/transmit.hpp"
#include "wire/cob_id.hpp"
#include "wire/emcy.hpp"

namespace co::emcy {

// Takes over the errors of the application.
void take_over(CO_NODE& node, const CO_NODE_SPEC& spec);

// Finds 1001h, 1014h and 1015h in the dictionary.
void find_objects(CO_NODE& node);

// Clears all errors of the stack; those of the application remain.
void init(CO_NODE& node);

// Discards queued messages when EMCY is not allowed.
void on_mode(CO_NODE& node);

// Implement the functions of base/events.hpp.
void change_fault(CO_NODE& node, event::Fault fault, event::Change change, uint32_t detail);
void report_can(CO_NODE& node, CO_CAN_EVENT what);

// Clears the application's errors and the history.
void forget_application(CO_NODE& node);

// Returns the number of errors of the application.
[[nodiscard]] unsigned table_length(const CO_EMCY& emcy);

// Writes the error register to 1001h, and sends the queued messages unless the inhibit time is running: part of the
// deferred work.
void send_queued(CO_NODE& node);

// Returns the identifier of EMCY messages; wire::no_frame: no messages are sent.
[[nodiscard]] uint32_t identifier(CO_NODE& node);

// Queue of messages (queue.cpp). CO_EMCY_QUEUE_N 0 omits queue and inhibit time: messages are sent at once.
#if CO_EMCY_QUEUE_N > 0
// Queues a message for the end of the API call, if there is an identifier. low, high: bytes as in wire::emcy()
void send_message(CO_NODE& node, uint32_t low, uint32_t high);

// Sends the queued messages, unless the inhibit time is running.
void send_waiting(CO_NODE& node);

void stop_inhibit_time(CO_NODE& node);

// Discards queued messages, including those in the transmit queue with this identifier.
void withdraw(CO_NODE& node, uint32_t identifier);
#else
inline void send_message(CO_NODE& node, uint32_t low, uint32_t high) {
  const uint32_t id = identifier(node);
  if (id != wire::no_frame) {
    transmit::send(node, wire::emcy(id, low, high));
  }
}
inline void send_waiting(CO_NODE&) {}
inline void stop_inhibit_time(CO_NODE&) {}
inline void withdraw(CO_NODE& node, uint32_t identifier) { transmit::withdraw(node, identifier); }
#endif

// 1003h. Its entries are those whose types were initialised. init_history() empties it if their number has changed.
#if USE_EMCY
inline void init_history(CO_NODE& node) {
  CO_EMCY_HIST& history = node.Emcy.Hist;
  if (history.Found != history.Max) {
    history.Max = history.Found;
    history.Num = 0;
    history.Off = 0;
  }
  history.Found = 0;
}
inline void clear_history(CO_NODE& node) { node.Emcy.Hist.Num = 0; }
#endif

// Processes a message of the node with sub-index number + 1 in 1028h. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Adds the routes of 1028h.
void init_consumer(CO_NODE& node);

inline constexpr Part part = Part()
                                 .take_over(take_over)
                                 .init(init)
                                 .mode(on_mode)
                                 .table(find_objects)
                                 .reset_node(forget_application)
                                 .change_fault(change_fault)
                                 .can(report_can)
                                 .deferred(event::send_emcy, send_queued);

}  // namespace co::emcy

namespace co::emcy_consumer {

inline constexpr Part part = Part().init(emcy::init_consumer).frames(emcy::on_frame);

}  // namespace co::emcy_consumer
