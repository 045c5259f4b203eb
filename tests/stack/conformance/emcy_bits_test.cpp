// SPDX-License-Identifier: Apache-2.0
// Error status bits: an octet string with a bit for each error of the application and of the stack.
#include "support/emcy_fixture.hpp"
#include "support/pdo_fixture.hpp"

#if USE_EMCY

namespace {

using namespace test;

constexpr std::uint16_t index_bits = 0x2E00;

Setup with_bits(CO_EMCY_BITS& bits, std::uint32_t flags = CO_OBJ____PR_) {
  return Setup().emergencies(errors_of_device()).with({CO_KEY(index_bits, 0, flags), CO_TEMCY_BITS, &bits});
}

Setup with_many(CO_EMCY_BITS& bits, std::size_t errors) {
  return Setup()
      .emergencies(std::vector<CO_EMCY_TBL>(errors, {CO_EMCY_REG_GENERAL, CO_EMCY_CODE_GEN_ERR}))
      .with({CO_KEY(index_bits, 0, CO_OBJ_____R_), CO_TEMCY_BITS, &bits});
}

TEST_CASE("error status bits: error n of COEmcySet is bit n until COEmcyClr [O2]") {
  CO_EMCY_BITS bits{};
  EmcyNode node(with_bits(bits));
  node.ask("601#40002E0000000000", "581#4F002E0000000000");
  node.set(current);
  node.set(no_disk);
  node.trace();
  node.ask("601#40002E0000000000", "581#4F002E0012000000");
  node.clr(current);
  node.trace();
  node.ask("601#40002E0000000000", "581#4F002E0010000000");
  node.call([&] { COEmcyReset(&node->Emcy, 1); });
  node.trace();
  node.ask("601#40002E0000000000", "581#4F002E0000000000");
}

TEST_CASE("error status bits: every error of the table has its own bit [O2]") {
  CO_EMCY_BITS bits{};
  EmcyNode node(with_many(bits, CO_EMCY_N));
  for (unsigned err = 0; err < CO_EMCY_N; ++err) {
    CAPTURE(err);
    node.set(static_cast<std::uint8_t>(err));
    node.trace();
    Bytes expected(CO_EMCY_STORAGE);
    expected[err / 8] = static_cast<std::uint8_t>(1U << (err % 8));
    CHECK(node.upload(index_bits, 0) == expected);
    node.clr(static_cast<std::uint8_t>(err));
    node.trace();
  }
}

TEST_CASE("error status bits: the length is that of the error table or the given one [O2]") {
  const auto length = [](std::uint8_t size, std::size_t errors, std::uint8_t stack) {
    CO_EMCY_BITS bits{0, size, stack};
    EmcyNode node(with_many(bits, errors));
    return node.upload(index_bits, 0).size();
  };
  CHECK(length(0, 1, 0) == 1);
  CHECK(length(0, 8, 0) == 1);
  if (CO_EMCY_N > 8) {
    CHECK(length(0, 9, 0) == 2);
  }
  CHECK(length(0, 8, 1) == 3);
  CHECK(length(4, 8, 0) == 4);
  CHECK(length(4, 8, 1) == 6);
  CHECK(length(255, 8, 1) == 257);
}

TEST_CASE("error status bits: bytes behind the errors of the application are 0 [O2]") {
  CO_EMCY_BITS bits{0, 255, 0};
  EmcyNode node(with_bits(bits));
  node.set(general);
  node.trace();
  Bytes expected(255);
  expected[0] = 1;
  CHECK(node.upload(index_bits, 0) == expected);
}

TEST_CASE("error status bits: expedited and segmented and block uploads return the same bytes [O2]") {
  for (const std::uint8_t size : {std::uint8_t{1}, std::uint8_t{4}, std::uint8_t{5}, std::uint8_t{40}}) {
    CAPTURE(unsigned{size});
    CO_EMCY_BITS bits{0, size, 1};
    EmcyNode node(with_bits(bits));
    node.set(hot);
    node.trace();
    node.raise_fault(co::event::Fault::heartbeat, 5);
    node.trace();
    Bytes expected(size + 2U);
    expected[0] = 0x04;
    expected[size] = 0x08;
    CHECK(node.upload(index_bits, 0) == expected);
#if USE_SDO_BLOCK
    CHECK(node.block_upload(index_bits, 0).data == expected);
#endif
  }
}

TEST_CASE("error status bits: each error of the stack has its bit while it is present [O2]") {
  using co::event::Fault;
  const std::pair<Fault, unsigned> all[] = {
    {Fault::overrun, CO_EMCY_BIT_OVERRUN},
    {Fault::collision, CO_EMCY_BIT_COLLISION},
    {Fault::passive, CO_EMCY_BIT_PASSIVE},
    {Fault::heartbeat, CO_EMCY_BIT_HEARTBEAT},
    {Fault::life_guard, CO_EMCY_BIT_LIFE_GUARD},
    {Fault::recovered, CO_EMCY_BIT_BUS_OFF},
    {Fault::pdo_short, CO_EMCY_BIT_PDO_SHORT},
    {Fault::pdo_long, CO_EMCY_BIT_PDO_LONG},
#if CO_MPDO_N > 0
    {Fault::pdo_unknown, CO_EMCY_BIT_PDO_UNKNOWN},
#endif
    {Fault::sync_length, CO_EMCY_BIT_SYNC_LENGTH},
    {Fault::pdo_timeout, CO_EMCY_BIT_PDO_TIMEOUT}
  };
  CO_EMCY_BITS bits{0, 1, 1};
  EmcyNode node(with_bits(bits));
  for (const auto& row : all) {
    const Fault fault = row.first;
    const unsigned bit = row.second;
    CAPTURE(bit);
    node.raise_fault(fault);
    node.trace();
    const Bytes expected{0, static_cast<std::uint8_t>((1U << bit) & 0xFFU),
                         static_cast<std::uint8_t>((1U << bit) >> 8U)};
    CHECK(node.upload(index_bits, 0) == expected);
    node.resolve_fault(fault);
    node.trace();
    CHECK(node.upload(index_bits, 0) == Bytes(3));
  }
}

TEST_CASE("error status bits: a fault that occurs twice keeps its bit until both have ended [O2]") {
  CO_EMCY_BITS bits{0, 1, 1};
  EmcyNode node(with_bits(bits));
  node.raise_fault(co::event::Fault::heartbeat, 5);
  node.raise_fault(co::event::Fault::heartbeat, 6);
  node.resolve_fault(co::event::Fault::heartbeat, 5);
  node.trace();
  CHECK(node.upload(index_bits, 0) == Bytes{0, 8, 0});
  node.resolve_fault(co::event::Fault::heartbeat, 6);
  node.trace();
  CHECK(node.upload(index_bits, 0) == Bytes{0, 0, 0});
}

TEST_CASE("error status bits: the network cannot write them with or without flag W [O2]") {
  for (const std::uint32_t flags : {std::uint32_t{CO_OBJ_____R_}, std::uint32_t{CO_OBJ____PRW}}) {
    CO_EMCY_BITS bits{0, 4, 0};
    EmcyNode node(with_bits(bits, flags));
    node.set(general);
    node.trace();
    node.ask("601#23002E0000000000", "581#80002E0002000106");
    node.ask("601#21002E0004000000", "581#80002E0002000106");
#if USE_SDO_BLOCK
    node.ask("601#C2002E0004000000", "581#80002E0002000106");
#endif
    node.ask("601#40002E0000000000", "581#43002E0001000000");
  }
}

TEST_CASE(
    "error status bits: reset communication keeps the errors of the application and reset node clears them [O2]") {
  CO_EMCY_BITS bits{0, 1, 1};
  EmcyNode node(with_bits(bits));
  node.set(current);
  node.raise_fault(co::event::Fault::heartbeat, 5);
  node.trace();
  node.rx("000#8201");
  node.trace();
  CHECK(node.upload(index_bits, 0) == Bytes{2, 0, 0});
  node.rx("000#8101");
  node.trace();
  CHECK(node.upload(index_bits, 0) == Bytes{0, 0, 0});
}

TEST_CASE("error status bits: without data SDO is refused and the errors work [O2] [D37]") {
  EmcyNode node(Setup().emergencies(errors_of_device()).with({CO_KEY(index_bits, 0, CO_OBJ____PR_), CO_TEMCY_BITS, 0}));
  node.set(current);
  node.trace();
  node.ask("601#40002E0000000000", "581#80002E0020000008");
}

TEST_CASE("error status bits: several objects show the same errors [O2]") {
  CO_EMCY_BITS bits{0, 1, 0};
  CO_EMCY_BITS wide{0, 2, 1};
  EmcyNode node(with_bits(bits).with({CO_KEY(0x2E01, 3, CO_OBJ_____R_), CO_TEMCY_BITS, &wide}));
  node.set(current);
  node.trace();
  CHECK(node.upload(index_bits, 0) == Bytes{2});
  CHECK(node.upload(0x2E01, 3) == Bytes{2, 0, 0, 0});
}

#if CO_TPDO_N > 1

struct MappedBits {
  explicit MappedBits(std::uint8_t size, std::uint8_t stack, std::uint8_t type = 255) : bits{0, size, stack} {
    PdoTable table;
    const auto length = static_cast<std::uint32_t>(8 * (size + (stack != 0 ? 2 : 0)));
    table.tpdo[0].on(0x40000181, type, {0x2E000000 | length});
    node = std::make_unique<PdoNode>(table, [&](Setup& setup) {
      setup.emergencies(errors_of_device()).with({CO_KEY(index_bits, 0, CO_OBJ____PR_), CO_TEMCY_BITS, &bits});
    });
    node->frames_per_call(3);
    node->start();
  }
  void set(std::uint8_t err) {
    node->call([&] { COEmcySet(&node->node.Emcy, err, nullptr); });
  }
  CO_EMCY_BITS bits;
  std::unique_ptr<PdoNode> node;
};

TEST_CASE("error status bits: a change sends the TPDO behind the EMCY message [O2]") {
  MappedBits device(4, 0);
  device.set(hot);
  device.node->tx({"081#0040090000000000", "181#04000000"});
  device.set(hot);
  device.node->silent();
  device.node->call([&] { COEmcyClr(&device.node->node.Emcy, hot); });
  device.node->tx({"081#0000000000000000", "181#00000000"});
}

TEST_CASE("error status bits: a string of 8 bytes is mapped and one of 9 is not [O2] [M5]") {
  MappedBits device(6, 1);
  device.set(no_disk);
  device.node->tx({"081#00FF810000000000", "181#1000000000000000"});
  CO_EMCY_BITS long_bits{0, 9, 0};
  PdoNode node({}, [&](Setup& setup) {
    setup.with({CO_KEY(index_bits, 0, CO_OBJ____PR_), CO_TEMCY_BITS, &long_bits});
  });
  CHECK(node.remap_tpdo(0, {0x2E000048}, 0x40000181) == CO_SDO_ERR_OBJ_MAP);
  CHECK(node.remap_tpdo(0, {0x2E000040}, 0x40000181) == CO_SDO_ERR_OBJ_MAP);
}

TEST_CASE("error status bits: an error of the stack sends the TPDO when it begins and when the last one ends [O2]") {
  MappedBits device(1, 1);
  PdoNode& node = *device.node;
  using co::event::Fault;
  const auto complete = [&](auto function) { node.call([&] { function(), co::event::run_deferred(node.node); }); };
  complete([&] { co::event::raise(node.node, Fault::heartbeat, 5); });
  node.tx({"081#3081110000050000", "181#000800"});
  complete([&] { co::event::raise(node.node, Fault::heartbeat, 6); });
  node.tx("081#3081110000060000");
  complete([&] { co::event::resolve(node.node, Fault::heartbeat, 6); });
  node.tx("081#0000110000060000");
  complete([&] { co::event::forget(node.node, Fault::heartbeat); });
  node.tx("181#000000");
}

TEST_CASE("error status bits: bus-off sends the TPDO before the node leaves Operational [O2]") {
  MappedBits device(1, 1);
  PdoNode& node = *device.node;
  node.call([&] { CONodeCanEvent(&node.node, CO_CAN_BUS_OFF); });
  node.tx("181#002000");
  CHECK(node.mode() == CO_PREOP);
}

TEST_CASE("error status bits: COEmcyReset sends the TPDO once [O2]") {
  MappedBits device(1, 0);
  device.set(general);
  device.set(hot);
  device.node->trace();
  device.node->call([&] { COEmcyReset(&device.node->node.Emcy, 1); });
  device.node->tx("181#00");
  device.node->call([&] { COEmcyReset(&device.node->node.Emcy, 1); });
  device.node->silent();
}

TEST_CASE("error status bits: they cannot be mapped into an RPDO [O2] [M5]") {
#if CO_RPDO_N > 0
  CO_EMCY_BITS bits{0, 4, 0};
  PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(index_bits, 0, CO_OBJ____PRW), CO_TEMCY_BITS, &bits}); });
  CHECK(node.remap_rpdo(0, {0x2E000020}, 0x201) == CO_SDO_ERR_OBJ_MAP);
#endif
}

#endif

}  // namespace

#endif
