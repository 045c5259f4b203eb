// SPDX-License-Identifier: Apache-2.0
#include "sdo_client_fixture.hpp"

#if USE_CSDO

#include <algorithm>
#include <exception>

namespace test {
namespace {

constexpr std::size_t guard = 16;
constexpr std::uint8_t guard_byte = 0xA5;
constexpr std::uint8_t blank = 0xEE;

CO_OBJ entry(unsigned client, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
  return {CO_KEY(0x1280U + client, sub, flags), type, data};
}

Bytes guarded(const Bytes& data) {
  Bytes memory(data.size() + 2 * guard, guard_byte);
  std::copy(data.begin(), data.end(), memory.begin() + guard);
  return memory;
}

}  // namespace

Bytes counted(std::size_t size, unsigned first) {
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(first++);
  }
  return bytes;
}

Setup SdoClient::with_entries(Setup setup) {
  for (unsigned n = 0; n < CO_CSDO_N && n < 3; ++n) {
    setup.with(test::entry(n, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 3));
    setup.with(test::entry(n, 1, CO_OBJ_____RW, CO_TSDO_ID, &entry[n].tx));
    setup.with(test::entry(n, 2, CO_OBJ_____RW, CO_TSDO_ID, &entry[n].rx));
    setup.with(test::entry(n, 3, CO_OBJ_____RW, CO_TUNSIGNED8, &entry[n].node_id));
  }
  return setup;
}

SdoClient::SdoClient(Setup setup, const ClientEntries& entries)
    : ClientEntries(entries), Fixture(with_entries(std::move(setup))) {
  frames_per_call(1 + CO_SDO_BLOCK_PACE);
}

SdoClient::~SdoClient() {
  if (std::uncaught_exceptions() == 0) {
    finish();
  }
  if (node.Nmt.Mode != CO_INVALID) {
    CONodeStop(&node);  // No callback may be called after the members of this class are destroyed.
  }
}

// Checks that all frames and callbacks were checked, and that each open transfer can be cancelled with a callback.
void SdoClient::finish() {
  const std::vector<std::string> left = frames();
  CHECK_MESSAGE(left.empty(), "left unread: ", left.size(), " frames, the first is ", left.empty() ? "" : left[0]);
  CHECK_MESSAGE(ends.empty(), "callbacks that the test has not checked: ", ends.size());
  on_end = nullptr;
  can.accept_all();
  for (unsigned n = 0; n < CO_CSDO_N; ++n) {
    if (requests_[n].open) {
      CHECK(cancel(n) == CO_ERR_NONE);
      CHECK_FALSE(requests_[n].open);
    }
  }
  loop();
  frames();
}

void SdoClient::run(const std::function<void()>& api, Where at) {
  if (in_callback_ > 0) {
    api();
  } else {
    call(api, at);
  }
}

CO_ERR SdoClient::begin(Request request, unsigned client, const std::function<CO_ERR(std::uint8_t*)>& api, Where at) {
  Request before = std::move(requests_[client]);  // a move keeps the address of the buffer
  requests_[client] = std::move(request);
  requests_[client].open = true;
  CO_ERR err = CO_ERR_NONE;
  run([&] { err = api(requests_[client].memory.data() + guard); }, at);
  if (err != CO_ERR_NONE) {
    requests_[client] = std::move(before);
  }
  return err;
}

CO_ERR SdoClient::try_upload(std::uint16_t index, std::uint8_t sub, std::uint32_t size, std::uint32_t timeout,
                             unsigned client, Where at) {
  Request request;
  request.key = CO_DEV(index, sub);
  request.memory = guarded(Bytes(size, blank));
  const auto api = [&](std::uint8_t* buffer) {
    return COCSdoRequestUpload(csdo(client), CO_DEV(index, sub), buffer, size, on_callback, timeout);
  };
  return begin(std::move(request), client, api, at);
}

CO_ERR SdoClient::try_download(std::uint16_t index, std::uint8_t sub, const Bytes& data, std::uint32_t timeout,
                               unsigned client, Where at) {
  Request request;
  request.key = CO_DEV(index, sub);
  request.memory = guarded(data);
  request.sent = data;
  const auto size = static_cast<std::uint32_t>(data.size());
  const auto api = [&](std::uint8_t* buffer) {
    return COCSdoRequestDownload(csdo(client), CO_DEV(index, sub), buffer, size, on_callback, timeout);
  };
  return begin(std::move(request), client, api, at);
}

void SdoClient::start_upload(std::uint16_t index, std::uint8_t sub, std::uint32_t size, std::uint32_t timeout,
                             unsigned client, Where at) {
  if (try_upload(index, sub, size, timeout, client, at) != CO_ERR_NONE) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "upload refused");
  }
}

void SdoClient::start_download(std::uint16_t index, std::uint8_t sub, const Bytes& data, std::uint32_t timeout,
                               unsigned client, Where at) {
  if (try_download(index, sub, data, timeout, client, at) != CO_ERR_NONE) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "download refused");
  }
}

CO_ERR SdoClient::cancel(unsigned client, Where at) {
  CO_ERR err = CO_ERR_NONE;
  run([&] { err = COCSdoCancel(csdo(client)); }, at);
  return err;
}

void SdoClient::on_callback(CO_CSDO* csdo, std::uint16_t index, std::uint8_t sub, std::uint32_t code) {
  const OutsideStack outside;
  auto* const fixture = static_cast<Fixture*>(CONodeGetUser(csdo->Node));
  const auto client = static_cast<unsigned>(csdo - csdo->Node->CSdo);
  static_cast<SdoClient*>(fixture)->store_end(client, index, sub, code);
}

void SdoClient::check_memory_of(const Request& request) {
  const auto is_guard = [](std::uint8_t byte) { return byte == guard_byte; };
  const Bytes& memory = request.memory;
  CHECK_MESSAGE(std::all_of(memory.begin(), memory.begin() + guard, is_guard), "written in front of the buffer");
  CHECK_MESSAGE(std::all_of(memory.end() - guard, memory.end(), is_guard), "written behind the buffer");
  const bool same =
      request.sent.empty() || std::equal(request.sent.begin(), request.sent.end(), memory.begin() + guard);
  CHECK_MESSAGE(same, "the buffer of a download has changed");
}

void SdoClient::store_end(unsigned client, std::uint16_t index, std::uint8_t sub, std::uint32_t code) {
  Request request = std::move(requests_[client]);
  requests_[client] = Request{};
  CHECK_MESSAGE(request.open, "a callback without a request");
  CHECK(request.key == CO_DEV(index, sub));
  CHECK(node.CSdo[client].State != CO_CSDO_STATE_BUSY);
  check_memory_of(request);
  const std::size_t size = request.memory.size() - 2 * guard;
  const std::uint32_t bytes = num(client);
  CHECK(bytes <= size);
  const auto first = request.memory.begin() + guard;
  const Bytes data(first, first + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes, size)));
  const ClientEnd end{client, index, sub, code, bytes, total(client), data};
  ends.push_back(end);
  if (const auto hook = on_end) {  // a copy: the function may replace on_end
    ++in_callback_;
    hook(end);
    --in_callback_;
  }
}

bool SdoClient::is_watched(unsigned client) const {
  for (const CO_TMR_MEM* timer = node.Tmr.First; timer != nullptr; timer = timer->Next) {
    if (timer == &node.CSdo[client].Tmr) return true;
  }
  return false;
}

void SdoClient::goes_on(unsigned client, Where at) {
  if (!ends.empty()) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "ended with code " << ends.front().code);
    ends.clear();
  } else if (!is_busy(client)) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "not busy");
  }
}

ClientEnd SdoClient::ended(std::uint32_t code, unsigned client, Where at) {
  const auto of_client = [=](const ClientEnd& end) { return end.client == client; };
  const auto number = std::count_if(ends.begin(), ends.end(), of_client);
  if (number != 1) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "expected one callback, there were " << number);
  }
  const auto found = std::find_if(ends.begin(), ends.end(), of_client);
  const ClientEnd end = found == ends.end() ? ClientEnd{} : *found;
  ends.erase(std::remove_if(ends.begin(), ends.end(), of_client), ends.end());
  if (end.code != code) {
    ADD_FAIL_CHECK_AT(at.file, at.line, std::hex << "expected code " << code << ", was " << end.code);
  }
  if (!requests_[client].open && (is_busy(client) || is_watched(client))) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "still busy, or its timer is armed");
  }
  return end;
}

ClientEnd SdoClient::has_read(const Bytes& data, unsigned client, Where at) {
  const ClientEnd end = ended(0, client, at);
  if (end.data != data) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "other bytes: " << end.data.size() << " instead of " << data.size());
  }
  return end;
}

ClientEnd SdoClient::has_written(unsigned client, Where at) {
  const ClientEnd end = ended(0, client, at);
  if (end.num != end.total) {
    ADD_FAIL_CHECK_AT(at.file, at.line, end.num << " bytes written of " << end.total);
  }
  return end;
}

}  // namespace test

#endif
