// SPDX-License-Identifier: Apache-2.0
#include "json/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>

namespace lexican::codict::json {

namespace {

// Iterator that records how far the parser has read, because the parser reports no positions of values.
class Cursor {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Cursor(const char* at, const char*& read) : at_(at), read_(&read) {}

  reference operator*() const { return *at_; }
  Cursor& operator++() {
    *read_ = ++at_;
    return *this;
  }
  bool operator==(const Cursor& other) const { return at_ == other.at_; }
  bool operator!=(const Cursor& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** read_;
};

bool is_of_number(char c) { return is_digit(c) || c == '-' || c == '+' || c == '.' || to_lower(c) == 'e'; }

// SAX handler. The parser has completely read a value when it calls the function of its kind. Returning false stops the
// parser.
class Builder {
 public:
  Builder(std::string_view bytes, const char*& read) : bytes_(bytes), read_(read) {}

  Node root;
  std::string fault;
  std::uint32_t fault_at = 0;

  bool null() { return scalar(Kind::null, before(4)); }
  bool boolean(bool value) {
    node_.boolean = value;
    return scalar(Kind::boolean, before(value ? 4 : 5));
  }
  bool number_integer(std::int64_t value) {
    return integer(Integer(0 - static_cast<std::uint64_t>(value), true), static_cast<double>(value));
  }
  bool number_unsigned(std::uint64_t value) { return integer(Integer(value), static_cast<double>(value)); }
  bool number_float(double value, const std::string& /*text*/) {
    node_.real = value;
    return scalar(Kind::real, number());
  }
  bool string(std::string& value) {
    node_.text = std::move(value);
    return scalar(Kind::string, quoted());
  }
  bool binary(std::vector<std::uint8_t>& /*value*/) { return false; }
  bool key(std::string& name) {
    node_.name = std::move(name);
    node_.name_span = quoted();
    return true;
  }
  bool start_object(std::size_t /*size*/) { return start(Kind::object); }
  bool start_array(std::size_t /*size*/) { return start(Kind::array); }
  bool end_object() { return end(); }
  bool end_array() { return end(); }
  bool parse_error(std::size_t at, const std::string& /*token*/, const std::exception& error) {
    const std::string_view text = error.what();
    const std::string_view said = text.substr(0, text.find(';'));
    const std::size_t dash = said.find(" - ");
    return fail(
        dash == std::string_view::npos ? "this is no JSON" : "this is no JSON: " + std::string(said.substr(dash + 3)),
        static_cast<std::uint32_t>(at == 0 ? 0 : at - 1));
  }

 private:
  std::uint32_t at() const { return static_cast<std::uint32_t>(read_ - bytes_.data()); }
  Span before(std::uint32_t size) const { return {at() - size, at()}; }

  // Returns the span of a number. The parser has usually read one character behind it, too.
  Span number() const {
    std::uint32_t end = at();
    end -= end != 0 && !is_of_number(bytes_[end - 1]) ? 1U : 0U;
    std::uint32_t begin = end;
    while (begin != 0 && is_of_number(bytes_[begin - 1])) {
      --begin;
    }
    return {begin, end};
  }

  // Returns the span of a string. It begins behind the last quote that is not escaped: preceded by an even number of
  // backslashes.
  Span quoted() const {
    const std::uint32_t end = at() - 1;
    for (std::size_t quote = bytes_.rfind('"', end - 1); quote != std::string_view::npos && quote != 0;
         quote = bytes_.rfind('"', quote - 1)) {
      const std::size_t other = bytes_.find_last_not_of('\\', quote - 1);
      if ((quote - 1 - other) % 2 == 0) {
        return {static_cast<std::uint32_t>(quote) + 1, end};
      }
    }
    return {1, end};
  }

  bool integer(Integer value, double real) {
    node_.integer = value;
    node_.real = real;
    return scalar(Kind::integer, number());
  }
  bool scalar(Kind kind, Span span) {
    node_.kind = kind;
    node_.span = span;
    return add();
  }
  bool start(Kind kind) {
    if (open_.size() == Document::most_levels) {
      return fail(fmt::format("more than {} levels: this is no description", Document::most_levels), at());
    }
    node_.kind = kind;
    node_.span = before(1);
    open_.push_back(std::exchange(node_, {}));
    return true;
  }
  bool end() {
    node_ = std::move(open_.back());
    open_.pop_back();
    node_.end = at();
    return add();
  }
  bool add() {
    if (++number_ > Document::most_values) {
      return fail(fmt::format("more than {} values: this is no description", Document::most_values), at());
    }
    Node& place = open_.empty() ? root : open_.back().children.emplace_back();
    place = std::exchange(node_, {});
    return true;
  }
  bool fail(std::string why, std::uint32_t where) {
    fault = std::move(why);
    fault_at = where;
    return false;
  }

  std::string_view bytes_;
  const char*& read_;
  Node node_;  // the next value; its name is set before the value is read
  std::vector<Node> open_;
  std::size_t number_ = 0;
};

// Printing ---------------------------------------------------------------------------------------------------------

std::string literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : to_utf8(text, Encoding::utf8)) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < ' ') {
      fmt::format_to(std::back_inserter(result), "\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

bool is_flat(const Node& node) {
  return std::all_of(node.children.begin(), node.children.end(),
                     [](const Node& child) { return child.kind < Kind::array; });
}

std::string real_text(double value) {
  std::string text = fmt::format("{}", value);  // shortest text that is read as the same number
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

void print(const Node& node, std::size_t level, std::string& text) {
  switch (node.kind) {
    case Kind::null: text += "null"; return;
    case Kind::boolean: text += node.boolean ? "true" : "false"; return;
    case Kind::integer:
      text += fmt::format("{}{}", node.integer.is_negative ? "-" : "", node.integer.magnitude);
      return;
    case Kind::real: text += real_text(node.real); return;
    case Kind::string: text += literal(node.text); return;
    case Kind::array:
    case Kind::object: break;
  }
  const bool is_line = is_flat(node);
  const std::string between = is_line ? " " : "\n" + std::string(2 * level + 2, ' ');
  text += node.kind == Kind::object ? '{' : '[';
  for (std::size_t n = 0; n < node.children.size(); ++n) {
    text += (n == 0 ? "" : ",") + (n == 0 && is_line ? std::string() : between);
    if (node.kind == Kind::object) {
      text += literal(node.children[n].name) + ": ";
    }
    print(node.children[n], level + 1, text);
  }
  if (!is_line) {
    text += "\n" + std::string(2 * level, ' ');
  }
  text += node.kind == Kind::object ? '}' : ']';
}

}  // namespace

std::string_view name_of(Kind kind) {
  constexpr std::array<std::string_view, 7> names = {"null",     "true or false", "an integer", "a number",
                                                     "a string", "an array",      "an object"};
  return names[static_cast<std::size_t>(kind)];
}

const Node* Node::find(std::string_view member) const {
  const auto place =
      std::find_if(children.begin(), children.end(), [member](const Node& child) { return child.name == member; });
  return place != children.end() ? &*place : nullptr;
}

Document::Document(Source source) : source_(std::move(source)) {
  const std::string_view bytes = source_.bytes();
  const char* read = bytes.data();
  Builder builder(bytes, read);
  const Cursor begin(bytes.data(), read);
  const Cursor end(bytes.data() + bytes.size(), read);
  if (!nlohmann::json::sax_parse(begin, end, &builder)) {
    const Position place = source_.position(std::min(builder.fault_at, source_.size()));
    fault_ = fmt::format("line {}, column {}: {}", place.line, place.column, builder.fault);
  }
  root_ = std::move(builder.root);
}

std::string print(const Node& node) {
  std::string text;
  print(node, 0, text);
  return text + "\n";
}

}  // namespace lexican::codict::json
