// SPDX-License-Identifier: Apache-2.0
#include "json/write.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "json/document.hpp"
#include "json/members.hpp"
#include "json/words.hpp"

namespace lexican::codict::json {

namespace {

Node node_of(std::string_view text) {
  Node node;
  node.kind = Kind::string;
  node.text = text;
  return node;
}

Node node_of(const std::string& text) { return node_of(std::string_view(text)); }

Node node_of(bool value) {
  Node node;
  node.kind = Kind::boolean;
  node.boolean = value;
  return node;
}

Node node_of(Integer value) {
  Node node;
  node.kind = Kind::integer;
  node.integer = value;
  return node;
}

Node node_of(double value) {
  Node node;
  node.kind = Kind::real;
  node.real = value;
  return node;
}

template <typename T, std::enable_if_t<std::is_integral_v<T> && !std::is_same_v<T, bool>, int> = 0>
Node node_of(T value) {
  return node_of(value < T{} ? Integer(0 - static_cast<std::uint64_t>(value), true)
                             : Integer(static_cast<std::uint64_t>(value)));
}

template <typename E, std::enable_if_t<std::is_enum_v<E>, int> = 0>
Node node_of(E value) {
  return node_of(word_of(value));
}

void add(Node& object, std::string_view name, Node member) {
  member.name = name;
  object.children.push_back(std::move(member));
}

Node object() {
  Node node;
  node.kind = Kind::object;
  return node;
}

// Adds the text of a field. "given" is false if the description does not have it, but a standard defines its value.
void add_text(Node& node, const Text& text) {
  if (text.is_given || !text.is_empty()) {
    add(node, "text", node_of(text.text));
  }
  if (!text.is_given) {
    add(node, "given", node_of(false));
  }
}

Node node_of(const Text& text) {
  if (text.is_given) {
    return node_of(text.text);
  }
  Node node = object();
  add_text(node, text);
  return node;
}

template <typename T>
Node node_of(const Field<T>& field) {
  Node node = object();
  add(node, "value", node_of(field.value));
  add_text(node, field);
  return node;
}

Node node_of(const Value& value) {
  Node node = object();
  add(node, "kind", node_of(value.kind));
  if (value.kind == Value::Kind::integer) {
    add(node, "value", node_of(value.integer));
    if (value.adds_node_id) {
      add(node, "node_id", node_of(true));
    }
  } else if (value.kind == Value::Kind::octets) {
    add(node, "value", node_of(hexadecimal_octets(*value.octets)));
  } else if (value.kind == Value::Kind::real && std::isfinite(value.real)) {  // JSON has no infinity and NaN
    add(node, "value", node_of(value.real));
  }
  add_text(node, value);
  return node;
}

bool says_nothing(bool value) { return !value; }
bool says_nothing(const std::string& text) { return text.empty(); }
bool says_nothing(std::uint16_t value) { return value == 0; }
bool says_nothing(const Text& text) { return !text.is_given && text.is_empty(); }
bool says_nothing(const Value& value) {
  return says_nothing(static_cast<const Text&>(value)) && value.kind == Value::Kind::none;
}
template <typename T>
bool says_nothing(const Field<T>& field) {
  return says_nothing(static_cast<const Text&>(field)) && field.value == T{};
}

template <typename T>
Node part_of(const T& part);

class Writer {
 public:
  static constexpr bool is_reading = false;

  explicit Writer(Node& node) : node_(node) {}

  template <typename T>
  void required(std::string_view name, const T& value) {
    add(node_, name, node_of(value));
  }
  template <typename T>
  void operator()(std::string_view name, const T& member) {
    if constexpr (std::is_class_v<T> && !std::is_base_of_v<Text, T> && !std::is_same_v<T, std::string>) {
      Node node = part_of(member);
      if (!node.children.empty()) {
        add(node_, name, std::move(node));
      }
    } else if (!says_nothing(member)) {
      add(node_, name, node_of(member));
    }
  }
  template <typename T>
  void operator()(std::string_view name, const std::vector<T>& members) {
    if (members.empty()) {
      return;
    }
    Node array;
    array.kind = Kind::array;
    for (const T& member : members) {
      if constexpr (std::is_base_of_v<Text, T>) {
        array.children.push_back(node_of(member));
      } else {
        array.children.push_back(part_of(member));
      }
    }
    add(node_, name, std::move(array));
  }
  template <typename T>
  void operator()(std::string_view name, const Rare<T>& member) {
    (*this)(name, *member);
  }
  template <typename T>
  void end_of(const T& /*part*/) {}

 private:
  Node& node_;
};

template <typename T>
Node part_of(const T& part) {
  Node node = object();
  Writer writer(node);
  members(writer, part);
  return node;
}

}  // namespace

std::string write(const Description& description) {
  Node root = object();
  Writer writer(root);
  writer.required("schema", schema);
  writer("devices", description.devices);
  return print(root);
}

}  // namespace lexican::codict::json
