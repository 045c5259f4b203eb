// SPDX-License-Identifier: Apache-2.0
/// \file operations.hpp
/// Functions that measure operations. Each prints a line for each operation.
#pragma once

namespace bench {

/// Measures all operations that the configuration has.
void run_all();

/// \name Operations of the default configuration: 4 PDOs in each direction
/// \{
void measure_dictionary();
void measure_network();
void measure_sdo();
void measure_rpdos();
void measure_tpdos();
void measure_sync();
void measure_timers();
/// \}

/// Measures operations with 512 PDOs in each direction.
void measure_many_pdos();

/// Measures operations that exist with USE_OD only.
void measure_index();

}  // namespace bench
