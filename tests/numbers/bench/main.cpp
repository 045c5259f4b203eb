// SPDX-License-Identifier: Apache-2.0
// Prints the number of instructions of each operation that the configuration has.
#include "co_cfg.h"
#include "machine.hpp"
#include "operations.hpp"

namespace bench {
namespace {

void measure_usual_node() {
  measure_dictionary();
  measure_network();
  measure_sdo();
  measure_rpdos();
  measure_tpdos();
  measure_sync();
  measure_timers();
}

}  // namespace

// Measures the operations of the configuration that the program is compiled with.
void run_all() {
  start_clock();
  check_clock();
  if (USE_OD != 0) {
    measure_index();
  } else {
    CO_RPDO_N > 4 ? measure_many_pdos() : measure_usual_node();
  }
}

}  // namespace bench
