// SPDX-License-Identifier: Apache-2.0
// Process data objects. [301:7.2.2]
#pragma once

#include "co_core.h"

namespace co::pdo {

// Takes the configuration of all PDOs from the dictionary. A PDO whose mapping is wrong does not exist.
void init(CO_NODE& node);

// Entering and leaving Operational.
void on_mode_rpdos(CO_NODE& node);
void on_mode_tpdos(CO_NODE& node);

// A frame for RPDO number. False: it is shorter than the mapping.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// A remote request for TPDO number.
[[nodiscard]] bool on_remote(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Samples and sends the synchronous TPDOs, then writes the synchronous RPDOs. counter: 0 if the SYNC has none.
void sample(CO_NODE& node, uint8_t counter);
void apply(CO_NODE& node);

#if USE_MPDO
// See co_pdo.h; number exists.
[[nodiscard]] CO_ERR send_to(CO_NODE& node, uint16_t number, uint8_t node_id, uint32_t key, uint32_t value);

// Objects of the scanner list that wait can be sent again.
[[nodiscard]] bool on_free(CO_NODE& node, uint16_t number);
#endif

// After the synchronous window nothing synchronous is sent, or taken until the next SYNC.
void end_window(CO_NODE& node);

// Nothing synchronous waits for a controller that is not on the bus.
void flush(CO_NODE& node);

// An event for the TPDOs that map the object; while objects are locked it waits until they are not. Returns what keeps
// one from being sent; CO_ERR_TPDO_OBJ_TRIGGER: none maps it.
CO_ERR change_object(CO_NODE& node, const CO_OBJ& obj);
void send_touched(CO_NODE& node);
inline void settle_touched(CO_NODE& node) {
  if (node.Touched != 0) {
    send_touched(node);
  }
}

// Entries have other numbers.
void remap(CO_NODE& node);

// See co_pdo.h; number and object exist.
[[nodiscard]] CO_ERR request(CO_NODE& node, uint16_t number);
[[nodiscard]] bool was_received(CO_NODE& node, uint16_t number);
[[nodiscard]] bool was_received(CO_NODE& node, const CO_OBJ& obj);
[[nodiscard]] bool was_sent(CO_NODE& node, uint16_t number);
[[nodiscard]] bool was_sent(CO_NODE& node, const CO_OBJ& obj);

}  // namespace co::pdo
