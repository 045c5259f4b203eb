// SPDX-License-Identifier: Apache-2.0
#include "clock/names.hpp"

#include <vector>

namespace lexican::demo {

trace::Mappings clock_mappings() {
  const std::vector<trace::Mapped> time = {{0x2100, 1, 1}, {0x2100, 2, 1}, {0x2100, 3, 1}};
  return {{0x180, time}, {0x200, time}};
}

const trace::Names& clock_object_names() {
  using trace::Form;
  static const trace::Names names = {
      {0x1000, 0, "device type", Form::hex},
      {0x1001, 0, "error register", Form::hex},
      {0x1003, 0, "errors in the history", Form::decimal},
      {0x1003, 1, "last error", Form::hex},
      {0x1005, 0, "COB-ID SYNC", Form::hex},
      {0x1006, 0, "SYNC period in us", Form::decimal},
      {0x1008, 0, "device name", Form::characters},
      {0x1009, 0, "hardware version", Form::characters},
      {0x100A, 0, "software version", Form::characters},
      {0x100C, 0, "guard time in ms", Form::decimal},
      {0x100D, 0, "life time factor", Form::decimal},
      {0x1010, 1, "save", Form::characters},
      {0x1011, 1, "load", Form::characters},
      {0x1014, 0, "COB-ID EMCY", Form::hex},
      {0x1017, 0, "heartbeat time in ms", Form::decimal},
      {0x1018, 0, "identity, highest sub-index", Form::decimal},
      {0x1018, 1, "vendor-ID", Form::hex},
      {0x1018, 2, "product code", Form::hex},
      {0x1018, 3, "revision number", Form::hex},
      {0x1018, 4, "serial number", Form::decimal},
      {0x1020, 1, "configuration date", Form::decimal},
      {0x1020, 2, "configuration time", Form::decimal},
      {0x1200, 0, "SDO server, highest sub-index", Form::decimal},
      {0x1200, 1, "COB-ID of SDO requests", Form::hex},
      {0x1200, 2, "COB-ID of SDO responses", Form::hex},
      {0x1800, 2, "transmission type of TPDO1", Form::decimal},
      {0x2100, 0, "time, highest sub-index", Form::decimal},
      {0x2100, 1, "hour", Form::decimal},
      {0x2100, 2, "minute", Form::decimal},
      {0x2100, 3, "second", Form::decimal},
      {0x2101, 0, "time zone in min", Form::decimal},
      {0x2200, 0, "picture", Form::hex},
      {0x2201, 0, "station name", Form::characters},
  };
  return names;
}

}  // namespace lexican::demo
