// SPDX-License-Identifier: Apache-2.0
/// \file network_services.hpp
/// Decodes PDO, SYNC, TIME and EMCY messages of the pre-defined connection set [301:7.3.3], GFC and SRDOs [EN 50325-5].
#pragma once

#include <optional>
#include <string>

#include "trace/decode.hpp"

namespace lexican::trace {

// The parts of an identifier. [301:7.3.3]
inline unsigned function_code(const CO_IF_FRM& frame) { return frame.Identifier >> 7; }
inline unsigned node_id(const CO_IF_FRM& frame) { return frame.Identifier & 0x7Fu; }

/// Returns the meaning of a frame of these services, nothing for other frames.
std::optional<std::string> decode_network_service(const CO_IF_FRM& frame, const Names& names, const Mappings& mappings);

}  // namespace lexican::trace
