// SPDX-License-Identifier: Apache-2.0
// Runs the cases of the services, with a node and its master at the two controllers of QEMU's xlnx-zcu102, and the
// cases of the driver.
#include "bus.hpp"
#include "cases.hpp"
#include "check.hpp"

extern "C" int main() {
  using namespace zynqmp;
  serve_controllers();
  const Cases groups[] = {nmt_cases(), sdo_cases(), pdo_cases(), emcy_cases(), master_cases(), driver_cases()};
  return run_all(groups, sizeof groups / sizeof groups[0]) == 0 ? 0 : 1;
}
