// SPDX-License-Identifier: Apache-2.0
#include "logged_stream.hpp"

#include <algorithm>
#include <cstdio>

#include "heap_watch.hpp"

namespace test {
namespace {

LoggedStream& of(CO_OBJ* obj) { return *static_cast<LoggedStream*>(obj->Data); }

CO_ERR result(const std::function<CO_ERR(CO_OBJ*, CO_NODE*)>& function, CO_OBJ* obj, CO_NODE* node) {
  return function ? function(obj, node) : CO_ERR_NONE;
}

std::uint32_t size(CO_OBJ* obj, CO_NODE*, std::uint32_t width) {
  const LoggedStream& stream = of(obj);
  if (width != 0) {
    return std::min(width, LoggedStream::capacity);
  }
  const bool known = stream.knows_size || stream.at_end;
  return known ? static_cast<std::uint32_t>(stream.data.size()) : CO_OBJ_SIZE_UNKNOWN;
}

CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  const OutsideStack outside;
  LoggedStream& stream = of(obj);
  stream.log.push_back("read " + std::to_string(size));
  stream.position = std::min(stream.position, static_cast<std::uint32_t>(stream.data.size()));
  const std::uint32_t filled = std::min(size, static_cast<std::uint32_t>(stream.data.size()) - stream.position);
  std::copy_n(stream.data.data() + stream.position, filled, static_cast<std::uint8_t*>(buffer));
  stream.position += filled;
  stream.at_end = stream.at_end || filled < size;
  return result(size == 0 ? stream.on_open : stream.on_piece, obj, node);
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  const OutsideStack outside;
  LoggedStream& stream = of(obj);
  stream.log.push_back("write " + std::to_string(size));
  const auto* const bytes = static_cast<const std::uint8_t*>(buffer);
  stream.data.resize(stream.position);
  stream.data.insert(stream.data.end(), bytes, bytes + size);
  stream.position += size;
  return result(size == 0 ? stream.on_open : stream.on_piece, obj, node);
}

CO_ERR reset(CO_OBJ* obj, CO_NODE* node, std::uint32_t position) {
  const OutsideStack outside;
  LoggedStream& stream = of(obj);
  stream.log.push_back("reset " + std::to_string(position));
  stream.position = position;
  return result(stream.on_reset, obj, node);
}

#if USE_OBJ_EX
std::string direction(CO_OBJ_TRANSFER transfer) { return transfer == CO_OBJ_UPLOAD ? "up " : "down "; }

CO_ERR begin(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER transfer, std::uint32_t size) {
  const OutsideStack outside;
  LoggedStream& stream = of(obj);
  const std::string length = size == CO_OBJ_SIZE_UNKNOWN ? "?" : std::to_string(size);
  stream.log.push_back("begin " + direction(transfer) + length);
  stream.at_end = false;
  return result(stream.on_begin, obj, node);
}

CO_ERR end(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER transfer, std::uint32_t abort) {
  const OutsideStack outside;
  LoggedStream& stream = of(obj);
  char code[9];
  std::snprintf(code, sizeof code, abort == 0 ? "%u" : "%08X", static_cast<unsigned>(abort));
  stream.log.push_back("end " + direction(transfer) + code);
  return result(stream.on_end, obj, node);
}

const CO_OBJ_TYPE_EX extended_type = {{size, nullptr, read, write, COObjTypeExReset}, reset, begin, end};
#endif
const CO_OBJ_TYPE plain_type = {size, nullptr, read, write, reset};
const CO_OBJ_TYPE value_type = {size, nullptr, read, write, nullptr};

}  // namespace

#if USE_OBJ_EX
CO_OBJ LoggedStream::extended(std::uint16_t index) {
  return {CO_KEY(index, 0, CO_OBJ_____RW), &extended_type.Type, CO_DATA(this)};
}
#endif

CO_OBJ LoggedStream::plain(std::uint16_t index) {
  return {CO_KEY(index, 0, CO_OBJ_____RW), &plain_type, CO_DATA(this)};
}

CO_OBJ LoggedStream::value(std::uint16_t index) {
  return {CO_KEY(index, 0, CO_OBJ_____RW), &value_type, CO_DATA(this)};
}

Log LoggedStream::take_log() {
  Log taken;
  taken.swap(log);
  return taken;
}

}  // namespace test
