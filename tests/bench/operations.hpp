// SPDX-License-Identifier: Apache-2.0
/// \file operations.hpp
/// What is measured. Each prints a line for each operation.
#pragma once

namespace bench {

/// All that the configuration has.
void run_all();

/// With a usual configuration: 4 PDOs in each direction.
/// \{
void measure_dictionary();
void measure_network();
void measure_sdo();
void measure_rpdos();
void measure_tpdos();
void measure_sync();
void measure_timers();
/// \}

/// With 512 PDOs in each direction.
void measure_many_pdos();

/// With USE_OD.
void measure_index();

}  // namespace bench
