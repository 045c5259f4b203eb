// SPDX-License-Identifier: Apache-2.0
// Plot of a recorder: text or numbers that are generated while they are read.
//
// A plot is a sequence of points. Only the position of the next point is stored, so the plot needs no memory. A client
// that has lost segments goes back point by point: the length of each one follows from its content.
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "extra/recorder/recorder.hpp"

#if USE_RECORDER

namespace co::recorder_plot {
namespace {

using Plot = CO_RECORDER_PLOT;

// Text of a point: two numbers of up to 11 characters and two separators, or 8 bytes.
class Text {
 public:
  Text(const CO_RECORDER& recorder, const CO_RECORDER_POINT& point) {
    const auto value = static_cast<uint32_t>(point.Value);
    if ((recorder.Config.Format & CO_RECORDER_BINARY) != 0) {
      put_bytes(point.Time);
      put_bytes(value);
      return;
    }
    put_number(point.Time);
    put(';');
    put_value(recorder, value);
    put('\n');
  }
  [[nodiscard]] const char* begin() const { return text_; }
  [[nodiscard]] uint32_t length() const { return length_; }

 private:
  void put(char character) {
    CO_ASSERT(length_ < sizeof text_);
    text_[length_++] = character;
  }
  // Appends a decimal number. Subtracts powers of ten: small CPUs have no division.
  void put_number(uint32_t number) {
    constexpr uint32_t powers[] = {1000000000, 100000000, 10000000, 1000000, 100000, 10000, 1000, 100, 10, 1};
    bool is_begun = false;
    for (const uint32_t power : powers) {
      char digit = '0';
      for (; number >= power; number -= power) {
        ++digit;
      }
      is_begun = is_begun || digit != '0' || power == 1;
      if (is_begun) {
        put(digit);
      }
    }
  }
  // Appends a value of the recorded object.
  void put_value(const CO_RECORDER& recorder, uint32_t value) {
    constexpr uint32_t sign = 0x80000000;
    if ((recorder.Config.Format & CO_RECORDER_UNSIGNED) == 0 && (value & sign) != 0) {
      put('-');
      value = 0 - value;
    }
    put_number(value);
  }
  void put_bytes(uint32_t number) {
    for (unsigned shift = 0; shift != 32; shift += 8) {
      put(static_cast<char>(number >> shift));
    }
  }

  char text_[24] = {};
  uint32_t length_ = 0;
};

// Reading -------------------------------------------------------------------------------------------------------------

bool is_at_end(const CO_RECORDER& recorder) { return recorder.Plot.Left == 0; }

// Returns whether a point of a plot is not overwritten yet. left: points from this one to the last one of the plot
bool is_held(const CO_RECORDER& recorder, uint32_t left) { return left <= recorder.Limit - recorder.Plot.Since; }

// Copies the next point, because it may be overwritten while it is read. Skips points that are overwritten, unless they
// were read before: returns false then.
bool copy_point(CO_RECORDER& recorder) {
  Plot& plot = recorder.Plot;
  if (!is_held(recorder, plot.Left)) {
    if (plot.Left > plot.New) {
      return false;
    }
    plot.Left = recorder.Limit - plot.Since;
  }
  if (plot.Left != 0) {
    plot.Point = recorder::point_at(recorder, plot.Left + plot.Since);
  }
  if (plot.Left <= plot.New) {
    plot.New = plot.Left != 0 ? plot.Left - 1 : 0;
  }
  return true;
}

// Reads bytes of the next point. Returns their number.
uint32_t read_point(CO_RECORDER& recorder, uint8_t* buffer, uint32_t n) {
  Plot& plot = recorder.Plot;
  const Text text(recorder, plot.Point);
  const uint32_t before = plot.At - plot.Position;
  const uint32_t part = text.length() - before < n ? text.length() - before : n;
  __builtin_memcpy(buffer, text.begin() + before, part);
  plot.At += part;
  if (before + part == text.length()) {
    plot.Position = plot.At;
    --plot.Left;
  }
  return part;
}

// Sets the position to a byte that was already read. Returns CO_ERR_OBJ_STATE if a point from there on is overwritten.
CO_ERR seek(CO_RECORDER& recorder, uint32_t position) {
  Plot& plot = recorder.Plot;
  if (position > plot.At) {
    return CO_ERR_OBJ_STATE;
  }
  while (plot.Position > position) {
    if (!is_held(recorder, plot.Left + 1)) {
      return CO_ERR_OBJ_STATE;
    }
    ++plot.Left;
    plot.Point = recorder::point_at(recorder, plot.Left + plot.Since);
    plot.Position -= Text(recorder, plot.Point).length();
  }
  plot.At = position;
  return CO_ERR_NONE;
}

// Type ----------------------------------------------------------------------------------------------------------------

CO_ERR init(CO_OBJ* obj, CO_NODE* node) {
  const CO_ERR err = dict::check_type(*obj, *node, rules::recorder_plot);
  auto* const recorder = data_of<CO_RECORDER>(*obj);
  return err == CO_ERR_NONE && recorder != nullptr ? recorder::start(*node, *recorder) : err;
}

// Returns the recorder whose plot is being read; null: none.
CO_RECORDER* read_by(const CO_OBJ& obj) {
  auto* const recorder = data_of<CO_RECORDER>(obj);
  return recorder != nullptr && recorder->Plot.Reading != 0 ? recorder : nullptr;
}

uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) {
  if (uintptr_t{obj->Data} == 0) {
    return 0;
  }
  const CO_RECORDER* const recorder = read_by(*obj);
  return recorder != nullptr && is_at_end(*recorder) ? recorder->Plot.At : CO_OBJ_SIZE_UNKNOWN;
}

CO_ERR begin(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER, uint32_t) {
  auto* const recorder = data_of<CO_RECORDER>(*obj);
  if (recorder == nullptr) {
    return CO_ERR_TYPE_RD;
  }
  if (recorder->Node != node || recorder->Plot.Reading != 0) {
    return CO_ERR_OBJ_STATE;
  }
  recorder->Plot = {};
  recorder->Plot.Left = recorder->Held;
  recorder->Plot.New = recorder->Held;
  recorder->Plot.Key = CO_GET_DEV(obj->Key);
  recorder->Plot.Reading = 1;
  return CO_ERR_NONE;
}

CO_ERR reset(CO_OBJ* obj, CO_NODE*, uint32_t position) {
  CO_RECORDER* const recorder = read_by(*obj);
  return recorder != nullptr ? seek(*recorder, position) : CO_ERR_OBJ_STATE;
}

// Afterwards is_at_end() returns whether the last byte was read.
CO_ERR read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t length) {
  CO_RECORDER* const recorder = read_by(*obj);
  if (recorder == nullptr) {
    return CO_ERR_OBJ_STATE;
  }
  auto* to = static_cast<uint8_t*>(buffer);
  while (length != 0 && !is_at_end(*recorder)) {
    if (recorder->Plot.At == recorder->Plot.Position && !copy_point(*recorder)) {
      return CO_ERR_OBJ_STATE;
    }
    if (!is_at_end(*recorder)) {
      const uint32_t part = read_point(*recorder, to, length);
      to += part;
      length -= part;
    }
  }
  return CO_ERR_NONE;
}

CO_ERR end(CO_OBJ* obj, CO_NODE*, CO_OBJ_TRANSFER, uint32_t abort) {
  CO_RECORDER* const recorder = read_by(*obj);
  if (recorder != nullptr) {
    recorder->Plot.Reading = 0;
    if (abort == 0) {
      recorder::remove_read(*recorder);
    }
  }
  return CO_ERR_NONE;
}

}  // namespace
}  // namespace co::recorder_plot

extern "C" const CO_OBJ_TYPE_EX COTRecPlot = {
    {co::recorder_plot::size, co::recorder_plot::init, co::recorder_plot::read, nullptr, COObjTypeExReset},
    co::recorder_plot::reset,
    co::recorder_plot::begin,
    co::recorder_plot::end};

#endif
