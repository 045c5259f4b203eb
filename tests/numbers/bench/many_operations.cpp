// SPDX-License-Identifier: Apache-2.0
// Cost of hundreds of PDOs, all of which exist, for operations that do not use them, and of these PDOs.
#include "measure.hpp"
#include "node_operations.hpp"
#include "operations.hpp"

namespace bench {

void measure_many_pdos() {
  measure("512 + 512 PDOs: foreign frame", ForeignFrame([] { set_up_event_driven(words); }));
  measure("512 + 512 PDOs: RPDO, 8 x 8 bits, neighbours", ReceivedPdo(set_up_event_driven, bytes));
  measure("512 + 512 PDOs: RPDO, 2 x 32 bits, neighbours", ReceivedPdo(set_up_event_driven, words));
  measure("512 + 512 PDOs: TPDO, 8 x 8 bits, neighbours, trigger to frame", TriggeredPdo(set_up_event_driven, bytes));
  measure("512 + 512 PDOs: TPDO, 8 x 8 bits, write of an object to frame", WrittenObject(set_up_event_driven));
  measure("512 + 512 PDOs: SYNC, 4 RPDOs and 4 TPDOs of 8 x 8 bits, neighbours", Sync(set_up_synchronous, bytes, 4, 4));
}

}  // namespace bench
