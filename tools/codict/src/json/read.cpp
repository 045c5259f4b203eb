// SPDX-License-Identifier: Apache-2.0
#include "json/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "json/members.hpp"
#include "json/words.hpp"
#include "model/parse.hpp"

namespace lexican::codict::json {

namespace rules {

const Rule type{"json-type", Severity::error, "member of the wrong JSON type"};
const Rule range{"json-range", Severity::error, "number out of range"};
const Rule word{"json-word", Severity::error, "unknown word"};
const Rule unknown{"json-unknown", Severity::warning, "member unknown to the schema"};
const Rule duplicate{"json-duplicate", Severity::error, "member or object given more than once"};
const Rule missing{"json-missing", Severity::error, "mandatory member is missing"};
const Rule contradiction{"json-contradiction", Severity::error, "text contradicts value"};

}  // namespace rules

const std::vector<const Rule*>& all_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {&type, &range, &word, &unknown, &duplicate, &missing, &contradiction};
  return all;
}

namespace {

// A value whose text is interpreted after all data types of the device have been read.
struct UninterpretedValue {
  Value* value;
  const Entry* entry;  // null: without a data type
  bool has_meaning;    // the meaning is given as well ("value")
  bool has_kind;       // the kind is given as well, and remains unless the text contradicts the value
};

struct Context {
  Findings& findings;
  std::vector<UninterpretedValue> uninterpreted;
  Format format = Format::eds;  // of the device that is read
};

bool is_of_eds(Format format) { return format == Format::eds || format == Format::dcf; }

// Returns the meaning of a field's text; none if it is unknown, or if only the reader of its format could interpret it.
// In XML, some numbers are hexadecimal, and bit rates may be in bit/s.
std::optional<std::uint64_t> number_in(const Text& text, std::uint64_t value, Format format) {
  const ParsedInteger number = parse_integer(text.text);
  if (is_of_eds(format)) {
    return number.is_meant() ? std::optional(number.value.bits()) : std::nullopt;
  }
  std::uint64_t digits = 0;
  const bool is_hex = parse_hex(text.text, digits) && digits == value;
  const bool is_known = number.is_number() && !is_hex && number.value.bits() != 1000 * value;
  return is_known ? std::optional(number.value.bits()) : std::nullopt;
}
std::optional<bool> meaning_of(const Field<bool>& field, Format format) {
  const std::optional<std::uint64_t> number = number_in(field, 0, format);
  return number && *number < 2 ? std::optional(*number == 1) : std::nullopt;
}
template <typename T>
std::optional<T> meaning_of(const Field<T>& field, Format format) {
  const std::optional<std::uint64_t> number = number_in(field, static_cast<std::uint64_t>(field.value), format);
  return number && *number <= std::numeric_limits<T>::max() ? std::optional(static_cast<T>(*number)) : std::nullopt;
}
std::optional<Access> meaning_of(const Field<Access>& field, Format /*format*/) {
  const Access access = access_named(field.text);
  return access != Access::unknown ? std::optional(access) : std::nullopt;
}
std::optional<PdoMapping> meaning_of(const Field<PdoMapping>& field, Format format) {
  const std::optional<std::uint64_t> number = number_in(field, 0, format);
  const bool is_mapped = field.value != PdoMapping::no;
  return !number        ? std::nullopt
         : *number == 0 ? std::optional(PdoMapping::no)
         : is_mapped    ? std::optional(field.value)
                        : std::optional(PdoMapping::optional);
}

class Reader {
 public:
  static constexpr bool is_reading = true;

  Reader(const Node& node, Context& context)
      : node_(node), context_(context), first_untyped_(context.uninterpreted.size()) {}

  template <typename T>
  void required(std::string_view name, T& member) {
    if (node_.find(name) == nullptr) {
      context_.findings.add(rules::missing, node_.span, fmt::format("member \"{}\" is missing", name), "add it");
    }
    (*this)(name, member);
  }
  template <typename T>
  void operator()(std::string_view name, T& member) {
    names_.push_back(name);
    if (const Node* const node = node_.find(name); node != nullptr) {
      read(*node, member);
    }
    if constexpr (std::is_same_v<T, Format>) {
      context_.format = member;
    }
  }
  template <typename T>
  void operator()(std::string_view name, Rare<T>& member) {
    names_.push_back(name);
    if (const Node* const node = node_.find(name); node != nullptr) {
      read(*node, member.edit());
    }
  }

  void end_of(Entry& entry) {
    entry.span = node_.span;
    entry.extent = {node_.span.begin, node_.end};
    for (std::size_t n = first_untyped_; n != context_.uninterpreted.size(); ++n) {
      context_.uninterpreted[n].entry = &entry;
    }
  }
  void end_of(const Device& device) {
    for (const UninterpretedValue& uninterpreted : context_.uninterpreted) {
      const bool is_typed = uninterpreted.entry != nullptr;
      const bool is_implied = uninterpreted.has_meaning && uninterpreted.value->is_empty();  // defined by a standard
      if (!is_implied) {
        interpret_by_type(uninterpreted,
                          data_type_of(device, is_typed ? uninterpreted.entry->data_type.value : std::uint16_t{0}));
      }
    }
    context_.uninterpreted.clear();
  }

  // Reports members that no read has requested, and duplicates.
  void report_others() const {
    for (const Node& child : node_.children) {
      const bool is_known = std::find(names_.begin(), names_.end(), child.name) != names_.end();
      if (!is_known) {
        context_.findings.add(rules::unknown, child.name_span,
                              fmt::format("member {} is unknown; not used", in_quotes(child.name)),
                              "correct the name, or remove it");
      } else if (node_.find(child.name) != &child) {
        context_.findings.add(rules::duplicate, child.name_span,
                              fmt::format("duplicate member {}; the first is used", in_quotes(child.name)),
                              "remove one of them");
      }
    }
  }

 private:
  bool is_a(const Node& node, Kind kind) const {
    if (node.kind != kind) {
      context_.findings.add(rules::type, node.span, fmt::format("{} instead of {}", name_of(node.kind), name_of(kind)),
                            fmt::format("write {}", name_of(kind)));
    }
    return node.kind == kind;
  }

  void read(const Node& node, std::string& text) {
    if (is_a(node, Kind::string)) {
      text = node.text;
    }
  }
  void read(const Node& node, bool& value) {
    if (is_a(node, Kind::boolean)) {
      value = node.boolean;
    }
  }
  template <typename T, std::enable_if_t<std::is_integral_v<T> && !std::is_same_v<T, bool>, int> = 0>
  void read(const Node& node, T& value) {
    if (!is_a(node, Kind::integer)) {
      return;
    }
    const Integer number = node.integer;
    constexpr unsigned bits = 8 * sizeof(T);
    if (std::is_signed_v<T> ? fits_signed(number, bits) : fits_unsigned(number, bits)) {
      value = static_cast<T>(number.bits());
    } else {
      context_.findings.add(
          rules::range, node.span,
          fmt::format("{}{} does not fit {} bits", number.is_negative ? "-" : "", number.magnitude, bits),
          "correct the number");
    }
  }
  template <typename E, std::enable_if_t<std::is_enum_v<E>, int> = 0>
  void read(const Node& node, E& value) {
    if (is_a(node, Kind::string) && !take_word(node.text, value)) {
      context_.findings.add(rules::word, node.span, fmt::format("unknown word {}", in_quotes(node.text)),
                            fmt::format("write one of: {}", list_of_words<E>()));
    }
  }
  template <typename E>
  static std::string list_of_words() {
    std::string list;
    for (const Word<E>& word : words_of<E>()) {
      list += (list.empty() ? "" : ", ") + std::string(word.word);
    }
    return list;
  }
  template <typename E>
  static bool take_word(std::string_view text, E& value) {
    for (const Word<E>& word : words_of<E>()) {
      if (word.word == text) {
        value = word.value;
        return true;
      }
    }
    return false;
  }

  static void read_string(const Node& node, Text& text) {
    text.text = node.text;
    text.span = node.span;
    text.is_given = true;
  }

  void read(const Node& node, Text& text) {
    if (node.kind == Kind::object) {
      read_object(node, text);
    } else if (is_a(node, Kind::string)) {
      read_string(node, text);
    }
  }

  // Reads "text" and "given".
  void read_object(const Node& node, Text& text) {
    Reader parts(node, context_);
    text.is_given = true;
    text.span = node.span;
    parts.read_text(text);
    parts.report_others();
  }
  void read_text(Text& text) {
    (*this)("given", text.is_given);
    names_.emplace_back("text");
    const Node* const written = node_.find("text");
    if (written != nullptr && is_a(*written, Kind::string)) {
      text.text = written->text;
      text.span = written->span;
    }
  }

  template <typename T>
  void read(const Node& node, Field<T>& field) {
    field.is_given = true;
    field.span = node.span;
    if (node.kind != Kind::object) {
      read(node, field.value);
      field.text = text_of(field.value);
      return;
    }
    Reader parts(node, context_);
    parts("value", field.value);
    parts.read_text(static_cast<Text&>(field));
    parts.report_others();
    if (node.find("value") == nullptr) {
      interpret(field);
    } else if (node.find("text") == nullptr && field.is_given) {
      field.text = text_of(field.value);
    } else if (!field.is_empty()) {
      compare(field);
    }
  }

  // Compares a value with its text, and reports a contradiction. Reports faults in the text of a number of an EDS, too.
  template <typename T>
  void compare(Field<T>& field) {
    if constexpr (std::is_unsigned_v<T>) {
      if (is_of_eds(context_.format)) {
        Field<T> written = field;
        interpret(written);
      }
    }
    if constexpr (std::is_unsigned_v<T> || std::is_same_v<T, Access> || std::is_same_v<T, PdoMapping>) {
      // In XML, the data type of an object is that of its parameter, even if the object has another.
      const bool is_another = std::is_same_v<T, std::uint16_t> && !is_of_eds(context_.format);
      const std::optional<T> meaning = is_another ? std::nullopt : meaning_of(field, context_.format);
      if (meaning && *meaning != field.value && !is_refused(*meaning, field)) {
        context_.findings.add(rules::contradiction, field.span,
                              fmt::format("text {} contradicts the value; the text is used", in_quotes(field.text)),
                              "change both, or remove one of them");
        field.value = *meaning;
      }
    }
  }

  // Returns whether CiA 306 does not allow the number of the text, so that the value is 0: FileVersion=300 of an EDS.
  template <typename T>
  bool is_refused(const T& meaning, const Field<T>& field) {
    if constexpr (std::is_same_v<T, std::uint32_t>) {
      const bool is_so = field.value == 0 && meaning > 0xFF;
      if (is_so) {
        context_.findings.add(codict::rules::value_range, field.span,
                              fmt::format("{} is not in the range 0 to 255", in_quotes(field.text)),
                              "correct the number");
      }
      return is_so;
    }
    return false;
  }

  template <typename T>
  static std::string text_of(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      return std::string(word_of(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      return value;
    } else {
      return std::to_string(value);
    }
  }

  template <typename T>
  void interpret(Field<T>& field) {
    if constexpr (std::is_same_v<T, std::string>) {
      field.value = field.text;
    } else if constexpr (std::is_enum_v<T>) {
      if (!field.is_empty() && !take_word(field.text, field.value)) {
        context_.findings.add(rules::word, field.span, fmt::format("unknown word {}", in_quotes(field.text)),
                              fmt::format("write one of: {}", list_of_words<T>()));
      }
    } else if constexpr (std::is_same_v<T, bool>) {
      interpret_flag(field, context_.findings);
    } else if constexpr (std::is_signed_v<T>) {
      const ParsedInteger number = parse_integer(field.text);
      field.value = static_cast<T>(number.value.bits());
      if (!field.is_empty() && !number.is_number()) {
        context_.findings.add(codict::rules::value_number, field.span,
                              fmt::format("{} is not a number", in_quotes(field.text)), "write a number");
      }
    } else {
      interpret_number(field, std::numeric_limits<T>::max(), context_.findings);
    }
  }

  void read(const Node& node, Value& value) {
    value.is_given = true;
    value.span = node.span;
    bool has_meaning = false;
    if (node.kind == Kind::object) {
      has_meaning = read_value(node, value);
    } else if (node.kind == Kind::string) {
      read_string(node, value);
    } else {
      read_meaning(node, value);
      complete(value);
    }
    const bool has_kind = node.kind == Kind::object && node.find("kind") != nullptr;
    context_.uninterpreted.push_back({&value, nullptr, has_meaning, has_kind});
  }

  // Reads a number without a text.
  void read_meaning(const Node& node, Value& value) {
    if (node.kind == Kind::real) {
      value.kind = Value::Kind::real;
      value.real = node.real;
    } else if (is_a(node, Kind::integer)) {
      value.kind = Value::Kind::integer;
      value.integer = node.integer;
    }
  }

  // Returns false if only the text is given.
  bool read_value(const Node& node, Value& value) {
    Reader parts(node, context_);
    parts("kind", value.kind);
    parts("node_id", value.adds_node_id);
    parts.read_text(static_cast<Text&>(value));
    parts.names_.emplace_back("value");
    parts.report_others();
    const Node* const meaning = node.find("value");
    if (meaning == nullptr) {
      return false;
    }
    read_meaning_of_kind(*meaning, node.find("kind") != nullptr, value);
    if (node.find("text") == nullptr) {
      complete(value);
    }
    return true;
  }

  void read_meaning_of_kind(const Node& meaning, bool has_kind, Value& value) {
    if (has_kind && value.kind == Value::Kind::octets) {
      if (is_a(meaning, Kind::string) && !read_octets(meaning.text, value.octets.edit())) {
        context_.findings.add(codict::rules::value_octets, meaning.span,
                              fmt::format("{} is not an octet string", in_quotes(meaning.text)),
                              "write pairs of hexadecimal digits");
      }
    } else if (value.kind == Value::Kind::real && meaning.kind == Kind::integer) {
      value.real = meaning.real;
    } else {
      read_meaning(meaning, value);
    }
  }

  // Sets a value to the meaning of its text for a data type. A given kind remains if it is consistent with the text;
  // without a known data type, the given meaning remains.
  void interpret_by_type(const UninterpretedValue& uninterpreted, const DataType& type) {
    const Value& given = *uninterpreted.value;
    const bool is_typed = type.kind != TypeKind::unknown && type.kind != TypeKind::structure;
    // Without a "value", texts of these kinds are interpreted, and other given kinds remain.
    const bool is_of_text = given.kind == Value::Kind::real || given.kind == Value::Kind::malformed;
    const bool keeps_given =
        uninterpreted.has_meaning ? uninterpreted.has_kind || !is_typed : uninterpreted.has_kind && !is_of_text;
    Findings ignored;
    Value value;
    const Text& written = given;
    static_cast<Text&>(value) = written;
    codict::interpret(value, type, keeps_given ? ignored : context_.findings);
    const bool is_contradiction = uninterpreted.has_meaning && contradicts(given, value);
    if (is_contradiction) {
      context_.findings.add(rules::contradiction, value.span,
                            fmt::format("text {} contradicts the value; the text is used", in_quotes(value.text)),
                            "change both, or remove one of them");
    }
    const bool keeps_kind = given.kind != Value::Kind::none && !is_typed && given.kind != value.kind;
    if (is_contradiction || !(keeps_given || keeps_kind)) {
      *uninterpreted.value = std::move(value);
    }
  }

  // Returns whether a given value contradicts its text: values of one kind differ, or the text of an integer is
  // malformed. An integer may stand for a real.
  static bool contradicts(const Value& given, const Value& value) {
    if (given.kind == Value::Kind::integer && value.kind == Value::Kind::integer) {
      return given.adds_node_id != value.adds_node_id || !are_alike(value.integer, given.integer);
    }
    if (given.kind == Value::Kind::octets && value.kind == Value::Kind::octets) {
      return *given.octets != *value.octets;
    }
    if (value.kind == Value::Kind::real) {
      return given.kind == Value::Kind::real && given.real != value.real;
    }
    return given.kind == Value::Kind::integer && value.kind == Value::Kind::malformed;
  }
  // Returns whether two integers are equal, or one is the bit pattern of the other, a negative number, in some width.
  static bool are_alike(const Integer& text, const Integer& value) {
    const std::uint64_t difference = text.bits() - value.bits();
    constexpr std::array<std::uint64_t, 8> widths = {0,
                                                     std::uint64_t{1} << 8U,
                                                     std::uint64_t{1} << 16U,
                                                     std::uint64_t{1} << 24U,
                                                     std::uint64_t{1} << 32U,
                                                     std::uint64_t{1} << 40U,
                                                     std::uint64_t{1} << 48U,
                                                     std::uint64_t{1} << 56U};
    const bool is_pattern = std::find(widths.begin(), widths.end(), difference) != widths.end();
    return text == value || (value.is_negative && !text.is_negative && is_pattern);
  }

  static void complete(Value& value) {
    if (!value.is_given) {
      return;
    }
    switch (value.kind) {
      case Value::Kind::integer: value.text = value.written_integer(); break;
      case Value::Kind::real: value.text = fmt::format("{}", value.real); break;
      case Value::Kind::octets: value.text = hexadecimal_octets(*value.octets); break;
      default: break;
    }
  }

  static bool read_octets(std::string_view digits, std::string& octets) {
    for (; digits.size() > 1; digits.remove_prefix(2)) {
      std::uint64_t octet = 0;
      if (!parse_hex(digits.substr(0, 2), octet)) {
        return false;
      }
      octets += static_cast<char>(octet);
    }
    return digits.empty();
  }

  template <typename T>
  void read(const Node& node, std::vector<T>& list) {
    if (!is_a(node, Kind::array)) {
      return;
    }
    const std::vector<const Node*> elements = elements_of<T>(node);
    list.resize(elements.size());  // not resized later: `untyped` holds pointers to the elements
    for (std::size_t n = 0; n < elements.size(); ++n) {
      read(*elements[n], list[n]);
    }
  }

  template <typename T>
  std::vector<const Node*> elements_of(const Node& node) {
    std::vector<const Node*> elements;
    for (const Node& child : node.children) {
      elements.push_back(&child);
    }
    if constexpr (std::is_same_v<T, Object>) {
      sort(elements, "index", 16);
    } else if constexpr (std::is_same_v<T, Sub>) {
      sort(elements, "sub_index", 8);
    }
    return elements;
  }

  // Sorts elements by a number that identifies them, which is 0 if it is missing or does not fit. Reports and removes
  // duplicates.
  void sort(std::vector<const Node*>& elements, std::string_view name, unsigned bits) {
    const auto key = [name, bits](const Node* element) {
      const Node* const number = element->find(name);
      return number != nullptr && fits_unsigned(number->integer, bits) ? number->integer.magnitude : 0;
    };
    std::stable_sort(elements.begin(), elements.end(), [key](const Node* a, const Node* b) { return key(a) < key(b); });
    const auto end = std::unique(elements.begin(), elements.end(), [key, name, this](const Node* a, const Node* b) {
      const bool is_second = key(a) == key(b);
      if (is_second) {
        context_.findings.add(rules::duplicate, b->span,
                              fmt::format("duplicate {} {}; the first is used", name, key(b)),
                              "remove one of them, or correct its number");
      }
      return is_second;
    });
    elements.erase(end, elements.end());
  }

  template <typename T, std::enable_if_t<std::is_class_v<T> && !std::is_base_of_v<Text, T>, int> = 0>
  void read(const Node& node, T& part) {
    if (is_a(node, Kind::object)) {
      Reader reader(node, context_);
      members(reader, part);
      reader.report_others();
    }
  }

  const Node& node_;
  Context& context_;
  std::size_t first_untyped_;
  std::vector<std::string_view> names_;
};

}  // namespace

// An EDS may begin with a bracket as well, but its section names do not begin like a value of JSON.
bool is_json(const Source& source) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::string_view bytes = source.bytes();
  const std::size_t first = bytes.find_first_not_of(blanks, mark_size(bytes));
  if (first == std::string_view::npos || bytes[first] != '[') {
    return first != std::string_view::npos && bytes[first] == '{';
  }
  const std::size_t second = bytes.find_first_not_of(blanks, first + 1);
  return second != std::string_view::npos && std::string_view("{[\"").find(bytes[second]) != std::string_view::npos;
}

namespace {

// Returns the names of the first members for a message: "a, b, c, d, …".
std::string first_members(const Node& root) {
  constexpr std::size_t most = 4;
  std::vector<std::string> names;
  for (const Node& member : root.children) {
    if (names.size() == most) {
      names.emplace_back("…");
      break;
    }
    names.push_back(member.name.substr(0, 40));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

// Returns what JSON without a schema of codict is, derived from its members.
std::string foreign_json(const Node& root) {
  if (root.kind != Kind::object) {
    return "a JSON array";
  }
  const auto has = [&root](std::string_view name) { return root.find(name) != nullptr; };
  if (has("fileInfo") && has("deviceInfo") && has("objects")) {
    return "a project of CANopenEditor in JSON; export it as XDD or EDS";
  }
  if (has("runs") && has("version")) {
    return "a SARIF log";
  }
  if (has("$schema") && has("properties")) {
    return "a JSON Schema";
  }
  return root.children.empty() ? "an empty JSON object" : "JSON with the members " + first_members(root);
}

}  // namespace

std::string refusal(const Document& document) {
  if (!document.fault().empty()) {
    return document.fault();
  }
  const Node* const name = document.root().find("schema");
  const std::string wanted = "\"schema\": \"" + std::string(schema) + "\"";
  if (name == nullptr || name->kind != Kind::string) {
    return fmt::format("line 1, column 1: this is {}: no device description, which has {}",
                       foreign_json(document.root()), wanted);
  }
  const Position place = document.source().position(name->span.begin);
  const std::string where = fmt::format("line {}, column {}: ", place.line, place.column);
  if (name->text.substr(0, 14) == "codict-device-" && name->text != schema) {
    return where + "version " + name->text.substr(14) + " of the schema: this codict reads " + wanted;
  }
  if (name->text.substr(0, 7) == "codict-" && name->text != schema) {
    return where + name->text + " is the output of a command, no device description, which has " + wanted;
  }
  if (name->text != schema) {
    return where + "another schema, " + name->text.substr(0, 80) + ": no device description, which has " + wanted;
  }
  const Node* const devices = document.root().find("devices");
  const bool is_any = devices != nullptr && devices->kind == Kind::array && !devices->children.empty();
  return is_any ? std::string() : where + "there are no devices";
}

Description read(const Document& document, Findings& findings) {
  Context context{findings, {}};
  Description description;
  std::string name;
  Reader reader(document.root(), context);
  reader("schema", name);
  reader("devices", description.devices);
  reader.report_others();
  findings.sort();
  return description;
}

}  // namespace lexican::codict::json
