// SPDX-License-Identifier: Apache-2.0
// Table of the services of the node, and the functions that use it.
#pragma once

#include "base/routes.hpp"
#include "co_core.h"

namespace co {

// Service: its permission and its functions; null: it has none.
struct Service {
  routes::Service id;  // owner of its routes; count: it receives no frames
  uint8_t allowed;     // CO_…_ALLOWED bit that the NMT state must permit for its frames
  uint16_t streams;    // senders that on_free continues, numbered from 0
  void (*init)(CO_NODE& node);
  bool (*on_frame)(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);   // false: malformed
  bool (*on_remote)(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);  // remote frame; false: malformed
  void (*on_mode)(CO_NODE& node);                                             // the NMT state has changed
  bool (*on_free)(CO_NODE& node, uint16_t number);  // transmit::offer() may succeed now; true: frames were sent
  void (*configure)(CO_NODE& node);                 // parameters have changed
};

namespace services {

void init(CO_NODE& node);

// Functions of the LSS slave. begin_lss() sets node-ID and bit rate of the node that is being initialised to the stored
// ones, load_node_id() reads the stored ones for the next reset, take_node_id() sets the node-ID at a reset.
// awaits_node_id() returns whether the node, which is being started, has to wait for a node-ID; is_started() whether it
// is waiting.
#if USE_LSS
void begin_lss(CO_NODE& node);
void load_node_id(CO_NODE& node);
void take_node_id(CO_NODE& node);
[[nodiscard]] bool awaits_node_id(CO_NODE& node);
[[nodiscard]] bool is_started(const CO_NODE& node);
#else
inline void begin_lss(CO_NODE&) {}
inline void load_node_id(CO_NODE&) {}
inline void take_node_id(CO_NODE&) {}
[[nodiscard]] inline bool awaits_node_id(CO_NODE&) { return false; }
[[nodiscard]] inline bool is_started(const CO_NODE&) { return false; }
#endif

// Functions of the parameter groups. load() loads the groups of a reset, save_changes() stores changes of the groups
// that are stored autonomously.
#if USE_PARA
void load(CO_NODE& node, CO_NMT_RESET type);
void save_changes(CO_NODE& node);
#else
inline void load(CO_NODE&, CO_NMT_RESET) {}
inline void save_changes(CO_NODE&) {}
#endif

// Sends the EMCY messages that are queued.
#if USE_EMCY
void send_emcy(CO_NODE& node);
#else
inline void send_emcy(CO_NODE&) {}
#endif

// Clears the EMCY errors that the application has set: the application starts anew.
#if USE_EMCY
void forget_application(CO_NODE& node);
#else
inline void forget_application(CO_NODE&) {}
#endif

// Returns whether all routes of the identifier at this position belong to SYNC and PDOs.
[[nodiscard]] bool is_real_time(const CO_NODE& node, unsigned place);

// Passes a frame to the services whose routes begin at this position. Returns false if the NMT state permits none of
// them.
#if CO_ROUTES_SORTED
[[nodiscard]] bool dispatch(CO_NODE& node, const CO_IF_FRM& frame, unsigned place);
#else
[[nodiscard]] bool dispatch(CO_NODE& node, const CO_IF_FRM& frame);
#endif

// Reads the COB-IDs of SDO servers and clients and the parameters of changed PDOs from the dictionary again.
void configure(CO_NODE& node);

// Reads parameters from the dictionary again and finds the mapped objects of PDOs, SRDOs and recorders in it.
void remap(CO_NODE& node);

// Continues the senders whose frames the controller has refused.
void on_free(CO_NODE& node);

}  // namespace services
}  // namespace co
