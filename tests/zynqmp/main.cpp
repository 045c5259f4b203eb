// SPDX-License-Identifier: Apache-2.0
// A node and its master, one at each controller of QEMU's xlnx-zcu102: the usual services, and the driver's own cases.
#include "bus.hpp"
#include "cases.hpp"
#include "check.hpp"

extern "C" int main() {
  using namespace zynqmp;
  serve_controllers();
  const Cases groups[] = {nmt_cases(), sdo_cases(), pdo_cases(), emcy_cases(), master_cases(), driver_cases()};
  return run_all(groups, sizeof groups / sizeof groups[0]) == 0 ? 0 : 1;
}
