// SPDX-License-Identifier: Apache-2.0
// Process data objects. [301:7.2.2]
#pragma once

#include "base/part.hpp"
#include "co_core.h"

namespace co::pdo {

// Assigns the PDOs to the node, and their timers to the real-time thread.
void take_over(CO_NODE& node, const CO_NODE_SPEC& spec);

// Configures all PDOs from the dictionary. A PDO with an invalid mapping does not exist.
void init(CO_NODE& node);

// Configures the PDOs whose parameters were changed.
void configure_changed(CO_NODE& node);

// Start PDOs when Operational is entered, and stop them when it is left.
void on_mode_rpdos(CO_NODE& node);
void on_mode_tpdos(CO_NODE& node);

// Processes a frame for RPDO number. Returns false if it is malformed, for example shorter than the mapping.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Processes a remote request for TPDO number.
[[nodiscard]] bool on_remote(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Process a SYNC: sample() samples and sends the synchronous TPDOs, then apply() writes the data of the synchronous
// RPDOs to their objects. counter: 0 if the SYNC has none.
void sample(CO_NODE& node, uint8_t counter);
void apply(CO_NODE& node, uint8_t counter);

// Begin and end the synchronous window; outside of it synchronous RPDOs are ignored.
inline void begin_window(CO_NODE& node, uint8_t) { node.WindowOver = 0; }
inline void end_window(CO_NODE& node) { node.WindowOver = 1; }

// Withdraws synchronous TPDOs: at the end of the synchronous window, and when the controller is not on the bus.
void flush(CO_NODE& node);

// Marks the TPDOs that map the object. Returns the error of a TPDO that cannot be sent; CO_ERR_TPDO_OBJ_TRIGGER: no
// TPDO maps the object.
CO_ERR change_object(CO_NODE& node, const CO_OBJ& obj);
[[nodiscard]] event::Outlet find_outlet(CO_NODE& node, const CO_OBJ& obj);
// Sends the marked TPDOs: part of the deferred work. Returns the last error. The caller ensures that a TPDO is marked,
// OdLock is not held, and the node works.
CO_ERR send_marked(CO_NODE& node);

// Resolves all mappings again after CODictInit() has renumbered the entries.
void remap(CO_NODE& node);

// Implement the functions of co_pdo.h for numbers and objects that exist. Requests send the TPDOs, or mark them while
// OdLock is held.
[[nodiscard]] CO_ERR request(CO_NODE& node, uint16_t number);
[[nodiscard]] CO_ERR request_object(CO_NODE& node, const CO_OBJ& obj);
[[nodiscard]] bool was_received(CO_NODE& node, uint16_t number);
[[nodiscard]] bool was_received(CO_NODE& node, const CO_OBJ& obj);
[[nodiscard]] bool was_sent(CO_NODE& node, uint16_t number);
[[nodiscard]] bool was_sent(CO_NODE& node, const CO_OBJ& obj);

inline constexpr Part part = Part()
                                 .take_over(take_over)
                                 .init(init)
                                 .configure(configure_changed)
                                 .remap(remap)
                                 .sync(begin_window)
                                 .window(end_window);

}  // namespace co::pdo

// TPDOs come before RPDOs: at a SYNC they are sampled before the data of RPDOs is written. [301:7.2.2.3]
namespace co::tpdo {

inline constexpr Part part = Part()
                                 .remote_frames(pdo::on_remote)
                                 .mode(pdo::on_mode_tpdos)
                                 .sync(pdo::sample)
                                 .window(pdo::flush)
                                 .bus_off(pdo::flush)
                                 .object_changed(pdo::change_object)
                                 .outlet(pdo::find_outlet)
                                 .deferred(event::send_tpdos, [](CO_NODE& node) { (void)pdo::send_marked(node); });

}  // namespace co::tpdo

namespace co::rpdo {

inline constexpr Part part = Part().frames(pdo::on_frame).mode(pdo::on_mode_rpdos).sync(pdo::apply);

}  // namespace co::rpdo

// The PDOs of a node as ranges, which are empty where the configuration has none.

namespace co::pdo {

struct Pdos {
  CO_PDO* first;
  unsigned num;

  [[nodiscard]] CO_PDO* begin() const { return first; }
  [[nodiscard]] CO_PDO* end() const { return first + num; }
};

#if CO_RPDO_N > 0
[[nodiscard]] inline Pdos rpdos(CO_NODE& node) { return {node.RPdo, CO_RPDO_N}; }
#else
[[nodiscard]] inline Pdos rpdos(CO_NODE&) { return {nullptr, 0}; }
#endif

#if CO_TPDO_N > 0
[[nodiscard]] inline Pdos tpdos(CO_NODE& node) { return {node.TPdo, CO_TPDO_N}; }
#else
[[nodiscard]] inline Pdos tpdos(CO_NODE&) { return {nullptr, 0}; }
#endif

}  // namespace co::pdo
