// SPDX-License-Identifier: Apache-2.0
// SDO server: expedited, segmented and block transfer. [301:7.2.4]
#pragma once

#include "co_core.h"

namespace co::sdo_server {

// Ends all transfers and takes the COB-IDs from the dictionary.
void init(CO_NODE& node);

// A frame for channel number. False: malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Transfers end, without an abort, when SDO is no longer allowed. [301:7.3.2.2.4]
void on_mode(CO_NODE& node);

// The controller may take frames again: a block upload goes on by a segment. True: it was sent.
[[nodiscard]] bool on_free(CO_NODE& node, uint16_t number);

// Takes the COB-IDs from the dictionary again; a channel whose identifiers have changed drops its transfer.
void configure(CO_NODE& node);

}  // namespace co::sdo_server
