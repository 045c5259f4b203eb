// SPDX-License-Identifier: Apache-2.0
/// \file network_services.hpp
/// PDO, SYNC, TIME and EMCY messages of the pre-defined connection set in words. [301:7.3.3]
#pragma once

#include <optional>
#include <string>

#include "trace/decode.hpp"

namespace demo::trace {

/// Nothing if the frame is none of them.
std::optional<std::string> decode_network_service(const CO_IF_FRM& frame, const Names& names, const Mappings& mappings);

}  // namespace demo::trace
