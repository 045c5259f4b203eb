// SPDX-License-Identifier: Apache-2.0
// SDO client whose server is the same node: streams, including those with Begin and End (CO_OBJ_TYPE_EX).
#include <cstring>

#include "support/sdo_client_fixture.hpp"

#if USE_CSDO && USE_CSDO_OWN

namespace {

using namespace test;

// The object at 3000h: logged calls of its type functions, and their results.
struct Image {
  std::vector<std::string> calls;
  Bytes data;
  std::uint32_t position = 0;
  bool knows_size = true;
  std::uint32_t read_total = 0;
  bool at_end = false;
  CO_ERR begin = CO_ERR_NONE;
  CO_ERR end = CO_ERR_NONE;
  CO_ERR access = CO_ERR_NONE;
  std::uint32_t user_abort = 0;
  std::function<void(CO_NODE*)> on_access;

  unsigned count(const std::string& call) const {
    return static_cast<unsigned>(std::count(calls.begin(), calls.end(), call));
  }
} image;

uint32_t image_size(CO_OBJ*, CO_NODE*, uint32_t width) {
  if (width != 0) return width;
  if (image.knows_size || image.at_end) return static_cast<uint32_t>(image.data.size());
  return CO_OBJ_SIZE_UNKNOWN;
}

CO_ERR image_access(CO_OBJ* obj, CO_NODE* node) {
  if (image.on_access) image.on_access(node);
  if (image.user_abort != 0) COObjTypeUserSDOAbort(obj, node, image.user_abort);
  return image.access;
}

CO_ERR image_read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const OutsideStack outside;
  if (size == 0) return CO_ERR_NONE;
  const std::size_t left = image.data.size() - image.position;
  const std::size_t n = std::min<std::size_t>(size, left);
  if (n > 0) std::memcpy(buffer, image.data.data() + image.position, n);
  image.position += static_cast<std::uint32_t>(n);
  image.at_end = n < size;
  return image_access(obj, node);
}

CO_ERR image_write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const OutsideStack outside;
  if (size == 0) return CO_ERR_NONE;
  const auto* bytes = static_cast<const std::uint8_t*>(buffer);
  image.data.resize(image.position);
  image.data.insert(image.data.end(), bytes, bytes + size);
  image.position += size;
  return image_access(obj, node);
}

CO_ERR image_seek(CO_OBJ*, CO_NODE*, uint32_t position) {
  const OutsideStack outside;
  image.position = position;
  return CO_ERR_NONE;
}

CO_ERR image_begin(CO_OBJ*, CO_NODE*, CO_OBJ_TRANSFER transfer, uint32_t size) {
  const OutsideStack outside;
  image.calls.push_back(std::string(transfer == CO_OBJ_UPLOAD ? "begin upload " : "begin download ") +
                        (size == CO_OBJ_SIZE_UNKNOWN ? "?" : std::to_string(size)));
  return image.begin;
}

CO_ERR image_end(CO_OBJ*, CO_NODE*, CO_OBJ_TRANSFER transfer, uint32_t abort) {
  const OutsideStack outside;
  char code[16];
  std::snprintf(code, sizeof code, "%08X", static_cast<unsigned>(abort));
  image.calls.push_back(std::string(transfer == CO_OBJ_UPLOAD ? "end upload " : "end download ") + code);
  return image.end;
}

const CO_OBJ_TYPE_EX image_type = {
    {image_size, nullptr, image_read, image_write, COObjTypeExReset}, image_seek, image_begin, image_end};

class Local : public SdoClient {
 public:
  Local()
      : SdoClient(Setup().only_small().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &image_type.Type, 0}), local_entries()) {
    image = Image{};
    image.data = counted(40);
  }
  ClientEnd settle() {
    loop();
    after(1ms);
    silent();
    CHECK(ends.size() == 1);
    const ClientEnd end = ends.empty() ? ClientEnd{} : ends.front();
    ends.clear();
    return end;
  }
  ClientEnd read(std::uint32_t size) {
    start_upload(0x3000, 0, size);
    return settle();
  }
  ClientEnd write(const Bytes& data) {
    start_download(0x3000, 0, data);
    return settle();
  }
};

using Calls = std::vector<std::string>;

TEST_CASE("SDO client, own node: Begin and End of a CO_OBJ_TYPE_EX are called for a read") {
  for (const std::size_t length : {1U, 4U, 7U, 29U, 889U, 2000U}) {
    CAPTURE(length);
    Local node;
    image.data = counted(length);
    const ClientEnd end = node.read(2000);
    CHECK(end.code == 0);
    CHECK(end.data == counted(length));
    CHECK(image.calls == Calls{"begin upload " + std::to_string(length), "end upload 00000000"});
  }
}

TEST_CASE("SDO client, own node: Begin and End of a CO_OBJ_TYPE_EX are called for a write") {
  for (const std::size_t length : {1U, 4U, 7U, 29U, 889U, 2000U}) {
    CAPTURE(length);
    Local node;
    CHECK(node.write(counted(length, 9)).code == 0);
    CHECK(image.data == counted(length, 9));
    CHECK(image.calls == Calls{"begin download " + std::to_string(length), "end download 00000000"});
  }
}

TEST_CASE("SDO client, own node: a stream of unknown size is read to its end") {
  for (const std::size_t length : {0U, 1U, 6U, 7U, 8U, 40U, 889U, 1000U}) {
    for (const std::uint32_t more : {0U, 1U, 500U}) {
      CAPTURE(length);
      CAPTURE(more);
      const auto size = static_cast<std::uint32_t>(length) + more;
      if (size == 0) continue;
      Local node;
      image.knows_size = false;
      image.data = counted(length);
      const ClientEnd end = node.read(size);
      CHECK(end.code == 0);
      CHECK(end.data == counted(length));
      CHECK(image.calls == Calls{"begin upload ?", "end upload 00000000"});
    }
  }
}

TEST_CASE("SDO client, own node: a stream larger than the buffer ends with 0504 0005h, which is passed to End") {
  Local node;
  image.knows_size = false;
  CHECK(node.read(39).code == CO_SDO_ERR_MEM);
  CHECK(image.calls == Calls{"begin upload ?", "end upload 05040005"});
}

TEST_CASE("SDO client, own node: a stream larger than the buffer has one End for each Begin") {
  Local node;
  CHECK(node.read(39).code == CO_SDO_ERR_MEM);
  CHECK(image.count("begin upload 40") == image.count("end upload 05040005"));
}

TEST_CASE("SDO client, own node: a Begin that fails ends the transfer without End") {
  Local node;
  image.begin = CO_ERR_OBJ_STATE;
  CHECK(node.read(40).code == CO_SDO_ERR_TOS_STATE);
  CHECK(image.calls == Calls{"begin upload 40"});
  image.calls.clear();
  CHECK(node.write({1, 2, 3}).code == CO_SDO_ERR_TOS_STATE);
  CHECK(image.calls == Calls{"begin download 3"});
  CHECK(image.data == counted(40));
}

TEST_CASE("SDO client, own node: the error of a read or write is its abort code, and End is called") {
  Local node;
  image.access = CO_ERR_OBJ_NO_DATA;
  CHECK(node.read(40).code == CO_SDO_ERR_NO_DATA);
  CHECK(image.calls == Calls{"begin upload 40", "end upload 08000024"});
  image.calls.clear();
  image.access = CO_ERR_OBJ_RANGE;
  CHECK(node.write(counted(3)).code == CO_SDO_ERR_RANGE);
  CHECK(image.calls == Calls{"begin download 3", "end download 06090030"});
}

TEST_CASE("SDO client, own node: COObjTypeUserSDOAbort sets the abort code as over the bus") {
  Local node;
  image.access = CO_ERR_TYPE_WR;
  image.user_abort = 0x06090031;
  CHECK(node.write(counted(3)).code == 0x06090031);
  CHECK(image.calls.back() == "end download 06090031");
  CHECK(node.read(40).code == 0x06090031);
  image.user_abort = 0;
  CHECK(node.write(counted(3)).code == CO_SDO_ERR_TOS);
}

TEST_CASE("SDO client, own node: the error of End is the result of a download, not of an upload") {
  Local node;
  image.end = CO_ERR_OBJ_INCOMPATIBLE;
  CHECK(node.write(counted(3)).code == CO_SDO_ERR_PARA_INCOMP);
  CHECK(node.read(40).code == 0);
}

TEST_CASE("SDO client, own node: a stream that a remote client has open is refused with 0800 0022h") {
  Local node;
  node.ask("601#4000300000000000", "581#4100300028000000");
  CHECK(node.read(40).code == CO_SDO_ERR_TOS_STATE);
  CHECK(node.write({1, 2, 3}).code == CO_SDO_ERR_TOS_STATE);
  CHECK(image.calls == Calls{"begin upload 40"});
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.rx("601#8000300000000405");
  CHECK(node.read(40).data == counted(40));
}

TEST_CASE("SDO client, own node: a domain open in a remote transfer is refused with 0800 0022h; that one continues") {
  for (const bool upload : {true, false}) {
    CAPTURE(upload);
    Local node;
    node.ask(upload ? "601#4000210F00000000" : "601#2100210F0F000000",
             upload ? "581#4100210F0F000000" : "581#6000210F00000000");
    node.start_upload(0x2100, 15, 15);
    CHECK(node.settle().code == CO_SDO_ERR_TOS_STATE);
    node.start_download(0x2100, 15, counted(15, 90));
    CHECK(node.settle().code == CO_SDO_ERR_TOS_STATE);
    node.ask(upload ? "601#6000000000000000" : "601#0001020304050607",
             upload ? "581#0001020304050607" : "581#2000000000000000");
  }
}

TEST_CASE("SDO client, own node: a type function called for a remote client may start a local transfer [Q9]") {
  Local node;
  CO_ERR err = CO_ERR_BAD_ARG;
  image.on_access = [&](CO_NODE*) {
    if (err != CO_ERR_NONE)
      err = COCSdoRequestUpload(
          node.csdo(), CO_DEV(0x2001, 0), image.data.data(), 1,
          [](CO_CSDO*, std::uint16_t, std::uint8_t, std::uint32_t code) {
            const OutsideStack outside;
            image.calls.push_back("callback " + std::to_string(code));
          },
          0);
  };
  node.rx("601#2F00300042000000");
  node.tx("581#6000300000000000");
  CHECK(err == CO_ERR_NONE);
  node.loop();
  node.after(1ms);
  CHECK(image.calls == Calls{"begin download 1", "end download 00000000", "callback 0"});
  CHECK(image.data == Bytes{0x11});
}

TEST_CASE("SDO client, own node: a reset that a type function requests follows the access and its callback [Q9]") {
  for (const CO_NMT_RESET type : {CO_RESET_NODE, CO_RESET_COM}) {
    Local node;
    image.on_access = [=](CO_NODE* n) { CONmtReset(&n->Nmt, type); };
    node.start_upload(0x3000, 0, 40);
    node.loop();
    node.after(1ms);
    node.tx("701#00");
    node.has_read(counted(40));
    CHECK(image.calls == Calls{"begin upload 40", "end upload 00000000"});
    CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
  }
}

TEST_CASE("SDO client, own node: COObjTypeUserSDOAbort between two accesses has no effect") {
  Local node;
  CHECK(node.read(40).code == 0);
  node.call([&] { COObjTypeUserSDOAbort(node.find(0x3000, 0), &node.node, 0x06090031); });
  image.access = CO_ERR_OBJ_NO_DATA;
  CHECK(node.read(40).code == CO_SDO_ERR_NO_DATA);
  node.ask("601#2F00300001000000", "581#8000300024000008");
}

TEST_CASE("SDO client, own node: a type function that stops SDO during the access causes one callback and one End") {
  for (const CO_MODE mode : {CO_STOP, CO_INVALID}) {
    CAPTURE(mode);
    Local node;
    image.on_access = [=](CO_NODE* n) {
      if (mode == CO_STOP) CONmtSetMode(&n->Nmt, CO_STOP);
      if (mode == CO_INVALID) CONodeStop(n);
    };
    node.start_upload(0x3000, 0, 40);
    node.loop();
    node.after(1ms);
    node.silent();
    CHECK(node.ends.size() == 1);
    node.ends.clear();
    CHECK(image.calls.size() == 2);
    CHECK_FALSE(node.is_busy());
  }
}

}  // namespace

#endif
