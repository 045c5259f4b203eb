// SPDX-License-Identifier: Apache-2.0
/// \file memory.hpp
/// Memory of the process.
#pragma once

namespace lexican::codict {

/// Returns freed memory to the system, where the C library has a function for it. Many small parts of memory between
/// others would else remain in the process.
void return_free_memory();

}  // namespace lexican::codict
