// SPDX-License-Identifier: Apache-2.0
// SDO downloads to read-only memory: the flags of the entries permit them, but the entries (flag D), their variables,
// strings and domains are constants. The application's Writable function refuses the writes, so that the server aborts
// with 0601 0000h. A write to this memory would crash the program.
#include <iterator>

#include "support/fixture.hpp"

namespace {

using namespace test;

const std::uint32_t constant = 0x44332211;
const std::uint8_t text_memory[8] = "rom";
CO_OBJ_STR_RW text{0, 3, 8, const_cast<std::uint8_t*>(text_memory)};
CO_OBJ_DOM domain{0, 8, const_cast<std::uint8_t*>(text_memory)};

const CO_OBJ table[] = {
    {CO_KEY(0x1017, 0, CO_OBJ_D___RW), CO_THB_PROD, 0},
    {CO_KEY(0x2000, 1, CO_OBJ_D___RW), CO_TUNSIGNED8, 0x11},
    {CO_KEY(0x2000, 2, CO_OBJ_D___RW), CO_TUNSIGNED16, 0x2211},
    {CO_KEY(0x2000, 3, CO_OBJ_DN__RW), CO_TUNSIGNED32, 0x180},
    {CO_KEY(0x2000, 4, CO_OBJ_D___RW), CO_TBOOLEAN, 0},
    {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TUNSIGNED32, &constant},
    {CO_KEY(0x2002, 0, CO_OBJ_____RW), CO_TVISIBLE_STRING, &text},
    {CO_KEY(0x2003, 0, CO_OBJ_____RW), CO_TDOMAIN, &domain},
    CO_OBJ_DICT_ENDMARK,
};

bool is_in(const void* address, const void* memory, std::size_t size) {
  const auto* byte = static_cast<const std::uint8_t*>(address);
  const auto* first = static_cast<const std::uint8_t*>(memory);
  return byte >= first && byte < first + size;
}

bool may_write(const void* address, std::uint32_t) {
  return !is_in(address, table, sizeof table) && !is_in(address, &constant, sizeof constant) &&
         !is_in(address, text_memory, sizeof text_memory);
}

class Device : public Fixture {
 public:
  Device() : Fixture(Setup().only_small().writable(may_write)) {
    call([this] { CHECK(CODictInit(&node.Dict, &node, const_cast<CO_OBJ*>(table), std::size(table)) >= 0); });
  }
};

TEST_CASE("SDO: a download to a value in a read-only dictionary (flags D and W) is refused and changes nothing [D16]") {
  Device node;
  node.ask("601#2F00200101000000", "581#8000200100000106");
  node.ask("601#2B00200201000000", "581#8000200200000106");
  node.ask("601#2300200381010000", "581#8000200300000106");
  node.ask("601#2F00200401000000", "581#8000200400000106");
  node.ask("601#2100200304000000", "581#6000200300000000");
  node.ask("601#0781010000000000", "581#8000200300000106");
  node.ask("601#4000200100000000", "581#4F00200111000000");
  node.ask("601#4000200200000000", "581#4B00200211220000");
  node.ask("601#4000200300000000", "581#4300200381010000");
  node.ask("601#4000200400000000", "581#4F00200400000000");
}

TEST_CASE("SDO: a download to 1017h in read-only memory is refused and starts no heartbeat [H1]") {
  Device node;
  node.ask("601#2B1710000A000000", "581#8017100000000106");
  node.after(100ms);
  node.silent();
  node.ask("601#4017100000000000", "581#4B17100000000000");
}

TEST_CASE("SDO: a download to a variable or string or domain in read-only memory is refused and changes nothing") {
  Device node;
  node.ask("601#2301200001020304", "581#8001200000000106");
  node.ask("601#2F02200041000000", "581#8002200000000106");
  node.ask("601#2F03200041000000", "581#8003200000000106");
  node.rx("601#2103200008000000");
  // The domain may be refused at the initiate or at the segment.
  if (!node.can.sent.empty() && node.can.sent.front().frm.Data[0] == 0x60) {
    node.tx("581#6003200000000000");
    node.rx("601#0041424344454647");
  }
  node.tx("581#8003200000000106");
  node.ask("601#4001200000000000", "581#4301200011223344");
  node.ask("601#4002200000000000", "581#47022000726F6D00");
}

}  // namespace
