// SPDX-License-Identifier: Apache-2.0
// 1021h and 1022h, the device's own EDS in flash; CO_TDOMAIN_RO at any index. [301:7.5.2.24, 7.5.2.25]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

constexpr char plain[] = "[FileInfo]\nFileName=pump.eds\n";
// The zlib stream of the five bytes "[eds]".
constexpr std::uint8_t compressed[] = {0x78, 0x9C, 0x8B, 0x4E, 0x4D, 0x29, 0x8E, 0x05, 0x00, 0x06, 0x2B, 0x01, 0xF9};

const std::uint8_t* bytes(const char* text) { return reinterpret_cast<const std::uint8_t*>(text); }

struct Device {
  Device(const std::uint8_t* start, std::uint32_t size, std::uint16_t format, std::uint32_t flags = CO_OBJ_____R_)
      : eds{0, size, start},
        node(Setup()
                 .with({CO_KEY(0x1021, 0, flags), CO_TDOMAIN_RO, &eds})
                 .with({CO_KEY(0x1022, 0, CO_OBJ_D___R_), CO_TUNSIGNED16, format})) {}
  CO_OBJ_DOM_RO eds;
  Fixture node;
};

TEST_CASE("1021h: a plain EDS is read in segments [O3]") {
  Device device(bytes(plain), 9, CO_EDS_FORMAT_PLAIN);
  device.node.ask("601#4022100000000000", "581#4B22100000000000");
  device.node.ask("601#4021100000000000", "581#4121100009000000");
  device.node.ask("601#6000000000000000", "581#005B46696C65496E");
  device.node.ask("601#7000000000000000", "581#1B666F0000000000");
}

TEST_CASE("1021h: a compressed EDS is served as it was generated [O3]") {
  Device device(compressed, sizeof compressed, CO_EDS_FORMAT_ZLIB);
  device.node.ask("601#4022100000000000", "581#4B22100080000000");
  CHECK(device.node.upload(0x1021, 0) == Bytes(std::begin(compressed), std::end(compressed)));
}

TEST_CASE("1021h: files of every length are read by every kind of transfer [O3]") {
  Bytes file(2000);
  for (std::size_t n = 0; n < file.size(); ++n) {
    file[n] = static_cast<std::uint8_t>(n * 7 + n / 256);
  }
  for (const std::uint32_t size : {1U, 4U, 5U, 7U, 8U, 889U, 890U, 2000U}) {
    CAPTURE(size);
    const Bytes expected(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
    Device device(file.data(), size, CO_EDS_FORMAT_PLAIN);
    CHECK(device.node.upload(0x1021, 0) == expected);
#if USE_SDO_BLOCK
    CHECK(device.node.block_upload(0x1021, 0).data == expected);
    CHECK(device.node.block_upload(0x1021, 0, {true, true, {1, 3, 127}}).data == expected);
#endif
  }
}

#if USE_SDO_BLOCK
TEST_CASE("1021h: lost segments of a block upload are repeated [O3]") {
  const Bytes expected(bytes(plain), bytes(plain) + sizeof plain - 1);
  for (unsigned lost = 1; lost < 6; ++lost) {
    CAPTURE(lost);
    Device device(expected.data(), static_cast<std::uint32_t>(expected.size()), CO_EDS_FORMAT_PLAIN);
    BlockOptions options;
    options.lost_answers = {lost};
    const BlockResult result = device.node.block_upload(0x1021, 0, options);
    CHECK((result.abort != 0 || result.data == expected));
  }
}
#endif

TEST_CASE("1021h: it cannot be written by any transfer with or without flag W [O3]") {
  const std::string before(plain);
  for (const std::uint32_t flags : {std::uint32_t{CO_OBJ_____R_}, std::uint32_t{CO_OBJ____PRW}}) {
    Device device(bytes(plain), 9, CO_EDS_FORMAT_PLAIN, flags);
    device.node.ask("601#2321100001020304", "581#8021100002000106");
    device.node.ask("601#2121100009000000", "581#8021100002000106");
#if USE_SDO_BLOCK
    device.node.ask("601#C221100009000000", "581#8021100002000106");
#endif
    std::uint8_t byte = 0;
    CHECK(COObjWrBufStart(device.node.find(0x1021, 0), &device.node.node, &byte, 1) == CO_ERR_OBJ_ACC);
  }
  CHECK(before == plain);
}

TEST_CASE("1021h: a write of the format is refused [O3]") {
  Device device(bytes(plain), 9, CO_EDS_FORMAT_PLAIN);
  device.node.ask("601#2B22100080000000", "581#8022100002000106");
}

TEST_CASE("1021h: without memory the upload is empty and without data it is refused [O3]") {
  Device missing(nullptr, 100, CO_EDS_FORMAT_PLAIN);
  CHECK(missing.node.upload(0x1021, 0).empty());
  Fixture null(Setup().with({CO_KEY(0x1021, 0, CO_OBJ_____R_), CO_TDOMAIN_RO, 0}));
  null.ask("601#4021100000000000", "581#8021100020000008");
}

TEST_CASE("1021h: the application reads the bytes while a client reads them [O3]") {
  Device device(bytes(plain), 20, CO_EDS_FORMAT_PLAIN);
  device.node.ask("601#4021100000000000", "581#4121100014000000");
  device.node.ask("601#6000000000000000", "581#005B46696C65496E");
  std::uint8_t first[3] = {};
  CHECK(COObjRdBufStart(device.node.find(0x1021, 0), &device.node.node, first, 3) == CO_ERR_NONE);
  CHECK(std::string(first, first + 3) == "[Fi");
  device.node.ask("601#7000000000000000", "581#10666F5D0A46696C");
  device.node.ask("601#6000000000000000", "581#03654E616D653D00");
}

#if CO_TPDO_N > 0
TEST_CASE("1021h: a constant domain of up to 8 bytes can be mapped into a TPDO and no RPDO [O3] [M5]") {
  CO_OBJ_DOM_RO eds{0, 8, bytes(plain)};
  PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(0x2E00, 0, CO_OBJ____PRW), CO_TDOMAIN_RO, &eds}); });
  CHECK(node.remap_tpdo(0, {0x2E000040}, 0x40000181) == 0);
  CHECK(node.remap_rpdo(0, {0x2E000040}, 0x201) == CO_SDO_ERR_OBJ_MAP);
  node.start();
  node.trigger(0);
  node.tx("181#5B46696C65496E66");
}
#endif

}  // namespace
