// SPDX-License-Identifier: Apache-2.0
// Object types of a recorder, except that of its plot.
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "extra/recorder/recorder.hpp"

#if USE_RECORDER

#include <stddef.h>

namespace co::recorder_objects {
namespace {

// Member of CO_RECORDER_CONFIG that an entry contains.
struct Member {
  uint8_t offset;
  uint8_t bytes;  // 0: no member
};

constexpr Member no_member = {0, 0};

constexpr Member configured[] = {
    no_member,
    {offsetof(CO_RECORDER_CONFIG, Size), sizeof(CO_RECORDER_CONFIG::Size)},
    {offsetof(CO_RECORDER_CONFIG, Axis), sizeof(CO_RECORDER_CONFIG::Axis)},
    no_member,  // the name
    {offsetof(CO_RECORDER_CONFIG, Colour), sizeof(CO_RECORDER_CONFIG::Colour)},
    {offsetof(CO_RECORDER_CONFIG, Map), sizeof(CO_RECORDER_CONFIG::Map)},
    {offsetof(CO_RECORDER_CONFIG, Format), sizeof(CO_RECORDER_CONFIG::Format)},
    {offsetof(CO_RECORDER_CONFIG, Trigger), sizeof(CO_RECORDER_CONFIG::Trigger)},
    {offsetof(CO_RECORDER_CONFIG, Threshold), sizeof(CO_RECORDER_CONFIG::Threshold)},
    {offsetof(CO_RECORDER_CONFIG, PreTrigger), sizeof(CO_RECORDER_CONFIG::PreTrigger)},
    {offsetof(CO_RECORDER_CONFIG, Period), sizeof(CO_RECORDER_CONFIG::Period)},
};

constexpr uint8_t sub_held = 1;
constexpr uint8_t sub_trigger_time = 6;

const Member& configured_by(const CO_OBJ& obj) {
  const uint8_t sub = CO_GET_SUB(obj.Key);
  return configured[sub < sizeof configured / sizeof *configured ? sub : 0];
}

CO_ERR init(CO_OBJ* obj, CO_NODE* node, const rules::Rule& rule) {
  const CO_ERR err = dict::check_type(*obj, *node, rule);
  auto* const recorder = data_of<CO_RECORDER>(*obj);
  return err == CO_ERR_NONE && recorder != nullptr ? recorder::start(*node, *recorder) : err;
}

// Configuration record ------------------------------------------------------------------------------------------------

CO_ERR init_config(CO_OBJ* obj, CO_NODE* node) {
  const uint8_t sub = CO_GET_SUB(obj->Key);
  return init(obj, node, sub < 3 ? rules::recorder_first : rules::recorder_config);
}

uint32_t config_size(CO_OBJ* obj, CO_NODE*, uint32_t) {
  return uintptr_t{obj->Data} == 0 ? 0 : configured_by(*obj).bytes;
}

CO_ERR read_config(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  const auto* const recorder = data_of<const CO_RECORDER>(*obj);
  const Member member = configured_by(*obj);
  if (recorder == nullptr || size == 0 || size != member.bytes) {
    return CO_ERR_BAD_ARG;
  }
  __builtin_memcpy(buffer, reinterpret_cast<const uint8_t*>(&recorder->Config) + member.offset, size);
  return CO_ERR_NONE;
}

CO_ERR write_config(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  auto* const recorder = data_of<CO_RECORDER>(*obj);
  const Member member = configured_by(*obj);
  if (recorder == nullptr || size == 0 || size != member.bytes) {
    return CO_ERR_BAD_ARG;
  }
  if (recorder->Node != node || node->Nmt.Mode == CO_INVALID) {
    return CO_ERR_OBJ_STATE;
  }
  CO_RECORDER_CONFIG config = recorder->Config;
  __builtin_memcpy(reinterpret_cast<uint8_t*>(&config) + member.offset, buffer, size);
  return recorder::configure(*recorder, config);
}

// Data record ---------------------------------------------------------------------------------------------------------

CO_ERR init_data(CO_OBJ* obj, CO_NODE* node) {
  const bool is_last = CO_GET_SUB(obj->Key) == sub_trigger_time;
  return init(obj, node, is_last ? rules::recorder_trigger_time : rules::recorder_data);
}

uint32_t data_size(CO_OBJ* obj, CO_NODE*, uint32_t) { return uintptr_t{obj->Data} == 0 ? 0 : sizeof(uint32_t); }

uint32_t value_of(const CO_RECORDER& recorder, uint8_t sub) {
  switch (sub) {
    case sub_held: return recorder.Held;
    case 2: return static_cast<uint32_t>(recorder.Value);
    case 3: return static_cast<uint32_t>(recorder.Min);
    case 4: return static_cast<uint32_t>(recorder.Max);
    default: return recorder.TriggerTime;
  }
}

CO_ERR read_data(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  const auto* const recorder = data_of<const CO_RECORDER>(*obj);
  if (recorder == nullptr || size != sizeof(uint32_t)) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t value = value_of(*recorder, CO_GET_SUB(obj->Key));
  __builtin_memcpy(buffer, &value, sizeof value);
  return CO_ERR_NONE;
}

CO_ERR write_data(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  auto* const recorder = data_of<CO_RECORDER>(*obj);
  uint32_t value = 0;
  if (recorder == nullptr || size != sizeof value) {
    return CO_ERR_BAD_ARG;
  }
  if (CO_GET_SUB(obj->Key) != sub_held || recorder->Node != node) {
    return CO_ERR_OBJ_ACC;
  }
  __builtin_memcpy(&value, buffer, sizeof value);
  return value == 0 ? recorder::clear(*recorder) : CO_ERR_OBJ_RANGE;
}

// Enable --------------------------------------------------------------------------------------------------------------

CO_ERR init_enable(CO_OBJ* obj, CO_NODE* node) {
  const CO_ERR err = dict::check_type(*obj, *node, rules::recorder_enable);
  if (err == CO_ERR_NONE) {
    node->Recorders.Enable = data_of<const uint8_t>(*obj);
  }
  return err;
}

uint32_t enable_size(CO_OBJ* obj, CO_NODE* node, uint32_t width) { return COTBoolean.Size(obj, node, width); }

CO_ERR read_enable(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return COTBoolean.Read(obj, node, buffer, size);
}

CO_ERR write_enable(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return COTBoolean.Write(obj, node, buffer, size);
}

}  // namespace
}  // namespace co::recorder_objects

extern "C" {

const CO_OBJ_TYPE COTRecConfig = {co::recorder_objects::config_size, co::recorder_objects::init_config,
                                  co::recorder_objects::read_config, co::recorder_objects::write_config, nullptr};
const CO_OBJ_TYPE COTRecData = {co::recorder_objects::data_size, co::recorder_objects::init_data,
                                co::recorder_objects::read_data, co::recorder_objects::write_data, nullptr};
const CO_OBJ_TYPE COTRecEnable = {co::recorder_objects::enable_size, co::recorder_objects::init_enable,
                                  co::recorder_objects::read_enable, co::recorder_objects::write_enable, nullptr};

}  // extern "C"

#endif
