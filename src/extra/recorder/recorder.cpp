// SPDX-License-Identifier: Apache-2.0
#include "extra/recorder/recorder.hpp"

#include "base/error.hpp"
#include "base/events.hpp"
#include "base/timer.hpp"
#include "co_assert.h"
#include "dictionary/access.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "wire/bytes.hpp"

#if USE_RECORDER

namespace co::recorder {
namespace {

// Longest cycle of the timer, in ticks. The time is updated at each expiry, before the clock of the timers wraps.
constexpr uint32_t longest_cycle = 1U << 30U;

constexpr uint32_t smaller(uint32_t a, uint32_t b) { return a < b ? a : b; }

// Returns whether the recorder has been added to the node since the node was initialised.
bool is_listed(const CO_NODE& node, const CO_RECORDER& recorder) {
  const CO_RECORDER* listed = node.Recorders.First;
  while (listed != nullptr && listed != &recorder) {
    listed = listed->Next;
  }
  return listed != nullptr;
}
bool is_started(const CO_RECORDER* recorder) {
  return recorder != nullptr && recorder->Node != nullptr && is_listed(*recorder->Node, *recorder);
}

// Time ----------------------------------------------------------------------------------------------------------------

// Updates the time of the recorders and returns it, in milliseconds.
uint32_t count_time(CO_NODE& node) {
  CO_RECORDERS& all = node.Recorders;
  const uint32_t now = tmr::now(node);
  all.Time += tmr::milliseconds(node, now - all.Tick, all.Rest);
  all.Tick = now;
  return all.Time;
}

// Returns the ticks between two expiries of the timer; 0: the timer cannot count them.
uint32_t cycle_of(const CO_NODE& node, const CO_RECORDER_CONFIG& config) {
  if (config.Period == 0) {
    return longest_cycle;
  }
  const uint32_t ticks = tmr::ticks(node, config.Period, CO_TMR_UNIT_1MS);
  return ticks <= longest_cycle ? ticks : 0;
}

// Configuration -------------------------------------------------------------------------------------------------------

bool has_number(CO_NODE& node, CO_OBJ& obj, uint32_t bytes) {
  const bool is_readable = CO_IS_READ(obj.Key) != 0 && obj.Type->Read != nullptr;
  return is_readable && !obj::is_stream(obj) && obj::size(obj, node, bytes) == bytes;
}

// Finds the object that map contains, in the form of a PDO mapping entry, and checks that it can be recorded.
CO_ERR find_number(CO_NODE& node, uint32_t map, CO_OBJ*& obj) {
  const uint32_t bits = map & 0xFFU;
  obj = dict::find(node, map);
  if (obj == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  const bool is_length = bits != 0 && bits % 8 == 0 && bits <= 32;
  return is_length && has_number(node, *obj, bits / 8) ? CO_ERR_NONE : CO_ERR_OBJ_MAP_TYPE;
}

bool is_in_range(const CO_RECORDER& recorder, const CO_RECORDER_CONFIG& config) {
  constexpr uint32_t colours = 0xFFFFFF;
  const uint32_t available = recorder.Points != nullptr ? recorder.Num : 0;
  const bool is_split = config.PreTrigger == 0 || config.PreTrigger < config.Size;
  const bool is_format = (config.Format & ~CO_RECORDER_UNSIGNED) <= CO_RECORDER_BINARY;
  return config.Size <= available && is_split && is_format && config.Trigger <= CO_RECORDER_BOTH &&
         config.Colour <= colours;
}

CO_ERR check(CO_NODE& node, const CO_RECORDER& recorder, const CO_RECORDER_CONFIG& config) {
  if (!is_in_range(recorder, config) || cycle_of(node, config) == 0) {
    return CO_ERR_OBJ_RANGE;
  }
  CO_OBJ* obj = nullptr;
  return config.Map == 0 ? CO_ERR_NONE : find_number(node, config.Map, obj);
}

// Returns whether the recorder must be emptied when one configuration replaces the other.
bool starts_anew(const CO_RECORDER_CONFIG& a, const CO_RECORDER_CONFIG& b) {
  return a.Size != b.Size || a.Map != b.Map || a.Threshold != b.Threshold || a.PreTrigger != b.PreTrigger ||
         a.Trigger != b.Trigger || ((a.Format ^ b.Format) & CO_RECORDER_UNSIGNED) != 0;
}

// Recording -----------------------------------------------------------------------------------------------------------

void arm(CO_RECORDER& recorder) { recorder.State = recorder.Config.Trigger == CO_RECORDER_FREE ? recording : waiting; }

void empty(CO_RECORDER& recorder) {
  recorder.Limit = recorder.Config.Size;
  recorder.Write = 0;
  recorder.Held = 0;
  recorder.Missing = 0;
  recorder.Value = 0;
  recorder.Min = 0;
  recorder.Max = 0;
  recorder.TriggerTime = 0;
  recorder.HasValue = 0;
  recorder.Plot = {};
  arm(recorder);
}

// Adds a point, over the oldest one if the memory is full.
void add(CO_RECORDER& recorder, const CO_RECORDER_POINT& point) {
  CO_ASSERT(recorder.Write < recorder.Limit && recorder.Limit <= recorder.Num);
  recorder.Points[recorder.Write] = point;
  recorder.Write = recorder.Write + 1 < recorder.Limit ? recorder.Write + 1 : 0;
  recorder.Held = smaller(recorder.Held + 1, recorder.Limit);
  recorder.Plot.Since = smaller(recorder.Plot.Since + 1, recorder.Limit);
}

// Returns whether the change from the last value to this one is the edge of the trigger.
bool is_edge(const CO_RECORDER& recorder, int32_t value) {
  const uint32_t threshold = ordered(recorder, static_cast<uint32_t>(recorder.Config.Threshold));
  const bool was_above = ordered(recorder, static_cast<uint32_t>(recorder.Value)) >= threshold;
  const bool is_above = ordered(recorder, static_cast<uint32_t>(value)) >= threshold;
  return was_above != is_above &&
         (recorder.Config.Trigger & (is_above ? CO_RECORDER_RISING : CO_RECORDER_FALLING)) != 0;
}

// Adds a point to a recorder that is not full. Before the trigger, holds only the points to be kept from before it.
void record(CO_RECORDER& recorder, const CO_RECORDER_POINT& point) {
  add(recorder, point);
  if (recorder.State == waiting) {
    recorder.Held = smaller(recorder.Held, recorder.Config.PreTrigger);
  } else if (recorder.State == triggered) {
    --recorder.Missing;
    recorder.State = recorder.Missing == 0 ? full : triggered;
  }
}

// Processes the first value, or a value that differs from the last one.
void change(CO_RECORDER& recorder, int32_t value, uint32_t time) {
  if (recorder.State == waiting && recorder.HasValue != 0 && is_edge(recorder, value)) {
    recorder.State = triggered;
    recorder.TriggerTime = time;
    recorder.Missing = recorder.Limit - recorder.Config.PreTrigger;
  }
  const uint32_t order = ordered(recorder, static_cast<uint32_t>(value));
  if (recorder.HasValue == 0 || order < ordered(recorder, static_cast<uint32_t>(recorder.Min))) {
    recorder.Min = value;
  }
  if (recorder.HasValue == 0 || order > ordered(recorder, static_cast<uint32_t>(recorder.Max))) {
    recorder.Max = value;
  }
  recorder.Value = value;
  recorder.HasValue = 1;
  if (recorder.Limit != 0 && recorder.State != full) {
    record(recorder, {time, value});
  }
}

// Returns the value of a number of 8 to 32 bits: extends its sign unless it is unsigned.
int32_t extend(const CO_RECORDER& recorder, uint32_t number, uint32_t bits) {
  const bool is_signed = (recorder.Config.Format & CO_RECORDER_UNSIGNED) == 0;
  const uint32_t sign = is_signed ? 1U << (bits - 1) : 0;
  return static_cast<int32_t>((number ^ sign) - sign);
}

// Returns whether CO_TREC_ENABLE forbids samples.
bool is_disabled(const CO_NODE& node) {
  const uint8_t* const enable = node.Recorders.Enable;
  return enable != nullptr && *enable == 0;
}

CO_ERR sample(CO_RECORDER& recorder) {
  CO_NODE& node = *recorder.Node;
  const uint32_t map = recorder.Config.Map;
  if (is_disabled(node) || map == 0 || recorder.State == idle || node.Nmt.Mode == CO_INVALID) {
    return CO_ERR_OBJ_STATE;
  }
  CO_OBJ* obj = nullptr;
  CO_ERR err = find_number(node, map, obj);
  if (err != CO_ERR_NONE) {
    return err;
  }
  uint32_t number = 0;
  const uint32_t bits = map & 0xFFU;
  const uint32_t above = wire::host_is_little_endian ? 0 : sizeof number - bits / 8;
  {
    const access::Request none(node, nullptr);
    err = obj::read(*obj, node, reinterpret_cast<uint8_t*>(&number) + above, bits / 8);
  }
  const int32_t value = extend(recorder, number, bits);
  // The Read function of the type may have changed the configuration.
  if (err == CO_ERR_NONE && recorder.Config.Map == map && (recorder.HasValue == 0 || value != recorder.Value)) {
    change(recorder, value, count_time(node));
  }
  return err;
}

void on_time(void* recorder_pointer) {
  CO_RECORDER& recorder = *static_cast<CO_RECORDER*>(recorder_pointer);
  count_time(*recorder.Node);
  if (recorder.Config.Period != 0) {
    (void)sample(recorder);
  }
}

void start_timer(CO_RECORDER& recorder) {
  CO_NODE& node = *recorder.Node;
  tmr::start(node, recorder.Tmr, 0, cycle_of(node, recorder.Config), on_time, &recorder);
}

// Adds a recorder to the list of the node, unless it is there. Clears its timer first, which may have its state from
// before CONodeInit().
void list(CO_NODE& node, CO_RECORDER& recorder) {
  if (is_listed(node, recorder)) {
    return;
  }
  if (node.Recorders.First == nullptr) {
    node.Recorders.Tick = tmr::now(node);
  }
  recorder.Node = &node;
  recorder.Tmr = {};
  recorder.Next = node.Recorders.First;
  node.Recorders.First = &recorder;
}

}  // namespace

CO_ERR start(CO_NODE& node, CO_RECORDER& recorder) {
  const CO_ERR err = check(node, recorder, recorder.Config);
  list(node, recorder);
  tmr::stop(node, recorder.Tmr);
  empty(recorder);
  if (err != CO_ERR_NONE) {
    recorder.State = idle;
    recorder.Limit = 0;
    return err;
  }
  start_timer(recorder);
  return CO_ERR_NONE;
}

CO_ERR configure(CO_RECORDER& recorder, const CO_RECORDER_CONFIG& config) {
  if (recorder.Plot.Reading != 0) {
    return CO_ERR_OBJ_STATE;
  }
  const CO_ERR err = check(*recorder.Node, recorder, config);
  if (err != CO_ERR_NONE) {
    return err;
  }
  const bool anew = recorder.State == idle || starts_anew(recorder.Config, config);
  const bool has_other_period = recorder.Config.Period != config.Period;
  recorder.Config = config;
  if (anew) {
    return start(*recorder.Node, recorder);
  }
  if (has_other_period) {
    start_timer(recorder);
  }
  return CO_ERR_NONE;
}

CO_ERR clear(CO_RECORDER& recorder) {
  if (recorder.Plot.Reading != 0) {
    return CO_ERR_OBJ_STATE;
  }
  if (recorder.State != idle) {
    empty(recorder);
  }
  return CO_ERR_NONE;
}

const CO_RECORDER_POINT& point_at(const CO_RECORDER& recorder, uint32_t age) {
  CO_ASSERT(age != 0 && age <= recorder.Limit && recorder.Limit <= recorder.Num);
  const uint32_t before = recorder.Write;
  return recorder.Points[before >= age ? before - age : before + recorder.Limit - age];
}

void remove_read(CO_RECORDER& recorder) {
  recorder.Held = smaller(recorder.Held, recorder.Plot.Since);
  if (recorder.State == full && recorder.Held == 0) {
    arm(recorder);
  }
}

void on_mode(CO_NODE& node) {
  if (node.Nmt.Mode != CO_INVALID) {
    return;
  }
  for (CO_RECORDER* recorder = node.Recorders.First; recorder != nullptr; recorder = recorder->Next) {
    tmr::stop(node, recorder->Tmr);
  }
}

void on_remap(CO_NODE& node) {
  node.Recorders.Enable = nullptr;
  for (unsigned entry = 0; entry < node.Dict.Num; ++entry) {
    if (node.Dict.Root[entry].Type == CO_TREC_ENABLE) {
      node.Recorders.Enable = data_of<const uint8_t>(node.Dict.Root[entry]);
    }
  }
  for (CO_RECORDER* recorder = node.Recorders.First; recorder != nullptr; recorder = recorder->Next) {
    const CO_OBJ* const obj = dict::find(node, recorder->Plot.Key);
    if (obj == nullptr || !access::is_open(node, *obj)) {
      recorder->Plot.Reading = 0;
    }
  }
}

}  // namespace co::recorder

extern "C" {

CO_ERR CORecorderStart(CO_NODE* node, CO_RECORDER* recorder) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(recorder, CO_ERR_BAD_ARG);
  if (node->Dict.Node == nullptr || node->Nmt.Mode == CO_INVALID) {
    return CO_ERR_BAD_ARG;
  }
  const bool is_reading = co::recorder::is_listed(*node, *recorder) && recorder->Plot.Reading != 0;
  return is_reading ? CO_ERR_OBJ_STATE : co::recorder::start(*node, *recorder);
}

CO_ERR CORecorderConfigure(CO_RECORDER* recorder, const CO_RECORDER_CONFIG* config) {
  if (config == nullptr || !co::recorder::is_started(recorder) || recorder->Node->Nmt.Mode == CO_INVALID) {
    return CO_ERR_BAD_ARG;
  }
  return co::recorder::configure(*recorder, *config);
}

CO_ERR CORecorderSample(CO_RECORDER* recorder) {
  if (!co::recorder::is_started(recorder)) {
    return CO_ERR_BAD_ARG;
  }
  const co::event::Call call(*recorder->Node);
  return co::recorder::sample(*recorder);
}

CO_ERR CORecorderClear(CO_RECORDER* recorder) {
  return co::recorder::is_started(recorder) ? co::recorder::clear(*recorder) : CO_ERR_BAD_ARG;
}

uint32_t CORecorderCount(const CO_RECORDER* recorder) { return recorder != nullptr ? recorder->Held : 0; }

CO_ERR CORecorderGet(const CO_RECORDER* recorder, uint32_t number, CO_RECORDER_POINT* point) {
  if (recorder == nullptr || point == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (number >= recorder->Held) {
    return CO_ERR_OBJ_NO_DATA;
  }
  *point = co::recorder::point_at(*recorder, recorder->Held - number);
  return CO_ERR_NONE;
}

}  // extern "C"

#endif
