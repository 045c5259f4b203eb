// SPDX-License-Identifier: Apache-2.0
// Plot of a recorder: text, numbers or a picture that is generated while it is read.
//
// A plot is a sequence of tokens: a constant text, a number, a character, or a point. Only the position of the next
// token is stored, so the plot needs no memory. Earlier positions are saved for segments that have to be repeated.
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/types/place.hpp"
#include "service/recorder/recorder.hpp"
#include "wire/bytes.hpp"

#if USE_RECORDER

namespace {

using namespace co;

using Plot = CO_RECORDER_PLOT;
using Cursor = CO_RECORDER_CURSOR;

// Largest number of bytes by which a block upload goes back, plus a token: a block that is not acknowledged yet begins
// within the last two pieces that were read.
constexpr uint32_t block_bytes = 127 * wire::segment_bytes;
constexpr uint32_t span = 2 * (CO_SDO_BUF_BYTE > block_bytes ? CO_SDO_BUF_BYTE : block_bytes) + 64;

// Content that follows the constant text of a part.
enum class Content : uint8_t {
  none,
  name,
  colour,
  start,     // time of the first point
  end,       // time of the last point
  top,       // greatest value
  bottom,    // least value
  duration,  // at least 1
  range,     // at least 1
  lines,     // points as text
  numbers,   // points as numbers
  steps      // points as commands of a path
};

struct Part {
  const char* text;
  Content content;
};

constexpr Part csv[] = {{"", Content::lines}};
constexpr Part binary[] = {{"", Content::numbers}};
constexpr Part svg[] = {
    {"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 400\" font-family=\"sans-serif\" font-size=\"13\">"
     "<title>",
     Content::name},
    {"</title><text x=\"100\" y=\"20\">", Content::name},
    {"</text><text x=\"94\" y=\"40\" text-anchor=\"end\">", Content::top},
    {"</text><text x=\"94\" y=\"370\" text-anchor=\"end\">", Content::bottom},
    {"</text><text x=\"100\" y=\"390\">", Content::start},
    {" ms</text><text x=\"790\" y=\"390\" text-anchor=\"end\">", Content::end},
    {" ms</text><path fill=\"none\" stroke=\"#999\" d=\"M100,30V370H790\"/>"
     "<svg x=\"100\" y=\"30\" width=\"690\" height=\"340\" preserveAspectRatio=\"none\" overflow=\"visible\""
     " viewBox=\"0 0 ",
     Content::duration},
    {" ", Content::range},
    {"\"><path fill=\"none\" stroke-width=\"2\" stroke-linecap=\"round\" vector-effect=\"non-scaling-stroke\""
     " stroke=\"#",
     Content::colour},
    {"\" d=\"", Content::steps},
    {"\"/></svg></svg>\n", Content::none},
};

// Text --------------------------------------------------------------------------------------------------------------

// Token of a plot.
struct Token {
  const char* text;
  uint32_t length;
};

constexpr uint32_t length_of(const char* text) {
  uint32_t length = 0;
  while (text[length] != '\0') {
    ++length;
  }
  return length;
}

// Appends text to a buffer that is large enough for every token: the longest one has two numbers of 11 characters.
class Writer {
 public:
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
  void put_text(const char* text) {
    for (; *text != '\0'; ++text) {
      put(*text);
    }
  }
  void put_colour(uint32_t colour) {
    for (unsigned shift = 24; shift != 0; shift -= 4) {
      put("0123456789ABCDEF"[(colour >> (shift - 4)) & 0xFU]);
    }
  }
  void put_bytes(uint32_t number) {
    for (unsigned shift = 0; shift != 32; shift += 8) {
      put(static_cast<char>(number >> shift));
    }
  }
  [[nodiscard]] Token token() const { return {text_, length_}; }

 private:
  char text_[24] = {};
  uint32_t length_ = 0;
};

// Returns the character of the name at a position; 0: the name has ended. Longer names do not fit into the picture.
uint8_t character_at(const CO_RECORDER& recorder, uint32_t position) {
  constexpr uint32_t longest_name = 80;
  const CO_OBJ_STR_RW& name = recorder.Name;
  const bool is_there = name.Start != nullptr && position < name.Size && position < longest_name;
  return is_there ? name.Start[position] : uint8_t{0};
}

// Appends a character of the name. Characters other than printable ASCII are replaced by '_'.
void put_character(Writer& writer, uint8_t character) {
  switch (character) {
    case '&': writer.put_text("&amp;"); break;
    case '<': writer.put_text("&lt;"); break;
    default: writer.put(character >= ' ' && character <= '~' ? static_cast<char>(character) : '_'); break;
  }
}

void put_line(Writer& writer, const CO_RECORDER& recorder) {
  const CO_RECORDER_POINT& point = recorder.Plot.Point;
  writer.put_number(point.Time);
  writer.put(';');
  writer.put_value(recorder, static_cast<uint32_t>(point.Value));
  writer.put('\n');
}

void put_numbers(Writer& writer, const CO_RECORDER& recorder) {
  const CO_RECORDER_POINT& point = recorder.Plot.Point;
  writer.put_bytes(point.Time);
  writer.put_bytes(static_cast<uint32_t>(point.Value));
}

// Appends a step from the previous point, or the begin of the curve. The vertical axis of a picture points down.
void put_step(Writer& writer, const CO_RECORDER& recorder) {
  const Plot& plot = recorder.Plot;
  const bool begins = plot.Cursor.Index == 0 || plot.Cursor.Gap != 0;
  writer.put(begins ? 'M' : 'H');
  writer.put_number(plot.Point.Time - plot.Start);
  writer.put(begins ? ' ' : 'V');
  writer.put_number(plot.Top - recorder::ordered(recorder, static_cast<uint32_t>(plot.Point.Value)));
  if (begins) {
    writer.put_text("h0");
  }
}

// Appends the content of a part, or its next character or point if it has several.
void put_content(Writer& writer, const CO_RECORDER& recorder, Content content) {
  const Plot& plot = recorder.Plot;
  switch (content) {
    case Content::none: break;
    case Content::name: put_character(writer, character_at(recorder, plot.Cursor.Index)); break;
    case Content::colour: writer.put_colour(recorder.Config.Colour); break;
    case Content::start: writer.put_number(plot.Start); break;
    case Content::end: writer.put_number(plot.Start + plot.Duration); break;
    case Content::top: writer.put_value(recorder, recorder::ordered(recorder, plot.Top)); break;
    case Content::bottom: writer.put_value(recorder, recorder::ordered(recorder, plot.Top - plot.Range)); break;
    case Content::duration: writer.put_number(plot.Duration != 0 ? plot.Duration : 1); break;
    case Content::range: writer.put_number(plot.Range != 0 ? plot.Range : 1); break;
    case Content::lines: put_line(writer, recorder); break;
    case Content::numbers: put_numbers(writer, recorder); break;
    case Content::steps: put_step(writer, recorder); break;
  }
}

// Cursor ------------------------------------------------------------------------------------------------------------

struct Format {
  const Part* parts;
  uint8_t num;
};

Format format_of(const CO_RECORDER& recorder) {
  switch (recorder.Config.Format & ~CO_RECORDER_UNSIGNED) {
    case CO_RECORDER_SVG: return {svg, sizeof svg / sizeof *svg};
    case CO_RECORDER_BINARY: return {binary, 1};
    default: return {csv, 1};
  }
}

// Cursor.Part counts the text and the content of a part separately.
bool is_text(const Cursor& cursor) { return cursor.Part % 2 == 0; }
const Part& part_at(const CO_RECORDER& recorder) {
  const Format format = format_of(recorder);
  CO_ASSERT(recorder.Plot.Cursor.Part / 2 < format.num);
  return format.parts[recorder.Plot.Cursor.Part / 2];
}
bool is_at_end(const CO_RECORDER& recorder) { return recorder.Plot.Cursor.Part / 2 >= format_of(recorder).num; }

bool is_points(Content content) { return content >= Content::lines; }

// Returns whether the point at the cursor has been read in part. It was copied to Plot.Point.
bool is_within_point(const CO_RECORDER& recorder) {
  const Plot& plot = recorder.Plot;
  return plot.At != plot.Cursor.Position && !is_at_end(recorder) && !is_text(plot.Cursor) &&
         is_points(part_at(recorder).content);
}

// Returns whether a point of a plot is not overwritten yet. left: points from this one to the last one of the plot
bool is_held(const CO_RECORDER& recorder, uint32_t left) { return left <= recorder.Limit - recorder.Plot.Since; }

// Copies the next point, because it may be overwritten while its text is read. Skips points that are overwritten.
void copy_point(CO_RECORDER& recorder) {
  Plot& plot = recorder.Plot;
  if (!is_held(recorder, plot.Cursor.Left)) {
    plot.Cursor.Left = recorder.Limit - plot.Since;
    plot.Cursor.Gap = 1;
  }
  if (plot.Cursor.Left != 0) {
    plot.Point = recorder::point_at(recorder, plot.Cursor.Left + plot.Since);
  }
}

// Returns whether the content at the cursor has another token.
bool has_token(const CO_RECORDER& recorder, Content content) {
  const Cursor& cursor = recorder.Plot.Cursor;
  if (content == Content::name) {
    return character_at(recorder, cursor.Index) != 0;
  }
  return is_points(content) ? cursor.Left != 0 : cursor.Index == 0 && content != Content::none;
}

// Returns the token at the cursor; its length is 0 if the part has ended.
Token token_at(CO_RECORDER& recorder, Writer& writer) {
  const Part& part = part_at(recorder);
  if (is_text(recorder.Plot.Cursor)) {
    return {part.text, length_of(part.text)};
  }
  if (is_points(part.content) && recorder.Plot.At == recorder.Plot.Cursor.Position) {
    copy_point(recorder);
  }
  if (has_token(recorder, part.content)) {
    put_content(writer, recorder, part.content);
  }
  return writer.token();
}

// Returns whether the cursor is at the end of a part.
bool is_part_over(const CO_RECORDER& recorder) {
  const Part& part = part_at(recorder);
  return is_text(recorder.Plot.Cursor) ? *part.text == '\0' : !has_token(recorder, part.content);
}

// Saves the cursor if it is at least span bytes after the cursor that was saved last.
void save(Plot& plot) {
  if (plot.Cursor.Position - plot.Saved[1].Position >= span) {
    plot.Saved[0] = plot.Saved[1];
    plot.Saved[1] = plot.Cursor;
  }
}

// Moves the cursor behind a token that was read completely.
void advance(CO_RECORDER& recorder, const Token& token) {
  Plot& plot = recorder.Plot;
  Cursor& cursor = plot.Cursor;
  const bool has_more = token.length != 0 && !is_text(cursor);
  if (has_more && is_points(part_at(recorder).content)) {
    --cursor.Left;
    cursor.Index = 1;
  } else if (has_more) {
    ++cursor.Index;
  } else {
    ++cursor.Part;
    cursor.Index = 0;
  }
  cursor.Gap = 0;
  cursor.Position += token.length;
  save(plot);
}

// Reads up to n bytes. Afterwards is_at_end() returns whether they were the last ones. buffer: null to skip the bytes.
void read_tokens(CO_RECORDER& recorder, uint8_t* buffer, uint32_t n) {
  Plot& plot = recorder.Plot;
  const uint32_t from = plot.At;
  while (!is_at_end(recorder) && (plot.At - from != n || is_part_over(recorder))) {
    Writer writer;
    const Token token = token_at(recorder, writer);
    const uint32_t ahead = plot.At - plot.Cursor.Position;
    const uint32_t before = ahead < token.length ? ahead : token.length;  // the name may have been changed meanwhile
    const uint32_t left = n - (plot.At - from);
    const uint32_t part = token.length - before < left ? token.length - before : left;
    if (buffer != nullptr) {
      __builtin_memcpy(buffer + (plot.At - from), token.text + before, part);
    }
    plot.At += part;
    if (before + part == token.length) {
      advance(recorder, token);
    }
  }
}

// Moves the cursor back to a saved one. Returns false if a point that was generated since then is overwritten.
bool go_back(CO_RECORDER& recorder, const Cursor& to) {
  Plot& plot = recorder.Plot;
  const uint32_t generated = to.Left - plot.Cursor.Left + (is_within_point(recorder) ? 1U : 0U);
  if (generated != 0 && !is_held(recorder, to.Left)) {
    return false;
  }
  plot.Cursor = to;
  plot.Saved[1] = to;  // save() requires that no saved cursor is behind the current one
  return true;
}

// Sets the position to a byte that was already read. Generates the tokens from a saved cursor to this byte again.
CO_ERR seek(CO_RECORDER& recorder, uint32_t position) {
  Plot& plot = recorder.Plot;
  if (position > plot.At || position < plot.Saved[0].Position) {
    return CO_ERR_OBJ_STATE;
  }
  if (position < plot.Cursor.Position) {
    const Cursor& saved = plot.Saved[position < plot.Saved[1].Position ? 0 : 1];
    if (!go_back(recorder, saved)) {
      return CO_ERR_OBJ_STATE;
    }
    plot.At = saved.Position;
    read_tokens(recorder, nullptr, position - plot.At);
  }
  plot.At = position;
  return CO_ERR_NONE;
}

// Finds the limits of the axes of a picture.
void find_limits(CO_RECORDER& recorder) {
  Plot& plot = recorder.Plot;
  uint32_t least = UINT32_MAX;
  plot.Top = plot.Total != 0 ? 0 : recorder::ordered(recorder, 0);
  for (uint32_t age = plot.Total; age != 0; --age) {
    const uint32_t order = recorder::ordered(recorder, static_cast<uint32_t>(recorder::point_at(recorder, age).Value));
    plot.Top = order > plot.Top ? order : plot.Top;
    least = order < least ? order : least;
  }
  if (plot.Total != 0) {
    plot.Range = plot.Top - least;
    plot.Start = recorder::point_at(recorder, plot.Total).Time;
    plot.Duration = recorder::point_at(recorder, 1).Time - plot.Start;
  }
}

// Type --------------------------------------------------------------------------------------------------------------

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
  recorder->Plot.Total = recorder->Held;
  recorder->Plot.Cursor.Left = recorder->Held;
  recorder->Plot.Key = CO_GET_DEV(obj->Key);
  recorder->Plot.Saved[0] = recorder->Plot.Cursor;
  recorder->Plot.Saved[1] = recorder->Plot.Cursor;
  recorder->Plot.Reading = 1;
  if (format_of(*recorder).parts == svg) {
    find_limits(*recorder);
  }
  return CO_ERR_NONE;
}

CO_ERR reset(CO_OBJ* obj, CO_NODE*, uint32_t position) {
  CO_RECORDER* const recorder = read_by(*obj);
  return recorder != nullptr ? seek(*recorder, position) : CO_ERR_OBJ_STATE;
}

CO_ERR read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t length) {
  CO_RECORDER* const recorder = read_by(*obj);
  if (recorder == nullptr) {
    return CO_ERR_OBJ_STATE;
  }
  read_tokens(*recorder, static_cast<uint8_t*>(buffer), length);
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

extern "C" const CO_OBJ_TYPE_EX COTRecPlot = {{size, init, read, nullptr, COObjTypeExReset}, reset, begin, end};

#endif
