// SPDX-License-Identifier: Apache-2.0
// SDO server: expedited, segmented and block transfer. [301:7.2.4]
#pragma once

#include "base/part.hpp"

namespace co::sdo::server {

// Ends all transfers and reads the COB-IDs from the dictionary.
void init(CO_NODE& node);

// Processes a frame for channel number. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Ends all transfers, without an abort, when SDO is no longer allowed. [301:7.3.2.2.4]
void on_mode(CO_NODE& node);

// Continues a block upload when the controller can accept frames. Returns true if segments were sent.
[[nodiscard]] bool on_free(CO_NODE& node, uint16_t number);

// Reads the COB-IDs from the dictionary again; a channel whose identifiers have changed drops its transfer.
void configure(CO_NODE& node);

inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode).free(on_free).configure(configure);

}  // namespace co::sdo::server

namespace co {
namespace sdo_server = sdo::server;  // the name of the part
}  // namespace co
