// SPDX-License-Identifier: Apache-2.0
// Fuzzes the messages of socketcand, to a client and to a server, with any bytes: every frame is valid, is the same
// when it is written and read again, and does not depend on the pieces in which the bytes arrive.
#include "bus/socketcand.hpp"

#include <cstring>
#include <string>
#include <vector>

#include "fuzz/fuzz.hpp"

namespace {

using namespace lexican::host_bus;
using Kind = SocketcandMessage::Kind;

bool is_same(const CO_IF_FRM& a, const CO_IF_FRM& b) {
  return a.Identifier == b.Identifier && a.DLC == b.DLC && std::memcmp(a.Data, b.Data, sizeof a.Data) == 0;
}

/// Returns the only message of a text.
SocketcandMessage read_again(SocketcandInput& input, const std::string& text) {
  fuzz::require(input.append(text) == text.size(), "a message has space");
  const std::optional<std::string_view> found = input.next();
  fuzz::require(found.has_value(), "a message that is written is found");
  return parse_socketcand(*found);
}

void check(const SocketcandMessage& message) {
  const CO_IF_FRM& frame = message.entry.frame;
  if (message.kind != Kind::frame && message.kind != Kind::send) {
    return;
  }
  const std::uint32_t id = frame.Identifier;
  fuzz::require(frame.DLC <= 8, "a frame has at most 8 bytes");
  fuzz::require((id & (CO_IF_FRM_EXT | CO_IF_FRM_ERROR)) != 0 || (id & CO_IF_FRM_ID) <= 0x7FF, "11 bits or a flag");
  fuzz::require((id & CO_IF_FRM_ERROR) == 0 || message.kind == Kind::frame, "clients send no error frame");
  if ((id & (CO_IF_FRM_RTR | CO_IF_FRM_ERROR)) != 0) {
    return;
  }
  SocketcandInput input;
  const SocketcandMessage sent = read_again(input, to_socketcand_send(frame));
  fuzz::require(sent.kind == Kind::send && is_same(sent.entry.frame, frame), "a frame to send is read as it was");
  const SocketcandMessage received = read_again(input, to_socketcand_frame(message.entry));
  fuzz::require(
      received.kind == Kind::frame && received.entry.time == message.entry.time && is_same(received.entry.frame, frame),
      "a received frame is read as it was");
}

/// Returns the messages until the end of the bytes, or until there are too many bytes without one. \a sizes: of the
/// pieces, in turn.
std::vector<std::string> messages_of(std::string_view bytes, const std::vector<std::size_t>& sizes) {
  std::vector<std::string> messages;
  SocketcandInput input;
  for (std::size_t n = 0; !bytes.empty() && !input.is_full(); ++n) {
    const std::size_t size = input.append(bytes.substr(0, sizes[n % sizes.size()]));
    fuzz::require(size != 0, "memory that is not full has space");
    bytes.remove_prefix(size);
    while (const std::optional<std::string_view> text = input.next()) {
      messages.emplace_back(*text);
    }
  }
  messages.emplace_back(input.is_full() ? "full" : "");
  return messages;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  const std::size_t first = 1 + input.below(16);
  const std::size_t second = 1 + input.below(256);
  const std::string filling(17 * input.below(256), ' ');  // up to the limit of a message
  const std::size_t header = size < 3 ? size : 3;
  const std::string bytes = filling + std::string(data + header, data + size);
  const std::vector<std::string> messages = messages_of(bytes, {SocketcandInput::max_size});
  fuzz::require(messages == messages_of(bytes, {first, second}), "pieces have the messages of the whole");
  for (const std::string& text : messages) {
    check(parse_socketcand(text));
  }
  return 0;
}
