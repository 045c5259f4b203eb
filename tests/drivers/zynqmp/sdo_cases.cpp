// SPDX-License-Identifier: Apache-2.0
// SDO server: bytes of expedited, segmented and block transfers. [301:7.2.4]
#include "bus.hpp"
#include "cases.hpp"
#include "nodes.hpp"

namespace zynqmp {
namespace {

// Value of 1008h and data of the downloads; its CRC is 31C3h. [301:7.2.4.3.16]
constexpr char digits[] = "123456789";

bool memory_has_digits() {
  for (unsigned n = 0; n < sizeof digits - 1; ++n) {
    if (objects.memory[n] != digits[n]) {
      return false;
    }
  }
  return true;
}

void expedited() {
  start_device();
  ASK("605#4000100000000000", "585#4300100092010200");
  ASK("605#2F00200155000000", "585#6000200100000000");
  ASK("605#2B00200234120000", "585#6000200200000000");
  ASK("605#2300200378563412", "585#6000200300000000");
  CHECK_EQUAL(objects.byte, 0x55);
  CHECK_EQUAL(objects.word, 0x1234);
  CHECK_EQUAL(objects.number, 0x12345678);
  ASK("605#4000200100000000", "585#4F00200155000000");
  ASK("605#4000200200000000", "585#4B00200234120000");
  ASK("605#4000200300000000", "585#4300200378563412");
}

void segmented_upload() {
  start_device();
  ASK("605#4008100000000000", "585#4108100009000000");
  ASK("605#6000000000000000", "585#0031323334353637");
  ASK("605#7000000000000000", "585#1B38390000000000");
}

void segmented_download() {
  start_device();
  ASK("605#2110200009000000", "585#6010200000000000");
  ASK("605#0031323334353637", "585#2000000000000000");
  ASK("605#1B38390000000000", "585#3000000000000000");
  CHECK(memory_has_digits());
}

void block_upload() {
  start_device();
  ASK("605#A40810007F000000", "585#C608100009000000");
  ASK("605#A300000000000000", "585#0131323334353637");
  RX("585#8238390000000000");
  ASK("605#A2027F0000000000", "585#D5C3310000000000");
  send("605#A100000000000000");
}

void block_upload_repeated() {
  start_device();
  ASK("605#A40810007F000000", "585#C608100009000000");
  ASK("605#A300000000000000", "585#0131323334353637");
  RX("585#8238390000000000");
  ASK("605#A2017F0000000000", "585#8138390000000000");  // segment 2 was lost
  ASK("605#A2017F0000000000", "585#D5C3310000000000");
  send("605#A100000000000000");
}

void block_download() {
  start_device();
  ASK("605#C610200009000000", "585#A41020007F000000");
  send("605#0131323334353637");
  ASK("605#8238390000000000", "585#A2027D0000000000");
  ASK("605#D5C3310000000000", "585#A100000000000000");
  CHECK(memory_has_digits());
}

void block_download_wrong_crc() {
  start_device();
  ASK("605#C610200009000000", "585#A41020007F000000");
  send("605#0131323334353637");
  ASK("605#8238390000000000", "585#A2027D0000000000");
  ASK("605#D5C3320000000000", "585#8010200004000405");
}

void aborts() {
  start_device();
  ASK("605#40FF2F0000000000", "585#80FF2F0000000206");  // no such object
  ASK("605#4000200900000000", "585#8000200911000906");  // no such sub-index
  ASK("605#2300100000000000", "585#8000100002000106");  // read-only
  ASK("605#2300200155000000", "585#8000200112000706");  // too long
  ASK("605#E000200000000000", "585#8000200001000405");  // invalid command specifier
}

void wrong_toggle() {
  start_device();
  ASK("605#4008100000000000", "585#4108100009000000");
  ASK("605#7000000000000000", "585#8008100000000305");
}

void no_answer() {
  start_device();
  send("605#40001000000000");  // 7 bytes
  SILENT(20);
  ASK("605#4008100000000000", "585#4108100009000000");
  send("605#8008100000000008");  // the client aborts
  SILENT(20);
  ASK("605#4000100000000000", "585#4300100092010200");
}

void time_out() {
  start_device();
  ASK("605#4008100000000000", "585#4108100009000000");
  SILENT(1700);
  RX("585#8008100000000405", 400);
}

constexpr Case cases[] = {
    {"SDO: expedited upload and download of 1, 2 and 4 bytes [301:7.2.4.3.3, 7.2.4.3.5]", expedited},
    {"SDO: segmented upload [301:7.2.4.3.6]", segmented_upload},
    {"SDO: segmented download [301:7.2.4.3.4]", segmented_download},
    {"SDO: block upload with CRC [301:7.2.4.3.12]", block_upload},
    {"SDO: block upload, a lost segment is sent again [301:7.2.4.3.13]", block_upload_repeated},
    {"SDO: block download with CRC [301:7.2.4.3.9]", block_download},
    {"SDO: block download with a wrong CRC is aborted with 0504 0004h [301:7.2.4.3.11]", block_download_wrong_crc},
    {"SDO: what cannot be done is aborted with its code [301:7.2.4.3.17]", aborts},
    {"SDO: a toggle bit that does not alternate is aborted with 0503 0000h [301:7.2.4.3.6]", wrong_toggle},
    {"SDO: no answer to a frame of 7 bytes, or to an abort [D1, D6]", no_answer},
    {"SDO: a silent client is aborted with 0504 0000h [D18]", time_out},
};

}  // namespace

Cases sdo_cases() { return all_of(cases); }

}  // namespace zynqmp
