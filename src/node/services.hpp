// SPDX-License-Identifier: Apache-2.0
// The services of the node, a row each.
#pragma once

#include "co_core.h"

namespace co {

struct Service {
  uint8_t allowed;   // CO_…_ALLOWED bit that its frames need
  uint16_t streams;  // for on_free: who may send so, numbers from 0
  void (*init)(CO_NODE& node);
  bool (*on_frame)(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);   // false: malformed
  bool (*on_remote)(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);  // a remote frame, likewise
  void (*on_mode)(CO_NODE& node);
  bool (*on_free)(CO_NODE& node, uint16_t number);  // transmit::offer() may now succeed. True: it has
  void (*configure)(CO_NODE& node);                 // COB-IDs have changed
};

namespace services {

void init(CO_NODE& node);

// LSS: node-ID and bit rate as they were stored, for the node that is being initialised, and for the next reset. Does
// the node that is started have to wait for a node-ID? Was it started so?
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

// Loads the parameters of a reset. What is stored autonomously is safe.
#if USE_PARA
void load(CO_NODE& node, CO_NMT_RESET type);
void save_changes(CO_NODE& node);
#else
inline void load(CO_NODE&, CO_NMT_RESET) {}
inline void save_changes(CO_NODE&) {}
#endif

// The application starts anew: what it has told the services is no more.
#if USE_EMCY
void forget_application(CO_NODE& node);
#else
inline void forget_application(CO_NODE&) {}
#endif

// Are the routes that begin at this place those of SYNC and PDOs alone?
[[nodiscard]] bool is_real_time(const CO_NODE& node, unsigned place);

// Gives a frame to the services whose routes begin at this place. False: none may have it.
[[nodiscard]] bool dispatch(CO_NODE& node, const CO_IF_FRM& frame, unsigned place);

// Takes COB-IDs from the dictionary again.
void configure(CO_NODE& node);

// Finds mapped objects again.
void remap(CO_NODE& node);

// Lets those go on that have found the controller full.
void on_free(CO_NODE& node);

}  // namespace services
}  // namespace co
