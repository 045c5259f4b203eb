// SPDX-License-Identifier: Apache-2.0
/// \file names.hpp
/// Texts for the dictionary of the clock.
#pragma once

#include "trace/decode.hpp"

namespace lexican::demo {

/// Returns the names of the objects, for the trace.
const trace::Names& clock_object_names();
/// Returns the objects mapped to the PDOs of the clock.
trace::Mappings clock_mappings();

}  // namespace lexican::demo
