// SPDX-License-Identifier: Apache-2.0
/// \file names.hpp
/// The dictionary of the clock in words.
#pragma once

#include "trace/decode.hpp"

namespace demo {

/// Names of the objects of the clock, for the trace.
const trace::Names& clock_object_names();
/// What its PDOs hold.
trace::Mappings clock_mappings();

}  // namespace demo
