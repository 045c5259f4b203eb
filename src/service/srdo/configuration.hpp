// SPDX-License-Identifier: Apache-2.0
// Configuration and mapping of SRDOs.
#pragma once

#include "base/part.hpp"
#include "co_core.h"

#if CO_SRDO_N > 0

namespace co::srdo {

inline constexpr uint16_t first_communication = 0x1301;
inline constexpr uint16_t first_mapping = 0x1381;
inline constexpr uint32_t key_valid = CO_DEV(0x13FE, 0);
inline constexpr uint16_t signatures = 0x13FF;

inline constexpr uint32_t unit_us = 1000000;  // unit of CO_SRDO_GAP, like CO_TMR_UNIT_1MS

[[nodiscard]] inline bool is_operational(const CO_NODE& node) { return (node.Nmt.Allowed & CO_PDO_ALLOWED) != 0; }

// Returns sub 1 of 1301h…; 0: there is none.
[[nodiscard]] uint8_t direction_of(CO_NODE& node, unsigned number);

// Sets the state of an SRDO by its direction, outside of Operational.
void change_direction(CO_NODE& node, unsigned number);

// Returns whether a value of sub 1…6 of 1301h… is allowed.
[[nodiscard]] bool is_parameter(uint8_t sub, uint32_t value);

// Returns whether an object may be mapped. rights: flags that it needs
[[nodiscard]] CO_ERR check_mapping(CO_NODE& node, uint32_t mapping, uint32_t rights);

// Checks an SRDO whose direction is not 0, and reads its parameters and its mapping. Returns the key of the object with
// the fault; 0: none.
[[nodiscard]] uint32_t configure(CO_NODE& node, unsigned number);

[[nodiscard]] bool is_valid(CO_NODE& node);
void invalidate(CO_NODE& node);

[[nodiscard]] CO_ERR compute_signature(CO_NODE& node, unsigned number, uint16_t& signature);

// Bit of CO_SRDO.Flags: objects are being read or written; cleared when the SRDO ends.
inline constexpr uint8_t accessing = 0x04;

// Reads or writes the mapped objects of an SRDO that is being processed, with OdLock held. Returns the first error.
[[nodiscard]] CO_ERR read_objects(CO_NODE& node, const CO_SRDO& srdo, uint8_t* plain, uint8_t* inverse);
[[nodiscard]] CO_ERR write_objects(CO_NODE& node, const CO_SRDO& srdo, uint8_t* plain, uint8_t* inverse);

}  // namespace co::srdo

#endif

// Safety-relevant data objects. [EN 50325-5]

namespace co::srdo {

// Sets the states of all SRDOs. No SRDO runs until Operational is entered.
void init(CO_NODE& node);

// Checks and starts the SRDOs when Operational is entered, and stops them when it is left.
void on_mode(CO_NODE& node);

// Processes a frame. number: twice the number of the SRDO, plus 1 for the inverse frame
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// End the running SRDOs with CO_SRDO_ERR_INTERNAL after CODictInit() has replaced the dictionary, which was checked:
// halt() before any function of the application may run, report_halted() with the callbacks.
void halt(CO_NODE& node);
void report_halted(CO_NODE& node);

inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode).halt(halt).configure(report_halted);

}  // namespace co::srdo
